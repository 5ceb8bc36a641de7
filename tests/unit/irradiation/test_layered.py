"""Layered light on particles that have moved: all of it is absorbed, and the scaling is booked."""

import numpy as np
import pytest
from flow_boxes import pool

LIT = (50e-9, 50.05e-9)
"""Begin and end of a step near the peak of the pulse [s]."""


def lit_pool(shift):
    """Light of a step on a pool whose first 60 particles have moved by `shift` spacings [m]."""
    solver = pool(lambda x, z: z > -5e-7)
    backend, light = solver.backend, solver.body.light
    light.shine(*LIT)
    temperature = solver.particles["temperature"]
    lattice = light.absorb(temperature)
    moved = (np.arange(solver.particle_count) < 60).astype(float)
    place = backend.to_host(solver.position) + moved * shift * solver.domain.spacing
    position = backend.asarray(place)
    solver.domain.find_depth(position, solver._depth)
    light.follow(position, solver._depth, backend.asarray(moved), temperature)
    return solver, lattice, light.absorb(temperature), place


@pytest.fixture(scope="module")
def shift():
    """Displacements of all particles in x and z."""
    return np.random.default_rng(1).uniform(-0.3, 0.3, (2, 1))


def test_depth_is_below_the_surface(shift):
    """The surface says how deep a particle lies."""
    solver, *_, place = lit_pool(shift)
    assert np.array_equal(solver.backend.to_host(solver._depth), -place[1])


def test_all_light_is_absorbed(shift):
    """As much as on the lattice, and what was added for that is booked."""
    solver, lattice, total, _ = lit_pool(shift)
    light = solver.body.light
    assert light.incident > lattice > 0.0
    assert total == pytest.approx(lattice, rel=1e-12)
    assert 0.0 < abs(light.rescaled) < 0.3 * total


def test_nothing_is_booked_on_the_lattice():
    """Particles where they were take what they took, to rounding."""
    solver, lattice, total, _ = lit_pool(np.zeros((2, 1)))
    assert total == pytest.approx(lattice, rel=1e-14)
    assert abs(solver.body.light.rescaled) <= 1e-12 * lattice


def test_next_step_begins_anew(shift):
    """`shine` forgets what the last step has booked."""
    light = lit_pool(shift)[0].body.light
    light.shine(*LIT)
    assert light.rescaled == 0.0
