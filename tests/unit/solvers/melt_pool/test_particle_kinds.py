"""Kinds of the particles of a small patch: fluid, edge, dummy, interior."""

import numpy as np
import pytest
from flow_boxes import pool

from lasersph.particles.kinds import DUMMY, EDGE, FLUID, INTERIOR
from lasersph.particles.particles import Particles
from lasersph.solvers.melt_pool.particle_kinds import (
    ParticleKinds,
    fluid_neighbors,
    is_fluid,
    kind_of,
)


def test_what_flows():
    """Only what is molten completely; mush is wall; and what flows or rests since."""
    assert is_fluid(1.0, 1.0) == (1.0, 1.0, 0.0)
    assert is_fluid(1.0, 0.0) == (1.0, 1.0, 1.0)
    assert is_fluid(0.999, 1.0) == (0.0, 0.0, 1.0)
    assert is_fluid(0.0, 0.0) == (0.0, 0.0, 0.0)


def test_fluid_neighbors_by_hand():
    """A fluid neighbor at 2 spacings: within the support of 3.75, not within 1.5 of the edge."""
    assert fluid_neighbors(1.0, 0.1, 2.0, 1.5) == (1.0, 0.0)
    assert fluid_neighbors(1.0, 0.1, 1.4, 1.5) == (1.0, 1.0)
    assert fluid_neighbors(1.0, 0.0, 3.8, 1.5) == (0.0, 0.0)
    assert fluid_neighbors(0.0, 0.1, 1.0, 1.5) == (0.0, 0.0)


@pytest.mark.parametrize(
    ("within", "close", "fluid", "kind"),
    [(5, 3, 1, FLUID), (0, 0, 1, FLUID), (5, 3, 0, EDGE), (5, 0, 0, DUMMY), (0, 0, 0, INTERIOR)],
)
def test_kind_by_hand(within, close, fluid, kind):
    """Fluid itself; next to it; within its support; far."""
    found, unknown, dummy, *_ = kind_of(float(within), float(close), float(fluid))
    assert found == kind
    assert unknown == (kind in (FLUID, EDGE))
    assert dummy == (kind == DUMMY)


def test_patch():
    """Around a molten square of 4 x 3: a ring of edge, dummies in the support, then interior."""
    spacing = 1.25e-7
    solver = pool(lambda x, z: (x < 4 * spacing) & (z > -3 * spacing))
    solver.time_step_limits()
    solver.advect(0.0)
    kinds, host = solver.kinds, solver.backend.to_host
    x, z = host(solver.position)
    column, row = np.rint(x / spacing - 0.5), np.rint(-z / spacing - 0.5)
    out = np.hypot(np.maximum(column - 3, 0), np.maximum(row - 2, 0))
    expected = np.select([out == 0, out < 1.5, out < 3.75], [FLUID, EDGE, DUMMY], INTERIOR)
    fine = np.arange(solver.body.count) < 20 * 8
    assert np.array_equal(host(kinds.kind)[fine], expected[fine])
    assert solver.fluid_count == 12
    assert np.array_equal(
        host(kinds.unknown)[fine] > 0, (expected == FLUID)[fine] | (expected == EDGE)[fine]
    )
    assert np.array_equal(host(kinds.dummy)[fine] > 0, expected[fine] == DUMMY)


def test_box(backend):
    """In a box all flow, whatever the melt fraction says."""
    particles = Particles(backend, 3, 2)
    kinds = ParticleKinds(particles, 0.1, is_box=True)
    assert kinds.find_fluid(backend.asarray([0.0, 0.5, 1.0])) == 3.0
    kinds = ParticleKinds(Particles(backend, 3, 2), 0.1, is_box=False)
    assert kinds.find_fluid(backend.asarray([0.0, 0.5, 1.0])) == 1.0
    assert backend.to_host(kinds.fluid).tolist() == [0.0, 0.0, 1.0]
