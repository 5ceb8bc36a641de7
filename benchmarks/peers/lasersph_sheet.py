"""lasersph on the displaced sheet: one implicit step of heat, D dt / dx^2 = 5.

    (V + s G) dT = s (B - G T),    (G p)_i = sum_j g_ij (p_i - p_j) + a_i p_i,    s = D dt

by the package's conjugate gradients, from the temperatures of the last step as OpenFOAM does, until
the residual of the unrounded equations, normalized as OpenFOAM's, is below 1e-8. One end of x is
held at 1000 K, the other at 300 K. No part of it uses that the particles come from a lattice.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import same_particles as particles
from lasersph_block import backend, timed
from measurement import Measurement
from workplace import Workplace

from lasersph.compute.backend import Backend
from lasersph.linear_solvers.conjugate_gradient import ConjugateGradient, PairOperator
from lasersph.particles.neighbor_lists import find_neighbors
from lasersph.particles.support import arithmetic
from lasersph.solvers.ablation.equations import pair_weight
from lasersph.sph.kernels import kernel
from lasersph.sph.laplacian import flow
from lasersph.sph.lattice_sums import second_moment

HOT, COLD = 1000.0, 300.0
"""Temperatures of the ends, and of all at the start [K]."""
TOLERANCE = 1e-8
MARGIN = 0.5
"""Share of the tolerance that the solver is asked for, since it reads rounded weights."""
MAX_ITERATIONS = 1000
HALF_CELL = 2.0
"""Conductance of a face to particles half a spacing away, over that of two particles [1]."""
ROW = 19 * 8
"""Bytes of vectors that an iteration reads and writes for each row, beside the stored weights."""


def weight_of(g_ij):
    """Weight of a pair."""
    return g_ij


def itself(T):
    """The argument."""
    return T


def missing(total, T, V, a, B, s, mean):
    """Right-hand side s (B - G T), its absolute value, and what OpenFOAM divides by.

    That is |A T - A m| + |b - A m|, with A = V + s G, b = V T + s B and the mean temperature m.
    """
    r = s * (total + B - a * T)
    new, reference = V * T + s * (a * T - total), (V + s * a) * mean
    return r, abs(r), abs(new - reference) + abs(V * T + s * B - reference)


def remaining(total, P, b, V, a, s):
    """|b - A P|."""
    return abs(b - V * P - s * (a * P - total))


def warmed(T, x):
    """Temperature after the step."""
    return T + x


class Sheet:
    """Particles of the sheet and their operator; a call is a step.

    Attributes:
        operator: the pairs. temperature: (n,) [K]. iterations: of all steps. error: residual of
            the last step over what is allowed, recomputed by `check`.
    """

    def __init__(self, on: Backend, edge: int) -> None:
        count, shape = edge**2, kernel("quintic-spline", 2)
        self.on, self.count = on, count
        place = on.asarray(particles.displaced_lattice(edge, 2))
        support = on.asarray(np.full(count, shape.support_ratio))
        neighbors = find_neighbors(on, place, support, count, kernel=shape, mean=arithmetic)
        weights, total = on.zeros(on.host_view(neighbors.neighbor).shape[0]), on.zeros(count)
        ones = on.asarray(np.ones(count))
        factor = 1.0 / second_moment(shape, shape.support_ratio)
        on.pair_values(pair_weight, neighbors, {"V": ones}, weights, factor=factor)
        on.pair_sum(weight_of, neighbors, {"g_ij": weights}, total)
        boundary_coefficient, heat = np.zeros(count), np.zeros(count)
        for first, temperature in ((0, HOT), (edge - 1, COLD)):
            column = np.arange(first, count, edge)
            boundary_coefficient[column], heat[column] = HALF_CELL, HALF_CELL * temperature
        self.operator = PairOperator(neighbors, weights, on.asarray(boundary_coefficient), total)
        self.temperature = on.asarray(np.full(count, COLD))
        self._ones, self._heat, self._r = ones, on.asarray(heat), on.zeros(count)
        self.solver = ConjugateGradient(on, self.operator, count, rounds=True, rests=True)
        self.iterations, self.allowed = 0, 0.0

    def _fields(self) -> dict[str, Any]:
        operator = self.operator
        return {
            "g_ij": operator.weights, "a": operator.boundary_coefficient, "B": self._heat,
            "b": self._r, "T": self.temperature, "V": self._ones, "x": self.solver.solution,
        }  # fmt: skip

    def __call__(self) -> None:
        """One step."""
        on, fields = self.on, self._fields()
        (whole,) = on.pointwise(itself, fields, (None,), reduce=("sum",))
        _, norm = on.pair_sum(
            flow, self.operator.neighbors, fields | {"P": self.temperature},
            (self._r, None, None), finish=missing, reduce=(None, "sum", "sum"),
            s=particles.STIFFNESS, mean=whole / self.count,
        )  # fmt: skip
        self.allowed = TOLERANCE * norm
        self.iterations += self.solver.solve(
            self._r, self._ones, self._ones, particles.STIFFNESS, residual=MARGIN * self.allowed,
            max_iterations=MAX_ITERATIONS,
        )  # fmt: skip
        on.pointwise(warmed, fields, self.temperature)

    def residual(self) -> float:
        """Residual of the last step with unrounded weights, over what is allowed."""
        fields = self._fields() | {"P": self.solver.solution}
        (error,) = self.on.pair_sum(
            flow, self.operator.neighbors, fields, (None,), finish=remaining, reduce=("sum",),
            s=particles.STIFFNESS,
        )  # fmt: skip
        return error / self.allowed


def read_bandwidth(on: Backend, workplace: Workplace, size: int) -> float:
    """Bytes per second of summing an array of `size` bytes [1/s]."""
    fields = {"T": on.asarray(np.ones(size // 8))}
    times = timed(lambda: on.pointwise(itself, fields, (None,), reduce=("sum",)), workplace)
    return size / workplace.time(*times)


def implicit(workplace: Workplace) -> Measurement:
    """One implicit step, and the least time that its iterations can take."""
    on = backend(workplace.threads)
    step = Sheet(on, workplace.sheet)
    wall, processor = timed(step, workplace)
    if step.residual() > 1.0:
        raise RuntimeError(f"the residual is {step.residual():.2f} times what is allowed")
    entries, factors = step.operator.weights.shape[0], step.solver.factors
    assert factors is not None
    traffic = factors.pairs.stored + ROW * step.count
    floor = traffic / read_bandwidth(on, workplace, 8 * entries)
    iterations = step.iterations / ((workplace.segments + 1) * workplace.steps)
    detail = {
        "iterations": iterations,
        "ms per iteration": 1e3 * workplace.time(wall, processor) / iterations,
        "ms floor of bandwidth": 1e3 * floor,
        "entries per row": entries / step.count,
    }
    return Measurement(
        "implicit", "lasersph", workplace.threads, step.count, wall, processor, detail=detail
    )
