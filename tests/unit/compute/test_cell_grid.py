"""Cells of a box, and the particles in them."""

import numpy as np
import pytest

from lasersph.compute.cell_grid import CellGrid, place_along
from lasersph.particles.neighbor_lists import members_of


def test_cells_fill_the_box(backend):
    """2.5 m hold two cells of 1 m or more; what is outside counts to the cell at the end."""
    grid = CellGrid.over(np.array([1.0, -1.0]), np.array([2.5, 3.0]), 1.0)
    assert (grid.shape, grid.count) == ((2, 3), 6)
    assert grid.width == pytest.approx((1.25, 1.0))
    x = [[1.1, 2.3, 1.1, -9.0, 9.0], [-0.9, -0.9, 1.5, 0.5, 9.0]]
    cells = grid.find_cells(backend, backend.asarray(x))
    assert backend.to_host(cells).tolist() == [0, 3, 2, 1, 5]
    members = members_of(backend, cells, grid.count)
    assert backend.to_host(members.neighbor).tolist() == [0, 3, 2, 1, 4]
    assert backend.to_host(members.row_start).tolist() == [0, 1, 2, 3, 4, 4, 5]


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_last_axis_is_fastest(backend, dimension):
    """On a line and in space, one particle in the middle of each cell."""
    grid = CellGrid.over(np.zeros(dimension), np.array([2.0, 3.0, 4.0])[:dimension], 1.0)
    middles = np.indices(grid.shape).reshape(dimension, -1) + 0.5
    found = backend.to_host(grid.find_cells(backend, backend.asarray(middles)))
    assert found.tolist() == list(range(grid.count))


def test_places_wrap():
    """Where an axis of 4 cells wraps, a place beyond its end is one near its start."""
    assert place_along(11.0, 1.0, 0.5, 4, 1) == pytest.approx(1.0)
    assert place_along(0.0, 1.0, 0.5, 4, 1) == pytest.approx(3.5)
    assert place_along(11.0, 1.0, 0.5, 4, 0) == pytest.approx(5.0)


def test_numbers_of_indices():
    """The last axis wraps, the first ends: what is outside has the number behind the last one."""
    grid = CellGrid((0.0, 0.0), (2, 3), (1.0, 1.0), (False, True))
    index = np.array([[0, 1, 1, 2, -1], [0, 2, 3, 0, 1]])
    assert grid.numbers(index).tolist() == [0, 5, 3, 6, 6]
    assert np.array_equal(grid.numbers(grid.index), np.arange(6))


def test_cells_around():
    """Of the first cell of two by three, whose last axis wraps."""
    grid = CellGrid((0.0, 0.0), (2, 3), (1.0, 1.0), (False, True))
    assert grid.around()[:, 0].tolist() == [6, 6, 6, 2, 1, 5, 3, 4]


@pytest.mark.parametrize("repeats", [(False, False, False), (True, False, True)])
def test_grown_marks(repeats):
    """All cells within a distance of a marked one along every axis, around the ends of periods."""
    grid = CellGrid((0.0,) * 3, (5, 4, 3), (1.0,) * 3, repeats)
    marks = np.zeros(grid.shape, bool)
    marks[0, 1, 2] = True
    for distance in (1, 2):
        apart = np.abs(grid.index - np.array([[0], [1], [2]]))
        size = np.array(grid.shape)[:, None]
        apart = np.where(np.array(repeats)[:, None], np.minimum(apart, size - apart), apart)
        expected = (apart <= distance).all(axis=0).reshape(grid.shape)
        assert np.array_equal(grid.grown(marks, distance), expected)
