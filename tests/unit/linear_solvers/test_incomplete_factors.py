"""Incomplete factors: by hand, against dense solves, and when they are left out."""

from weakref import ref

import numpy as np
import pytest
from particle_square import dense, held_front, right_side, square, system

from lasersph import compute
from lasersph.compute import sweeps
from lasersph.linear_solvers.conjugate_gradient import ConjugateGradient
from lasersph.linear_solvers.incomplete_factors import advance, backward, factor, forward

SIDE = 20
STEP = 4.0


def solved(backend, operator, b, C, mask, s, *, residual, rounds=False, rests=True):
    """Iterations, solution and the solver."""
    solver = ConjugateGradient(backend, operator, b.size, rounds=rounds, rests=rests)
    arrays = [backend.asarray(v) for v in (b, C, mask)]
    iterations = solver.solve(*arrays, s, residual=residual, max_iterations=200)
    return iterations, backend.to_host(solver.solution), solver


def problem():
    """Right-hand side, uneven diagonal and a mask with held particles."""
    count = SIDE * SIDE
    C = 1.0 + 0.5 * np.sin(np.arange(count))
    return right_side(count, SIDE), C, held_front(SIDE)


def test_factors_of_two_particles_by_hand():
    """D = 1 + 2 (0.5 + 0.25) = 2.5 of both, E = 1: K = 2.5 and 2.5 - 1 * 1 / 2.5 = 2.1."""
    q, K, inverse, middle = factor(0.0, 1.0, 0.5, 0.5, 0.25, 1.0, 2.0)
    assert (q, K, inverse, middle) == (0.4, 2.5, 0.4, -2.5)
    q, K, inverse, middle = factor(0.5 * q, 1.0, 0.5, 0.0, 0.25, 1.0, 2.0)
    assert (q, K, middle) == pytest.approx((0.0, 2.1, -1.7))
    second = K + 1.0 / 2.5  # of (K - E) K^-1 (K - E^T); the sums of its rows are those of A
    assert second == pytest.approx(2.5)
    assert factor(3.0, 1.0, 0.5, 0.5, 0.0, 0.0, 2.0) == (0.0, 0.0, 0.0, 0.0)


def test_terms_by_hand():
    """One row of each sweep and of the update; the bound of the residual is (K + s F) |r'|."""
    t, p = backward(3.0, 2.0, 4.0, 5.0, 0.2, 0.5, 2.0)
    assert (t, p) == pytest.approx((3.6, 12.0))
    w, pq = forward(3.0, 12.0, 3.6, -4.0, 0.2, 2.0)
    assert (w, pq) == pytest.approx((0.72, 12.0 * 4.32))
    found = advance(1.0, 2.0, 3.0, 1.0, 5.0, 4.0, 2.0, 1.0)
    assert found == (4.0, -2.0, 20.0, 26.0)


@pytest.mark.parametrize("block", [8192, 64])
def test_solution_is_that_of_a_dense_solve(backend, block, monkeypatch):
    """With held particles, an uneven diagonal and given values, in one block and in many."""
    monkeypatch.setattr(sweeps, "BLOCK", block)
    operator, pairs = system(backend, SIDE, boundary_coefficient=0.02)
    b, C, mask = problem()
    iterations, x, solver = solved(backend, operator, b, C, mask, STEP, residual=1e-9)
    A = dense(pairs, C, mask, STEP, 0.02)
    assert solver.factors is not None
    assert iterations < 25
    assert np.abs(mask * b - A @ x).sum() <= 1e-9
    assert x == pytest.approx(np.linalg.solve(A, mask * b), abs=1e-9)
    assert np.all(x[mask == 0.0] == 0.0)


def test_half_the_iterations_of_jacobi():
    """At the stiffness of a step with D dt / dx^2 = 5, and the same solution."""
    backend = compute.cpu(threads=1)
    operator, _ = system(backend, SIDE)
    b, C, mask = problem()
    s = 10.0 / float(backend.to_host(operator.total).max())
    arguments = (backend, operator, b, C + 0.5, mask, s)
    few, x, _ = solved(*arguments, residual=1e-7)
    many, y, solver = solved(*arguments, residual=1e-7, rests=False)
    assert solver.factors is None
    assert 2 * few <= many
    assert x == pytest.approx(y, abs=1e-7)


def test_rounded_weights_and_allowance(backend):
    """Weights in float32 change the solution by as much; iterations are limited."""
    operator, _ = system(backend, SIDE)
    b, C, mask = problem()
    _, x, _ = solved(backend, operator, b, C, mask, STEP, residual=1e-9)
    _, y, _ = solved(backend, operator, b, C, mask, STEP, residual=1e-9, rounds=True)
    assert y == pytest.approx(x, rel=1e-6, abs=1e-7)
    assert not np.array_equal(x, y)
    solver = ConjugateGradient(backend, operator, b.size, rests=True)
    arrays = [backend.asarray(v) for v in (b, C, mask)]
    assert solver.solve(*arrays, STEP, residual=1e-9, max_iterations=3) == 3


def test_new_mask_and_weights(backend):
    """Another mask is taken; after weights have been replaced, Jacobi's preconditioner is."""
    operator, pairs = system(backend, SIDE)
    b, C, mask = problem()
    _, _, solver = solved(backend, operator, b, C, mask, STEP, residual=1e-9)
    free = np.ones(b.size)
    arrays = [backend.asarray(v) for v in (b, C, free)]
    solver.solve(*arrays, STEP, residual=1e-9, max_iterations=200)
    expected = np.linalg.solve(dense(pairs, C, free, STEP, 0.0), b)
    assert backend.to_host(solver.solution) == pytest.approx(expected, abs=1e-9)
    operator.weights = backend.asarray(pairs[2])
    solver.solve(*arrays, STEP, residual=1e-9, max_iterations=200)
    assert solver.factors is None
    assert backend.to_host(solver.solution) == pytest.approx(expected, abs=1e-9)


def test_pairs_that_were_replaced_are_let_go():
    """Nothing holds them once a solve has seen others, though it is too stiff for factors."""
    backend = compute.cpu(threads=1)
    operator, pairs = system(backend, SIDE)
    b, C, mask = problem()
    _, _, solver = solved(backend, operator, b, C, mask, STEP, residual=1e-9)
    replaced, operator.weights = ref(operator.weights), backend.asarray(pairs[2])
    arrays = [backend.asarray(v) for v in (b, C, mask)]
    solver.solve(*arrays, 1e3 * STEP, residual=1e-6, max_iterations=200)
    assert replaced() is None and solver.factors is None


def test_threads_change_no_bit(monkeypatch):
    """The same solution to the last bit on one thread and on two, in blocks of two colors."""
    monkeypatch.setattr(sweeps, "BLOCK", 64)
    b, C, mask = problem()
    runs = []
    for threads in (1, 2):
        backend = compute.cpu(threads=threads)
        operator, _ = system(backend, SIDE)
        runs.append(solved(backend, operator, b, C, mask, STEP, residual=1e-9)[1])
    assert np.array_equal(*runs)


def test_square_of_particles_is_arranged():
    """Four particles in a row share most neighbors: fewer than twice as many weights as pairs."""
    backend = compute.cpu(threads=1)
    operator, _ = system(backend, SIDE)
    ordered = sweeps.ordered_pairs(backend, operator.neighbors, operator.weights)
    assert ordered is not None
    values = sum(side.value.size for side in ordered.sides)
    assert values < 2 * square(SIDE)[1].size
    columns = values // 4
    assert ordered.stored == 8 * values + 4 * columns + 2 * 8 * 6 * SIDE * SIDE // 4
