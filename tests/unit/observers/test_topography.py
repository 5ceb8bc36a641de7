"""The relief of a surface: closed forms of its parameters, places between columns, the observer."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt

import numpy as np
import pytest

from lasersph.observers.relief import Relief
from lasersph.observers.topography import (
    Topography,
    first_harmonic,
    profile_parameters,
    shape_of_spot,
)

PERIOD = 5e-6
A = 50e-9


def columns(width, count):
    """Centers of equal columns from 0 on [m]."""
    return (np.arange(count) + 0.5) * width / count


@dataclass
class Seen:
    """What the observer reads of a view."""

    relief: Relief | None
    time: float = 1.0
    limit: str = "stability"


@pytest.mark.parametrize(("width", "beyond"), [(0.5, "mirror"), (1.0, "periodic"), (2.0, "mirror")])
def test_cosine(width, beyond):
    """Pa = 2 a/pi, Pq = a/sqrt 2, Pz = 2 a, Psk = 0, a1 = a; a tilt of the level changes none."""
    x = columns(width * PERIOD, 600)
    relief = Relief(x, A * np.cos(2.0 * pi * x / PERIOD) - 3e-9, beyond)
    Pa, Pq, Pz, Psk = profile_parameters(relief)
    assert Pa == pytest.approx(2.0 * A / pi, rel=2e-5)
    assert Pq == pytest.approx(A / sqrt(2.0), rel=1e-12)
    assert Pz == pytest.approx(2.0 * A, rel=1e-6)
    assert abs(Psk) < 1e-12
    assert first_harmonic(relief, PERIOD) == pytest.approx(A, rel=1e-12)
    assert relief.width == pytest.approx(width * PERIOD)


def test_half_and_whole_period_are_the_same():
    """A relief with harmonics: every parameter of half a period is that of the whole."""
    x = columns(PERIOD, 500)
    z = A * (np.cos(2 * pi * x / PERIOD) + 0.3 * np.cos(4 * pi * x / PERIOD)) - 0.1 * A
    whole, half = Relief(x, z, "periodic"), Relief(x[:250], z[:250], "mirror")
    assert profile_parameters(half) == pytest.approx(profile_parameters(whole), rel=1e-9)
    assert first_harmonic(half, PERIOD) == pytest.approx(first_harmonic(whole, PERIOD), rel=1e-9)
    # skewness by hand: mean z^3 = 3/4 a^2 b, mean z^2 = (a^2 + b^2) / 2
    expected = 0.75 * 0.3 / (0.5 * (1.0 + 0.3**2)) ** 1.5
    assert profile_parameters(whole).Psk == pytest.approx(expected, rel=1e-9)


def test_square_wave_and_plane():
    """Half up, half down: Pa = Pq = a, Psk = 0; a plane has none of anything."""
    x = columns(PERIOD, 100)
    square = Relief(x, np.where(x < 0.5 * PERIOD, A, -A), "periodic")
    assert profile_parameters(square)[:2] == pytest.approx((A, A))
    assert profile_parameters(Relief(x, np.full(100, 2e-9))) == (0.0, 0.0, 0.0, 0.0)


def test_extremes_lie_between_columns():
    """The vertex of a parabola at 0.37 columns from a center is found exactly; mirrored ends have
    theirs on the plane of symmetry, a pinned end keeps that of its column."""
    x = columns(1e-6, 20)
    top = x[7] + 0.37 * 5e-8
    relief = Relief(x, 1e-8 - 1e5 * (x - top) ** 2)
    assert relief.highest() == pytest.approx((top, 1e-8), rel=1e-9)
    cosine = np.cos(pi * x / 1e-6)
    place, height = Relief(x, cosine, "mirror").highest()
    assert (place, height) == (pytest.approx(0.0, abs=1e-15), pytest.approx(1.0, abs=1e-4))
    assert Relief(x, cosine, "pinned").highest() == (x[0], cosine[0])


def test_observer():
    """Depth and rim from the original surface; without a period no first harmonic."""
    x = columns(0.5 * PERIOD, 400)
    relief = Relief(x, -2.0 * A * np.cos(2.0 * pi * x / PERIOD) - A)
    observer = Topography(PERIOD)
    row = observer.observe(Seen(relief))
    assert row["topography.depth_m"] == pytest.approx(3.0 * A, rel=1e-5)
    assert row["topography.rim_height_m"] == pytest.approx(A, rel=1e-4)
    assert row["topography.peak_to_valley_m"] == pytest.approx(4.0 * A, rel=1e-5)
    found = observer.summary()["topography"]
    assert found["first_harmonic_m"] == pytest.approx(-2.0 * A)
    assert (found["lowest_x_m"], found["rim_x_m"]) == pytest.approx((0.0, 0.5 * PERIOD), abs=1e-15)
    again = Topography(PERIOD)
    again.restore(observer.state())
    assert again.summary() == observer.summary()
    plain = Topography()
    plain.observe(Seen(relief))
    assert "first_harmonic_m" not in plain.summary()["topography"]


def test_volumes_of_rings():
    """A bowl -a (1 - (r/R)^2) over the whole radius has the volume pi a R^2 / 2 of the paraboloid,
    in a plane half a width of 2/3 a R, in both halves twice that; the mirrored end has -a."""
    x = columns(PERIOD, 400)
    height = -A * (1.0 - (x / PERIOD) ** 2)
    ring = Relief(x, height, is_section=True)
    assert np.sum(ring.area) == pytest.approx(pi * PERIOD**2, rel=1e-12, abs=0.0)
    assert ring.volumes() == (pytest.approx(0.5 * pi * A * PERIOD**2, rel=1e-5, abs=0.0), 0.0)
    assert ring.center == pytest.approx(-A, rel=1e-12, abs=0.0)
    both = Relief(x, -height, mirror_images=2)
    assert both.volumes() == (0.0, pytest.approx(4.0 / 3.0 * A * PERIOD, rel=1e-5, abs=0.0))
    row = Topography(is_section=True).observe(Seen(ring))
    assert row["topography.center_m"] == ring.center
    assert row["topography.displaced_volume_m3"] == ring.volumes()[0]


@pytest.mark.parametrize("count", [99, 100])
def test_height_in_the_middle_of_a_plane_relief(count):
    """A cubic is met exactly, whether a column or a face lies at x = 0."""
    x = columns(PERIOD, count) - 0.5 * PERIOD
    relief = Relief(x, A * (1.0 + x / PERIOD + (x / PERIOD) ** 3), "periodic")
    assert relief.center == pytest.approx(A, rel=1e-12, abs=0.0)


def test_shapes_of_a_spot():
    """A dimple with its rim, a bump with the moat that it leaves, a bump within a rim, a plane."""
    r = columns(PERIOD, 100) / PERIOD
    peak = np.exp(-((r / 0.2) ** 2))
    ring = np.exp(-(((r - 0.6) / 0.1) ** 2))
    shapes = {
        "bowl": 0.3 * ring - peak,
        "bump": peak - 0.2 * ring,
        "sombrero": 0.4 * peak - 0.5 * np.exp(-(((r - 0.35) / 0.1) ** 2)) + ring,
        "flat": 0.0 * r,
    }
    for shape, height in shapes.items():
        relief = Relief(r * PERIOD, A * height, is_section=True)
        assert shape_of_spot(relief) == shape
        observer = Topography(is_section=True)
        observer.observe(Seen(relief))
        assert observer.summary()["topography"]["shape"] == shape


def test_refusals():
    """Too few or uneven columns, a width that is no half periods, a flat surface."""
    x = columns(PERIOD, 10)
    with pytest.raises(ValueError, match="three columns"):
        Relief(x[:2], x[:2])
    with pytest.raises(ValueError, match="equally wide"):
        Relief(x**2, x)
    with pytest.raises(ValueError, match="no whole half periods"):
        first_harmonic(Relief(x, x), 0.7 * PERIOD)
    with pytest.raises(ValueError, match="does not move"):
        Topography().observe(Seen(None))
