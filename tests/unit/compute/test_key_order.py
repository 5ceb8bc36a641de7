"""Members of keys in order, beside NumPy's stable sort."""

import numpy as np
import pytest

from lasersph import compute


def test_rows_by_key_are_a_stable_sort():
    """Rows of equal keys stay in order, keys without rows begin where the next one does."""
    backend = compute.cpu(threads=1)
    keys = np.random.default_rng(1).integers(0, 7, 500)
    keys[keys == 3] = 4
    start, order = backend.rows_by_key(backend.asarray(keys, "index"), 8)
    assert backend.to_host(order).tolist() == np.argsort(keys, kind="stable").tolist()
    assert backend.to_host(start).tolist() == np.searchsorted(np.sort(keys), np.arange(9)).tolist()


def test_no_rows_and_a_key_too_large():
    """Without rows every key begins at 0; a key beyond the last is refused."""
    backend = compute.cpu(threads=1)
    start, order = backend.rows_by_key(backend.zeros(0, "index"), 2)
    assert backend.to_host(start).tolist() == [0, 0, 0] and order.shape == (0,)
    with pytest.raises(ValueError, match="key 5 is not below 5"):
        backend.rows_by_key(backend.asarray([0, 5, 1], "index"), 5)


@pytest.mark.parametrize("kind", ["real", "index", "flag"])
def test_places_and_counts(kind):
    """Of a value among any kind of numbers, NaN being none; and how often each key occurs."""
    backend = compute.cpu(threads=1)
    values = np.random.default_rng(2).integers(0, 4, 99).astype(float)
    if kind == "real":
        values[3:7] = np.nan
    for wanted in (0.0, 3.0, 5.0):
        found = backend.to_host(backend.rows_where(backend.asarray(values, kind), wanted))
        assert found.tolist() == np.flatnonzero(values == wanted).tolist()
    keys = backend.asarray(np.nan_to_num(values), "index")
    counts = np.bincount(np.nan_to_num(values).astype(int), minlength=6)
    assert backend.to_host(backend.count_by_key(keys, 6)).tolist() == counts.tolist()
    with pytest.raises(ValueError, match="key 3 is not below 3"):
        backend.count_by_key(backend.asarray([0, 3], "index"), 3)
