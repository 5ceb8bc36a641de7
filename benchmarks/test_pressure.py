"""Pressure equation of a melt pool: iterations, and their time against plain methods.

Half an elliptic pool under a mirrored surface, as wide and deep as the published pools in their
finest particles, displaced from a lattice. Compared are the preconditioner of the package, the
diagonal alone in the same conjugate gradients, and the published matrix with BiCGStab and its
diagonal. The floor is the time to read each pair once, 12 bytes of value and neighbor, at the
bandwidth that `benchmarks/roofline.py` measures. Iterations are compared from a quarter to four
times the unknowns of the largest pool, too. Run: pytest benchmarks/test_pressure.py -s
"""

from time import perf_counter

import numpy as np
import pytest
from hot_loops.ceilings import bandwidth

from lasersph import compute
from lasersph.compute.graph import graph
from lasersph.linear_solvers.unknowns import Unknowns
from lasersph.particles.neighbor_lists import find_neighbors
from lasersph.particles.support import arithmetic
from lasersph.solvers.melt_pool.pressure_equation import PressureEquation
from lasersph.solvers.melt_pool.published.pressure_equation import PublishedPressure
from lasersph.sph.kernels import kernel
from lasersph.sph.laplacian import weight

SPACING, SUPPORT = 1.0, 3.75
POOLS = {"steel": (330, 55), "aluminium": (450, 265), "thin": (250, 10)}
TOLERANCE = 1e-4
SCALES, MORE = (0.5, 1.0, 2.0), 3
"""Of the largest pool, whose iterations are compared, and how many more the largest may take."""


class Pool:
    """Particles of spacing 1: fluid (1), two layers of edge (2), dummies (3)."""

    def __init__(self, backend, width, depth):
        x, z = np.meshgrid(np.arange(width + 6) + 0.5, -(np.arange(depth + 6) + 0.5))
        x, z = x.ravel(), z.ravel()

        def inside(margin):
            return (x / (width + margin)) ** 2 + (z / (depth + margin)) ** 2 < 1.0

        self.kind = np.select([inside(0.0), inside(1.5), inside(5.5)], [1, 2, 3], 0)
        step = np.random.default_rng(0).uniform(-0.15, 0.15, (2, x.size))
        position = np.array([x, z]) + step * (self.kind == 1)
        self.count, self.backend = x.size, backend
        source = np.arange(x.size)
        for axis in (0, 1):
            near = np.flatnonzero(np.abs(position[axis]) < SUPPORT)
            ghost = position[:, near].copy()
            ghost[axis] *= -1.0
            position = np.hstack([position, ghost])
            source = np.concatenate([source, source[near]])
        self.source = backend.asarray(source, "index")
        self.neighbors = find_neighbors(
            backend, backend.asarray(position), backend.asarray(np.full(source.size, SUPPORT)),
            self.count, kernel=kernel("quintic-spline", 2), mean=arithmetic,
        )  # fmt: skip
        self.folded = self.neighbors.without_ghosts(backend, self.source)
        self.weights = backend.zeros(backend.to_host(self.neighbors.neighbor).size)
        ones = backend.asarray(np.ones(source.size))
        backend.pair_values(weight, self.neighbors, {"V": ones}, self.weights)
        self.volume = backend.asarray(np.ones(self.count))
        self.mask = backend.asarray(((self.kind == 1) | (self.kind == 2)).astype(float))
        x, z = position[:, : self.count]
        noise = np.random.default_rng(1).standard_normal(self.count)
        self.b = backend.asarray(np.cos(3.0 * x / width) + np.sin(5.0 * z / depth) + 0.3 * noise)


class Diagonal:
    """Jacobi's preconditioner in the place of the grid's."""

    def __init__(self, backend):
        self.backend = backend

    def prepare(self, volume, boundary_coefficient):
        """Nothing to do."""

    @graph
    def correct(self, r, diagonal, mask, z):
        """z = r / d; reduces r z."""
        fields = {"r": r, "d": diagonal, "mask": mask}
        self.backend.pointwise(divided, fields, (z, None), reduce=(None, "sum"))


def divided(r, d, mask):
    """Value over the diagonal, and r z."""
    z = mask * r / d
    return z, r * z


def timed(backend, solver, pool, rounds):
    """Outcome, and the shortest time [s] from p = 0."""
    times = []
    for _ in range(rounds):
        pressure = backend.zeros(pool.count)
        start = perf_counter()
        outcome = solver.solve(pool.b, pressure)
        times.append(perf_counter() - start)
    return outcome, min(times)


@pytest.mark.parametrize("name", POOLS)
def test_pressure(name):
    """At most 15 iterations to 1e-4, in less than a third of the time of either plain method."""
    backend = compute.cpu(threads=2)
    pool = Pool(backend, *POOLS[name])
    equation = PressureEquation(
        backend, Unknowns(backend, pool.count, SUPPORT, SPACING), tolerance=TOLERANCE
    )
    arguments = (pool.folded, pool.weights, pool.mask, pool.volume)
    set_up = []
    for _ in range(4):
        start = perf_counter()
        equation.set_operator(*arguments)
        set_up.append(perf_counter() - start)
    outcome, time = timed(backend, equation, pool, 5)

    jacobi = PressureEquation(
        backend,
        Unknowns(backend, pool.count, SUPPORT, SPACING),
        tolerance=TOLERANCE,
        max_iterations=9999,
    )
    jacobi._correction = Diagonal(backend)  # pyright: ignore[reportAttributeAccessIssue]
    jacobi.set_operator(*arguments)
    plain, plain_time = timed(backend, jacobi, pool, 2)

    published = PublishedPressure(backend, pool.count, tolerance=TOLERANCE)
    kind = backend.asarray(pool.kind, "flag")
    published.set_operator(pool.neighbors, pool.source, pool.weights, kind, pool.volume)
    paper, paper_time = timed(backend, published, pool, 2)

    unknowns = int((pool.kind == 1).sum() + (pool.kind == 2).sum())
    pairs = backend.to_host(pool.neighbors.neighbor).size
    floor = 12.0 * pairs / bandwidth(backend)
    each = time / outcome.iterations
    print(
        f"\n{name}: {unknowns} unknowns, {pairs} pairs; set-up {1e3 * min(set_up):.1f} ms;"
        f" {outcome.iterations} iterations, {1e3 * each:.2f} ms each, {each / floor:.1f} times the"
        f" floor; diagonal alone {plain.iterations} iterations, {plain_time / time:.1f} times the"
        f" time; published {paper.iterations} iterations, {paper_time / time:.1f} times the time"
    )
    assert max(outcome.residual, plain.residual, paper.residual) <= TOLERANCE
    assert outcome.iterations <= 15
    assert min(plain_time, paper_time) > (3.0 if unknowns > 10000 else 1.0) * time


def test_iterations_do_not_follow_the_size():
    """Aluminum's pool at half, once and twice the resolution: nearly the same number."""
    backend, iterations = compute.cpu(threads=2), {}
    for scale in SCALES:
        pool = Pool(backend, *(round(scale * length) for length in POOLS["aluminium"]))
        equation = PressureEquation(
            backend, Unknowns(backend, pool.count, SUPPORT, SPACING), tolerance=TOLERANCE
        )
        equation.set_operator(pool.folded, pool.weights, pool.mask, pool.volume)
        outcome = equation.solve(pool.b, backend.zeros(pool.count))
        assert outcome.residual <= TOLERANCE
        iterations[pool.count] = outcome.iterations
    print(f"\niterations by particles: {iterations}")
    counts = list(iterations.values())
    assert counts[-1] <= counts[0] + MORE
