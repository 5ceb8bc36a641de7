"""What `look` gives of an array: NumPy's array to read, copied only as far as it is looked at."""

import numpy as np
import pytest

ROWS = np.array([3, 0, -1, 3])
SCALAR = [4, -2, ROWS, np.zeros(0, np.int64), slice(None, 3), slice(1, 4), slice(None, None, 2),
          (Ellipsis, slice(None, 2)), np.array([True, False, False, True, True])]  # fmt: skip
VECTOR = [1, -1, slice(None, 1), (0, 2), (-1, ROWS), (slice(None), ROWS), (slice(None, 1), ROWS),
          (slice(None), slice(None, 3)), (1, slice(None, 3)), (Ellipsis, slice(None, 3)),
          (slice(None), 2), (slice(None, -1), 2), (slice(None, 1), slice(None, 2)),
          (1, slice(1, 3))]  # fmt: skip


@pytest.fixture
def scalar():
    """Five numbers."""
    return np.array([3.0, -1.0, 4.0, 1.0, 5.0])


@pytest.fixture
def vector():
    """Five vectors."""
    return np.arange(10.0).reshape(2, 5) ** 1.5


def same(found, expected):
    """Whether they are the same numbers in the same shape."""
    return np.shape(found) == np.shape(expected) and np.array_equal(np.asarray(found), expected)


def test_parts(backend, scalar, vector):
    """Every index means what it means to NumPy."""
    for index in SCALAR:
        assert same(backend.host_view(backend.asarray(scalar))[index], scalar[index]), index
    for index in VECTOR:
        assert same(backend.host_view(backend.asarray(vector))[index], vector[index]), index


def test_whole(backend, scalar, vector):
    """Sums, comparisons, extremes and methods are NumPy's, and nothing can be written."""
    seen, arrows = (
        backend.host_view(backend.asarray(scalar)),
        backend.host_view(backend.asarray(vector)),
    )
    assert np.max(seen) == 5.0 and seen.min() == -1.0 and float(seen.max()) == 5.0
    assert np.max(arrows) == vector.max() and same(np.min(arrows, axis=1), vector.min(axis=1))
    assert np.max(seen, where=seen < 4.5, initial=0.0) == 4.0
    assert same(2.0 * seen - 1.0, 2.0 * scalar - 1.0) and same(seen > 2.0, scalar > 2.0)
    assert same(np.sum(arrows * arrows, axis=0), np.sum(vector * vector, axis=0))
    assert same(seen.astype(np.float32), scalar.astype(np.float32))
    assert same(np.where(seen > 2.0, seen, 0.0), np.where(scalar > 2.0, scalar, 0.0))
    assert (arrows.shape, arrows.ndim, seen.size, len(seen)) == ((2, 5), 2, 5, 5)
    with pytest.raises((ValueError, TypeError)):
        seen[0] = 1.0
    with pytest.raises(IndexError):
        seen[np.array([5])]


def test_computed(backend, scalar, vector):
    """Functions, reductions and searches that a card does itself give what NumPy gives."""
    seen, arrows = (
        backend.host_view(backend.asarray(scalar)),
        backend.host_view(backend.asarray(vector)),
    )
    is_high, is_low = seen >= 3.0, ~(seen > 1.0)
    assert same(is_high, scalar >= 3.0) and same(is_high & (seen < 5.0), [1, 0, 1, 0, 0])
    assert same(is_low | is_high, [1, 1, 1, 1, 1]) and np.any(is_low) and not np.any(seen > 9.0)
    assert np.count_nonzero(is_high) == 3 and same(np.flatnonzero(is_low), [1, 3])
    assert same(seen[is_high], [3.0, 4.0, 5.0]) and same(arrows[1][is_low], vector[1, [1, 3]])
    assert same(arrows[:, is_low], vector[:, [1, 3]])
    assert np.max(seen, where=is_low, initial=-7.0) == 1.0 and np.argmin(seen) == 1
    assert np.min(seen, where=is_high, initial=9.0) == 3.0
    assert np.max(seen, where=seen > 9.0, initial=0.0) == 0.0
    assert same(np.sqrt(np.abs(-seen)) / 2.0, np.sqrt(np.abs(scalar)) / 2.0)
    assert np.sum(arrows) == pytest.approx(vector.sum())
    assert same(np.max(arrows, axis=1), vector.max(axis=1))
    even = np.broadcast_to(np.array([[1.0], [2.0]]), (2, 5))
    assert same(arrows + even, vector + even) and same(arrows - even[:, :1], vector - even)
    assert same(arrows[0] * scalar, vector[0] * scalar)  # of the host, with a value for each
    assert set(np.argpartition(seen, 1)[:2].tolist()) == {1, 3}
    order = backend.host_view(backend.asarray([0, 2, 5, 9], "index"))
    assert np.searchsorted(order, 5) == 2 and np.searchsorted(order, 10) == 4


def test_shown_and_snapshot(backend, scalar, vector):
    """A host array that never changes stands beside others; a snapshot outlives its array."""
    widths = np.array([1.0, 2.0, 3.0, 4.0, 5.0])
    array = backend.asarray(vector)
    seen, shown, kept = backend.host_view(array), backend.shown(widths), backend.snapshot(array)
    assert same(seen[0] * shown, vector[0] * widths) and np.min(shown) == 1.0
    assert same(shown[np.array([4, 0])], [5.0, 1.0]) and same(backend.shown(widths), widths)
    backend.fill(array, 0.0)
    assert same(kept, vector)


def test_no_more_than_looked_at(backend, scalar, vector, monkeypatch):
    """From a card come listed particles and extremes without the rest, and never what is old."""
    if backend.name != "cuda":
        pytest.skip("arrays of this backend lie in the host's memory")
    from lasersph.compute.cuda_array import CudaArray

    sizes, to_host = [], CudaArray.to_host
    monkeypatch.setattr(CudaArray, "to_host", lambda a: sizes.append(a.size) or to_host(a))
    array = backend.asarray(scalar)
    seen, arrows = backend.host_view(array), backend.host_view(backend.asarray(vector))
    assert seen.max() == 5.0 and seen[:4].max() == 4.0 and sizes == []
    assert same(arrows[1, :4][ROWS[:2]], vector[1, :4][ROWS[:2]]) and sizes == [2]
    assert np.cumsum(seen)[-1] + np.cumsum(seen)[-1] == 24.0 and sizes == [2, 5]
    stale = backend.host_view(array)
    backend.fill(array, 0.0)
    with pytest.raises(RuntimeError, match="after it had been written"):
        stale.max()
