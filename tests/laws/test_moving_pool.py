"""Pools whose surface moves: pinned at the solid, the same bits, no volume made."""

import numpy as np
import pytest
from flow_boxes import go, host_fields, pool

from lasersph import compute
from lasersph.input import format_quantity
from lasersph.solvers.step_control import NotConverged

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
    assert not line.height[line.centers() > EDGE].any()
    assert abs(line.height.sum()) < 1e-10 * np.abs(line.height).sum()


def test_flow_that_has_become_unstable():
    """It stops at once, with the speed, the place and what to change."""
    solver = moving_pool()
    velocity = host_fields(solver)["velocity"]
    fastest = np.argmax(velocity[0])
    velocity[1, fastest] = 2000.0
    solver.flow.set_initial_velocity(velocity)
    x, z = (format_quantity(place, "m", 3) for place in host_fields(solver)["position"][:, fastest])
    line = rf"unstable: 2e\+03 m/s at x = {x}, z = {z}; take another particles.spacing"
    with pytest.raises(NotConverged, match=line):
        solver.step(1e-12)


def test_one_row_of_melt_moves():
    """Down to one row of melt, also where a particle has gone over to the next column."""
    solver = pool(lambda x, z: (x < EDGE) & (z > -1e-7), *MOVING, slope=-2e8)
    position = host_fields(solver)["position"]
    position[0, np.argmin(np.hypot(position[0] - 6.9e-7, position[1]))] -= 7e-8
    solver.backend.copy(solver.backend.asarray(position), solver.position)
    go(solver, 1)
    moves = solver.domain.surface.segments.is_molten
    assert np.array_equal(moves, solver.domain.surface.line.centers() < EDGE)
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


HALF, HEIGHT = 6e-7, 4.2e-7
"""Half of the chord and height of a drop [m], which meets the solid at 54 degrees."""


def drop_on_solid(tmp_path):
    """A drop of steel over a pool of its own width, on solid that it does not melt; its surface
    tension is weak, so that it creeps."""
    x = np.linspace(-3e-6, 3e-6, 3001)
    rows = np.c_[x, np.maximum(HEIGHT * (1.0 - (x / HALF) ** 2), 0.0)]
    path = tmp_path / "drop.csv"
    np.savetxt(path, rows, delimiter=",", header="x_m,height_m", comments="")
    settings = ("particles.spacing=60nm", "particles.fine_depth=900nm", "laser.fluence=1e-9 J/cm^2",
                "solver.marangoni=false", f"solver.flow.initial_surface.path={path}",
                "material.conductivity=1e-6 W/(m K)", "material.surface_tension=0.448 N/m",
                "time.step=1ns", "domain.extent=full")  # fmt: skip
    return pool(
        lambda x, z: (np.abs(x) < HALF) & (z > -1.5e-7), *MOVING, *settings, hot=1760.0, cold=1600.0
    )


def kept_line(solver):
    """Arrays of the line, by the names of a checkpoint."""
    return {k: solver.backend.to_host(v) for k, v in solver.domain.surface.state.kept.items()}


def test_drop_spreads_to_the_advancing_angle(tmp_path):
    """To 45 degrees at its edge: the segment of a circle of its area, whose chord the pins meet
    within a column; both sides alike, volume is kept, columns that are just reached drive no flow,
    and what is restored on the way has the same bits."""
    solver = drop_on_solid(tmp_path)
    segments, line = solver.domain.surface.segments, solver.domain.surface.line
    area = line.height.sum() * line.widths[0]
    go(solver, 30)
    again = drop_on_solid(tmp_path)
    again.restore(host_fields(solver) | kept_line(solver), solver.checkpoint_scalars())
    for one in (solver, again):
        go(one, 5)
    for name, values in host_fields(solver).items():
        assert np.array_equal(values, host_fields(again)[name]), name
    assert solver.flow.largest_speed < 10.0
    go(solver, 40)
    assert abs(line.height.sum() * line.widths[0] / area - 1.0) < 1e-12
    assert np.abs(line.height - line.height[::-1]).max() < 1e-12 * line.height.max()
    chord = 2.0 * np.sqrt(area / (np.pi / 4.0 - 0.5)) * np.sin(np.pi / 4.0)
    assert abs(segments.is_molten.sum() * line.widths[0] - chord) < line.widths[0]
