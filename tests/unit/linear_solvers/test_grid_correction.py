"""Grids and their correction: transfers by hand, symmetry, exact inverses, thin and periodic."""

import numpy as np
import pytest
from scattered_pairs import LEFT, TOP, scattered

from lasersph.linear_solvers import grid_nodes
from lasersph.linear_solvers.cells import Axis, Cells, FilledCells
from lasersph.linear_solvers.grid_correction import COARSEST, GridCorrection
from lasersph.linear_solvers.unknowns import WIDTH


def prepared(
    backend,
    position,
    support,
    *,
    mask=None,
    volume=None,
    boundary_coefficient=None,
    period=(0.0, 0.0),
):
    """Correction for the positions, and its mask."""
    count = position.shape[1]
    cells = FilledCells(backend, count, WIDTH * support, period)
    mask = np.ones(count) if mask is None else mask
    volume = np.ones(count) if volume is None else volume
    boundary_coefficient = np.zeros(count) if boundary_coefficient is None else boundary_coefficient
    mask = backend.asarray(mask)
    cells.update(backend.asarray(position), mask)
    correction = GridCorrection(backend, cells)
    correction.prepare(backend.asarray(volume), backend.asarray(boundary_coefficient))
    return correction, mask


def test_cells_by_hand(backend):
    """Cells of width 2 around the free particles, line by line; the held one comes last."""
    cells = Cells(backend, 4, 2.0, (0.0, 0.0))
    position = np.array([[2.5, 5.0, 3.0, 90.0], [-1.0, 1.5, -3.9, 0.0]])
    cells.update(backend.asarray(position), backend.asarray([1.0, 1.0, 1.0, 0.0]))
    assert cells.grid.shape == (2, 3)
    place = backend.to_host(cells.place)[:, :3]
    assert place[0].tolist() == [0.25, 0.5, 0.5]
    assert place[1] == pytest.approx([0.5, 0.75, 0.05])
    assert backend.to_host(cells.number).tolist() == [1, 5, 0, 6]


def test_axes():
    """Axes are halved, a last pair of nodes is joined, odd periods stay."""
    assert Axis(5, 1.0, False).coarser() == Axis(3, 2.0, False)
    assert Axis(1, 4.0, False).coarser() == Axis(0, 4.0, False)
    assert Axis(0, 4.0, False).coarser() == Axis(0, 4.0, False)
    assert Axis(6, 1.0, True).coarser() == Axis(3, 2.0, True)
    assert Axis(3, 2.0, True).coarser() == Axis(3, 2.0, True)
    assert Axis(2, 2.0, True).coarser() == Axis(0, 2.0, False)


def test_volumes_and_boundary_coefficients_go_to_the_nodes(backend):
    """A particle a quarter across and half along its cell shares itself 3/8, 3/8, 1/8, 1/8."""
    correction, _ = prepared(
        backend,
        np.array([[0.5], [1.0]]),
        3.0,
        volume=np.array([8.0]),
        boundary_coefficient=np.array([16.0]),
    )
    level = correction.levels[0]
    assert level.count == 4
    assert backend.to_host(level.at["C"]) == pytest.approx([3.0, 3.0, 1.0, 1.0])
    assert backend.to_host(level.at["a"]) == pytest.approx([6.0, 6.0, 2.0, 2.0])


@pytest.mark.parametrize("period", [(0.0, 0.0), (30.0, 0.0)])
def test_every_level_holds_the_whole_volume(backend, period):
    """Sums over nodes are those over particles, on thin and on periodic grids."""
    pairs = scattered(8, 3.0)
    position = pairs.position * 10.0
    correction, _ = prepared(backend, position, 1.5, period=period)
    for level in correction.levels:
        assert backend.to_host(level.at["C"]).sum() == pytest.approx(pairs.count, rel=1e-12)
    assert correction.levels[-1].count <= COARSEST < correction.levels[0].count


def dense_of(backend, level):
    """Matrix K of a level, column by column from `grid_nodes.residual`."""
    K = np.zeros((level.count, level.count))
    s = backend.to_host(level.at["s"])
    for k in range(level.count):
        x = np.zeros(level.count + 1)
        x[k] = 1.0
        backend.copy(backend.asarray(x), level.all["x"])
        backend.copy(backend.asarray(x * np.append(s, 0.0)), level.all["y"])
        backend.fill(level.all["r"], 0.0)
        level.smooth(grid_nodes.residual, level.at["residual"])
        K[:, k] = -backend.to_host(level.at["residual"])
    return K


@pytest.mark.parametrize("boundary_coefficient", [0.0, 0.3])
def test_coarsest_grid_is_solved_exactly(backend, boundary_coefficient):
    """K times its inverse returns a right-hand side, one with sum 0 where K is singular."""
    pairs = scattered(6, 1.5, jitter=0.2)
    correction, _ = prepared(
        backend,
        pairs.position,
        pairs.support,
        boundary_coefficient=np.full(pairs.count, boundary_coefficient),
    )
    (level,) = correction.levels
    K = dense_of(backend, level)
    assert np.abs(K - K.T).max() <= 1e-13 * np.abs(K).max()
    assert np.linalg.eigvalsh(K).min() >= -1e-12 * np.abs(K).max()
    inverse = backend.to_host(correction._inverse).reshape(K.shape)
    is_node = np.diag(K) > 0.0
    r = np.where(is_node, np.cos(np.arange(level.count)), 0.0)
    r -= is_node * r.sum() / is_node.sum()
    assert np.abs(K @ inverse @ r - r).max() <= 1e-9
    assert np.abs(inverse - inverse.T).max() <= 1e-9 * np.abs(inverse).max()


def test_correction_is_symmetric_and_positive(backend):
    """u M^-1 v = v M^-1 u and u M^-1 u > 0, as conjugate gradients ask for."""
    pairs = scattered(40, 2.0, jitter=0.2, mirrors=(LEFT, TOP))
    x, z = pairs.position
    mask = ((x / 2.0) ** 2 + z**2 < 0.8).astype(float)
    correction, held = prepared(backend, pairs.position, pairs.support, mask=mask)
    assert len(correction.levels) > 2
    diagonal = backend.asarray(1.0 + 0.3 * np.sin(np.arange(pairs.count)))
    u, v = mask * np.cos(3.0 * x + z), mask * np.cos(0.7 * np.arange(pairs.count))

    def product(a, b):
        z = backend.zeros(pairs.count)
        (found,) = correction.correct(backend.asarray(b), diagonal, held, z)
        z = backend.to_host(z)
        assert found == pytest.approx(b @ z, rel=1e-9) and not z[mask == 0.0].any()
        return float(a @ z)

    assert product(u, v) == pytest.approx(product(v, u), rel=1e-8)
    assert product(u, u) > 0.0 and product(v, v) > 0.0


@pytest.mark.parametrize("side", [4, 5, 7, 8])
def test_node_that_particles_hardly_touch_is_left_out(backend, side):
    """Particles a rounding error beyond a line of the grid: the next line has no volume."""
    x, z = np.meshgrid(np.linspace(-0.5, 0.5, side), np.linspace(0.0, 1.0, side))
    x[:, -1] += 2.3e-16
    correction, _ = prepared(backend, np.stack([x.ravel(), z.ravel()]), 0.75)
    assert np.abs(backend.to_host(correction._inverse)).max() < 1e9
