"""Melt pool sizes worked by hand on small lattices."""

import math
from dataclasses import replace

import numpy as np
import pytest
import synthetic_ablation
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from lasersph.observers import MeltPool, View, numerical_sd
from lasersph.observers.melt_pool import pool_width


def view_of(fraction, *, cell=10e-9, time=0.0, symmetry=2, dimension=2):
    """A view of a lattice of square cells.

    Args:
        fraction: melt fractions (rows, columns), the first row at the surface.
    """
    fraction = np.atleast_2d(np.asarray(fraction, dtype=float))
    rows, columns = fraction.shape
    x = np.tile((np.arange(columns) + 0.5) * cell, rows)
    z = np.repeat(-(np.arange(rows) + 0.5) * cell, columns)
    position = np.array([z] if dimension == 1 else [x, z])
    flat = fraction.ravel()
    return View(
        time=time,
        step=0,
        time_step=0.0,
        position=position,
        width=np.full(position.shape, cell),
        volume=np.full(flat.size, cell**2),
        mass=np.full(flat.size, cell**2),
        temperature=300.0 + 1000.0 * flat,
        enthalpy=flat + np.where(flat >= 1.0, np.linspace(0.5, 0.0, flat.size), 0.0),
        melt_fraction=flat,
        vapor_fraction=np.zeros(flat.size),
        surface=np.arange(columns),
        solidus=300.0,
        liquidus=1300.0,
        symmetry_factor=symmetry,
    )


def test_sizes_at_the_three_levels():
    """Depth below the hottest cell, and twice the half width, at f_m = 1, 0.5 and above 0.

    At 0.5 the surface is fluid to 25 nm + (0.6 - 0.5) / (0.6 - 0.1) 10 nm = 27 nm, and below the
    hottest cell to 15 nm + (1 - 0.5) / (1 - 0.4) 10 nm, by fraction as by temperature; T falls to
    the liquidus in the cell at 15 nm and to the solidus below the one at 25 nm, which is the last.
    """
    view = view_of(
        [[1.0, 1.0, 0.6, 0.1, 0.0], [1.0, 0.6, 0.2, 0.0, 0.0], [0.4, 0.0, 0.0, 0.0, 0.0]]
    )
    row = MeltPool(2).observe(view)
    assert row == pytest.approx(
        {
            "melt_depth_m": 15e-9,
            "melt_width_m": 40e-9,
            "melt_width_half_m": 54e-9,
            "melt_depth_any_m": 30e-9,
            "melt_width_any_m": 80e-9,
            "melt_volume_m3": 5.9 * (10e-9) ** 2,
            "melt_depth_half_m": 23.3333333e-9,
        }
    )


def test_depth_between_cells():
    """From 15 nm, at 1800 K, to 25 nm: half way by the fractions (1 and 0), 5/6 by the temperatures
    (1800 and 1680 K about 1700 K), 15 + 10 (1/2 + 5/6) / 2 = 21.667 nm."""
    view = view_of([[1.0], [1.0], [0.0], [0.0]], dimension=1)
    heat = np.array([2000.0, 1800.0, 1680.0, 1500.0])
    view = replace(view, temperature=heat, solidus=1650.0, liquidus=1750.0)
    row = MeltPool(1).observe(view)
    assert row["melt_depth_half_m"] == pytest.approx(21.6666667e-9)
    # to 1750 K by the temperatures 15 + 10 * 5/12, before the fractions say 20 nm
    assert row["melt_depth_m"] == pytest.approx(19.1666667e-9)
    # to 1650 K: beyond the center of the last cell that is warmer, but no deeper than molten
    assert row["melt_depth_any_m"] == pytest.approx(25e-9)


def test_depth_between_cells_always_moves():
    """With a melting point cells warm up, melt and warm up: the depth rests at no cell."""
    depths = []
    for melting in (0.0, 0.2, 0.4, 0.6, 0.8, 1.0):
        view = view_of([[1.0], [melting], [0.0]], dimension=1)
        heat = np.array([1800.0 + 50.0 * melting, 1700.0, 1600.0 + 50.0 * melting])
        view = replace(view, temperature=heat, solidus=1700.0, liquidus=1700.0)
        depths.append(MeltPool(1).observe(view)["melt_depth_half_m"])
    for warmer in (10.0, 30.0, 80.0):
        view = view_of([[1.0], [1.0], [0.0]], dimension=1)
        heat = np.array([1850.0 + warmer, 1700.0 + warmer, 1650.0 + 0.5 * warmer])
        view = replace(view, temperature=heat, solidus=1700.0, liquidus=1700.0)
        depths.append(MeltPool(1).observe(view)["melt_depth_half_m"])
    assert np.all(np.diff(depths) > 0.1e-9)
    assert depths[0] == pytest.approx(12.5e-9)


