"""Multigrid correction for conjugate gradients: what Jacobi leaves on long wavelengths.

    M^-1 r = D^-1 r + P B P^T r

D is the diagonal of A = C + s G, P constant on aggregates (`aggregation`), B a V cycle on the
aggregates' levels with one damped Jacobi sweep before and after, and an exact inverse at the end.
The particles' wide stencils make D^-1 a good smoother for everything shorter than a support
radius, so that the first level is additive and costs no pair sum over particles; the levels of
aggregates have a fiftieth of the pairs. All parts are symmetric and positive, and so is M^-1.

A particle with mask 0 is held. On aggregates with the share w_I of free members

    (A p)_I = C_I p_I + s w_I sum_J w_J g_IJ (p_I - p_J),
    C_I = sum_{i in I, free} [ C_i + s (a_i + sum_{j held} g_ij) ],

the row sums of P^T A P exactly, its other elements in the mean. Geometry enters once, C and the
mask at each `prepare`. References: [Vanek1996], [Bramble1990] for the additive form.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.dense import invert
from lasersph.compute.graph import graph
from lasersph.linear_solvers.aggregation import Aggregates, coarsen

DAMPING = 0.9


class Rows(NamedTuple):
    """A list for pair sums without geometry: members of aggregates, aggregates of members, pairs.

    `support` only tells how many values there are to sum, where not as many as rows.
    """

    row_start: Array
    neighbor: Array
    support: Array | None
    row_end: Array | None = None
    position: Array | None = None
    kernel: Any = None
    mean: Any = None
    period: tuple[float, ...] = ()


def fixed_weight(g_ij, mask_j):
    """Weight toward a neighbor whose value is given."""
    return g_ij * (1.0 - mask_j)


def free(C, a, mask, s):
    """As `pinned` where no particle is held; and the mask."""
    return mask * (C + s * a), mask


def pinned(total, C, a, mask, s):
    """Sum of a particle's row of A, 0 where held."""
    return mask * (C + s * (total + a))


def value(v_j):
    """Value of a member, or of the aggregate of a member."""
    return v_j


def mean(total, size):
    """Mean of the members' values."""
    return total / size


def weighted(g_ij, w_j):
    """Weight toward a neighbor with held members."""
    return g_ij * w_j


def diagonal(total, C, w, s):
    """Diagonal of A on aggregates; 1 where all members are held, and nothing is to be solved."""
    d = C + s * w * total
    if d <= 0.0:
        return 1.0 + 0.0 * d
    return d


def first_sweep(r, d, damping):
    """Damped Jacobi from zero."""
    return damping * r / d


def coupling(g_ij, w_j, x_i, x_j):
    """Term of (A x)_I."""
    return g_ij * w_j * (x_i - x_j)


def remaining(total, r, C, w, x, s):
    """r - A x."""
    return r - C * x - s * w * total


def sweep(total, r, C, w, x, d, s, damping):
    """One more damped Jacobi sweep."""
    return x + damping * (r - C * x - s * w * total) / d


def add(total, x):
    """x + P e, where P e of a member is the value `total` of its aggregate."""
    return x + total


def product(inverse_ij, r_j):
    """Term of the inverse times r."""
    return inverse_ij * r_j


def corrected(total, z, r, mask):
    """As `add` on free particles, and r z."""
    new = z + mask * total
    return new, r * new


class _Level:
    """Aggregates of one level on the backend, and what changes with C and the mask."""

    def __init__(self, backend: Backend, aggregates: Aggregates) -> None:
        self.backend, count = backend, aggregates.count
        members = aggregates.parent.size
        self.members = Rows(
            backend.asarray(aggregates.member_start, "offset"),
            backend.asarray(aggregates.member, "index"),
            backend.zeros(members, "flag"),
        )
        self.pairs = Rows(
            backend.asarray(aggregates.row_start, "offset"),
            backend.asarray(aggregates.neighbor, "index"),
            None,
        )
        self.count = count
        self.parents = Rows(
            backend.asarray(np.arange(members + 1), "offset"),
            backend.asarray(aggregates.parent, "index"),
            None,
        )
        self.weights = backend.asarray(aggregates.weight)
        self.size = backend.asarray(aggregates.size)
        self.C, self.w, self.d, self.r, self.x, self.residual = (
            backend.zeros(count) for _ in range(6)
        )
        self._padded = backend.zeros(members)  # sums want as many values as there are rows
        self.solution = backend.head(self._padded, count)
        self._v = {"g_ij": self.weights, "r": self.r, "C": self.C, "w": self.w, "d": self.d}
        self._v["x"] = self.x

    def set_operator(self, C: Array, w: Array, s: float) -> None:
        """Set the operator from the row sums C and the free shares w of the members."""
        self._sum(C, self.C)
        self._sum(w, self.w, mean)
        self.backend.pair_sum(weighted, self.pairs, self._v, self.d, finish=diagonal, s=s)

    def _sum(self, values: Array, out: Array, finish: Callable | None = None) -> None:
        """Sum over members."""
        fields = {"v": values, "size": self.size}
        self.backend.pair_sum(value, self.members, fields, out, finish=finish)

    def restrict(self, residual: Array) -> None:
        """Set the right-hand side from the members' residuals."""
        self._sum(residual, self.r)

    def sweep_from_zero(self) -> None:
        """Damped Jacobi sweep from x = 0."""
        self.backend.pointwise(first_sweep, self._v, self.x, damping=DAMPING)

    def find_remainder(self, s: float) -> None:
        """Remainder of the right-hand side, r - A x."""
        self.backend.pair_sum(coupling, self.pairs, self._v, self.residual, finish=remaining, s=s)

    def sweep_again(self, s: float) -> None:
        """One more damped Jacobi sweep, which gives the solution."""
        how = {"finish": sweep, "damping": DAMPING}
        self.backend.pair_sum(coupling, self.pairs, self._v, self.solution, **how, s=s)

    def prolong(
        self,
        function: Callable,
        fields: dict[str, Array],
        out: Array | tuple,
        reduce: tuple | None = None,
    ) -> None:
        """Give members their aggregate's `solution`, as `total` of `function`."""
        fields = fields | {"v": self._padded}
        self.backend.pair_sum(value, self.parents, fields, out, finish=function, reduce=reduce)


