"""Heights over pools on a grid of two axes: planes, waves in any direction, caps, rims, volume."""

from itertools import product

import numpy as np
import pytest
from surface_lines import line_of

from lasersph.surface.height_field import HeightField
from lasersph.surface.pool_field import PoolField
from lasersph.surface.pools import SurfacePools
from lasersph.surface.smoothing import EVEN_PARITY, ODD_PARITY, ORDER

SIDE, CUTOFF = 1.2e-6, 0.3e-6
MIRROR, PERIODIC, PINNED = ("mirror",) * 2, ("periodic",) * 2, ("pinned",) * 2


def grid_of(ends=(MIRROR, MIRROR), shape=(24, 30), start=(0.0, 0.0), width=SIDE / 24):
    """Columns of a rectangle of 1.2 um times 1.5 um."""
    return HeightField(start, (width, width), shape, ends, CUTOFF)


def whole_of(grid):
    """The pool that is all of a grid."""
    return PoolField(grid, np.arange(grid.count))


def pool_in(grid, heights, is_molten):
    """Pool of the columns where that holds, its rim pinned at heights of x and y."""
    grid.height = heights(*grid.places)
    found = PoolField(grid, np.flatnonzero(is_molten(*grid.places).ravel()))
    _, _, x, y = found._pins
    middle = [
        start + width * (place[:, 1:3].mean(axis=1) + 0.5)
        for start, width, place in zip(grid.start, grid.widths, (x, y), strict=True)
    ]
    found.at_pins = heights(*middle)
    return found


def test_a_plane_stays_a_plane():
    """Pinned at its own heights around an odd shape: neither smoothed nor bent, however steep."""
    grid = grid_of((PINNED, PINNED))
    found = pool_in(
        grid,
        lambda x, y: 0.3 * x - 0.2 * y + 1e-8,
        lambda x, y: (np.hypot(x - 6e-7, y - 7e-7) < 5e-7) | (x + y < 5e-7),
    )
    assert found.at_columns(found.smoothed) == pytest.approx(found.height, abs=1e-12)
    assert found.slopes[0] == pytest.approx(0.3, abs=1e-4)
    assert found.slopes[1] == pytest.approx(-0.2, abs=1e-4)
    assert found.length_ratio == pytest.approx(np.sqrt(1.13), abs=1e-4)
    assert np.abs(found.curvature).max() < 1e-2 / SIDE


@pytest.mark.parametrize("ends", [(MIRROR, MIRROR), (PERIODIC, MIRROR), (PERIODIC, PERIODIC)])
@pytest.mark.parametrize("waves", [(2, 0), (0, 2), (2, 2), (4, 2)])
def test_waves_keep_their_closed_form(ends, waves):
    """1/(1 + (s^2 |k|^2)^n) of cos kx cos ky, with the differences' own k = 2 sin(k dx/2)/dx."""
    grid = grid_of(ends)
    x, y = (place.ravel() for place in grid.places)
    sizes = [count * width for count, width in zip(grid.shape, grid.widths, strict=True)]
    k = [np.pi * number / size for number, size in zip(waves, sizes, strict=True)]
    wave = np.cos(k[0] * x) * np.cos(k[1] * y)
    square = sum(
        (2.0 * np.sin(0.5 * one * width) / width) ** 2
        for one, width in zip(k, grid.widths, strict=True)
    )
    kept = 1.0 / (1.0 + ((CUTOFF / (2.0 * np.pi)) ** 2 * square) ** ORDER)
    found = whole_of(grid)
    assert found.smooth(wave) == pytest.approx(kept * wave, abs=1e-8)

    # damping takes the rest, and no volume
    found.height = 1e-9 * wave
    found.damp_short_waves(1.0)
    assert found.height == pytest.approx(1e-9 * kept * wave, abs=1e-17)


def test_directions_are_alike():
    """A wave of the cut-off length keeps half along an axis and along the diagonal."""
    grid = HeightField((0.0, 0.0), (1e-8, 1e-8), (60, 60), (PERIODIC, PERIODIC), CUTOFF)
    x, y = (place.ravel() for place in grid.places)
    found, k = whole_of(grid), 2.0 * np.pi / CUTOFF
    along = np.cos(k * x)
    diagonal = np.cos(2.0 * np.pi / 6e-7 * x) * np.cos(2.0 * np.pi / 6e-7 * y)
    kept = [np.sum(found.smooth(wave) * wave) / np.sum(wave**2) for wave in (along, diagonal)]
    assert kept[0] == pytest.approx(0.5, abs=0.02)
    # the diagonal one is longer by sqrt(2)
    assert kept[1] == pytest.approx(1.0 / (1.0 + 0.5**ORDER), abs=0.01)


