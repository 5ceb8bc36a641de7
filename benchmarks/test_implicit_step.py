"""Implicit heat on particles at rest: incomplete factors against Jacobi's diagonal.

200 000 particles displaced from a lattice of spacing 1, D dt = 5, 43 neighbors each; the same
equations are solved by both in turn, to 1e-8 of the right-hand side's sum of amounts. The floor of
an iteration is the time to read its weights, neighbors and vectors at the bandwidth of summing a
large array. Times are those of the processors. From 40 000 to a million particles the iterations
stay the same. Run: pytest benchmarks/test_implicit_step.py -s
"""

from time import process_time

import numpy as np
import pair_functions as functions

from lasersph import compute
from lasersph.linear_solvers.conjugate_gradient import ConjugateGradient, PairOperator
from lasersph.particles.neighbor_lists import find_neighbors
from lasersph.particles.support import arithmetic
from lasersph.sph.kernels import kernel
from lasersph.sph.laplacian import weight

EDGE, SUPPORT, STEP, ROUNDS = 450, 3.75, 5.0, 9
EDGES, MORE = (200, EDGE, 1000), 2
"""Of sheets whose iterations are compared, and how many more the largest may take."""
VECTORS = 19 * 8
"""Bytes of vectors that an iteration with factors reads and writes for a particle."""


def weight_of(g_ij):
    """Weight of a pair."""
    return g_ij


def sheet(backend, edge):
    """Weights between the particles of a displaced square."""
    count, shape = edge**2, kernel("quintic-spline", 2)
    place = np.array(np.meshgrid(np.arange(edge), np.arange(edge)), float).reshape(2, -1)
    place += np.random.default_rng(1).uniform(-0.1, 0.1, place.shape)
    support = backend.asarray(np.full(count, SUPPORT))
    position = backend.asarray(place)
    neighbors = find_neighbors(backend, position, support, count, kernel=shape, mean=arithmetic)
    weights, total = backend.zeros(neighbors.neighbor.shape[0]), backend.zeros(count)
    backend.pair_values(weight, neighbors, {"V": np.ones(count)}, weights)
    backend.pair_sum(weight_of, neighbors, {"g_ij": weights}, total)
    return PairOperator(neighbors, weights, backend.zeros(count), total)


def right_side(edge):
    """Long waves along the rows, and short ones."""
    index = np.arange(edge**2)
    return np.cos(index % edge * 0.02) + np.sin(index)


def test_factors_halve_the_time():
    """At least 1.4 times as fast, with half the iterations at most."""
    backend = compute.cpu()
    operator = sheet(backend, EDGE)
    count = EDGE**2
    ones, b = np.ones(count), right_side(EDGE)
    solvers = {
        name: ConjugateGradient(backend, operator, count, rounds=True, rests=rests)
        for name, rests in (("Jacobi", False), ("factors", True))
    }
    large = np.ones(operator.weights.shape[0])
    seconds, iterations = {"Jacobi": [], "factors": [], "read": []}, {}
    for _ in range(ROUNDS):
        for name, solver in solvers.items():
            start = process_time()
            iterations[name] = solver.solve(
                b, ones, ones, STEP, residual=1e-8 * float(np.abs(b).sum()), max_iterations=200
            )
            seconds[name].append(process_time() - start)
        start = process_time()
        backend.pointwise(functions.same, {"a": large}, None, reduce="sum")
        seconds["read"].append(process_time() - start)
    time = {name: float(np.median(found[1:])) for name, found in seconds.items()}
    factors = solvers["factors"].factors
    assert factors is not None
    stored = factors.pairs.stored
    floor = (stored + VECTORS * count) / large.nbytes * time["read"]
    for name, count_of in iterations.items():
        print(f"\n{name}: {count_of} iterations, {1e3 * time[name]:.0f} ms", end="")
    print(
        f"\n{1e3 * time['factors'] / iterations['factors']:.1f} ms an iteration with factors,"
        f" floor {1e3 * floor:.1f} ms, {stored / operator.weights.shape[0]:.1f} bytes a pair;"
        f" {time['Jacobi'] / time['factors']:.2f} times as fast"
    )
    assert 2 * iterations["factors"] <= iterations["Jacobi"]
    assert time["Jacobi"] >= 1.4 * time["factors"]


def test_iterations_do_not_follow_the_size():
    """The same number from 40 000 to a million particles."""
    backend, iterations = compute.cpu(), {}
    for edge in EDGES:
        solver = ConjugateGradient(backend, sheet(backend, edge), edge**2, rounds=True, rests=True)
        ones, b = np.ones(edge**2), right_side(edge)
        residual = 1e-8 * float(np.abs(b).sum())
        iterations[edge**2] = solver.solve(
            b, ones, ones, STEP, residual=residual, max_iterations=200
        )
        assert solver.factors is not None
    print(f"\niterations with factors by particles: {iterations}")
    assert iterations[EDGES[-1] ** 2] <= iterations[EDGES[0] ** 2] + MORE
