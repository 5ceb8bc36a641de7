"""Iterations of the implicit solves do not follow the number of particles."""

import numpy as np
import pytest
from scattered_pairs import LEFT, TOP, scattered

from lasersph import compute
from lasersph.linear_solvers.conjugate_gradient import ConjugateGradient, PairOperator
from lasersph.linear_solvers.unknowns import Unknowns
from lasersph.particles.neighbor_lists import find_neighbors
from lasersph.particles.support import arithmetic
from lasersph.solvers.melt_pool.pressure_equation import PressureEquation
from lasersph.sph.kernels import kernel
from lasersph.sph.laplacian import weight

SIDES = (30, 60, 120)
"""Particles along a side: 900, 3 600 and 14 400 together."""
SUPPORT = 3.75
MORE = 2
"""Iterations that the largest may take more than the smallest."""


def weight_of(g_ij):
    """Weight of a pair."""
    return g_ij


def sheet(backend, side):
    """Weights of heat between particles displaced from a lattice of spacing 1."""
    count = side * side
    place = np.array(np.meshgrid(np.arange(side), np.arange(side)), float).reshape(2, -1)
    place += np.random.default_rng(1).uniform(-0.1, 0.1, place.shape)
    neighbors = find_neighbors(
        backend, backend.asarray(place), backend.asarray(np.full(count, SUPPORT)), count,
        kernel=kernel("quintic-spline", 2), mean=arithmetic,
    )  # fmt: skip
    weights, total = backend.zeros(neighbors.neighbor.size), backend.zeros(count)
    backend.pair_values(weight, neighbors, {"V": np.ones(count)}, weights)
    backend.pair_sum(weight_of, neighbors, {"g_ij": weights}, total)
    return PairOperator(neighbors, weights, backend.zeros(count), total)


def iterations_of_heat(side, stiffness):
    """Of one step from a field with long and short waves, to 1e-8 of its sum of amounts."""
    backend = compute.cpu(threads=1)
    x, z = np.divmod(np.arange(side * side), side) / np.float64(side)
    b = np.cos(3.0 * x) + np.sin(5.0 * z) + np.sin(np.arange(side * side))
    solver = ConjugateGradient(backend, sheet(backend, side), b.size, rests=True)
    ones = np.ones(b.size)
    residual = 1e-8 * float(np.abs(b).sum())
    return solver.solve(b, ones, ones, stiffness, residual=residual, max_iterations=200), solver


@pytest.mark.parametrize("stiffness", [5.0, 50.0])
def test_heat(stiffness):
    """D dt / dx^2 = 5 takes incomplete factors, 50 aggregation multigrid."""
    found = [iterations_of_heat(side, stiffness) for side in SIDES]
    iterations = [count for count, _ in found]
    assert all(bool(solver.factors) == (stiffness == 5.0) for _, solver in found)
    assert iterations[-1] <= iterations[0] + MORE, iterations


def test_pressure():
    """A closed box mirrored on two sides, to 1e-4 as melt pools solve it."""
    iterations = []
    for side in SIDES:
        backend = compute.cpu(threads=1)
        pairs = scattered(side, jitter=0.15, mirrors=(LEFT, TOP))
        x, z = pairs.position
        noise = np.random.default_rng(1).standard_normal(pairs.count)
        solver = PressureEquation(
            backend, Unknowns(backend, pairs.count, pairs.support, pairs.spacing), tolerance=1e-4
        )
        g, one, volume = pairs.arrays(backend, pairs.g, np.ones(pairs.count), pairs.volume)
        solver.set_operator(pairs.neighbors(backend), g, one, volume)
        b = backend.asarray(np.cos(3.0 * x) + np.sin(5.0 * z) + 0.3 * noise)
        iterations.append(solver.solve(b, backend.zeros(pairs.count)).iterations)
    assert iterations[-1] <= iterations[0] + MORE, iterations
