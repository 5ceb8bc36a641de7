"""Binding of launches in compiled code, or in Python where arrays are laid out otherwise."""

import numpy as np

from lasersph import compute
from lasersph.compute import loops
from lasersph.compute.rebinding import has_known_layout


def doubled(a):
    """Twice a field."""
    return 2.0 * a


def doubles(backend):
    """A loop run with two pairs of arrays: the second call finds the launch of the first."""
    found = []
    for values in (np.arange(3.0), np.arange(5.0)):
        out = backend.zeros(values.size)
        backend.pointwise(doubled, {"a": backend.asarray(values)}, out)
        found.append(backend.to_host(out))
    return found


def test_layout_is_known():
    """The structure of arrays is the one that the compiled code reads."""
    assert has_known_layout()


def test_same_results_without_the_layout(monkeypatch):
    """An unknown layout costs time and changes no result."""
    expected = doubles(compute.cpu(threads=1))
    monkeypatch.setattr(loops, "has_known_layout", lambda: False)
    monkeypatch.setattr(loops, "Rebound", None)
    for one, other in zip(doubles(compute.cpu(threads=1)), expected, strict=True):
        np.testing.assert_array_equal(one, other)


def both_halves(a):
    """Half of a field, and its other half."""
    return 0.5 * a, 0.25 * a


def test_calls_that_store_different_results():
    """A launch is not taken by a call that stores other ones of the results."""
    backend = compute.cpu(threads=1)
    a, first, second = backend.asarray([4.0, 8.0]), backend.zeros(2), backend.zeros(2)
    backend.pointwise(both_halves, {"a": a}, (first, None))
    backend.pointwise(both_halves, {"a": a}, (None, second))
    assert first.tolist() == [2.0, 4.0] and second.tolist() == [1.0, 2.0]