def test_depth_follows_the_hottest_of_the_lowest_row_where_particles_moved():
    """A cold particle that sank by a fifth of a cell does not tell how deep the pool is."""
    view = view_of([[1.0, 1.0], [0.9, 0.6], [0.3, 0.0]], symmetry=1)
    even = MeltPool(2).observe(view)["melt_depth_half_m"]
    position = view.position.copy()
    position[1, 3] -= 2e-9
    moved = MeltPool(2).observe(replace(view, position=position))["melt_depth_half_m"]
    assert moved == even == pytest.approx(15e-9 + 10e-9 * 0.4 / 0.6)


SOLIDUS, LATENT = 1700.0, 300.0
"""K, and a latent heat in units of the heat of one kelvin."""


def state_of(enthalpy, melting_range):
    """Temperature [K] and melt fraction of enthalpies in units of the heat of one kelvin, with the
    solidus at 0."""
    fraction = np.clip(enthalpy / (LATENT + melting_range), 0.0, 1.0)
    return SOLIDUS + enthalpy - LATENT * fraction, fraction


def sizes_of(enthalpy, melting_range, *, cell=10e-9, dimension=1, shift=0.0):
    """Row of the observer for enthalpies (rows, columns), particles moved by a part of a cell."""
    temperature, fraction = state_of(np.asarray(enthalpy), melting_range)
    view = view_of(fraction, cell=cell, dimension=dimension, symmetry=1)
    view = replace(view, temperature=temperature.ravel(), enthalpy=np.ravel(enthalpy))
    view = replace(view, position=view.position + shift * cell)
    view = replace(view, solidus=SOLIDUS, liquidus=SOLIDUS + melting_range)
    return MeltPool(dimension).observe(view)


@settings(max_examples=300, deadline=None)
@given(
    enthalpy=arrays(float, (6, 4), elements=st.floats(-900.0, 1500.0, width=32)),
    shift=arrays(float, (2, 24), elements=st.floats(-0.25, 0.25, width=32)),
    melting_range=st.sampled_from([0.0, 1.0, 55.0, 400.0]),
    dimension=st.sampled_from([1, 2]),
)
def test_fluid_metal_is_never_deeper_or_wider_than_half_molten(
    enthalpy, shift, melting_range, dimension
):
    """Of any profile and particles wherever they are: f_m = 1 within 0.5 within any melt."""
    enthalpy = enthalpy[:, :1] if dimension == 1 else enthalpy
    moved = shift[:, :6].mean(axis=0, keepdims=True) if dimension == 1 else shift
    row = sizes_of(enthalpy, melting_range, dimension=dimension, shift=moved)
    for size in ("depth", "width")[:dimension]:
        full, half, any_melt = (row[f"melt_{size}{level}_m"] for level in ("", "_half", "_any"))
        assert 0.0 <= full <= half * (1.0 + 1e-12) <= any_melt * (1.0 + 1e-11)


def melt_to(front, cells, melting_range):
    """Row of the observer of 100 nm of metal, completely fluid down to `front` [m], with 10 K/nm
    in the melt and 5 below it: each cell has the mean enthalpy of its part of the exact profile."""
    edges = np.linspace(0.0, 100e-9, cells + 1)
    full, mush = LATENT + melting_range, melting_range / 5e9
    melt, mushy = np.minimum(edges, front), np.clip(edges - front, 0.0, mush)
    solid = np.maximum(edges - front - mush, 0.0)
    held = full * melt + 1e10 * (front * melt - 0.5 * melt**2) - 2.5e9 * solid**2
    held += full * (mushy - 0.5 * mushy**2 / max(mush, 1e-300))
    mean = np.diff(held) / np.diff(edges)
    return sizes_of(mean[:, None], melting_range, cell=100e-9 / cells)


@pytest.mark.parametrize("melting_range", [0.0, 55.0])
def test_depth_of_fluid_metal_converges_and_never_jumps(melting_range):
    """The error at f_m = 1 falls with the spacing, and the depth creeps with the front."""
    errors = []
    for cells in (10, 20, 40):
        fronts = np.linspace(40e-9, 60e-9, 100 * cells + 1)  # 1/500 of a cell each
        depths = np.array(
            [melt_to(front, cells, melting_range)["melt_depth_m"] for front in fronts]
        )
        spacing = 100e-9 / cells
        assert np.min(np.diff(depths)) > -1e-9 * spacing
        assert np.max(np.diff(depths)) < 0.2 * spacing
        errors.append(np.max(np.abs(depths - fronts)))
        assert errors[-1] < 0.75 * spacing
    assert errors[1] < 0.6 * errors[0]
    assert errors[2] < 0.6 * errors[1]


