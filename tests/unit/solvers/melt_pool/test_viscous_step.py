"""Viscous steps of a whole box: exact profiles, and explicit against implicit."""

import numpy as np
import pytest
from flow_boxes import PERIODIC, PERIODIC_HEAT, block_of, box, jittered, matrix_of, place_of, pool

from lasersph.physics.viscosity import momentum
from lasersph.solvers.melt_pool import block as block_module
from lasersph.solvers.melt_pool.block_terms import weight_of
from lasersph.solvers.melt_pool.flow_terms import PLANE
from lasersph.solvers.melt_pool.viscous_step import (
    ViscousStep,
    first_residual,
    matrix_product,
    next_direction,
    next_solution,
    resisted,
)

NU = 0.01
FIRST, SECOND = np.array([1.0, 0.0]), np.array([3.0, -2.0])
COUETTE = {
    "left": "periodic", "right": "periodic", "bottom": "no-slip",
    "surface": {"kind": "moving-wall", "velocity": 1.0},
}  # fmt: skip
SIDES = {"sides": "periodic"}


def advanced(solver, block, v, step, kind, steps=1):
    """Velocities after viscous steps, and the iterations of the last."""
    backend, count = solver.backend, solver.body.count
    viscous = ViscousStep(backend, solver.flow.viscous.volume, NU, kind, PLANE, 2)
    velocity = backend.asarray(v)
    nothing, force = backend.zeros(count), backend.zeros((2, count))
    for _ in range(steps):
        extended = block.ghosts.extend_velocity(velocity, nothing)
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


@pytest.mark.parametrize("share", [0.0, 0.2])
def test_momentum_stays_where_the_viscosity_varies(share):
    """Pairs take a mean that both share; and viscosity only slows."""
    solver = box(flow=PERIODIC, heat=PERIODIC_HEAT)
    block, random = block_of(solver, jittered(solver, share)), np.random.default_rng(5)
    block.weigh_viscosity(solver.backend.asarray(random.uniform(0.1, 1.0, solver.body.count)))
    v = random.normal(size=(2, solver.body.count))
    found, _ = advanced(solver, block, v, 0.02, "implicit")
    assert found.sum(axis=1) == pytest.approx(v.sum(axis=1), abs=1e-6)
    assert np.sum(found**2) < np.sum(v**2)


def arithmetic_weight(g_ij, m_i, m_j):
    """g_ij times the arithmetic mean."""
    return g_ij * (0.5 * (m_i + m_j))


def error_of_layers(cells):
    """Largest error of a sheared film whose upper half has a quarter of the viscosity.

    The stress is the same in both: u = 1.6 (z + 1) / 4 below, four times as steep above.
    """
    solver = box(flow=COUETTE, heat=SIDES, cells=cells, width=0.5)
    block, height = block_of(solver), place_of(solver)[1] + 1.0
    relative = np.where(height > 0.5, 0.25, 1.0)
    block.weigh_viscosity(solver.backend.asarray(relative))
    v, _ = advanced(solver, block, np.zeros((2, height.size)), 500.0, "implicit", steps=8)
    return np.abs(v[0] - np.interp(height, [0.0, 0.5, 1.0], [0.0, 0.2, 1.0])).max()


def test_layers_of_different_viscosity(monkeypatch):
    """Halved cells, half the error. The arithmetic mean errs more than three times as much."""
    errors = [error_of_layers(cells) for cells in (10, 20)]
    assert errors[0] < 0.006
    assert errors[1] < 0.55 * errors[0]
    monkeypatch.setattr(block_module, "viscous_weight", arithmetic_weight)
    assert error_of_layers(20) > 3.0 * errors[1]


def test_turning_melt_feels_no_viscosity():
    """v = (-z, x) has no strain, whatever the viscosity: the transposed gradient takes away what
    pairs do, to 2 % of it in the inner third of a box of twenty cells."""
    solver = box(flow=PERIODIC, heat=PERIODIC_HEAT, cells=20)
    block, flow, backend = block_of(solver), solver.flow, solver.backend
    x, z = place_of(solver)
    inner = (np.abs(x) < 0.17) & (np.abs(z + 0.5) < 0.17)
    relative = 1.0 + 0.5 * x + 0.3 * (z + 0.5) ** 2
    flow.relative_viscosity = backend.asarray(relative)
    block.weigh_viscosity(flow.relative_viscosity)
    v = np.array([-z - 0.5, x])
    pairs = advanced(solver, block, v, 1e-4, "explicit")[0] - v
    flow._viscosity_varies = True
    extended = block.ghosts.extend_velocity(backend.asarray(v), backend.zeros(solver.body.count))
    flow._add_transposed_stress(extended, solver.kinds)
    rest = pairs + 1e-4 * backend.to_host(flow.force)
    assert np.abs(pairs[:, inner]).max() > 0.3e-4 * NU
    assert np.abs(rest[:, inner]).max() < 0.02 * np.abs(pairs[:, inner]).max()


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
    viscous = ViscousStep(backend, solver.flow.viscous.volume, 1e-6, "implicit", PLANE, 2)
    velocity, force = backend.asarray(v), backend.zeros((2, count))
    block = solver.flow.block
    extended = block.ghosts.extend_velocity(velocity, backend.zeros(count))
    viscous.advance(block, velocity, force, extended, solver.kinds, 1e-8)
    found = backend.to_host(velocity)
    fluid = v[0] > 0.0
    assert np.all(found[:, ~fluid] == 0.0)
    assert np.all((found[0, fluid] > 0.0) & (found[0, fluid] < 1.0))


