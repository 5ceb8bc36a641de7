"""Multigrid correction: against dense solves, and its independence of size and stiffness."""

import numpy as np
import pytest
from particle_square import SUPPORT, dense, held_front, right_side, square, system

from lasersph import compute
from lasersph.linear_solvers import conjugate_gradient
from lasersph.linear_solvers.aggregation import COARSEST, coarsen
from lasersph.linear_solvers.conjugate_gradient import ConjugateGradient
from lasersph.linear_solvers.multigrid import Multigrid


def solved(backend, operator, count, b, C, mask, s, share):
    """Iterations and solution for a residual that falls to `share` of the start."""
    solver = ConjugateGradient(backend, operator, count)
    arrays = [backend.asarray(v) for v in (b, C, mask)]
    iterations = solver.solve(
        *arrays, s, residual=share * float(np.abs(mask * b).sum()), max_iterations=2000
    )
    return iterations, backend.to_host(solver.solution)


@pytest.mark.parametrize("make", [compute.cpu, compute.strict])
@pytest.mark.parametrize("boundary_coefficient", [0.0, 0.02])
def test_solution_is_that_of_a_dense_solve(make, boundary_coefficient):
    """With held particles, an uneven diagonal and given values, on arrays that refuse NumPy too."""
    backend, side, s = make(threads=2), 20, 300.0
    operator, pairs = system(backend, side, boundary_coefficient=boundary_coefficient)
    b, mask = right_side(side * side, side), held_front(side)
    C = 1.0 + 0.5 * np.sin(np.arange(side * side))
    iterations, x = solved(backend, operator, side * side, b, C, mask, s, 1e-10)
    expected = np.linalg.solve(dense(pairs, C, mask, s, boundary_coefficient), mask * b)
    assert np.abs(x - expected).max() <= 1e-8 * np.abs(expected).max()
    assert iterations < 60


def test_correction_is_symmetric_and_positive():
    """u B v = v B u and u B u > 0, as conjugate gradients ask for."""
    backend, side = compute.cpu(threads=1), 24
    operator, _ = system(backend, side)
    count, mask = side * side, held_front(side)
    multigrid = Multigrid(backend, operator.first, operator, count)
    multigrid.prepare(backend.asarray(np.ones(count)), backend.asarray(mask), 50.0)
    u, v = mask * right_side(count, side), mask * np.cos(0.7 * np.arange(count))

    def product(a, b):
        z = backend.zeros(count)
        multigrid.correct(backend.asarray(b), z, backend.asarray(mask), 50.0)
        return float(a @ backend.to_host(z))

    assert product(u, v) == pytest.approx(product(v, u), rel=1e-10)
    assert product(u, u) > 0.0 and product(v, v) > 0.0


def test_iterations_hardly_depend_on_size_and_stiffness(monkeypatch):
    """Four times the width and 10 000 times the step: Jacobi's iterations rise, these do not."""
    backend = compute.cpu(threads=2)
    found, jacobi = {}, {}
    for side in (24, 96):
        operator, _ = system(backend, side)
        b, one = right_side(side * side, side), np.ones(side * side)
        for s in (1e2, 1e6):
            arguments = (backend, operator, side * side, b, one, one, s, 1e-6)
            found[side, s], _ = solved(*arguments)
            with monkeypatch.context() as patch:
                patch.setattr(conjugate_gradient, "STIFF", np.inf)
                jacobi[side, s], _ = solved(*arguments)
    assert max(found.values()) <= 40
    for s in (1e2, 1e6):
        assert found[96, s] <= 1.4 * found[24, s]
    assert jacobi[96, 1e6] > 4 * found[96, 1e6]


def test_threads_change_no_bit():
    """The same iterations and the same solution to the last bit on one thread and on two."""
    side = 96
    b, one = right_side(side * side, side), np.ones(side * side)
    runs = []
    for threads in (1, 2):
        backend = compute.cpu(threads=threads)
        operator, _ = system(backend, side)
        runs.append(solved(backend, operator, side * side, b, one, held_front(side), 300.0, 1e-8))
    assert runs[0][0] == runs[1][0]
    assert np.array_equal(runs[0][1], runs[1][1])


def test_few_particles_need_no_levels():
    """A handful is solved by Jacobi alone, also where it is stiff."""
    backend, side = compute.cpu(threads=1), 6
    operator, pairs = system(backend, side)
    assert Multigrid(backend, operator.first, operator, 36).levels == []
    b, one = right_side(36, side), np.ones(36)
    _, x = solved(backend, operator, 36, b, one, one, 1e4, 1e-10)
    expected = np.linalg.solve(dense(pairs, one, one, 1e4, 0.0), b)
    assert np.abs(x - expected).max() <= 1e-7 * np.abs(expected).max()


def test_aggregates_hold_all_particles_and_their_weights():
    """Members partition the level below; the first weights are sums over members' pairs."""
    position, row, column, weight = square(20)
    start = np.concatenate([[0], np.cumsum(np.bincount(row))])
    levels = coarsen(position, np.full(400, SUPPORT), start, column, weight)
    first = levels[0]
    assert first.size.sum() == 400 and first.count == 49
    assert sorted(first.member) == list(range(400))
    between = np.zeros((first.count, first.count))
    np.add.at(between, (first.parent[row], first.parent[column]), weight)
    np.fill_diagonal(between, 0.0)
    rows = np.repeat(np.arange(first.count), np.diff(first.row_start))
    assert np.allclose(first.weight, between[rows, first.neighbor])
    assert levels[-1].count <= COARSEST
