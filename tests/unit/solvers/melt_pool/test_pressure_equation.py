"""Pressure equation: manufactured solutions, singular pools, several pools, sizes and threads."""

import numpy as np
import pytest
from scattered_pairs import BOTTOM, LEFT, RIGHT, TOP, scattered

from lasersph import compute
from lasersph.linear_solvers.unknowns import Unknowns
from lasersph.solvers.melt_pool.pressure_equation import PressureEquation


def equation(backend, pairs, *, mask=None, coefficient=None, tolerance=1e-10, max_iterations=200):
    """Equation of the pairs with its operator set."""
    mask = np.ones(pairs.count) if mask is None else mask
    solver = PressureEquation(
        backend, Unknowns(backend, pairs.count, pairs.support, pairs.spacing, pairs.period),
        tolerance=tolerance, max_iterations=max_iterations,
    )  # fmt: skip
    mask, volume = pairs.arrays(backend, mask, pairs.volume)
    coefficient = None if coefficient is None else backend.asarray(coefficient)
    solver.set_operator(
        pairs.neighbors(backend), backend.asarray(pairs.g), mask, volume, coefficient
    )
    return solver


def solved(backend, solver, b, *, value=None, flux=None, guess=None):
    """Outcome and pressure on the host."""
    given = {
        name: backend.asarray(array)
        for name, array in (("value", value), ("flux", flux))
        if array is not None
    }
    pressure = backend.asarray(np.zeros(b.size) if guess is None else guess)
    outcome = solver.solve(backend.asarray(b), pressure, **given)
    return outcome, backend.to_host(pressure)


def exact(x, z):
    """Pressure with dp/dx = 0 at x = 0 and 1, p = cos(pi x) at z = 0, dp/dn given at z = -1."""
    return np.cos(np.pi * x) * np.exp(z)


def laplacian(x, z):
    return (1.0 - np.pi**2) * exact(x, z)


def manufactured_error(rows, jitter, is_simple):
    """RMS error for p given on top, a flux below, mirrors at the sides.

    is_simple: cross-section over distance on the first row; else by the pairs with ghosts.
    """
    backend = compute.cpu(threads=2)
    pairs = scattered(rows, jitter=jitter)
    x, z = pairs.position
    i, n = pairs.i, pairs.count
    g = np.array(pairs.g)
    if is_simple:
        is_first = z > -pairs.spacing
        coefficient = np.where(is_first, pairs.spacing / -z, 0.0)
        value = np.cos(np.pi * x)
        g[pairs.face == TOP] = 0.0
    else:
        on_top = pairs.face == TOP
        ratio = (pairs.partner[1] - z[i]) / -z[i]
        share = np.where(on_top, g * ratio, 0.0)
        place = x[i] + (pairs.partner[0] - x[i]) / np.where(on_top, ratio, 1.0)
        coefficient = np.bincount(i, share, minlength=n)
        value = np.bincount(i, share * np.cos(np.pi * place), minlength=n) / np.maximum(
            coefficient, 1e-30
        )
        g[on_top] = 0.0
    # dp/dn = -dp/dz on the bottom; the ghost of j has p_j + 2 depth_j dp/dn
    below = pairs.face == BOTTOM
    slope = -exact(pairs.partner[0], -1.0)
    flux = np.bincount(
        i, np.where(below, g * 2.0 * (-1.0 - pairs.partner[1]) * slope, 0.0), minlength=n
    )
    solver = PressureEquation(
        backend, Unknowns(backend, n, pairs.support, pairs.spacing), tolerance=1e-8
    )
    one, volume, g, coefficient = pairs.arrays(backend, np.ones(n), pairs.volume, g, coefficient)
    solver.set_operator(pairs.neighbors(backend), g, one, volume, coefficient)
    outcome, p = solved(backend, solver, pairs.volume * laplacian(x, z), value=value, flux=flux)
    assert outcome.residual <= 1e-8
    return np.sqrt(np.mean((p - exact(x, z)) ** 2))


def test_images_of_given_pressure_converge_with_the_square_of_the_spacing():
    """A given pressure, a flux and a divergence, on a lattice."""
    errors = [manufactured_error(rows, 0.0, False) for rows in (20, 40, 80)]
    assert np.log2(errors[0] / errors[1]) >= 1.9 and np.log2(errors[1] / errors[2]) >= 1.9
    assert errors[2] <= 1e-4


def test_cross_section_over_distance_converges():
    """The same with the pressure given to the first row alone, half a spacing away."""
    errors = [manufactured_error(rows, 0.0, True) for rows in (20, 40, 80)]
    assert errors[1] < 0.8 * errors[0] and errors[2] < 0.7 * errors[1]
    assert errors[2] <= 1e-3


def test_manufactured_solution_on_jittered_particles():
    """Displaced by up to a tenth of the spacing the error still falls, down to the disorder's."""
    errors = [manufactured_error(rows, 0.1, False) for rows in (10, 20, 40)]
    assert errors[1] < 0.3 * errors[0] and errors[2] < 0.7 * errors[1]


def ellipse(x, z):
    """A pool under the surface, mirrored at x = 0."""
    return (x / 2.0) ** 2 + (z / 0.8) ** 2 < 1.0