def end_of_profile(solver):
    """Height over the end of the melt, in spacings, where the straight profile of a sheared layer
    ends: the upper row moves with 1 m/s, all below follows from viscosity."""
    solver.fluid_count = solver.kinds.find_fluid(solver.particles["melt_fraction"])
    solver.advect(0.0)
    backend, block, kinds = solver.backend, solver.flow.block, solver.kinds
    z = place_of(solver)[1]
    rows = np.unique(np.round(z[backend.to_host(kinds.fluid) > 0.0], 10))
    top = np.isclose(z, rows[-1])
    v = np.zeros((2, z.size))
    viscous = ViscousStep(backend, solver.flow.viscous.volume, 1e-6, "implicit", PLANE, 2)
    for _ in range(30):
        v[0] = np.where(top, 1.0, v[0])
        velocity, force = backend.asarray(v), backend.zeros((2, z.size))
        extended = block.ghosts.extend_velocity(velocity, backend.zeros(z.size))
        viscous.advance(block, velocity, force, extended, kinds, 1e-6)
        v = np.array(backend.to_host(velocity))
    # a line through the rows in the middle of the layer
    inner = rows[3:-4]
    u = [v[0][np.isclose(z, row)].mean() for row in inner]
    slope, offset = np.polyfit(inner, u, 1)
    spacing = rows[1] - rows[0]
    return (-offset / slope - (rows[0] - 0.5 * spacing)) / spacing


def test_melt_ends_halfway_to_the_solid():
    """What rests is rigid: a sheared layer is at rest where it ends, within a tenth of a spacing;
    as viscous as melt, as published, 0.6 spacings behind."""
    layer = (lambda x, z: z > -1.5e-6, "particles.fine_depth=2.5um", "domain.extent=full",
             "boundaries.sides=periodic")  # fmt: skip
    assert abs(end_of_profile(pool(*layer))) < 0.1
    assert end_of_profile(pool(*layer, "solver.viscosity=explicit")) == pytest.approx(-0.6, abs=0.1)


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


def test_implicit_between_two_particles():
    """V = 1, s g = 0.5: the difference shrinks to 1 / (1 + 2 s g) = 1/2 in one step of the method.

    With equal diagonals the first direction is an eigenvector.
    """
    g, s = 0.5, 1.0
    v = [FIRST, SECOND]
    begun = [first_residual(momentum(g, v[i], v[1 - i]), v[i], 1.0, v[i], g, s) for i in range(2)]
    r, z = [b[0] for b in begun], [b[1] for b in begun]
    q_and_dq = [matrix_product(momentum(g, z[i], z[1 - i]), z[i], 1.0, s) for i in range(2)]
    alpha = sum(b[2] for b in begun) / sum(pair[1] for pair in q_and_dq)
    ended = [next_solution(v[i], r[i], z[i], q_and_dq[i][0], 1.0, g, alpha, s) for i in range(2)]
    mean, half = 0.5 * (FIRST + SECOND), 0.25 * (FIRST - SECOND)
    assert ended[0][0] == pytest.approx(mean + half)
    assert ended[1][0] == pytest.approx(mean - half)
    assert sum(e[4] for e in ended) == pytest.approx(0.0, abs=1e-30)


def test_hoop_stress_resists():
    """V = 2, s = 4, K = 1/8: a fourth of the radial component is lost in a step, and V + s K there
    is 2.5; the diagonal is that of the pairs."""
    totals = np.array([5.0, 3.0]), 0.125
    taken, v_star, inertia = resisted(*totals, np.array([4.0, 4.0]), np.array([8.0, 8.0]), 2.0, 4.0)
    assert taken.tolist() == [5.0, 3.0]
    assert v_star.tolist() == [4.0 - 0.25 * 8.0, 4.0]
    assert inertia.tolist() == [2.5, 2.0]


def test_directions():
    """z + beta d; a weight is summed as it is."""
    assert weight_of(0.5) == 0.5
    assert next_direction(FIRST, SECOND, 2.0).tolist() == [7.0, -4.0]
