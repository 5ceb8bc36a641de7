"""The published pressure equation: Table 1's matrix, regularized, with BiCGStab.

    sum_j e_ij (p_i - p_j) = b_i / V_i,    e_ij = 2 V_j W'(r_ij) / r_ij = -g_ij / V_i
                                                             [Demuth2020, eq. (77) and Table 1]

for fluid particles and the edge particles around them. dp/dn = 0 at the edge is imposed by dummy
particles beyond it, each of which has the pressure of the edge particle nearest to it (the one of
the lowest number where several are); so an edge particle does not feel its own dummies, and columns
of edge particles collect those of their dummies, which makes the matrix non-symmetric. Its rows sum
to zero; it is regularized by the factor 1 + `REINFORCEMENT` on the diagonal and by removing the
mean of the right-hand side, from all pools together.

Pairs with particles that are neither, and with dummies without an edge particle within their
support, are left out, as are boundary data: use `pressure_equation` for these, and for speed.
"""

from __future__ import annotations

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import same
from lasersph.linear_solvers.bicgstab import BiCGStab
from lasersph.linear_solvers.matrix import PairMatrix
from lasersph.particles.kinds import DUMMY, EDGE, FLUID
from lasersph.particles.neighbor_lists import NeighborList
from lasersph.solvers.melt_pool.pressure_equation import Outcome

REINFORCEMENT = 1e-6
"""Share r that is added to the diagonal. Derived: [Demuth2020] asks for "a slight reinforcement of
the diagonal" and gives no number. The diagonal is D = 2 / spacing^2, that of a wave with N spacings
between its zeros pi^2 / (N spacing)^2, so that r takes the part 0.2 r N^2 of its pressure: 0.2 % of
a pool 100 spacings wide; with 1e-5 it would be 2 %, and with 1e-8 less than the tolerance of 1e-4.
"""
TOLERANCE = 1e-4
"""Residual over the right-hand side, in 2-norms. Study: as `MeltPoolSettings.pressure_tolerance`.
"""
MAX_ITERATIONS = 5000
"""Iterations of a solution at most. Guard: the published matrix takes up to 2241."""
NO_NEIGHBOR = 1e30
"""Distance where there is no neighbor [m]. Format: farther than any two particles."""


def edge_distance(kind_j, r_ij):
    """Distance of an edge particle."""
    if kind_j == EDGE:
        return r_ij
    return NO_NEIGHBOR + 0.0 * r_ij


def edge_number(kind_j, source_j, r_ij, nearest_i):
    """Number of an edge particle as near as the nearest."""
    if kind_j == EDGE and r_ij <= nearest_i * (1.0 + 1e-6):
        return 1.0 * source_j
    return NO_NEIGHBOR + 0.0 * r_ij


def assigned(total, k):
    """Number found, or the particle's own."""
    if total < NO_NEIGHBOR:
        return int(total)
    return k


def is_known(kind, column, k):
    """1 for particles whose pressure is an unknown or that of one."""
    if FLUID <= kind <= EDGE or (kind == DUMMY and column != k):
        return 1.0
    return 0.0


def entry(g_ij, V_i, kind_i, known_j, column_j, k_i):
    """Element beside the diagonal, with the sign that makes the diagonal positive."""
    if FLUID <= kind_i <= EDGE and column_j != k_i:
        return -g_ij * known_j / V_i
    return 0.0 * g_ij


def opposite(a_ij):
    """Share of an element in the diagonal."""
    return -a_ij


def diagonal(total, reinforcement):
    """Regularized diagonal; 1 in rows without elements."""
    if total > 0.0:
        return total * (1.0 + reinforcement)
    return 1.0 + 0.0 * total


def right_side(b, V, kind):
    """-b / V, for the positive matrix, and 1 to count rows."""
    if FLUID <= kind <= EDGE:
        return -b / V, 1.0
    return 0.0 * b, 0.0


def less(p, kind, mean):
    """Value less the mean in rows that count, else 0; and its square."""
    deviation = 0.0 * p
    if FLUID <= kind <= EDGE:
        deviation = p - mean
    return deviation, deviation * deviation