def rough(count, seed=1):
    """Right-hand side without order."""
    return np.random.default_rng(seed).standard_normal(count)


@pytest.mark.parametrize("make", [compute.cpu, compute.strict])
def test_pool_without_given_pressure(make):
    """The mean of the right-hand side is removed, the mean of p is 0: as by a pseudo-inverse."""
    backend = make(threads=2)
    pairs = scattered(20, 2.0, jitter=0.2, inside=ellipse, mirrors=(LEFT, TOP))
    b = rough(pairs.count) + 0.7
    solver = equation(backend, pairs)
    outcome, p = solved(backend, solver, b)
    expected = np.linalg.pinv(pairs.dense(), rcond=1e-10) @ (b.mean() - b)
    assert np.abs(p - expected).max() <= 1e-7 * np.abs(expected).max()
    assert solver.components.count == 1 and outcome.residual <= 1e-10
    assert abs(p.mean()) <= 1e-12 * np.abs(p).max()


def test_given_pressure_is_left_alone():
    """With a boundary coefficient nothing is removed: p solves A p = a p_b + f - b."""
    backend = compute.cpu(threads=2)
    pairs = scattered(16, 1.0, jitter=0.2, mirrors=(LEFT, RIGHT))
    coefficient = np.where(pairs.position[1] > -pairs.spacing, 2.0, 0.0)
    b, value, flux = rough(pairs.count), np.full(pairs.count, 3.0), 0.1 * rough(pairs.count, 2)
    solver = equation(backend, pairs, coefficient=coefficient)
    _, p = solved(backend, solver, b, value=value, flux=flux)
    expected = np.linalg.solve(pairs.dense(coefficient=coefficient), coefficient * value + flux - b)
    assert np.abs(p - expected).max() <= 1e-7 * np.abs(expected).max()


def test_uniform_given_pressure_without_flow_is_exact():
    """p_b everywhere the same, no divergence, no flux: p = p_b to rounding."""
    backend = compute.cpu(threads=2)
    pairs = scattered(16, 1.0, jitter=0.2, mirrors=(LEFT, RIGHT))
    coefficient = np.where(pairs.position[1] > -pairs.spacing, 2.0, 0.0)
    solver = equation(backend, pairs, coefficient=coefficient, tolerance=1e-12)
    value = np.full(pairs.count, 1e5)
    _, p = solved(backend, solver, np.zeros(pairs.count), value=value)
    np.testing.assert_allclose(p, 1e5, rtol=1e-11)


def two_pools(x, z):
    """Two pools with five spacings of solid between, a remnant of nine and one of two particles."""
    first = np.hypot(x - 0.5, z) < 0.38
    second = np.hypot(x - 1.5, z) < 0.37
    remnant = (np.abs(x - 1.025) < 0.07) & (np.abs(z + 0.825) < 0.07)
    few = (np.abs(x - 0.025) < 0.02) & (np.abs(z + 0.95) < 0.04)
    return first | second | remnant | few


def test_pools_and_remnants():
    """Each pool has its own mean; two lone particles have p = 0; fixed particles take no part."""
    backend = compute.cpu(threads=2)
    pairs = scattered(20, 2.0)
    x, z = pairs.position
    mask = two_pools(x, z).astype(float)
    b = rough(pairs.count) + np.where(x < 1.0, 2.0, -1.0)
    solver = equation(backend, pairs, mask=mask)
    outcome, p = solved(backend, solver, b, guess=np.ones(pairs.count))
    assert solver.components.count == 3 and outcome.residual <= 1e-10
    few = (mask > 0) & (x < 0.1) & (z < -0.9)
    assert few.sum() == 2 and not p[few].any() and not p[mask == 0.0].any()
    for pool in (np.hypot(x - 0.5, z) < 0.38, np.hypot(x - 1.5, z) < 0.37, (mask > 0) & (z < -0.7)):
        pool = pool & ~few
        A = pairs.dense(pool.astype(float))
        expected = np.linalg.pinv(A, rcond=1e-10) @ (pool * (b[pool].mean() - b))
        assert np.abs(p - expected)[pool].max() <= 1e-7 * np.abs(expected).max()
        assert abs(p[pool].mean()) <= 1e-10


def test_weak_contact_between_pools_is_cut():
    """Pools two spacings apart are within each other's support but exchange nothing."""
    backend = compute.cpu(threads=2)
    pairs = scattered(20, 2.0)
    x, _ = pairs.position
    mask = (np.abs(x - 1.0) > 2.1 * pairs.spacing).astype(float)
    b = np.where(x < 1.0, 1.0, -2.0) + 0.1 * rough(pairs.count)
    solver = equation(backend, pairs, mask=mask)
    _, p = solved(backend, solver, b)
    left = (x < 1.0) & (mask > 0)
    expected = np.linalg.pinv(pairs.dense(left.astype(float)), rcond=1e-10) @ (
        left * (b[left].mean() - b)
    )
    assert solver.components.count == 2
    assert np.abs(p - expected)[left].max() <= 1e-7 * np.abs(expected).max()


