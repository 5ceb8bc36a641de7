"""Viscous steps of a whole box: exact profiles, and explicit against implicit."""

import numpy as np
import pytest
from flow_boxes import PERIODIC, PERIODIC_HEAT, block_of, box, jittered, matrix_of, place_of, pool

from lasersph.solvers.melt_pool.ghost_fields import velocity_change
from lasersph.solvers.melt_pool.viscous_step import ViscousStep

NU = 0.01
COUETTE = {
    "left": "periodic", "right": "periodic", "bottom": "no-slip",
    "surface": {"kind": "moving-wall", "velocity": 1.0},
}  # fmt: skip
SIDES = {"sides": "periodic"}


def advanced(solver, block, v, step, kind, steps=1):
    """Velocities after viscous steps, and the iterations of the last."""
    backend, count = solver.backend, solver.body.count
    viscous = ViscousStep(backend, solver.flow.viscous.volume, NU, kind)
    velocity = backend.asarray(v)
    nothing, force = backend.zeros(count), backend.zeros((2, count))
    for _ in range(steps):
        extended = block.extend_velocity(velocity, nothing)
        iterations = viscous.advance(block, velocity, force, extended, solver.kinds, step)
    return backend.to_host(velocity), iterations


@pytest.mark.parametrize("share", [0.0, 0.2])
def test_explicit_and_implicit_agree_for_small_steps(share):
    """Their difference is of second order in the step: halved steps, a quarter of it."""
    solver = box()
    block = block_of(solver, jittered(solver, share))
    x, z = place_of(solver)
    v = np.array([np.cos(2.0 * x) * z, np.sin(3.0 * z)])
    differences = []
    for step in (2e-3, 1e-3):
        explicit, none = advanced(solver, block, v, step, "explicit")
        implicit, iterations = advanced(solver, block, v, step, "implicit")
        assert none == 0 and iterations > 0
        change = np.abs(explicit - v).max()
        differences.append(np.abs(explicit - implicit).max())
        assert differences[-1] < 0.1 * change
    assert differences[0] / differences[1] == pytest.approx(4.0, rel=0.1)


@pytest.mark.parametrize("kind", ["explicit", "implicit"])
def test_couette_profile_is_at_rest(kind):
    """u = 1 + z between a wall at rest and a moving one changes by rounding, up to the walls."""
    solver = box(flow=COUETTE, heat=SIDES)
    block = block_of(solver)
    v = np.zeros((2, solver.body.count))
    v[0] = 1.0 + place_of(solver)[1]
    found, _ = advanced(solver, block, v, 0.01, kind, steps=3)
    assert found == pytest.approx(v, abs=1e-12)


def test_couette_is_reached():
    """From rest: long implicit steps lead to the straight profile."""
    solver = box(flow=COUETTE, heat=SIDES)
    block = block_of(solver)
    v, _ = advanced(solver, block, np.zeros((2, solver.body.count)), 500.0, "implicit", steps=8)
    assert v[0] == pytest.approx(1.0 + place_of(solver)[1], abs=1e-6)
    assert v[1] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("kind", ["explicit", "implicit"])
def test_momentum_stays(kind):
    """In a periodic box what one particle gains another loses, on disordered particles too."""
    solver = box(flow=PERIODIC, heat=PERIODIC_HEAT)
    block = block_of(solver, jittered(solver))
    v = np.random.default_rng(5).normal(size=(2, solver.body.count))
    found, _ = advanced(solver, block, v, 0.02, kind)
    assert found.sum(axis=1) == pytest.approx(v.sum(axis=1), abs=1e-6)
    assert np.sum(found**2) < np.sum(v**2)


def test_implicit_solves_its_equation():
    """(V - nu dt sum g) v = V v*, assembled as a matrix from the folded pairs."""
    solver = box(flow=PERIODIC, heat=PERIODIC_HEAT)
    block = block_of(solver, jittered(solver))
    v = np.random.default_rng(5).normal(size=(2, solver.body.count))
    found, _ = advanced(solver, block, v, 0.05, "implicit")
    g = matrix_of(solver.backend, block.without_ghosts(), block.weights, block.count)
    V, s = solver.backend.to_host(solver.flow.viscous.volume), NU * 0.05
    A = np.diag(V + s * g.sum(axis=1)) - s * g
    assert np.abs(A - A.T).max() < 1e-15
    assert found == pytest.approx(np.linalg.solve(A, (V * v).T).T, abs=1e-6)


def test_solid_drags():
    """A particle of the melt loses speed to the solid, which keeps none."""
    solver = pool(lambda x, z: (x < 6e-7) & (z > -4e-7))
    solver.time_step_limits()
    solver.advect(0.0)
    backend, count = solver.backend, solver.body.count
    v = np.zeros((2, count))
    v[0] = backend.to_host(solver.kinds.fluid)
    viscous = ViscousStep(backend, solver.flow.viscous.volume, 1e-6, "implicit")
    velocity, force = backend.asarray(v), backend.zeros((2, count))
    block = solver.flow.block
    extended = block.extend_velocity(velocity, backend.zeros(count))
    viscous.advance(block, velocity, force, extended, solver.kinds, 1e-8)
    found = backend.to_host(velocity)
    fluid = v[0] > 0.0
    assert np.all(found[:, ~fluid] == 0.0)
    assert np.all((found[0, fluid] > 0.0) & (found[0, fluid] < 1.0))


def test_nothing_flows():
    """No rows, no iterations."""
    solver = box()
    block = block_of(solver)
    backend = solver.backend
    solver.kinds.fluid_rows = backend.zeros(0, "index")
    v = np.ones((2, solver.body.count))
    found, iterations = advanced(solver, block, v, 0.1, "implicit")
    assert iterations == 0
    assert np.array_equal(found, v)


def test_velocity_change_of_a_ghost():
    """S d of its source."""
    d = np.array([1.0, 2.0]), np.array([-1.0, 3.0])
    found = velocity_change(1, 2, *d, np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.0, -1.0]))
    assert found.tolist() == [2.0, -3.0]