R0, H = 1e-6, 3e-7
RADIUS = (R0**2 + H**2) / (2.0 * H)


def cap(x, y):
    """Height of the sphere over a disc of 1 um, 300 nm in its middle [m]; below 0 beyond it."""
    return np.sqrt(RADIUS**2 - x**2 - y**2) - (RADIUS - H)


@pytest.mark.parametrize("width", [50e-9, 32e-9])
def test_curvature_of_a_cap_up_to_its_rim(width):
    """2/R, the sum of both, pinned at the exact heights of a staircase; a quarter by symmetry."""
    count = int(1.3e-6 / width)
    grid = grid_of(shape=(count, count), width=width)
    found = pool_in(grid, cap, lambda x, y: np.hypot(x, y) < R0)
    assert found.curvature == pytest.approx(2.0 / RADIUS, rel=0.01, abs=0.0)
    # the same of the whole disc, whose middle is a corner of columns
    grid = grid_of((PINNED, PINNED), (2 * count,) * 2, (-count * width,) * 2, width)
    whole = pool_in(grid, cap, lambda x, y: np.hypot(x, y) < R0)
    assert whole.count == 4 * found.count
    assert whole.curvature.max() == pytest.approx(found.curvature.max(), rel=1e-9, abs=0.0)


def test_a_turned_trough_is_as_curved():
    """A trough along the diagonal needs eta_xy: without it the curvature of slopes errs."""
    grid = grid_of((PINNED, PINNED), (40, 40), (-5e-7, -5e-7), 2.5e-8)
    found = pool_in(grid, lambda x, y: 0.25 * (x + y) ** 2 / 6e-7, lambda x, y: x < 1.0)
    x, y = found.places
    slope = (x + y) / np.sqrt(2.0) / 6e-7
    expected = -1.0 / 6e-7 / (1.0 + slope**2) ** 1.5
    inside = (np.abs(x) < 2e-7) & (np.abs(y) < 2e-7)
    assert found.curvature[inside] == pytest.approx(expected[inside], rel=0.02, abs=0.0)


@pytest.mark.parametrize(
    "ends", [(MIRROR, MIRROR), (PERIODIC, MIRROR), (PINNED, MIRROR), (PINNED, PINNED)]
)
def test_volume(ends):
    """Fluxes within two pools that meet in a corner, and damping, move volume and make none; none
    passes from one pool to the other."""
    grid, rng = grid_of(ends), np.random.default_rng(1)
    x, y = grid.places
    low = (x < 6e-7) & (y < 7.5e-7)
    thick = low | ((x > 6e-7) & (y > 7.5e-7))
    pools = SurfacePools(grid)
    pools.choose(thick.ravel())
    flux = rng.normal(size=(25, 30)), rng.normal(size=(24, 31))
    grid.height = pools.heights_after(1e-9, flux).reshape(grid.shape)
    moved = np.abs(grid.height).sum()
    assert moved > 0.0 and not grid.height[~thick].any()
    assert len(pools.parts) == 2
    assert abs(grid.height[low].sum()) < 1e-12 * moved
    pools.update_heights()
    for _, pool in pools.parts:
        before = pool.height.sum()
        pool.damp_short_waves(0.3)
        assert pool.height.sum() == pytest.approx(before, abs=1e-12 * moved)


def test_corners_of_two_walls_are_not_damped():
    """Within lambda_c of both walls heights keep their short waves, elsewhere they lose them; a
    wall alone has no corner, and a pool that is all corner is damped."""
    corner = ("mirror", "pinned")
    grid = grid_of((corner, corner))
    found, (x, y) = whole_of(grid), grid.places
    near = ((x > SIDE - CUTOFF) & (y > 1.25 * SIDE - CUTOFF)).ravel()
    rough = 1e-9 * (-1.0) ** np.arange(grid.count)
    found.height = rough.copy()
    found.damp_short_waves(1.0)
    assert 0 < near.sum() < grid.count
    assert np.array_equal(found.height[near], rough[near])
    assert np.abs(found.height[~near]).max() < 0.5e-9
    for ends in ((corner, MIRROR), (PERIODIC, corner)):
        assert whole_of(grid_of(ends))._is_damped.all()
    assert PoolField(grid, np.flatnonzero(near))._is_damped.all()