def test_nothing_molten():
    """No unknown at all: no iteration, no pressure."""
    backend = compute.cpu(threads=2)
    pairs = scattered(8)
    solver = equation(backend, pairs, mask=np.zeros(pairs.count))
    outcome, p = solved(backend, solver, rough(pairs.count), guess=np.ones(pairs.count))
    assert outcome.iterations == 0 and solver.components.count == 0 and not p.any()


def test_particle_without_weights():
    """One that touches the pool but exchanges nothing: finite, and the residual says so after more
    iterations than the others need; far beyond, rounding of a pressure that grows may hide it."""
    backend = compute.cpu(threads=2)
    pairs = scattered(12)
    g = np.where((pairs.i == 50) | (pairs.j == 50), 0.0, pairs.g)
    solver = PressureEquation(
        backend,
        Unknowns(backend, pairs.count, pairs.support, pairs.spacing),
        tolerance=1e-8,
        max_iterations=40,
    )
    g, one, volume = pairs.arrays(backend, g, np.ones(pairs.count), pairs.volume)
    solver.set_operator(pairs.neighbors(backend), g, one, volume)
    b = rough(pairs.count)
    outcome, p = solved(backend, solver, b)
    assert outcome.residual > 1e-8 and np.isfinite(p).all()


def test_periodic_box():
    """Whole periods along x and mirrors along z: one component, as by a pseudo-inverse."""
    backend = compute.cpu(threads=2)
    pairs = scattered(20, 1.5, jitter=0.2, is_periodic=True)
    b = rough(pairs.count)
    solver = equation(backend, pairs)
    _, p = solved(backend, solver, b)
    expected = np.linalg.pinv(pairs.dense(), rcond=1e-10) @ (b.mean() - b)
    assert np.abs(p - expected).max() <= 1e-7 * np.abs(expected).max()
    assert solver.components.count == 1


def iterations_of(rows, width, inside=None, tolerance=1e-6):
    backend = compute.cpu(threads=2)
    pairs = scattered(rows, width, jitter=0.15, inside=inside, mirrors=(LEFT, TOP))
    x, z = pairs.position
    b = np.cos(3.0 * x / width) + np.sin(5.0 * z) + 0.3 * rough(pairs.count)
    solver = equation(backend, pairs, tolerance=tolerance)
    return solved(backend, solver, b)[0].iterations


def test_iterations_do_not_grow():
    """Boxes of 400 and 14 400 particles, a pool and a thin one: at most 20 iterations to 1e-6."""
    boxes = [iterations_of(rows, 1.0) for rows in (20, 120)]
    pools = [iterations_of(30, 4.0, lambda x, z: (x / 4) ** 2 + z**2 < 1.0),
             iterations_of(10, 25.0, lambda x, z: (x / 25) ** 2 + z**2 < 1.0)]  # fmt: skip
    assert max(boxes + pools) <= 20
    assert boxes[1] <= boxes[0] + 5
    assert iterations_of(120, 1.0, tolerance=1e-4) <= 15


def test_first_guess_saves_iterations():
    """The solution itself needs none, one that is 1 % off fewer; nothing but p is remembered."""
    backend = compute.cpu(threads=2)
    pairs = scattered(40, 1.0, jitter=0.15)
    b = rough(pairs.count)
    solver = equation(backend, pairs, tolerance=1e-6)
    cold, p = solved(backend, solver, b)
    assert solved(backend, solver, b, guess=p)[0].iterations == 0
    near = p * (1.0 + 0.01 * np.sin(7.0 * pairs.position[0]))
    warm, again = solved(backend, solver, b, guess=near)
    assert warm.iterations <= cold.iterations - 3
    afresh = solved(backend, equation(backend, pairs, tolerance=1e-6), b, guess=near)
    assert np.array_equal(afresh[1], again)


def test_threads_and_former_operators_change_no_bit():
    """One thread and two, a new solver and one that has seen another pool: the same bits."""
    pairs = scattered(80, 2.0, jitter=0.15, mirrors=(LEFT, TOP))
    x, z = pairs.position
    pool = ellipse(x, z).astype(float)
    b, runs = rough(pairs.count), []
    for threads in (1, 2):
        backend = compute.cpu(threads=threads)
        solver = equation(backend, pairs, mask=pool, tolerance=1e-6)
        runs.append(solved(backend, solver, b)[1])
    other = equation(backend, pairs, mask=two_pools(x, z).astype(float), tolerance=1e-6)
    solved(backend, other, b)
    arguments = pairs.arrays(backend, pairs.g, pool, pairs.volume)
    other.set_operator(pairs.neighbors(backend), *arguments)
    runs.append(solved(backend, other, b)[1])
    assert np.array_equal(runs[0], runs[1]) and np.array_equal(runs[0], runs[2])


def test_no_convergence_is_reported():
    """Where the iterations end the residual tells: the caller decides."""
    backend = compute.cpu(threads=2)
    pairs = scattered(20)
    solver = equation(backend, pairs, tolerance=1e-10, max_iterations=2)
    outcome, _ = solved(backend, solver, rough(pairs.count))
    assert outcome.iterations == 2 and outcome.residual > 1e-10