def are_same(some: tuple, others: tuple) -> bool:
    """Whether two tuples hold the same objects."""
    return len(some) == len(others) and all(a is b for a, b in zip(some, others, strict=True))


class Multigrid:
    """Correction of the Jacobi preconditioner by all levels of aggregates.

    Args:
        first: pairs and weights that make the levels. operator: that of the equations.

    Attributes:
        levels: the finest first; empty where the particles are few.
    """

    def __init__(self, backend: Backend, first: Any, operator: Any, count: int) -> None:
        self.backend, self.operator = backend, operator
        pairs, weights = first
        host = [pairs.position, pairs.support, pairs.row_start, pairs.neighbor, weights]
        self.levels = [_Level(backend, a) for a in coarsen(*(backend.host_view(v) for v in host))]
        self._C = backend.zeros(count)
        if not self.levels:
            return
        n = self.levels[-1].count
        self._dense = Rows(
            backend.asarray(np.arange(n + 1) * n, "offset"),
            backend.asarray(np.tile(np.arange(n), n), "index"),
            None,
        )
        self._inverse = backend.zeros(n * n)

    def prepare(self, C: Array, mask: Array, s: float) -> None:
        """Set the operator of all levels for the diagonal C, the mask and the step s."""
        backend, operator = self.backend, self.operator
        fields = {
            "g_ij": operator.weights,
            "C": C,
            "a": operator.boundary_coefficient,
            "mask": mask,
        }
        # row sums of A that held particles leave
        (lowest,) = backend.pointwise(free, fields, (self._C, None), reduce=(None, "min"), s=s)
        if lowest < 1.0:
            backend.pair_sum(fixed_weight, operator.neighbors, fields, self._C, finish=pinned, s=s)

        # A on all levels, and its inverse on the coarsest
        self.set_up_levels(mask, s)
        backend.copy(backend.asarray(_inverse(backend, self.levels[-1], s)), self._inverse)

    @graph
    def set_up_levels(self, mask: Array, s: float) -> None:
        """Operators of all levels, each from the one before."""
        w, C = mask, self._C
        for level in self.levels:
            level.set_operator(C, w, s)
            w, C = level.w, level.C

    @graph
    def correct(self, r: Array, z: Array, mask: Array, s: float) -> None:
        """Add P B P^T r to z on the particles whose mask is 1; reduces r z."""
        finest, coarsest = self.levels[0], self.levels[-1]
        # down: sweep from zero, and what is left to the next level
        finest.restrict(r)
        for level, above in pairwise(self.levels):
            level.sweep_from_zero()
            level.find_remainder(s)
            above.restrict(level.residual)

        # exact where few are left
        fields = {"inverse_ij": self._inverse, "r": coarsest.r}
        self.backend.pair_sum(product, self._dense, fields, coarsest.solution)

        # up: add what the next level found, and sweep again
        for level, above in reversed(list(pairwise(self.levels))):
            above.prolong(add, {"x": level.x}, level.x)
            level.sweep_again(s)
        finest.prolong(corrected, {"r": r, "z": z, "mask": mask}, (z, None), (None, "sum"))


def _inverse(backend: Backend, level: _Level, s: float) -> np.ndarray:
    """(n n,) inverse of A on the coarsest level."""
    n = level.count
    start = backend.to_host(level.pairs.row_start).astype(np.int64)
    row = np.repeat(np.arange(n), np.diff(start))
    w = backend.to_host(level.w).astype(np.float64)
    A = np.zeros((n, n))
    column = backend.to_host(level.pairs.neighbor)
    A[row, column] = -s * w[row] * w[column] * backend.to_host(level.weights)
    A[np.arange(n), np.arange(n)] = backend.to_host(level.d)
    return invert(A).ravel()