def test_depth_of_a_block_that_is_all_molten():
    """Nothing lies below the deepest cell: its lower face."""
    row = MeltPool(1).observe(view_of([[1.0], [0.9]], dimension=1))
    assert row["melt_depth_half_m"] == pytest.approx(20e-9)


def test_numerical_standard_deviations():
    """A width in cells of 12 nm jumps at both of its ends; interpolation halves it, and the depths;
    what is no size in cells, or zero, has none."""
    melt = {"depth_max_m": 1e-7, "width_max_m": 1e-7, "depth_any_max_m": 0.0, "start_s": 1e-9}
    smooth = {"width_half_max_m": 1e-7, "depth_half_max_m": 1e-7, "volume_max_m3": 1e-14}
    found = numerical_sd({"spacing_m": 12e-9, "melt": melt | smooth, "temperature_max_K": 300.0})
    cell = 12e-9 / math.sqrt(12.0)
    assert found == {
        "melt.depth_max_m": 0.5 * cell,
        "melt.width_max_m": 2.0 * cell,
        "melt.width_half_max_m": cell,
        "melt.depth_half_max_m": 0.5 * cell,
    }


def test_full_period_is_not_doubled():
    """Over a full period the width is the sum of the cells."""
    view = view_of([[0.0, 1.0, 1.0, 1.0, 0.0]], symmetry=1)
    assert pool_width(view, 1.0) == pytest.approx(30e-9)


def test_half_fluid_width_between_cells():
    """From 5 + 5 = 10 nm (0 to 1) to 25 + 10 (0.75 - 0.5) / 0.75 = 28.33 nm (0.75 to 0)."""
    view = view_of([[0.0, 1.0, 0.75, 0.0]], symmetry=1)
    assert pool_width(view, 0.5) == pytest.approx(28.333333e-9 - 10e-9)


def test_half_fluid_width_ends_with_the_row():
    """Where everything is fluid the width is that of the row."""
    assert pool_width(view_of([[0.8, 0.9]], symmetry=1), 0.5) == pytest.approx(20e-9)


def test_only_one_pool_counts():
    """Fluid cells that do not are connected to the hottest one are another pool."""
    view = view_of([[1.0, 1.0, 0.0, 1.0, 1.0]], symmetry=2)
    assert pool_width(view, 1.0) == pytest.approx(40e-9)


def test_pool_away_from_the_symmetry_planes_is_whole():
    """A pool inside the half period is not doubled."""
    view = view_of([[0.0, 1.0, 1.0, 0.0, 0.0]], symmetry=2)
    assert pool_width(view, 1.0) == pytest.approx(20e-9)


@pytest.mark.parametrize(
    ("row", "halves_spot", "width"),
    [
        ([1.0, 1.0, 0.6, 0.0, 0.0], (True, False), 40e-9),
        ([0.0, 0.0, 0.6, 1.0, 1.0], (False, True), 40e-9),
        ([0.0, 0.0, 0.6, 1.0, 1.0], (True, False), 20e-9),
        ([0.0, 1.0, 1.0, 0.0, 0.0], (True, True), 20e-9),
    ],
)
def test_half_a_spot_is_doubled(row, halves_spot, width):
    """A pool at the end of x on which the axis of the spot lies is half a pool."""
    view = replace(view_of([row], symmetry=1), halves_spot=halves_spot)
    assert pool_width(view, 1.0) == pytest.approx(width)


def even_spot(noise):
    """A view from above of a round molten spot of 9 cells of 10 nm, all but evenly hot."""
    x, y = (grid.ravel() * 10e-9 for grid in np.meshgrid(np.arange(15) - 7.0, np.arange(15) - 7.0))
    fraction = (np.hypot(x, y) < 45e-9).astype(float)
    flat = view_of(fraction.reshape(1, -1), symmetry=1)
    return replace(
        flat,
        position=np.array([x, y, np.full(x.size, -5e-9)]),
        width=np.full((3, x.size), 10e-9),
        temperature=flat.temperature + noise,
        enthalpy=flat.enthalpy + 1e-3 * noise,
    )


def test_width_of_an_even_spot_does_not_depend_on_rounding():
    """Whichever cell of it is the hottest by rounding, the width is that through its middle."""
    random = np.random.default_rng(1)
    noises = [np.zeros(225), *random.normal(0.0, 0.1, (20, 225))]
    for level in (1.0, 0.5, 0.0):
        widths = [pool_width(even_spot(noise), level) for noise in noises]
        assert widths == pytest.approx([90e-9] * len(widths))


