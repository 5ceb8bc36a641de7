"""Blocks that grow with the pool, and the pool that becomes too deep."""

import numpy as np
import pytest
from flow_boxes import box, go, places_of, pool

from lasersph.solvers.melt_pool.domain import GROWTH, MELT_MARGIN, PoolTooDeep

SPACING = 1.25e-7
DEEP = ("domain.depth=9um", "particles.fine_depth=8um")


def molten_to(depth, *settings):
    """Pool of the upper left corner, down to `depth` [m]."""
    return pool(lambda x, z: (x < 1e-6) & (z > -depth), *settings)


def block_after(solver):
    """The block for what flows now."""
    solver.time_step_limits()
    return solver.domain.block_for(solver.position, solver.kinds)


def test_block_of_a_box():
    """All particles, down to the bottom."""
    solver = box()
    block = block_after(solver)
    assert (block.count, block.complete_rows, block.has_bottom) == (100, 100, True)
    assert solver.domain.width == 1.0
    assert solver.domain.conditions.periods == (0.0, 0.0)


def test_block_reaches_below_the_pool():
    """Two support radii below the deepest melt at least, with room to grow, and a margin."""
    solver = molten_to(4.0 * SPACING, *DEEP)
    block = block_after(solver)
    domain = solver.domain
    needed = 3.5 * SPACING + MELT_MARGIN * domain.support
    assert 0.0 <= domain.block_layers - GROWTH - needed / SPACING + 1e-9 <= 1.0
    assert block.complete_rows == 20 * domain.block_layers < block.count < solver.body.count
    assert not block.has_bottom


def test_block_is_kept_and_grows():
    """The same block while the pool fits; a larger one after; never a smaller one."""
    solver = molten_to(4.0 * SPACING, *DEEP)
    first = block_after(solver)
    assert block_after(solver) is first
    other = molten_to(30.0 * SPACING, *DEEP)
    solver.backend.copy(other.particles["enthalpy"], solver.particles["enthalpy"])
    solver.body.update_temperature()
    larger = block_after(solver)
    assert larger.complete_rows > first.complete_rows
    small = molten_to(2.0 * SPACING, *DEEP)
    solver.backend.copy(small.particles["enthalpy"], solver.particles["enthalpy"])
    solver.body.update_temperature()
    assert block_after(solver) is larger


def test_pool_too_deep():
    """The message names the depth of the pool, that of the fine layers, and a remedy that works."""
    with pytest.raises(PoolTooDeep) as told:
        solver = molten_to(2e-6)
        solver.step(1e-12)
    text = str(told.value)
    assert "flows into layers coarser than 125 nm, which begin at 1.25 um" in text
    remedy = text.partition('give particles.fine_depth = "')[2].partition('"')[0]
    block_after(molten_to(2e-6, f"particles.fine_depth={remedy}"))


def test_at_the_last_fine_layer():
    """Melt in all of the finest layers still flows."""
    solver = molten_to(1.25e-6)
    solver.step(1e-12)
    assert solver.fluid_count == 8 * 10


def test_coarse_layers_see_the_finest_where_they_are():
    """Where the lowest of the finest have moved, those below give them as much heat as they get."""
    solver = molten_to(4.0 * SPACING, "domain.depth=9um", "particles.ratio=0.6")
    z = np.array(solver.position[1])
    lowest = np.isclose(z, z[z > -1.25e-6].min())
    solver.particles.set("position", np.array([solver.position[0], z + 0.1 * SPACING * lowest]))
    solver.domain.cover_fine_layers()
    block = solver.domain.block_for(solver.position, solver.kinds)
    has_row = solver.backend.zeros(block.count)
    solver.backend.fill(has_row, 1.0)
    block.find_pairs(solver.position, has_row)
    solver.pairs.update(block)
    # sum of g_ij (a_j - a_i) over all pairs: 0 where g_ij = g_ji
    pairs = solver.body.pairs
    row, place = places_of(solver.backend, pairs.neighbors)
    other = np.asarray(pairs.neighbors.neighbor, int)[place]
    exchanged = np.asarray(pairs.weights)[place] * (z[other] - z[row])
    assert abs(exchanged.sum()) < 1e-12 * np.abs(exchanged).sum()


def test_pressure_does_not_see_the_coarser_layers():
    """Layers that grow below the pool change neither grid nor iterations of its pressure."""
    counts = []
    for settings in (DEEP, ("domain.depth=9um",)):
        solver = pool(lambda x, z: (x < 2.2e-6) & (z > -1.25e-6), *settings, slope=1e8)
        go(solver, 2)
        counts.append(solver.iterations["pressure"])
    assert solver.flow.block.layers.search_radius > 2.5 * solver.flow.block.layers.moving_support
    assert counts[0] == counts[1] > 0
