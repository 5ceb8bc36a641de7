"""How many pools: sides and corners, planes of symmetry, sides that repeat, cells of any width."""

from __future__ import annotations

import numpy as np
import pytest
import synthetic_run

from lasersph.observers.pool_count import PoolCount, count_pools, surface_grid

NONE, BOTH = (False, False), (True, True)


def grid(*rows):
    """A grid whose rows are drawn; # is molten."""
    return np.array([[one == "#" for one in row] for row in rows])


def test_sides_and_corners():
    """Two that share a corner are two, two that share a side are one."""
    assert count_pools(grid("##..", "..##"), NONE, NONE) == 2
    assert count_pools(grid("##..", ".###"), NONE, NONE) == 1
    assert count_pools(grid("....", "...."), BOTH, BOTH) == 0


def test_mirror_images():
    """Of a quarter: one in the corner is one, one on a plane is two, one beside both is four."""
    quarter = grid("#....", ".....", "..#..", ".....")
    assert count_pools(quarter, BOTH, NONE) == 1 + 4
    assert count_pools(grid(".....", "..#..", "....."), BOTH, NONE) == 4
    assert count_pools(grid("..#..", ".....", "....."), BOTH, NONE) == 2
    assert count_pools(quarter, (True, False), NONE) == 1 + 2


def test_repeating_sides():
    """The four corners of a period are one pool, and a band over a seam is one."""
    period = grid("#...#", "..#..", "#...#")
    assert count_pools(period, NONE, NONE) == 5
    assert count_pools(period, NONE, BOTH) == 2
    assert count_pools(period, NONE, (True, False)) == 3


@pytest.mark.parametrize("part", [1.0, 0.5])
def test_dots_of_a_period(part):
    """cos kx cos ky > 1/2 has two dots in a period, from whole periods and from their quarter."""
    n = 40
    x = (np.arange(round(n * part)) + 0.5) / n - (0.5 if part == 1.0 else 0.0)
    light = np.cos(2 * np.pi * x)[:, None] * np.cos(2 * np.pi * x)
    mirrored = BOTH if part < 1.0 else NONE
    assert count_pools(light > 0.5, mirrored, NONE if part < 1.0 else BOTH) == 2


def view_of(spots, width):
    """A view in 3-D whose surface is half molten within a radius of some places."""
    position, widths = synthetic_run.lattice(3)
    view = synthetic_run.view_at(0.0, 0, position, widths)
    lateral = view.position[:2]
    molten = np.zeros(lateral.shape[1])
    for place in spots:
        molten[np.hypot(*(lateral - np.array(place)[:, None])) < width] = 0.5
    view.__dict__["melt_fraction"] = molten
    return view


def test_observer():
    """The column and its largest value; nothing in a summary where nothing melted."""
    observer = PoolCount()
    span = np.ptp(view_of([], 0.0).position[0])
    two = [(0.25 * span, 0.0), (0.75 * span, 0.0)]
    assert observer.observe(view_of([], 0.0)) == {"melt_pools": 0}
    assert observer.summary() == {}
    images = view_of(two, 0.12 * span).mirror_images
    assert observer.observe(view_of(two, 0.12 * span))["melt_pools"] == 2 * images
    observer.observe(view_of(two[:1], 0.12 * span))
    assert observer.summary()["melt"]["pools_max"] == 2 * images


def test_coarse_columns_fill_their_cells():
    """A cell twice as wide covers four places of the grid."""
    view = view_of([], 0.0)
    fine, places = 1e-7, np.array([[0.05, 0.05, 0.15, 0.15, 0.3], [0.05, 0.15, 0.05, 0.15, 0.1]])
    wide = np.array([[1, 1, 1, 1, 2], [1, 1, 1, 1, 2]]) * fine
    view.__dict__.update(
        position=np.vstack([places * 1e-6, np.zeros(5)]),
        width=np.vstack([wide, wide[:1]]),
        surface=np.arange(5),
    )
    found = surface_grid(view, np.array([True, False, False, False, True]))
    assert found.tolist() == [[True, False], [False, False], [True, True], [True, True]]
