"""What the source compiler refuses, and what it must not confuse."""

import math
from dataclasses import dataclass

import numpy as np
import pytest

from lasersph.compute.source import SourceUnit, is_current
from lasersph.compute.values import LoopSourceError
from lasersph.compute.vectors import interpolate, interpolation_slope, inverse, vector

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


def test_vectors_in_plain_python():
    """The helpers are NumPy outside loops; tables are extended along their end segments."""
    np.testing.assert_allclose(inverse(np.array([[2.0, 0], [0, 4]])), [[0.5, 0], [0, 0.25]])
    assert vector(1.0, 2.0).tolist() == [1.0, 2.0]
    nodes, values = np.array([0.0, 1, 3]), np.array([0.0, 10, 20])
    assert [interpolate(x, nodes, values) for x in (-1, 0.5, 1, 2, 5)] == [-10, 5, 10, 15, 30]
    assert [interpolation_slope(x, nodes, values) for x in (-1, 0.5, 1, 5)] == [10, 10, 5, 5]
