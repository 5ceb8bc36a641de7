"""Components: labels of touching particles, and the means that are removed from them."""

import numpy as np
import pytest

from lasersph.compute.cell_grid import CellGrid
from lasersph.linear_solvers import components as components_module
from lasersph.linear_solvers.components import Components, connected_parts

SPACING = 1.0


def found(backend, position, mask=None, boundary_coefficient=None, period=(0.0, 0.0)):
    """Components of positions in spacings."""
    position = np.asarray(position, float)
    count = position.shape[1]
    components = Components(backend, count, SPACING, period)
    mask = np.ones(count) if mask is None else mask
    boundary_coefficient = np.zeros(count) if boundary_coefficient is None else boundary_coefficient
    components.find(backend.asarray(position), backend.asarray(mask))
    components.find_floating(backend.asarray(boundary_coefficient))
    return components, backend.to_host(components.number).tolist()


def lines(*starts):
    """Vertical lines of five particles at the given x."""
    x = np.repeat(np.array(starts, float), 5)
    return np.array([x, np.tile(np.arange(5.0), len(starts))])


def test_lines_apart_and_in_touch(backend):
    """Lines at x = 0, 1 and 6: two components, numbered along x."""
    components, number = found(backend, lines(0, 1, 6))
    assert number == [1] * 10 + [2] * 5 and components.count == 2


def test_masked_and_few_particles_belong_to_none(backend):
    """A line of which three particles remain is no component; masked particles never are."""
    mask = np.ones(10)
    mask[[8, 9]] = 0.0
    components, number = found(backend, lines(0, 6), mask)
    assert number == [1] * 5 + [0] * 5 and components.count == 1
    assert backend.to_host(components.mask).tolist() == [1.0] * 5 + [0.0] * 5


def test_components_join_across_the_period(backend):
    """Lines at both ends of a period touch, those in the middle do not."""
    components, number = found(backend, lines(0.5, 10, 19.5), period=(20.0, 0.0))
    assert number == [1] * 5 + [2] * 5 + [1] * 5 and components.count == 2


def test_means_of_floating_components_are_removed(backend):
    """The second line is pulled toward a value and keeps its mean."""
    boundary_coefficient = np.zeros(10)
    boundary_coefficient[7] = 0.5
    components, _ = found(backend, lines(0, 6), boundary_coefficient=boundary_coefficient)
    values = backend.asarray(np.arange(10.0))
    (square,) = components.remove_means(values)
    assert backend.to_host(values).tolist() == [-2.0, -1.0, 0.0, 1.0, 2.0, 5.0, 6.0, 7.0, 8.0, 9.0]
    assert square == 10.0 + 255.0


def test_large_components_are_added_up_in_slices(backend, monkeypatch):
    """Two of 35 and 15 members in slices of 16 at least: their means leave nothing."""
    monkeypatch.setattr(components_module, "SLICE", 16)
    monkeypatch.setattr(components_module, "SLICES", 4)
    position = lines(0, 1, 2, 3, 4, 5, 6, 20, 21, 22)
    components, number = found(backend, position)
    assert number == [1] * 35 + [2] * 15
    values = backend.asarray(np.arange(50.0) ** 2)
    totals = backend.to_host(components._sum(values)).tolist()
    squares = np.arange(50.0) ** 2
    assert totals == [0.0] * 4 + [squares[:16].sum(), squares[16:32].sum(), squares[32:35].sum(),
                                  0.0] + [squares[35:].sum(), 0.0, 0.0, 0.0]  # fmt: skip
    volume = backend.asarray(np.full(50, 2.0))
    for remove in (lambda: components.remove_means(values),
                   lambda: components.remove_shares(values, volume)):  # fmt: skip
        remove()
        left = backend.to_host(values)
        assert left[:35].sum() == pytest.approx(0.0, abs=1e-9)
        assert left[35:].sum() == pytest.approx(0.0, abs=1e-9)


def test_no_particle(backend):
    """Nothing is labeled where all are masked."""
    components, number = found(backend, lines(0), np.zeros(5))
    assert number == [0] * 5 and components.count == 0


def test_sides_and_corners():
    """Cells that touch at a corner are one part, numbered by its first cell; empty ones have 0."""
    filled = np.array([[1, 0, 0, 0], [0, 1, 0, 1], [0, 0, 0, 1]], bool)
    assert connected_parts(filled, (False, False)).tolist() == [
        [1, 0, 0, 0], [0, 1, 0, 2], [0, 0, 0, 2],
    ]  # fmt: skip


@pytest.mark.parametrize("repeats, expected", [
    ((False, False), [1, 2, 3, 4]), ((True, False), [1, 2, 1, 2]), ((False, True), [1, 1, 2, 2]),
    ((True, True), [1, 1, 1, 1]),
])  # fmt: skip
def test_around_ends(repeats, expected):
    """Across a period the last cells touch the first, those of a corner along both axes."""
    filled = np.zeros((4, 4), bool)
    filled[[0, 0, 3, 3], [0, 3, 0, 3]] = True
    assert connected_parts(filled, repeats)[filled].tolist() == expected


@pytest.mark.parametrize("shape", [(40,), (12, 15), (6, 7, 8)])
def test_parts_of_random_grids(shape):
    """As the smallest number spreads from cell to cell, with and without periods."""
    random, d = np.random.default_rng(4), len(shape)
    for share in (0.1, 0.25, 0.5, 1.0):
        for repeats in np.ndindex((2,) * d):
            filled = random.random(shape) < share
            grid = CellGrid((0.0,) * d, shape, (1.0,) * d, repeats)
            number = np.append(np.where(filled.ravel(), np.arange(grid.count), -1), -1)
            around, before = grid.around(), None
            while not np.array_equal(before, number):
                before = number.copy()
                near = np.where(number[around] < 0, grid.count, number[around]).min(axis=0)
                number[:-1] = np.where(number[:-1] >= 0, np.minimum(number[:-1], near), -1)
            firsts = sorted({*number[:-1]} - {-1})
            expected = [1 + firsts.index(k) if k >= 0 else 0 for k in number[:-1]]
            assert connected_parts(filled, repeats).ravel().tolist() == expected


@pytest.mark.parametrize("dimension", [1, 3])
def test_lines_and_blocks(backend, dimension):
    """Two heaps of particles on a line and in space, and a third that the period joins."""
    heap = np.indices((2 if dimension > 1 else 4,) * dimension).reshape(dimension, -1)
    starts = (0.5, 10.0, 17.0)
    position = np.concatenate([heap + start for start in starts], axis=1)
    for period, expected in ((0.0, [1, 2, 3]), (20.0, [1, 2, 1])):
        components, number = found(backend, position, period=(period,) * dimension)
        if dimension > 1 and period:
            expected = [1, 2, 3]  # 18.0 and 20.5 do not touch
        assert number == np.repeat(expected, heap.shape[1]).tolist()
        assert components.count == max(expected)
