"""The strict backend's arrays refuse NumPy; the backend's own operations accept them."""

import operator

import numpy as np
import pytest

from lasersph import compute
from lasersph.compute.kept_array import KeptArray


@pytest.fixture
def strict():
    """Strict backend."""
    return compute.strict(threads=1)


@pytest.mark.parametrize(
    "attempt",
    [
        np.sqrt,
        np.sum,
        np.asarray,
        lambda a: np.concatenate([a, a]),
        abs,
        len,
        list,
        float,
        bool,
        operator.neg,
        lambda a: a + 1,
        lambda a: 1 + a,
        lambda a: a * a,
        lambda a: a < 2,
        lambda a: a == a,
        lambda a: np.ones(2) + a,
        lambda a: a[0],
        lambda a: operator.setitem(a, 0, 1.0),
        lambda a: operator.iadd(a, 1.0),
    ],
)
def test_refusals(strict, attempt):
    """Functions, operators, indexing and conversions raise with one clear line."""
    array = strict.asarray([1.0, 2.0])
    with pytest.raises(TypeError, match=r"on a backend's array; use the backend's loops"):
        attempt(array)


def test_foreign_arrays(strict):
    """A NumPy array is refused where a backend's array is needed."""
    with pytest.raises(TypeError, match=r"ndarray given; make it with backend.asarray\(\)"):
        strict.fill(np.zeros(3), 1.0)


def test_arrays(backend):
    """zeros, asarray, fill, copy, gather, head and to_host on every backend."""
    a = backend.zeros((2, 3))
    assert a.shape == (2, 3) and a.dtype == np.float64 and a.ndim == 2 and a.size == 6
    backend.fill(a, 2.0)
    b = backend.asarray([[1.0, 2, 3], [4, 5, 6]])
    backend.copy(b, a)
    backend.fill(b, 0.0)
    order = backend.asarray([2, 0, 1], "index")
    backend.gather(a, order, b)
    assert backend.to_host(b).tolist() == [[3, 1, 2], [6, 4, 5]]
    backend.fill(backend.head(b, 1), 9.0)
    assert backend.to_host(b).tolist() == [[9, 1, 2], [9, 4, 5]]
    host = backend.to_host(a)
    host[:] = 0.0
    assert backend.to_host(a)[0, 0] == 1.0
    kinds = {kind: backend.zeros(1, kind).dtype for kind in ("index", "offset", "flag", "single")}
    expected = {"index": np.uint32, "offset": np.uint64, "flag": np.uint8, "single": np.float32}
    assert kinds == expected
    with pytest.raises(ValueError, match="kind must be"):
        backend.zeros(1, "double")
    with pytest.raises(ValueError, match="copy of shape"):
        backend.copy(a, backend.zeros(3))
    with pytest.raises(ValueError, match="the first 4 of 3"):
        backend.head(a, 4)


def test_scan_and_sort(backend):
    """Running sums start at zero; sorting by key keeps the order of equal keys."""
    counts, out = backend.asarray([2, 0, 3], "index"), backend.zeros(4, "offset")
    backend.exclusive_scan(counts, out)
    assert backend.to_host(out).tolist() == [0, 2, 2, 5]
    keys = backend.asarray([1, 0, 1, 0], "index")
    assert backend.to_host(backend.sort_by_key(keys, 2)).tolist() == [1, 3, 0, 2]
    assert backend.to_host(backend.sort_by_key(keys, 1 << 17)).tolist() == [1, 3, 0, 2]
    assert backend.to_host(backend.count_by_key(keys, 3)).tolist() == [2, 2, 0]
    with pytest.raises(ValueError, match="key 1 is not below 1"):
        backend.sort_by_key(keys, 1)
    with pytest.raises(ValueError, match="key 1 is not below 1"):
        backend.count_by_key(keys, 1)


def test_components(backend):
    """Of vectors, and of tensors row by row."""
    for shape in ((2, 5), (2, 2, 5)):
        values = np.arange(float(np.prod(shape))).reshape(shape)
        for k, row in enumerate(values.reshape(-1, 5)):
            found = backend.component(backend.asarray(values), k)
            assert backend.to_host(found).tolist() == row.tolist()


def test_single_precision_copies(backend):
    """A copy is an array of its own, or lies in one that is kept."""
    first = backend.single(backend.asarray([0.1, 0.2]))
    assert first.dtype == np.float32 and backend.single(first) is first
    assert backend.to_host(first).tolist() == np.float32([0.1, 0.2]).tolist()
    kept = KeptArray(backend, kind="single")
    copy = backend.single(backend.asarray([0.3, 0.4]), kept.of)
    assert backend.single(backend.asarray([0.5, 0.6]), kept.of) is copy
    assert backend.to_host(copy).tolist() == np.float32([0.5, 0.6]).tolist()


def test_kept_arrays(backend):
    """The same array for the same length, the same memory for lengths that it has room for."""
    kept = KeptArray(backend, 2)
    array = kept.of(4)
    assert array.shape == (2, 4) and kept.of(4) is array
    backend.copy(backend.asarray([[1.0, 2.0, 3.0, 4.0], [5.0, 6.0, 7.0, 8.0]]), array)

    # longer and shorter, within the room for half as many more that all have
    longer = kept.of(6)
    assert longer is not array
    assert backend.to_host(longer).tolist() == [[1, 2, 3, 4, 0, 0], [5, 6, 7, 8, 0, 0]]
    backend.fill(longer, 9.0)
    assert backend.to_host(kept.of(3)).tolist() == [[9, 9, 9], [9, 9, 9]]

    # beyond that it begins with zeros, and where far fewer are left
    assert backend.to_host(kept.of(13)).tolist() == [[0] * 13] * 2
    backend.fill(kept.of(13), 8.0)
    assert backend.to_host(kept.of(4)).tolist() == [[8] * 4] * 2
    assert backend.to_host(kept.of(3)).tolist() == [[0] * 3] * 2


def test_capacity():
    """Twice as many; more where memory is not taken before it is written, little of very many."""
    backend = compute.cpu(threads=1)
    assert backend.capacity_for(100) == 200
    assert backend.capacity_for(2**19 - 1) == 2**20 - 2 and backend.capacity_for(2**19) == 2**22
    assert backend.capacity_for(2**23) == 2**26 and backend.capacity_for(2**24) == 9 * 2**21


def test_unset_elements_show(strict):
    """What no loop has set is no number, here; in a graph it is whatever the memory held."""
    assert np.isnan(strict.to_host(strict.unset((2, 3)))).all()