@pytest.mark.parametrize("ends", [MIRROR, PERIODIC])
def test_even_along_y_is_the_line(ends):
    """Heights that do not vary along y: slope, curvature and means of the grid with one axis."""
    grid, line = grid_of((ends, MIRROR)), line_of(0.0, SIDE / 24, 24, ends, CUTOFF)
    line.height = 3e-8 * np.cos(np.pi * line.centers() / SIDE)
    grid.height = np.repeat(line.height[:, None], 30, axis=1)
    found = whole_of(grid)
    curvature, slopes = found.curvature.reshape(24, 30), found.slopes.reshape(2, 24, 30)
    assert curvature[:, 7] == pytest.approx(line.curvature, rel=1e-6, abs=1e-3)
    assert slopes[0][:, 7] == pytest.approx(line.slopes[0], rel=1e-6, abs=1e-9)
    assert np.abs(slopes[1]).max() < 1e-9
    everywhere = np.ones(grid.shape, bool)
    means = grid.mean_of_neighbors(grid.height, everywhere)
    assert means[:, 7] == pytest.approx(line.mean_of_neighbors(line.height, everywhere[:, 0]))
    assert grid.first_harmonic(2.0 * SIDE) == pytest.approx(line.first_harmonic(2.0 * SIDE))


def test_parity_along_each_axis():
    """sin kx cos ky is odd along x alone; v along y is odd there."""
    grid = grid_of()
    found, k = whole_of(grid), 2.0 * np.pi / SIDE
    x, y = found.places
    u = np.sin(0.5 * k * x) * np.cos(np.pi * y / (1.25 * SIDE))
    slope = found.derivative(u, (ODD_PARITY, EVEN_PARITY))
    expected = 0.5 * k * np.cos(0.5 * k * x) * np.cos(np.pi * y / (1.25 * SIDE))
    assert slope == pytest.approx(expected, abs=1e-4 * k)
    v = np.cos(0.5 * k * x) * np.sin(np.pi * y / (1.25 * SIDE))
    assert found.smooth(v, (EVEN_PARITY, ODD_PARITY)) == pytest.approx(v, abs=1e-3)


@pytest.mark.parametrize("turned", [False, True])
def test_pools_of_a_grid(turned):
    """A quarter disc at a corner of symmetry moves with its images, one of six by six columns in
    the middle is held; the rim is pinned at the solid beside it, and a wall at its own height."""
    grid = grid_of((("mirror", "pinned"), MIRROR), (40, 40))
    x, y = (place / SIDE * 24 for place in grid.places)
    molten = (np.hypot(x, y) < 8.0) | ((abs(x - 20) < 3) & (abs(y - 20) < 3)) | (x > 28)
    grid.height = np.where(molten, 1e-9, 5e-9)
    grid.pins = ((0.0, 7e-9), (0.0, 0.0))
    if turned:
        grid.ends, grid.height, molten = grid.ends[::-1], grid.height.T, molten.T
        grid.pins = grid.pins[::-1]
    pools = SurfacePools(grid)
    pools.choose(molten.ravel())
    pools.update_heights()
    assert len(pools.parts) == 2
    quarter, band = sorted(pools.parts, key=lambda part: part.columns.size)
    assert set(quarter.line.at_pins) == {5e-9}
    assert set(band.line.at_pins) == {5e-9, 7e-9}
    assert sum(band.line.at_pins == 7e-9) == 40


def test_pool_across_a_period():
    """Columns at both ends of x are one pool, and pass on volume through the end."""
    grid = grid_of((PERIODIC, MIRROR))
    x, _ = grid.places
    pools = SurfacePools(grid)
    pools.choose(((x < 3e-7) | (x > 9e-7)).ravel())
    assert len(pools.parts) == 1
    flux = np.zeros((25, 30)), np.zeros((24, 31))
    flux[0][[0, -1]] = 2.0
    height = pools.heights_after(1.0, flux).reshape(grid.shape)
    assert height[0] == pytest.approx(2.0 / grid.widths[0]) and height[-1] == pytest.approx(
        -height[0]
    )


def test_arms_of_one_column_have_values():
    """A cross of single columns: the smoothed field is finite, and flat where heights are."""
    grid = grid_of((PINNED, PINNED), (30, 30))
    cells = [(15, j) for j in range(5, 25)] + [(i, 15) for i in range(5, 25) if i != 15]
    columns = np.sort([i * 30 + j for i, j in cells])
    found = PoolField(grid, columns)
    found.height = np.full(columns.size, 1e-9)
    found.at_pins = np.full(found.rim.size, 1e-9)
    assert found.at_columns(found.smoothed) == pytest.approx(1e-9, rel=1e-5, abs=0.0)


def test_shares_of_every_pair_of_ends():
    """A wave of half a period in a quarter is that of the whole period, in both directions."""
    for low, high in product((MIRROR, PERIODIC), repeat=2):
        grid = grid_of((low, high))
        found = whole_of(grid)
        assert found.at_columns(found.smooth(np.ones(grid.count))) == pytest.approx(1.0, abs=1e-9)