def test_width_of_a_hotter_row_counts():
    """A pool that is wider but colder is another one."""
    view = even_spot(np.zeros(225))
    colder = view.position[1] < -10e-9
    temperature = np.where(colder, np.minimum(view.temperature, 1200.0), view.temperature)
    assert pool_width(replace(view, temperature=temperature), 1.0) == pytest.approx(90e-9)
    only = view.position[1] > 35e-9
    temperature = np.where(only, view.temperature, np.minimum(view.temperature, 1200.0))
    enthalpy = np.where(only, view.enthalpy, np.minimum(view.enthalpy, 1.0))
    narrow = replace(view, temperature=temperature, enthalpy=enthalpy)
    assert pool_width(narrow, 1.0) == pytest.approx(50e-9)


def test_ejecta_are_no_pool():
    """What flies stays molten, but the pool ends when the body is solid."""
    early, late = synthetic_ablation.view_at(8e-9, 16, 2), synthetic_ablation.view_at(2e-8, 40, 2)
    solid = late.ablation.stage >= 2
    late = replace(late, melt_fraction=solid.astype(float))
    pool = MeltPool(2)
    assert pool.observe(early)["melt_depth_m"] > 0.0
    assert pool.observe(late)["melt_depth_m"] == 0.0
    assert pool.summary()["melt"]["end_s"] == early.time
    assert pool.summary()["melt"]["molten_at_end"] is False


def test_no_width_in_one_dimension():
    """A 1-D run has a depth only; its summary says null for the width."""
    pool = MeltPool(1)
    row = pool.observe(view_of([[1.0], [0.7]], dimension=1))
    assert not any("width" in name for name in row)
    assert row["melt_volume_m3"] == pytest.approx(1.7e-16, rel=1e-9, abs=0.0)
    assert row["melt_depth_half_m"] == pytest.approx(20e-9)
    assert pool.summary()["melt"]["width_max_m"] is None


def test_times_and_largest_sizes():
    """First and last time of fluid material; the middle of the time at the largest depth."""
    pool = MeltPool(2)
    depths = [0, 1, 2, 2, 2, 1, 0]
    for k, depth in enumerate(depths):
        fraction = np.zeros((3, 4))
        fraction[:depth, :2] = 1.0
        pool.observe(view_of(fraction, time=float(k)))
    melt = pool.summary()["melt"]
    assert (melt["start_s"], melt["end_s"]) == (1.0, 5.0)
    assert melt["depth_max_m"] == pytest.approx(15e-9)  # where T is 1300 K, the liquidus
    assert melt["depth_max_at_s"] == 3.0
    assert melt["width_max_m"] == pytest.approx(40e-9)
    assert melt["width_max_at_s"] == 3.0
    assert melt["depth_half_max_m"] == pytest.approx(20e-9)
    assert melt["molten_at_end"] is False


def test_nothing_molten_nothing_said():
    """No `melt` where nothing melts; null times where material is only partly fluid."""
    pool = MeltPool(2)
    pool.observe(view_of(np.zeros((2, 3))))
    assert pool.summary() == {}
    pool.observe(view_of([[0.3, 0.0, 0.0]]))
    melt = pool.summary()["melt"]
    assert melt["start_s"] is None
    assert melt["depth_max_m"] == 0.0
    assert melt["depth_max_at_s"] is None
    assert melt["start_any_s"] == 0.0


def test_state_survives_a_restart():
    """A restored observer ends with the same summary."""
    views = [view_of([[f, 0.0, 0.0]], time=float(k)) for k, f in enumerate([0.2, 1.0, 0.7, 0.0])]
    whole, first, second = MeltPool(2), MeltPool(2), MeltPool(2)
    for view in views:
        whole.observe(view)
    for view in views[:2]:
        first.observe(view)
    second.restore(first.state())
    for view in views[2:]:
        second.observe(view)
    assert second.summary() == whole.summary()


def test_area_at_the_surface_of_dots():
    """Two of four surface cells of 10 nm fully molten, three half; half a cell is mirrored."""
    flat = view_of([[1.0, 0.6, 1.0, 0.2]])
    x = flat.position[0]
    position = np.array([x % 20e-9, x // 20e-9 * 10e-9, flat.position[1]])
    view = replace(flat, position=position, width=np.full((3, 4), 10e-9))
    row = MeltPool(3).observe(view)
    assert row["melt_area_m2"] == pytest.approx(2 * 2 * 1e-16)
    assert row["melt_area_half_m2"] == pytest.approx(2 * 3 * 1e-16)
    assert row["melt_area_any_m2"] == pytest.approx(2 * 4 * 1e-16)
