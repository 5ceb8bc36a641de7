"""Grids of nodes in 1, 2 and 3 axes: couplings of multilinear elements, and transfers."""

import numpy as np
import pytest

from lasersph.compute.cuda_device import IS_SIMULATED
from lasersph.linear_solvers import grid_nodes
from lasersph.linear_solvers.cells import Axis, FilledCells
from lasersph.linear_solvers.grid_correction import GridCorrection
from lasersph.linear_solvers.grid_levels import GridLevel, couplings

LINE = (Axis(9, 0.5, False),)
PLANE = (Axis(5, 0.5, False), Axis(6, 0.4, True))
SPACE = (Axis(5, 0.5, False), Axis(4, 0.4, True), Axis(3, 0.6, False))
AXES = pytest.mark.parametrize("axes", [LINE, PLANE, SPACE])


def set_values(backend, level, name, values):
    """Write the values of all nodes, the 0 behind them as well."""
    backend.copy(backend.asarray(np.append(values, 0.0)), level.all[name])


def with_volumes(backend, axes, volume=None, boundary_coefficient=0.0):
    """GridLevel with a volume of its own at each node."""
    level = GridLevel(backend, axes)
    if volume is None:
        volume = np.random.default_rng(3).uniform(0.2, 1.0, level.count)
    set_values(backend, level, "C", np.broadcast_to(volume, level.count))
    set_values(backend, level, "a", np.full(level.count, boundary_coefficient))
    level.prepare()
    return level


def stiffness(backend, level, x):
    """K x, as the loop finds it."""
    set_values(backend, level, "x", x)
    set_values(backend, level, "y", x * backend.to_host(level.at["s"]))
    set_values(backend, level, "r", np.zeros(level.count))
    level.smooth(grid_nodes.residual, level.at["residual"])
    return -backend.to_host(level.at["residual"])


def test_couplings_by_hand():
    """Those of linear, bilinear and trilinear elements with edges of one length [Strang1973]."""
    axis = Axis(4, 1.0, False)
    assert couplings((axis,)) == (1.0, 1.0)
    assert couplings((axis,) * 2) == pytest.approx([1.0 / 3.0] * 8)
    # toward nodes across an edge 1/6, across a corner 1/12, none across a side
    kinds = {1: 0.0, 2: 1.0 / 6.0, 3: 1.0 / 12.0}
    steps = [s for s in np.ndindex(3, 3, 3) if s != (1, 1, 1)]
    expected = [kinds[sum(one != 1 for one in s)] for s in steps]
    assert couplings((axis,) * 3) == pytest.approx(expected, abs=1e-15)


def test_axes_of_one_node_count_for_nothing():
    """A sheet in space couples as a plane, a thread as a line."""
    one, axis = Axis(0, 1.0, False), Axis(4, 0.5, False)
    found = couplings((axis, one, axis))
    sheet = np.reshape([*found[:13], 0.0, *found[13:]], (3, 3, 3))
    plane = couplings((axis, axis))
    assert sheet[:, 1].ravel() == pytest.approx([*plane[:4], 0.0, *plane[4:]])
    thread = couplings((one, axis, one))
    assert thread[10] == thread[15] == 4.0


@pytest.mark.parametrize("axes", [LINE, PLANE, (LINE[0], Axis(4, 0.5, True), LINE[0])])
def test_parabola_has_its_second_derivative(backend, axes):
    """K x of x_a^2 is -2 of the volume at nodes that have others on all sides."""
    level = with_volumes(backend, axes, volume=0.7)
    index = level.nodes.index
    for a, axis in enumerate(axes):
        if axis.wraps:
            continue
        found = stiffness(backend, level, (axis.spacing * index[a]) ** 2)
        inside = np.ones(level.count, bool)
        for b, other in enumerate(axes):
            inside &= other.wraps | ((index[b] > 0) & (index[b] < other.nodes - 1))
        assert inside.any()
        assert found[inside] == pytest.approx(-2.0 * 0.7, rel=1e-12)


@AXES
def test_stiffness_is_symmetric_and_keeps_constants(backend, axes):
    """x K y = y K x for any volumes; K of a constant is 0 where nothing holds it."""
    level, random = with_volumes(backend, axes), np.random.default_rng(5)
    x, y = random.normal(size=(2, level.count))
    first, second = x @ stiffness(backend, level, y), y @ stiffness(backend, level, x)
    assert first == pytest.approx(second, rel=1e-12)
    assert x @ stiffness(backend, level, x) > 0.0
    assert np.abs(stiffness(backend, level, np.ones(level.count))).max() <= 1e-13


@AXES
def test_matrix_is_what_loops_apply(backend, axes):
    """The matrix of the host, with a boundary coefficient, times a vector."""
    level = with_volumes(backend, axes, boundary_coefficient=0.3)
    x = np.cos(np.arange(level.count))
    assert level.matrix() @ x == pytest.approx(stiffness(backend, level, x), abs=1e-13)


@AXES
def test_transfers_are_transposed(backend, axes):
    """(P e) r = e (P^T r); P of ones is ones, and P^T keeps sums, from level to level."""
    level, random = GridLevel(backend, axes), np.random.default_rng(7)
    while level.can_be_coarser:
        above = level.coarser()
        for one in (level, above):
            backend.fill(one.all["s"], 1.0)
        e, r = random.normal(size=above.count), random.normal(size=level.count)
        set_values(backend, level, "residual", r)
        level.collect(above, "residual", above.outputs("r", "x", "y"))
        collected = backend.to_host(above.at["r"])

        def prolonged(values, level=level, above=above):
            set_values(backend, above, "x", values)
            set_values(backend, level, "x", np.zeros(level.count))
            level.add(above)
            return backend.to_host(level.at["x"])

        assert e @ collected == pytest.approx(prolonged(e) @ r, rel=1e-12, abs=1e-13)
        assert prolonged(np.ones(above.count)) == pytest.approx(np.ones(level.count))
        assert collected.sum() == pytest.approx(r.sum(), abs=1e-12)
        level = above


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_damped_sweep_reduces_short_waves(backend, dimension):
    """What the next grid does not resolve: to a third in a plane, to five ninths in space, by the
    same damping; on a line less well, to seven ninths.

    The simulator is given one wave of those that differ by an exchange of axes.
    """
    level = with_volumes(backend, (Axis(8, 1.0, True),) * dimension, volume=1.0)
    v, largest = backend.to_host(level.at["v"]), 0.0
    for wave in np.ndindex((5,) * dimension):
        if max(wave) < 2 or (IS_SIMULATED and list(wave) != sorted(wave)):
            continue
        phase = 2.0 * np.pi / 8.0 * np.tensordot(wave, level.nodes.index, 1)
        x = np.cos(phase)
        left = x - v * stiffness(backend, level, x)
        largest = max(largest, np.abs(left).max() / np.abs(x).max())
    assert largest == pytest.approx({1: 7.0, 2: 3.0, 3: 5.0}[dimension] / 9.0, rel=1e-9)


def test_odd_periods_stay(backend):
    """Three periods of five cells keep their 125 nodes, more than other grids end with."""
    cells, one = FilledCells(backend, 1, 1.0, (5.0,) * 3), backend.asarray(np.ones(1))
    cells.update(backend.asarray(np.full((3, 1), 0.5)), one)
    correction = GridCorrection(backend, cells)
    correction.prepare(one, backend.zeros(1))
    assert [level.count for level in correction.levels] == [125]
