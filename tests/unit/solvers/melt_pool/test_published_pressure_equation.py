"""Table 1's matrix against one written out by hand, and its solution beside the symmetric one's."""

import numpy as np
import pytest
from scattered_pairs import RATIO

from lasersph import compute
from lasersph.linear_solvers.unknowns import Unknowns
from lasersph.particles.kinds import DUMMY, EDGE, FLUID, INTERIOR
from lasersph.particles.neighbor_lists import find_neighbors
from lasersph.particles.support import arithmetic
from lasersph.solvers.melt_pool.pressure_equation import PressureEquation
from lasersph.solvers.melt_pool.published.pressure_equation import (
    REINFORCEMENT,
    PublishedPressure,
)
from lasersph.sph.kernels import kernel
from lasersph.sph.laplacian import weight

SHAPE = kernel("quintic-spline", 2)
SPACING = 0.5


class Pool:
    """A pool under a mirrored surface: fluid, one or two layers of edge, dummies, some at rest."""

    def __init__(self, backend, radius, *, jitter=0.2, unevenness=0.1):
        side = int(radius) + 6
        x, z = np.meshgrid(np.arange(-side, side + 1) * 1.0, -(np.arange(side) + 0.5))
        r = np.hypot(x, z).ravel()
        step = np.random.default_rng(3).uniform(-jitter, jitter, (2, r.size))
        rings = [r < radius, r < radius + 1.5, r < radius + 4.5]
        self.kind = np.select(rings, [FLUID, EDGE, DUMMY], INTERIOR)
        self.position = SPACING * (
            np.array([x.ravel(), z.ravel()]) + np.where(self.kind == FLUID, step, 0.0)
        )
        self.count = r.size
        self.volume = SPACING**2 * (1.0 + unevenness * np.cos(np.arange(self.count)))
        near = np.flatnonzero(self.position[1] > -RATIO * SPACING)
        self.source = np.concatenate([np.arange(self.count), near])
        ghost = self.position[:, near] * np.array([[1.0], [-1.0]])
        self.all = np.hstack([self.position, ghost])
        self.backend = backend
        self.neighbors = find_neighbors(
            backend, backend.asarray(self.all),
            backend.asarray(np.full(self.source.size, RATIO * SPACING)), self.count,
            kernel=SHAPE, mean=arithmetic,
        )  # fmt: skip
        pairs = backend.to_host(self.neighbors.neighbor).size
        self.weights = backend.zeros(pairs)
        volume_all = backend.asarray(self.volume[self.source])
        backend.pair_values(weight, self.neighbors, {"V": volume_all}, self.weights)

    def solver(self, **options):
        backend = self.backend
        solver = PublishedPressure(backend, self.count, **options)
        solver.set_operator(
            self.neighbors, backend.asarray(self.source, "index"), self.weights,
            backend.asarray(self.kind, "flag"), backend.asarray(self.volume),
        )  # fmt: skip
        return solver

    def table_1(self):
        """A as printed, before it is regularized: rows and columns of fluid and edge particles."""
        edges = np.flatnonzero(self.kind == EDGE)
        A = np.zeros((self.count, self.count))
        for i in np.flatnonzero((self.kind == FLUID) | (self.kind == EDGE)):
            for k in range(self.source.size):
                j = self.source[k]
                r = np.hypot(*(self.position[:, i] - self.all[:, k]))
                if r < 1e-9 or r >= RATIO * SPACING or self.kind[j] == 0:
                    continue
                e = 2.0 * self.volume[j] * SHAPE.derivative(r, RATIO * SPACING) / r
                if self.kind[j] == DUMMY:
                    offset = self.position[:, edges] - self.position[:, [j]]
                    distance = np.round(np.hypot(*offset), 9)
                    j = edges[np.argmin(distance)]
                    if j == i:
                        continue
                if j != i:
                    A[i, i] += e
                    A[i, j] -= e
        return A


def dense_of(solver, count):
    """The matrix that the solver holds."""
    matrix, backend = solver._solver.matrix, solver.backend
    A = np.diag(backend.to_host(matrix.diagonal))
    start = backend.to_host(matrix.neighbors.row_start).astype(np.int64)
    row = np.repeat(np.arange(count), np.diff(start))
    np.add.at(A, (row, backend.to_host(matrix.neighbors.neighbor)), backend.to_host(matrix.entries))
    return A