class PublishedPressure:
    """Matrix of the present particles and its solver.

    Args:
        count: particles of the block, n.
        tolerance: residual over right-hand side that ends the iteration (2-norms).
        max_iterations: where it ends anyhow.
    """

    def __init__(
        self,
        backend: Backend,
        count: int,
        *,
        tolerance: float = TOLERANCE,
        max_iterations: int = MAX_ITERATIONS,
    ) -> None:
        self.backend, self.tolerance, self.max_iterations = backend, tolerance, max_iterations
        self._number = backend.asarray(np.arange(count), "index")
        # column in which the pressure of each particle stands: its own, or that of its edge
        self._column, self._nearest = backend.zeros(count, "index"), backend.zeros(count)
        self._known, self._b, self._d = (backend.zeros(count) for _ in range(3))

    def set_operator(
        self, neighbors: NeighborList, source: Array, weights: Array, kind: Array, volume: Array
    ) -> None:
        """Take the matrix of the present particles.

        Args:
            neighbors: list of pairs with ghosts, of fluid, edge and dummy particles.
            source: (N,) kind "index", the particle that each is, or is a ghost of.
            weights: (pairs,) g_ij of all pairs. kind: (n,) kind "flag". volume: (n,) V_i [m^2].
        """
        backend, total = self.backend, source.shape[0]
        # ghosts mirror the pressure: each counts as its source
        inner = neighbors.without_ghosts(backend, source)
        kind_all = backend.zeros(total, "flag")
        backend.gather(kind, source, kind_all)
        near = {"kind": kind_all, "source": source, "nearest": self._nearest}
        # each dummy takes the column of the nearest edge particle, the lowest number of several
        dummies = backend.rows_where(kind, DUMMY)
        backend.pair_sum(edge_distance, neighbors, near, self._nearest, rows=dummies, combine="min")
        backend.copy(self._number, self._column)
        near["k"], column = self._number, self._column
        backend.pair_sum(
            edge_number, neighbors, near, column, rows=dummies, combine="min", finish=assigned
        )
        # particles with an unknown of their own or that of an edge; all else is left out
        fields = {"kind": kind, "column": self._column, "k": self._number}
        backend.pointwise(is_known, fields, self._known)
        # e_ij = 2 V_j W' / r (77) beside the diagonal, by the weights g_ij over V_i
        entries = backend.zeros(weights.shape[0])
        fields |= {"g_ij": weights, "V": volume, "known": self._known}
        backend.pair_values(entry, inner, fields, entries)
        # diagonal: rows sum to zero, reinforced by r so that the matrix is not singular
        values, r = {"a_ij": entries}, REINFORCEMENT
        backend.pair_sum(opposite, inner, values, self._d, finish=diagonal, reinforcement=r)
        # entries of dummies move to the columns of their edge particles
        columns = inner.without_ghosts(backend, self._column)
        self._kind, self._volume = kind, volume
        self.matrix = PairMatrix(columns, entries, self._d)
        self._solver = BiCGStab(backend, self.matrix)

    def solve(self, b: Array, pressure: Array) -> Outcome:
        """Solve for the pressure, from what it holds as the first guess.

        Args:
            b: (n,) right-hand side b_i as of `PressureEquation`. pressure: (n,) p [Pa], read and
                written, 0 where there is no unknown. Its mean is removed: b minus its mean is not
                in the range of the singular matrix, and the regularized one answers with a large
                constant, which a later first guess then lacks.
        """
        backend, solver = self.backend, self._solver
        # -b / V, without its mean over all rows: what a singular matrix can answer
        fields = {"b": b, "V": self._volume, "kind": self._kind}
        total, rows = backend.pointwise(right_side, fields, (self._b, None), reduce=("sum", "sum"))
        mean = total / rows if rows else 0.0
        scale = self._less(self._b, mean) ** 0.5
        # BiCGStab from the last pressure, 0 where there is no unknown
        self._less(pressure, 0.0)
        backend.copy(pressure, solver.solution)
        outcome = solver.solve(
            self._b, residual=self.tolerance * scale, max_iterations=self.max_iterations
        )
        backend.copy(solver.solution, pressure)
        # the constant that the reinforced matrix answers with is taken off
        (total,) = backend.pointwise(same, {"value": pressure}, None, reduce="sum")
        self._less(pressure, total / rows if rows else 0.0)
        return Outcome(outcome.iterations, outcome.residual / scale if scale > 0.0 else 0.0)

    def _less(self, values: Array, mean: float) -> float:
        fields = {"p": values, "kind": self._kind}
        return self.backend.pointwise(
            less, fields, (values, None), reduce=(None, "sum"), mean=mean
        )[0]
