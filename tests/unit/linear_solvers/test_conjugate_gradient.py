"""Conjugate gradients against a dense solution."""

from dataclasses import dataclass, field

import numpy as np
import pytest

from lasersph.linear_solvers.conjugate_gradient import (
    ConjugateGradient,
    PairOperator,
    advance,
    new_direction,
)
from lasersph.particles.support import arithmetic
from lasersph.sph.kernels import kernel

COUNT = 40


@dataclass
class Ring:
    """Neighbor list of a ring in which each particle sees the next two on either side."""

    backend: object
    kernel: object = field(default_factory=lambda: kernel("cubic-spline", 1))
    mean: object = staticmethod(arithmetic)
    period: tuple = (0.0,)

    def __post_init__(self):
        steps = np.array([-2, -1, 1, 2])
        self.host = (np.arange(COUNT)[:, None] + steps) % COUNT
        self.row_end = None
        self.row_start = self.backend.asarray(4 * np.arange(COUNT + 1), "offset")
        self.neighbor = self.backend.asarray(self.host.ravel(), "index")
        self.position = self.backend.asarray(np.arange(COUNT, dtype=float).reshape(1, -1))
        self.support = self.backend.asarray(np.ones(COUNT))


def system(seed=3):
    """Weights of a ring, boundary coefficient, diagonal, right-hand side, and the dense matrix."""
    random = np.random.default_rng(seed)
    dense = np.zeros((COUNT, COUNT))
    for i in range(COUNT):
        for step in (1, 2):
            dense[i, (i + step) % COUNT] = dense[(i + step) % COUNT, i] = random.uniform(0.1, 2.0)
    boundary_coefficient, C, b = (random.uniform(0.0, 1.0, COUNT) for _ in range(3))
    return dense, boundary_coefficient, 0.1 + C, b


def solve(backend, mask, s, residual=1e-12, max_iterations=200):
    """Solution, iterations and the dense matrix of the masked system."""
    g, boundary_coefficient, C, b = system()
    ring = Ring(backend)
    weights = np.take_along_axis(g, ring.host, axis=1).ravel()
    operator = PairOperator(
        ring,
        backend.asarray(weights),
        backend.asarray(boundary_coefficient),
        backend.asarray(g.sum(axis=1)),
    )
    solver = ConjugateGradient(backend, operator, COUNT)
    iterations = solver.solve(
        backend.asarray(b), backend.asarray(C), backend.asarray(mask), s,
        residual=residual, max_iterations=max_iterations,
    )  # fmt: skip
    matrix = np.diag(C + s * (g.sum(axis=1) + boundary_coefficient)) - s * g
    return backend.to_host(solver.solution), iterations, matrix, b


@pytest.mark.parametrize("s", [0.0, 0.3, 50.0])
def test_against_dense_solution(backend, s):
    """The solution of (C + s G) x = b is that of numpy, in at most as many steps as unknowns."""
    x, iterations, matrix, b = solve(backend, np.ones(COUNT), s)
    assert x == pytest.approx(np.linalg.solve(matrix, b), rel=1e-9)
    assert iterations <= COUNT
    assert (iterations == 1) == (s == 0.0)


def test_masked_particles_stay_zero(backend):
    """Particles on a plateau keep x = 0; the others solve their own block."""
    mask = np.ones(COUNT)
    mask[5:20] = 0.0
    x, _, matrix, b = solve(backend, mask, 2.0)
    inside = mask > 0.0
    assert np.all(x[~inside] == 0.0)
    assert x[inside] == pytest.approx(np.linalg.solve(matrix[np.ix_(inside, inside)], b[inside]))


def test_stops_at_residual_and_at_the_limit(backend):
    """The sum of |r| obeys the tolerance; an allowance of two iterations is kept."""
    x, _, matrix, b = solve(backend, np.ones(COUNT), 5.0, residual=1e-3)
    assert np.abs(b - matrix @ x).sum() <= 1e-3 * (1 + 1e-9)
    assert solve(backend, np.ones(COUNT), 5.0, max_iterations=2)[1] == 2
    assert solve(backend, np.ones(COUNT), 5.0, residual=1e9)[1] == 0
    assert np.all(solve(backend, np.zeros(COUNT), 5.0)[0] == 0.0)


def test_terms_by_hand():
    """One product and one update of a single unknown; a held one stays 0."""
    assert new_direction(6.0, 2.0, 3.0, 4.0, 7.0, 0.5, 0.1) == (3.5, 15.4, 3.5 * 15.4)
    assert new_direction(6.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.1) == (0.0, 0.0, 0.0)
    x, r, z, rz, size = advance(1.0, 5.0, 2.0, 4.0, 4.0, 0.5)
    assert (x, r, z, rz, size) == (2.0, 3.0, 0.75, 2.25, 3.0)
    assert advance(0.0, 0.0, 0.0, 0.0, 0.0, 0.5) == (0.0, 0.0, 0.0, 0.0, 0.0)


def test_rounded_weights(backend):
    """Weights in float32 change the solution by no more than they are rounded."""
    g, boundary_coefficient, C, b = system()
    ring = Ring(backend)
    weights = backend.asarray(np.take_along_axis(g, ring.host, axis=1).ravel())
    operator = PairOperator(
        ring, weights, *(backend.asarray(v) for v in (boundary_coefficient, g.sum(axis=1)))
    )
    found = []
    for rounds in (False, True):
        solver = ConjugateGradient(backend, operator, COUNT, rounds=rounds)
        arrays = [backend.asarray(v) for v in (b, C, np.ones(COUNT))]
        solver.solve(*arrays, 1.0, residual=1e-12, max_iterations=200)
        found.append(backend.to_host(solver.solution))
    assert found[1] == pytest.approx(found[0], rel=1e-6)
    assert not np.array_equal(*found)


def test_new_weights_are_taken(backend):
    """Weights that the operator was given after a solve count in the next one."""
    g, boundary_coefficient, C, b = system()
    ring = Ring(backend)
    weights = np.take_along_axis(g, ring.host, axis=1).ravel()
    total = backend.asarray(g.sum(axis=1))
    operator = PairOperator(
        ring, backend.asarray(weights), backend.asarray(boundary_coefficient), total
    )
    solver = ConjugateGradient(backend, operator, COUNT)
    arrays = [backend.asarray(v) for v in (b, C, np.ones(COUNT))]
    solver.solve(*arrays, 1.0, residual=1e-12, max_iterations=200)
    operator.weights = backend.asarray(2.0 * weights)
    backend.copy(backend.asarray(2.0 * g.sum(axis=1)), operator.total)
    solver.solve(*arrays, 1.0, residual=1e-12, max_iterations=200)
    matrix = np.diag(C + 2.0 * g.sum(axis=1) + boundary_coefficient) - 2.0 * g
    assert backend.to_host(solver.solution) == pytest.approx(np.linalg.solve(matrix, b), rel=1e-9)