@pytest.mark.parametrize("make", [compute.cpu, compute.strict])
def test_matrix_is_that_of_table_1(make):
    """Elements of fluid and edge rows, dummies' columns with their edge particles, row sums 0."""
    pool = Pool(make(threads=2), 3.0)
    expected = -pool.table_1()
    is_row = (pool.kind == FLUID) | (pool.kind == EDGE)
    A = dense_of(pool.solver(), pool.count)
    diagonal = np.diag(A)
    assert np.array_equal(A[~is_row], np.eye(pool.count)[~is_row])
    bare = A - np.diag(diagonal * REINFORCEMENT / (1.0 + REINFORCEMENT))
    assert np.abs((bare - expected)[is_row]).max() <= 1e-10 * diagonal.max()
    assert np.abs(bare[is_row].sum(axis=1)).max() <= 1e-10 * diagonal.max()
    assert np.abs(expected - expected.T).max() > 0.05 * diagonal.max()


def test_dummies_have_the_pressure_of_the_nearest_edge_particle():
    """Of two at the same distance the first; without one within the support, nobody's."""
    backend = compute.cpu(threads=1)
    position = np.array([[0.0, 2.0, 1.0, 3.0, 5.5], [0.0, 0.0, 0.0, 0.0, 0.0]])
    kind = backend.asarray([EDGE, EDGE, DUMMY, DUMMY, DUMMY], "flag")
    neighbors = find_neighbors(
        backend, backend.asarray(position), backend.asarray(np.full(5, 3.0)), 5,
        kernel=SHAPE, mean=arithmetic,
    )  # fmt: skip
    weights = backend.asarray(np.ones(backend.to_host(neighbors.neighbor).size))
    solver = PublishedPressure(backend, 5)
    numbers = backend.asarray(np.arange(5), "index")
    solver.set_operator(neighbors, numbers, weights, kind, backend.asarray(np.ones(5)))
    assert backend.to_host(solver._column).tolist() == [0, 1, 0, 1, 4]
    # row 0 drops its own dummy 2 and does not reach 3; row 1 has 0 twice, itself and through 2
    expected = np.array([[1.0, -1.0], [-2.0, 2.0]])
    A = dense_of(solver, 5)[:2, :2] - REINFORCEMENT * np.diag([1.0, 2.0])
    np.testing.assert_allclose(A, expected, atol=1e-12)


def test_solution():
    """That of the regularized matrix for the right-hand side without its mean; p has mean 0."""
    backend = compute.cpu(threads=2)
    pool = Pool(backend, 5.0)
    is_row = (pool.kind == FLUID) | (pool.kind == EDGE)
    b = pool.volume * np.cos(pool.position[0])
    solver = pool.solver(tolerance=1e-10)
    pressure = backend.zeros(pool.count)
    outcome = solver.solve(backend.asarray(b), pressure)
    right = np.where(is_row, -b / pool.volume, 0.0)
    right -= is_row * right[is_row].mean()
    expected = np.linalg.solve(dense_of(solver, pool.count), right)
    expected -= is_row * expected[is_row].mean()
    p = backend.to_host(pressure)
    assert outcome.residual <= 1e-10
    assert np.abs(p - expected).max() <= 1e-6 * np.abs(expected).max()


def amplitudes(backend, radius):
    """Share of p = x / R - x r^2 / (3 R^3) found in a half disc, published and symmetric.

    Its slope vanishes at r = R and its Laplacian is -8 x / (3 R^3).
    """
    pool = Pool(backend, radius, jitter=0.0, unevenness=0.0)
    x, z = pool.position
    edge = (radius + 1.5) * SPACING
    exact = x / edge - x * (x**2 + z**2) / (3.0 * edge**3)
    b = backend.asarray(-pool.volume * 8.0 * x / (3.0 * edge**3))
    published, pressure = backend.zeros(pool.count), backend.zeros(pool.count)
    pool.solver(tolerance=1e-6).solve(b, published)
    is_row = (pool.kind == FLUID) | (pool.kind == EDGE)
    symmetric = PressureEquation(
        backend, Unknowns(backend, pool.count, RATIO * SPACING, SPACING), tolerance=1e-6
    )
    mask, volume = backend.asarray(is_row.astype(float)), backend.asarray(pool.volume)
    folded = pool.neighbors.without_ghosts(backend, backend.asarray(pool.source, "index"))
    symmetric.set_operator(folded, pool.weights, mask, volume)
    symmetric.solve(b, pressure)
    inside = np.where(pool.kind == FLUID, exact, 0.0)
    return [float(inside @ backend.to_host(p) / (inside @ inside)) for p in (published, pressure)]


def test_half_disc():
    """The symmetric equation finds the exact pressure, the published matrix a fifth more.

    Its rows sum to zero but its columns do not: at a round edge what flows out of fluid rows does
    not all arrive in edge rows.
    """
    backend = compute.cpu(threads=2)
    published, symmetric = amplitudes(backend, 12.0)
    assert symmetric == pytest.approx(1.0, abs=0.05)
    assert 1.1 < published < 1.3
    assert abs(amplitudes(backend, 24.0)[1] - 1.0) < 0.6 * abs(symmetric - 1.0)
