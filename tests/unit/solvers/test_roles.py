"""Roles of the particles of a small patch: fluid, edge, dummy, rest."""

import numpy as np
import pytest
from flow_boxes import pool

from lasersph.particles.particles import Particles
from lasersph.solvers.melt_pool.roles import (
    DUMMY,
    EDGE,
    FLUID,
    MOLTEN,
    REST,
    Roles,
    flowing,
    nearby,
    role_of,
)

NAMES = {"fluid_role": FLUID, "edge_role": EDGE, "dummy_role": DUMMY}


def test_what_flows():
    """Only what is molten completely; mush is wall; in a box everything."""
    for f_m, is_box, expected in ((1.0, 0, 1), (0.999, 0, 0), (0.0, 0, 0), (0.0, 1, 1)):
        assert flowing(f_m, float(is_box), MOLTEN) == expected


def test_nearby_by_hand():
    """A fluid neighbor at 2 spacings: within the support of 3.75, not within 1.5 of the edge."""
    assert nearby(1.0, 2.0, 3.75, 1.5) == (1.0, 0.0)
    assert nearby(1.0, 1.4, 3.75, 1.5) == (1.0, 1.0)
    assert nearby(1.0, 3.8, 3.75, 1.5) == (0.0, 0.0)
    assert nearby(0.0, 1.0, 3.75, 1.5) == (0.0, 0.0)


@pytest.mark.parametrize(
    ("reach", "close", "fluid", "role"),
    [(5, 3, 1, FLUID), (0, 0, 1, FLUID), (5, 3, 0, EDGE), (5, 0, 0, DUMMY), (0, 0, 0, REST)],
)
def test_role_by_hand(reach, close, fluid, role):
    """Fluid itself; next to it; in its reach; far."""
    found, unknown, dummy, *_ = role_of(float(reach), float(close), float(fluid), **NAMES)
    assert found == role
    assert unknown == (role in (FLUID, EDGE))
    assert dummy == (role == DUMMY)


def test_patch():
    """Around a molten square of 4 x 3: one ring of edge, the support's rest dummies, then rest."""
    spacing = 1.25e-7
    solver = pool(lambda x, z: (x < 4 * spacing) & (z > -3 * spacing))
    solver.time_step_limits()
    solver.advect(0.0)
    roles, host = solver.roles, solver.backend.to_host
    x, z = host(solver.position)
    column, row = np.rint(x / spacing - 0.5), np.rint(-z / spacing - 0.5)
    out = np.hypot(np.maximum(column - 3, 0), np.maximum(row - 2, 0))
    expected = np.select([out == 0, out < 1.5, out < 3.75], [FLUID, EDGE, DUMMY], REST)
    fine = np.arange(solver.body.count) < 20 * 8
    assert np.array_equal(host(roles.role)[fine], expected[fine])
    assert solver.fluid_count == 12
    assert np.array_equal(
        host(roles.unknown)[fine] > 0, (expected == FLUID)[fine] | (expected == EDGE)[fine]
    )
    assert np.array_equal(host(roles.dummy)[fine] > 0, expected[fine] == DUMMY)


def test_box(backend):
    """In a box all flow, whatever the melt fraction says."""
    particles = Particles(backend, 3, 2, ("was_fluid",))
    roles = Roles(particles, 0.1, is_box=True)
    assert roles.find_fluid(backend.asarray([0.0, 0.5, 1.0])) == 3.0
    roles = Roles(particles, 0.1, is_box=False)
    assert roles.find_fluid(backend.asarray([0.0, 0.5, 1.0])) == 1.0
    assert backend.to_host(roles.fluid).tolist() == [0.0, 0.0, 1.0]
