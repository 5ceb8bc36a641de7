"""What the source compiler refuses, and what it must not confuse."""

import math
from dataclasses import dataclass

import numpy as np
import pytest

from lasersph.compute.source import SourceUnit, is_current
from lasersph.compute.values import LoopSourceError
from lasersph.compute.vectors import interpolate, interpolation_slope, inverse, multilinear, vector

REAL, WHOLE, PLANE = ("real", ()), ("int", ()), ("real", (2,))
LIMIT = 3.0


def reads_list(T):
    return [T]


def calls_itself(T):
    return calls_itself(T - 1)


def changes_shape(x):
    y = 1.0
    y = x
    return y


def forgets(T):
    if T > 0:
        return T


def mixes(x, M):
    return x + M


def limited(T):
    return min(T, LIMIT)


def starred(*T):
    return T


def exact(T):
    return 0.1 * T


def unknown(T):
    return T + undefined_name  # noqa: F821  # pyright: ignore[reportUndefinedVariable]


def whole(kind, count):
    return kind + 1 if count == 2 else kind


def along_axes(x):
    total = 0.0
    for k in range(len(x)):
        if x[k] > 1.0:
            return -1.0
        total += (k + 1) * x[k]
    for k in range(len(x) - 1, -1, -1):
        total = 2.0 * total - x[k]
    return total


def corner_weights(place):
    return multilinear(place)


def names_of_temporary_values(t):
    return 2.0 * t


def breaks(x):
    total = 0.0
    for k in range(len(x)):
        if x[k] > 1.0:
            break
        total += x[k]
    return total


def powers(x):
    return x**2, x**-3, x**0.5, x**1.5, x**2.7, x**0


@pytest.mark.parametrize(
    ("function", "kinds", "message"),
    [
        (reads_list, (REAL,), r"reads_list\(\) at .*test_source.py:\d+: .*`\[T\]`"),
        (calls_itself, (REAL,), "calls itself"),
        (changes_shape, (PLANE,), "y changes"),
        (forgets, (REAL,), "not every path returns"),
        (mixes, (PLANE, ("real", (2, 2))), "do not fit"),
        (starred, (REAL,), "plain arguments"),
        (names_of_temporary_values, (PLANE,), "cannot have the name t"),
        (unknown, (REAL,), "undefined_name is not defined"),
        (len, (REAL,), "not a plain Python function"),
        (lambda T: T, (REAL,), "not written as a plain"),
    ],
)
def test_refusals(function, kinds, message):
    """Each refusal names the function and the place."""
    with pytest.raises(LoopSourceError, match=message):
        SourceUnit().add(function, kinds)


def test_closure_is_refused():
    """Enclosing variables would enter without being seen."""
    factor = 2.0

    def scaled(T):
        return factor * T

    with pytest.raises(LoopSourceError, match="factor of an enclosing function"):
        SourceUnit().add(scaled, (REAL,))


def test_literals_keep_every_bit():
    """A literal enters by repr(), wrapped in the working precision."""
    unit = SourceUnit()
    unit.add(exact, (REAL,))
    assert "real(0.1) * T" in unit.texts[0]


def test_integers_stay_integers():
    """Integer arguments meet integer literals without a conversion."""
    unit = SourceUnit()
    _name, kind = unit.add(whole, (WHOLE, WHOLE))
    assert kind == WHOLE
    assert "(kind + 1)" in unit.texts[0] and "(count == 2)" in unit.texts[0]


def test_powers_are_products():
    """Whole and half powers become products and roots; others stay pow()."""
    unit = SourceUnit()
    unit.add(powers, (REAL,))
    assert "**" not in unit.texts[0]
    assert unit.texts[0].count("math.pow(") == 1


def test_changed_constant_is_noticed(monkeypatch):
    """A global name that means something else makes the unit stale."""
    unit = SourceUnit()
    unit.add(limited, (REAL,))
    watched = unit.watched()
    assert is_current(watched)
    monkeypatch.setitem(globals(), "LIMIT", 4.0)
    assert not is_current(watched)


def test_changed_constant_changes_the_result(backend, monkeypatch):
    """The same function object with another constant gives the new result."""
    out = backend.zeros(1)
    field = {"T": backend.asarray([9.0])}
    backend.pointwise(limited, field, out)
    assert backend.to_host(out)[0] == 3.0
    monkeypatch.setitem(globals(), "LIMIT", 4.0)
    backend.pointwise(limited, field, out)
    assert backend.to_host(out)[0] == 4.0


@dataclass(frozen=True)
class Constants:
    """Constants may stand in an object."""

    speed: float = 2.5
    axis: tuple[float, ...] = (0.0, 2.0)


WATER = Constants()


def with_object(x):
    return WATER.speed * x[0] + math.pi * WATER.axis[1] + np.pi


def test_constants_of_objects(backend):
    """Attributes of module constants, of math and of numpy are literals."""
    out = backend.zeros(1)
    backend.pointwise(with_object, {"x": backend.asarray([[4.0], [5.0]])}, out)
    assert backend.to_host(out)[0] == pytest.approx(10 + 3 * math.pi)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_loops_over_axes_are_written_out(backend, dimension):
    """Components by the number of the axis, forward and backward, with a return on the way."""
    x = np.random.default_rng(2).normal(size=(dimension, 5))
    out = backend.zeros(5)
    backend.pointwise(along_axes, {"x": backend.asarray(x)}, out)
    expected = [along_axes(x[:, k]) for k in range(5)]
    assert backend.to_host(out) == pytest.approx(expected, rel=1e-14)
    assert len({value == -1.0 for value in expected}) == 2 or dimension == 1
    with pytest.raises(LoopSourceError, match="cannot break"):
        SourceUnit().add(breaks, (("real", (dimension,)),))


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_multilinear_weights(backend, dimension):
    """Products over the axes, the last axis fastest: their sum is 1, the mean corner the place."""
    t = np.array([[0.25, 0.0], [0.5, 1.0], [0.125, 0.5]])[:dimension]
    out = backend.zeros((2**dimension, 2))
    backend.pointwise(corner_weights, {"place": backend.asarray(t)}, out)
    weights, corners = backend.to_host(out), np.array(list(np.ndindex((2,) * dimension))).T
    assert weights[:, 0].tolist() == [
        np.prod(np.where(corner, t[:, 0], 1.0 - t[:, 0])) for corner in corners.T
    ]
    assert weights.sum(axis=0) == pytest.approx([1.0, 1.0])
    assert corners @ weights == pytest.approx(t)
    assert multilinear(t[:, 1]) == pytest.approx(weights[:, 1])


def test_vectors_in_plain_python():
    """The helpers are NumPy outside loops; tables are extended along their end segments."""
    np.testing.assert_allclose(inverse(np.array([[2.0, 0], [0, 4]])), [[0.5, 0], [0, 0.25]])
    assert vector(1.0, 2.0).tolist() == [1.0, 2.0]
    nodes, values = np.array([0.0, 1, 3]), np.array([0.0, 10, 20])
    assert [interpolate(x, nodes, values) for x in (-1, 0.5, 1, 2, 5)] == [-10, 5, 10, 15, 30]
    assert [interpolation_slope(x, nodes, values) for x in (-1, 0.5, 1, 5)] == [10, 10, 5, 5]
