"""BiCGStab and its preconditioner against dense solutions, on both backends."""

from types import SimpleNamespace

import numpy as np
import pytest

from lasersph.linear_solvers.bicgstab import BiCGStab
from lasersph.linear_solvers.jacobi import Jacobi
from lasersph.linear_solvers.matrix import PairMatrix, residual


def matrix_of(backend, dense):
    """Rows of a dense matrix as pairs."""
    n = len(dense)
    is_pair = (dense != 0.0) & ~np.eye(n, dtype=bool)
    row_start = np.concatenate([[0], np.cumsum(is_pair.sum(axis=1))])
    neighbors = SimpleNamespace(
        row_end=None,
        row_start=backend.asarray(row_start, "offset"),
        neighbor=backend.asarray(np.nonzero(is_pair)[1], "index"),
        position=backend.zeros((1, n)),
        support=backend.zeros(n),
        kernel=None,
        mean=None,
        period=(0.0,),
    )
    return PairMatrix(
        neighbors, backend.asarray(dense[is_pair]), backend.asarray(np.diag(dense).copy())
    )


def convected(n, drift):
    """Diffusion with drift on a line: tridiagonal, diagonally dominant, not symmetric."""
    return (
        (2.0 + 1e-3) * np.eye(n) - (1.0 + drift) * np.eye(n, k=-1) - (1.0 - drift) * np.eye(n, k=1)
    )


def test_two_unknowns_by_hand(backend):
    """4 x + y = 1, 2 x + 3 y = 2 has x = 0.1, y = 0.6; two iterations span the plane."""
    solver = BiCGStab(backend, matrix_of(backend, np.array([[4.0, 1.0], [2.0, 3.0]])))
    outcome = solver.solve(backend.asarray(np.array([1.0, 2.0])), residual=1e-12, max_iterations=9)
    np.testing.assert_allclose(backend.to_host(solver.solution), [0.1, 0.6], rtol=1e-11)
    assert outcome.iterations <= 3
    assert outcome.residual <= 1e-12


@pytest.mark.parametrize("sweeps", [1, 3])
def test_nonsymmetric_system(backend, sweeps):
    """A drift of 0.5 in 200 unknowns; the reported residual is the true one."""
    dense = convected(200, 0.5)
    matrix = matrix_of(backend, dense)
    b = np.sin(np.arange(200.0))
    solver = BiCGStab(backend, matrix, preconditioner=Jacobi(backend, matrix, sweeps=sweeps))
    outcome = solver.solve(backend.asarray(b), residual=1e-10, max_iterations=500)
    x = backend.to_host(solver.solution)
    np.testing.assert_allclose(x, np.linalg.solve(dense, b), atol=1e-8)
    assert outcome.residual == pytest.approx(np.linalg.norm(b - dense @ x), abs=1e-13)
    assert outcome.residual <= 1e-10


def test_sweeps_save_iterations(backend):
    """Three sweeps need fewer iterations than one on a diffusion matrix."""
    matrix = matrix_of(backend, convected(300, 0.1))
    b = backend.asarray(np.cos(0.3 * np.arange(300.0)))
    counts = []
    for sweeps in (1, 3):
        solver = BiCGStab(backend, matrix, preconditioner=Jacobi(backend, matrix, sweeps=sweeps))
        counts.append(solver.solve(b, residual=1e-9, max_iterations=900).iterations)
    assert counts[1] < counts[0] < 900


def test_restart_where_the_first_shadow_fails(backend):
    """x - 3 y = 1, x + y = 1: r . A r = 0 at once; the tilted shadow finds x = 1, y = 0."""
    solver = BiCGStab(backend, matrix_of(backend, np.array([[1.0, -3.0], [1.0, 1.0]])))
    outcome = solver.solve(backend.asarray(np.ones(2)), residual=1e-12, max_iterations=50)
    np.testing.assert_allclose(backend.to_host(solver.solution), [1.0, 0.0], atol=1e-11)
    assert outcome.restarts >= 1


def test_skew_matrix(backend):
    """A nearly skew matrix, hard for a method of short recursions, within a bounded effort."""
    random = np.random.default_rng(5)
    skew = random.random((12, 12))
    dense = (skew - skew.T) + np.eye(12)
    solver = BiCGStab(backend, matrix_of(backend, dense))
    b = random.random(12)
    outcome = solver.solve(backend.asarray(b), residual=1e-9, max_iterations=2000)
    np.testing.assert_allclose(
        backend.to_host(solver.solution), np.linalg.solve(dense, b), atol=1e-7
    )
    assert outcome.residual <= 1e-9


def test_singular_matrix_without_solution(backend):
    """x + y = 1 and x + y = 0 at once: an honest residual, no NaN, no endless loop."""
    solver = BiCGStab(backend, matrix_of(backend, np.ones((2, 2))))
    b = backend.asarray(np.array([1.0, 0.0]))
    outcome = solver.solve(b, residual=1e-12, max_iterations=1000)
    assert 0.5**0.5 * (1.0 - 1e-9) <= outcome.residual < 2.0
    assert np.isfinite(backend.to_host(solver.solution)).all()


def test_first_guess_and_zero_right_side(backend):
    """An exact first guess needs no iteration; b = 0 gives x = 0."""
    dense = convected(10, 0.2)
    solver = BiCGStab(backend, matrix_of(backend, dense))
    x = np.arange(10.0)
    backend.copy(backend.asarray(x), solver.solution)
    assert solver.solve(backend.asarray(dense @ x), residual=1e-9, max_iterations=9).iterations == 0
    outcome = solver.solve(backend.zeros(10), residual=1e-12, max_iterations=90)
    np.testing.assert_allclose(backend.to_host(solver.solution), 0.0, atol=1e-11)
    assert outcome.residual <= 1e-12


def test_residual_and_jacobi_by_hand(backend):
    """b - A x, and one and two sweeps, on two unknowns."""
    matrix = matrix_of(backend, np.array([[4.0, 1.0], [2.0, 5.0]]))
    r, z = backend.zeros(2), backend.zeros(2)
    x, b = backend.asarray(np.array([1.0, 2.0])), backend.asarray(np.array([9.0, 8.0]))
    assert residual(backend, matrix, x, b, r) == pytest.approx(np.hypot(3.0, -4.0))
    np.testing.assert_allclose(backend.to_host(r), [3.0, -4.0])
    Jacobi(backend, matrix).apply(b, z)
    np.testing.assert_allclose(backend.to_host(z), [2.25, 1.6])
    Jacobi(backend, matrix, sweeps=2, damping=0.5).apply(b, z)
    np.testing.assert_allclose(backend.to_host(z), [2.25 - 0.5 * 0.4, 1.6 - 0.5 * 0.9])
    with pytest.raises(ValueError, match="at least 1"):
        Jacobi(backend, matrix, sweeps=0)
