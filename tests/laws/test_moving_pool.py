"""Pools whose surface moves: pinned at the solid, the same bits, no volume made."""

import numpy as np
from flow_boxes import go, host_fields, pool

from lasersph import compute

MOVING = (
    "solver.flow.surface=moving",
    "material.base=steel-304-demuth",
    "material.surface_tension=1.6 N/m",
)
STEPS = 12
EDGE = 2.1e-6


def moving_pool(backend=None):
    """A pool of 16 of 20 columns and six rows, hot in the middle, after some steps."""
    solver = pool(lambda x, z: (x < EDGE) & (z > -7.5e-7), *MOVING, backend=backend, slope=-5e8)
    go(solver, STEPS)
    return solver


def test_relief():
    """Melt leaves the hot middle; columns of solid keep their height, and volume is conserved."""
    line = moving_pool().domain.surface.line
    assert line.height[0] < -1e-12
    assert line.height.max() > 1e-12
    assert not line.height[line.x > EDGE].any()
    assert abs(line.height.sum()) < 1e-10 * np.abs(line.height).sum()


def test_one_row_of_melt_moves():
    """Down to one row of melt, also where a particle has gone over to the next column."""
    solver = pool(lambda x, z: (x < EDGE) & (z > -1e-7), *MOVING, slope=-2e8)
    position = host_fields(solver)["position"]
    position[0, np.argmin(np.hypot(position[0] - 6.9e-7, position[1]))] -= 7e-8
    solver.backend.copy(solver.backend.asarray(position), solver.position)
    go(solver, 1)
    moves = solver.domain.surface.segments.is_molten
    assert np.array_equal(moves, solver.domain.surface.line.x < EDGE)
    assert solver.fluid_count == np.count_nonzero(moves)
    assert solver.flow.largest_speed > 0.0


def test_same_bits():
    """Arrays that refuse NumPy, and two threads, give the same bits as one."""
    first, *others = (
        moving_pool(backend)
        for backend in (compute.cpu(threads=1), compute.strict(threads=1), compute.cpu(threads=2))
    )
    for other in others:
        assert other.checkpoint_scalars() == first.checkpoint_scalars()
        fields = host_fields(other)
        for name, values in host_fields(first).items():
            assert np.array_equal(values, fields[name]), name
