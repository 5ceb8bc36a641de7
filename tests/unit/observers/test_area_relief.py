"""Relief in 3-D: closed forms of its parameters on a dot, places between columns, the observer."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi

import numpy as np
import pytest

from lasersph.observers.area_relief import AreaRelief
from lasersph.observers.areal_parameters import areal_parameters
from lasersph.observers.topography import Topography

LX, LY, A = 5e-6, 4e-6, 50e-9


@dataclass
class Seen:
    """What the observer reads of a view."""

    relief: AreaRelief | None
    time: float = 1.0
    limit: str = "stability"


def dot(share_x=1.0, share_y=1.0, *, columns=(200, 160), beyond=None, level=0.0):
    """z = a cos kx cos ky + level over parts of a period, from -L/2 or from 0 on."""
    nx, ny = (round(n * share) for n, share in zip(columns, (share_x, share_y), strict=True))
    x = (np.arange(nx) + 0.5) * LX / columns[0] - (0.5 * LX if share_x == 1.0 else 0.0)
    y = (np.arange(ny) + 0.5) * LY / columns[1] - (0.5 * LY if share_y == 1.0 else 0.0)
    z = A * np.cos(2 * pi * x / LX)[:, None] * np.cos(2 * pi * y / LY) + level
    ends = ["periodic" if share == 1.0 else "mirror" for share in (share_x, share_y)]
    return AreaRelief(x, y, z, tuple(beyond or ends), round(1.0 / (share_x * share_y)))


PARTS = [(1.0, 1.0), (0.5, 1.0), (0.5, 0.5)]


@pytest.mark.parametrize("parts", PARTS)
def test_dot(parts):
    """Sa = 4 a/pi^2, Sq = a/2, Sz = 2 a, Ssk = 0, Sdr = a^2 (kx^2 + ky^2)/8, a11 = a less what
    columns average, the height in the middle a; of the whole, its half and its quarter."""
    relief = dot(*parts, level=-3e-9)
    Sa, Sq, Sz, Ssk, Sdr = relief.parameters()
    assert Sa == pytest.approx(4.0 * A / pi**2, rel=1e-3, abs=0.0)
    assert Sq == pytest.approx(0.5 * A, rel=1e-12, abs=0.0)
    assert Sz == pytest.approx(2.0 * A, rel=1e-3, abs=0.0)
    assert abs(Ssk) < 1e-12
    steepness = (2 * pi / LX) ** 2 + (2 * pi / LY) ** 2
    assert Sdr == pytest.approx(A**2 * steepness / 8.0, rel=3e-3, abs=0.0)
    averaged = np.sinc(1.0 / 200) * np.sinc(1.0 / 160)
    assert relief.first_harmonic(LX, LY) == pytest.approx(A * averaged, rel=1e-12, abs=0.0)
    assert abs(relief.first_harmonic(LX)) < 1e-12 * A
    assert relief.center == pytest.approx(A - 3e-9, rel=1e-6, abs=0.0)


def test_parts_are_the_whole():
    """Half and quarter have the parameters and volumes of the whole period."""
    whole, half, quarter = (dot(*parts, level=7e-9) for parts in PARTS)
    for part in (half, quarter):
        for found, expected in zip(part.parameters(), whole.parameters(), strict=True):
            assert found == pytest.approx(expected, rel=1e-9, abs=1e-12 * (expected < 1e-12))
        assert part.volumes() == pytest.approx(whole.volumes(), rel=1e-12, abs=0.0)
        assert part.first_harmonic(LX, LY) == pytest.approx(whole.first_harmonic(LX, LY), abs=1e-20)


def test_volumes():
    """A paraboloid -a (1 - r^2/R^2) within R has the volume pi a R^2/2; a quarter counts whole."""
    side, R = 2e-6, 1.5e-6
    x = (np.arange(400) + 0.5) * side / 400
    z = -A * np.maximum(1.0 - (x[:, None] ** 2 + x**2) / R**2, 0.0)
    missing, raised = AreaRelief(x, x, z, mirror_images=4).volumes()
    assert missing == pytest.approx(0.5 * pi * A * R**2, rel=1e-4, abs=0.0) and raised == 0.0


def test_wave_of_whole_periods_is_no_slope():
    """A sine over x has Sq = a/sqrt 2 as periods; the least-squares plane would take a part."""
    x = (np.arange(60) + 0.5) * LX / 60
    relief = AreaRelief(
        x, x, np.repeat(A * np.sin(2 * pi * x / LX)[:, None], 60, 1), 2 * ("periodic",)
    )
    assert relief.parameters().Sq == pytest.approx(A / np.sqrt(2.0), rel=1e-12, abs=0.0)
    assert areal_parameters(relief.height.T, 1e-8, 1e-8).Sq < 0.8 * relief.parameters().Sq
    tilted = replace(relief, beyond=("pinned", "pinned"))
    assert tilted.parameters().Sq == areal_parameters(relief.height.T, *relief.steps).Sq


def test_extremes_lie_between_columns():
    """The vertex of a paraboloid with a twist is found exactly; mirrored ends have theirs on the
    planes, a pinned end keeps that of its column, and what is even along y the middle of one."""
    x = (np.arange(20) + 0.5) * 5e-8
    at = x[7] + 0.37 * 5e-8, x[11] - 0.21 * 5e-8
    s, t = np.meshgrid(x - at[0], x - at[1], indexing="ij")
    found = AreaRelief(x, x, 1e-8 - 1e5 * (s**2 + 0.8 * s * t + 2.0 * t**2)).highest()
    assert found[0] == pytest.approx(at, rel=1e-9) and found[1] == pytest.approx(1e-8, rel=1e-9)
    corner = np.cos(pi * x / 1e-6)[:, None] * np.cos(pi * x / 1e-6)
    place, height = AreaRelief(x, x, corner).highest()
    assert place == pytest.approx((0.0, 0.0), abs=1e-15) and height == pytest.approx(1.0, abs=1e-4)
    pinned = AreaRelief(x, x, corner, ("pinned", "pinned")).highest()
    assert pinned == ((x[0], x[0]), corner[0, 0])
    even = np.repeat(np.cos(pi * x / 1e-6)[:, None], 20, 1)
    assert AreaRelief(x, x, even).lowest()[0][1] in x


def test_observer():
    """Depth and rim from the original surface, places, areal parameters, first harmonic."""
    observer = Topography(LX, LY, dimensions=3)
    row = observer.observe(Seen(dot(0.5, 0.5, level=-A)))
    assert row["topography.depth_m"] == pytest.approx(2.0 * A, rel=1e-4, abs=0.0)
    assert row["topography.rim_height_m"] == pytest.approx(0.0, abs=1e-4 * A)
    assert "topography.Pa_m" not in row
    found = observer.summary()["topography"]
    assert found["Sq_m"] == pytest.approx(0.5 * A, rel=1e-12, abs=0.0)
    assert found["first_harmonic_m"] == pytest.approx(A, rel=2e-4, abs=0.0)
    assert (found["rim_x_m"], found["rim_y_m"]) == pytest.approx((0.0, 0.0), abs=1e-12)
    assert sorted((found["lowest_x_m"], found["lowest_y_m"])) == pytest.approx(
        (0.0, 0.5 * LX), abs=1e-12
    ) or (found["lowest_x_m"], found["lowest_y_m"]) == pytest.approx((0.0, 0.5 * LY), abs=1e-12)
    again = Topography(LX, LY, dimensions=3)
    again.restore(observer.state())
    assert again.summary() == observer.summary()
    plain = Topography(dimensions=3)
    plain.observe(Seen(dot()))
    assert "first_harmonic_m" not in plain.summary()["topography"]


def test_refusals():
    """Too few or uneven columns, heights of another shape, no whole half periods."""
    x = (np.arange(10) + 0.5) * 1e-7
    with pytest.raises(ValueError, match="three columns"):
        AreaRelief(x[:2], x, np.zeros((2, 10)))
    with pytest.raises(ValueError, match="with heights"):
        AreaRelief(x, x[:5], np.zeros((5, 10)))
    with pytest.raises(ValueError, match="equally wide"):
        AreaRelief(x**2, x, np.zeros((10, 10)))
    with pytest.raises(ValueError, match="no whole half periods of 3e-07"):
        AreaRelief(x, x, np.zeros((10, 10))).first_harmonic(1e-6, 3e-7)
