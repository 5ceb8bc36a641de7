"""The hot loops of the linear solvers: product, iterations, preconditioners."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from hot_loops.counting import CountingBackend
from hot_loops.functions import flow
from hot_loops.hot_loop import HotLoop
from hot_loops.particles import shape_of
from hot_loops.sweeping import least_of_sweep
from lasersph.compute.backend import Backend
from lasersph.linear_solvers.bicgstab import BiCGStab
from lasersph.linear_solvers.cells import FilledCells
from lasersph.linear_solvers.conjugate_gradient import ConjugateGradient, PairOperator
from lasersph.linear_solvers.grid_correction import GridCorrection
from lasersph.linear_solvers.matrix import PairMatrix
from lasersph.linear_solvers.multigrid import Multigrid
from lasersph.linear_solvers.unknowns import WIDTH
from lasersph.particles.neighbor_lists import NeighborList

ITERATIONS = 20
STEP, STIFF_STEP = 0.1, 10.0
"""s of C + s G with C = 1: of heat without multigrid, and with it."""


def product(backend: Backend, neighbors: NeighborList, weights) -> HotLoop:
    """Sparse matrix times vector, as heat flows through assembled conductances."""
    _, count = shape_of(neighbors)
    fields, out = {"g_ij": weights, "T": _noise(backend, count)}, backend.zeros(count)

    def run() -> int:
        backend.pair_sum(flow, neighbors, fields, out)
        return 1

    return HotLoop("matrix times vector", count, run)


def conjugate_gradient(backend: Backend, operator: PairOperator) -> HotLoop:
    """An iteration with Jacobi's preconditioner, weights rounded to float32 as heat uses it."""
    count = operator.boundary_coefficient.shape[0]
    solver = ConjugateGradient(backend, operator, count, rounds=True)
    b, ones = _noise(backend, count), backend.asarray(np.ones(count))

    def run() -> int:
        return solver.solve(b, ones, ones, STEP, residual=0.0, max_iterations=ITERATIONS)

    return HotLoop("CG iteration", count, run)


def factored_iteration(backend: CountingBackend, operator: PairOperator) -> HotLoop:
    """An iteration with incomplete factors: two sweeps, each over half of the pairs.

    A solve begins with two sweeps more, which set the factors and the first residual.
    """
    count = operator.boundary_coefficient.shape[0]
    solver = ConjugateGradient(backend, operator, count, rounds=True, rests=True)
    b, ones = _noise(backend, count), backend.asarray(np.ones(count))

    def run() -> int:
        return solver.solve(b, ones, ones, STEP, residual=0.0, max_iterations=ITERATIONS)

    passes = run()
    assert solver.factors is not None
    back, forth = (least_of_sweep(sweep) for sweep in solver.factors.sweeps)
    least = backend.least(run) + back.times(passes) + forth.times(passes + 2)
    return HotLoop("CG iteration, factors", count, run, least.times(1.0 / passes))


def bicgstab(backend: Backend, neighbors: NeighborList, entries, diagonal) -> HotLoop:
    """An iteration with Jacobi's preconditioner; two products."""
    _, count = shape_of(neighbors)
    solver = BiCGStab(backend, PairMatrix(neighbors, entries, diagonal))
    b = _noise(backend, count)

    def run() -> int:
        backend.fill(solver.solution, 0.0)
        return solver.solve(b, residual=0.0, max_iterations=ITERATIONS).iterations

    return HotLoop("BiCGStab iteration", count, run)


def multigrid_cycle(backend: Backend, operator: PairOperator) -> HotLoop | None:
    """Preconditioner of heat beside Jacobi's; None where particles are too few."""
    count = operator.boundary_coefficient.shape[0]
    multigrid = Multigrid(backend, operator.first, operator, count)
    if not multigrid.levels:
        return None
    ones = backend.asarray(np.ones(count))
    multigrid.prepare(ones, ones, STIFF_STEP)
    r, z = _noise(backend, count), backend.zeros(count)

    def run() -> int:
        multigrid.correct(r, z, ones, STIFF_STEP)
        return 1

    return HotLoop("multigrid cycle", count, run)


def grid_cycle(backend: Backend, neighbors: NeighborList, diagonal) -> HotLoop:
    """Preconditioner of the pressure equation, in 2-D."""
    _, count = shape_of(neighbors)
    assert neighbors.position is not None and neighbors.support is not None
    width = WIDTH * float(backend.host_view(neighbors.support)[0])
    cells, ones = FilledCells(backend, count, width, (0.0, 0.0)), backend.asarray(np.ones(count))
    cells.update(neighbors.position, ones)
    correction = GridCorrection(backend, cells)
    correction.prepare(ones, backend.zeros(count))
    r, z = _noise(backend, count), backend.zeros(count)

    def run() -> int:
        correction.correct(r, diagonal, ones, z)
        return 1

    return HotLoop("pressure grid cycle", count, run)


def hot_solves(backend: Backend, neighbors: NeighborList) -> Iterator[HotLoop]:
    """Those above on a list of pairs in 2-D; each is made when it is asked for."""
    _, count = shape_of(neighbors)
    weights = backend.asarray(np.ones(neighbors.neighbor.shape[0]))
    degrees = np.diff(backend.to_host(neighbors.row_start).astype(float))
    degree = backend.asarray(degrees)
    operator = PairOperator(neighbors, weights, backend.zeros(count), degree)
    yield product(backend, neighbors, weights)
    yield conjugate_gradient(backend, operator)
    if isinstance(backend, CountingBackend):  # a card has no factors
        yield factored_iteration(backend, operator)
    yield bicgstab(backend, neighbors, weights, backend.asarray(degrees + 1.0))
    multigrid = multigrid_cycle(backend, operator)
    if multigrid is not None:
        yield multigrid
    yield grid_cycle(backend, neighbors, degree)


def _noise(backend: Backend, count: int):
    return backend.asarray(np.random.default_rng(4).standard_normal(count))
