"""Columns that are rings, and the particles that ride with them, by hand."""

import numpy as np
import pytest
from spot_pools import half_ball, spot_pool

from lasersph import compute
from lasersph.surface.columns import OwnColumns
from lasersph.surface.height_field import HeightField
from lasersph.surface.riding_surface import LARGEST_HEIGHT, LEAST_HEIGHT, is_uppermost, ride

ENDS = (("mirror", "pinned"),)
WIDTH = 2.5e-8


def rings(count=40, ends=ENDS):
    """Rings of 25 nm from the axis outward."""
    return HeightField((0.0,), (WIDTH,), (count,), ends, 3e-7, is_axisymmetric=True)


def test_curvature_of_a_cap():
    """2/R, the sum of both, on the axis as beside it."""
    line, R = rings(), 1.8e-6
    r = line.centers()
    line.height = np.sqrt(R**2 - r**2)
    line.pins = ((0.0, float(np.sqrt(R**2 - (r[-1] + 0.5 * WIDTH) ** 2))),)
    assert line.curvature[:30] == pytest.approx(2.0 / R, rel=3e-3, abs=0.0)


def test_flow_between_rings():
    """Q through a side of 2 pi 50 nm: what the second ring loses the third one gets."""
    line, Q = rings(4), np.array([0.0, 0.0, 3.0, 0.0, 0.0])
    height = line.heights_after(1e-9, Q)
    change = 3e-9 * 5e-8 / WIDTH * np.array([0.0, -1.0 / 3.75e-8, 1.0 / 6.25e-8, 0.0])
    assert height == pytest.approx(change)
    assert abs(line.volume_of(height)) < 1e-15 * line.volume_of(np.abs(height))


def test_damping_keeps_the_volume_of_rings():
    """A ring that stands out loses height to others of the same volume."""
    line = rings()
    line.height[7] = 1e-8
    before = line.volume_of(line.height)
    line.damp_short_waves(0.5)
    assert line.height[7] < 8e-9
    assert line.volume_of(line.height) == pytest.approx(before, rel=1e-12, abs=0.0)


def ridden(i, z, flows=1.0):
    """A particle of 2 m^2 at a height in the first of two columns, 1 m wide: base -4 m, twice as
    high after 2 s, 0.5 m evaporated."""
    tables = {"base": np.array([-4.0, 0.0]), "ratio": np.array([2.0, 1.0])}
    tables |= {
        "lost": np.array([0.5, 0.0]),
        "start": (0.0,),
        "inverse_width": (1.0,),
        "columns": (2.0,),
    }
    return ride(i, np.array([0.5, z]), 2.0, 6.0, flows, **tables, step=2.0, spacing=2.0)


def test_particle_that_rides():
    """From 3 m above the base to 6, twice as large and heavy; at the surface it has lost too."""
    place, V, m, w, growth, height, _ = ridden(0, -1.0)
    assert place.tolist() == [0.5, 2.0]
    assert (V, m, height) == (4.0, 12.0, 2.0)
    assert w.tolist() == [0.0, 1.5]
    assert growth == (2.0 + 0.5) / 2.0
    assert ridden(2, -1.0)[4] == 1.0


def test_solid_rests():
    """What does not flow stays as it is."""
    place, V, m, w, growth, *_ = ridden(0, -1.0, flows=0.0)
    assert place.tolist() == [0.5, -1.0]
    assert (V, m, growth) == (2.0, 6.0, 0.0)
    assert not w.any()


def test_one_particle_of_a_column_lies_at_the_surface():
    """The first, however low the next one lies; coarse columns keep their marks."""
    grid = {"start": (0.0,), "inverse_width": (1.0,), "columns": (2.0,)}
    inside, beside = np.array([1.5, -0.1]), np.array([2.5, -0.1])
    assert is_uppermost(1, inside, 0.0, **grid) == 1.0
    assert is_uppermost(3, inside, 1.0, **grid) == 0.0
    assert is_uppermost(9, beside, 1.0, **grid) == 1.0
    assert is_uppermost(9, beside, 0.0, **grid) == 0.0


def test_own_columns():
    """Areas with the slope, of coarse columns as they are; means are of the uppermost particle."""
    backend = compute.cpu(threads=1)
    area = backend.asarray([2.0, 4.0, 0.0, 5.0])
    columns = OwnColumns(backend, 2, area)
    columns.incline(backend.asarray([1.0, 1.5]))
    assert np.asarray(columns.area).tolist() == [2.0, 6.0, 0.0, 5.0]
    flux = backend.asarray([10.0, 20.0, 7.0, 7.0])
    assert np.asarray(columns.mean_from_above(flux)).tolist() == [10.0, 30.0]


@pytest.fixture
def spot():
    """A pool below a surface that moves."""
    metal = {"base": "steel-304-demuth", "surface_tension": 1.6}
    solver = {"flow": {"surface": "moving"}, "vaporization": "plateau"}
    return spot_pool(half_ball, material=metal, solver=solver)[1]


def test_light_through_stretched_columns(spot):
    """All light is taken, as deep as the columns reach now."""
    light = spot.body.light
    spot.state.time = 2e-8
    spot.illuminate(1e-11)
    light.absorb(spot.particles["temperature"])
    first = np.array(light.deposit)
    # twice as high from their bottom: what was absorbed in a row passes into the next
    volume, z = np.array(spot.particles["volume"]), np.array(spot.position)[1]
    spot.particles.set("volume", 2.0 * volume)
    spot.particles.set("position", np.array([np.array(spot.position)[0], 1e-6 + 2.0 * z]))
    spot.illuminate(1e-11)
    light.absorb(spot.particles["temperature"])
    second = np.array(light.deposit)
    assert second.sum() == pytest.approx(first.sum(), rel=1e-9, abs=0.0)
    assert second[0] > first[0]


def test_rows_that_are_stretched_end_the_run(spot):
    """Beyond twice their height, or below 0.4 of it."""
    surface = spot.domain.surface
    assert surface.validity_error() == ""
    for heights in ((1.0, 1.1 * LARGEST_HEIGHT), (0.9 * LEAST_HEIGHT, 1.0)):
        surface.row_heights = heights
        assert "rows of the melt are" in surface.validity_error()
