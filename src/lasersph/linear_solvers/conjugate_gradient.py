"""Preconditioned conjugate gradients, for a diagonal plus a sum over pairs.

    A = C + s G,    (G p)_i = sum_j g_ij (p_i - p_j) + a_i p_i

on the particles whose mask is 1; the others keep 0. All vectors stay on the backend, products and
dot products are fused into the loops. Symmetric positive definite for g_ij = g_ji >= 0, C > 0.

The preconditioner is Jacobi's, whose iterations grow with the root of the stiffness
s max(sum_j g_ij / C_i); where that exceeds `STIFF`, `multigrid` corrects it and they do not.
Reference: [Saad2003], Algorithm 9.1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from lasersph.compute.backend import Backend
from lasersph.linear_solvers.multigrid import Multigrid

STIFF = 20.0
"""Stiffness above which setting up and applying multigrid costs less than it saves."""


@dataclass
class PairOperator:
    """Weights g_ij on a list of pairs, and the pull a_i toward a fixed value.

    Whoever moves the particles replaces what has changed.

    Attributes:
        neighbors: list of pairs. weights: (pairs,) g_ij. pull: (n,) a_i. total: (n,) sum_j g_ij.
    """

    neighbors: Any
    weights: Any
    pull: Any
    total: Any


def difference(g_ij, p_i, p_j):
    """Term of (G p)_i."""
    return g_ij * (p_i - p_j)


def multiply(total, C, a, mask, p, s):
    """(A p)_i, and p_i (A p)_i for the step length."""
    q = mask * (C * p + s * (total + a * p))
    return q, p * q


def start(b, C, S, a, mask, s):
    """x = 0, r = b, z = r / diagonal, p = z; reduces r z and |r|."""
    r = mask * b
    z = r / (C + s * (S + a))
    return 0.0 * b, r, z, r * z, abs(r)


def advance(x, r, p, q, C, S, a, alpha, s):
    """x += alpha p, r -= alpha q, z = r / diagonal; reduces r z and |r|."""
    rest = r - alpha * q
    z = rest / (C + s * (S + a))
    return x + alpha * p, rest, z, rest * z, abs(rest)


def stiffness(C, S, mask):
    """Sum of a particle's weights over its diagonal [1/s]."""
    return mask * S / C


def turn(z, p, beta):
    """New direction p = z + beta p."""
    return z + beta * p


class ConjugateGradient:
    """Solver with its work vectors.

    Attributes:
        solution: (n,) x after `solve`.
    """

    def __init__(self, backend: Backend, operator: PairOperator, count: int) -> None:
        self.backend, self.operator = backend, operator
        self.solution = backend.zeros(count)
        self._r, self._z, self._p, self._q = (backend.zeros(count) for _ in range(4))
        self._multigrid: Multigrid | None = None

    def solve(
        self, b: Any, C: Any, mask: Any, s: float, *, residual: float, max_iterations: int
    ) -> int:
        """Solve A x = b until the sum of |r_i| is at most `residual`; returns the iterations.

        Stops at `max_iterations` with the best x so far: the caller judges.
        """
        backend, operator = self.backend, self.operator
        x, r, z, p, q = self.solution, self._r, self._z, self._p, self._q
        fields = {"C": C, "S": operator.total, "a": operator.pull, "mask": mask, "b": b}
        rz, error = backend.pointwise(
            start, fields, (x, r, z, None, None), reduce=(None, None, None, "sum", "sum"), s=s
        )
        multigrid = self._prepared(C, mask, s)
        if multigrid:
            rz = multigrid.correct(r, z, mask)
        backend.copy(z, p)
        fields |= {"x": x, "r": r, "z": z, "p": p, "q": q, "g_ij": operator.weights}
        iterations = 0
        while error > residual and iterations < max_iterations:
            (pq,) = backend.pair_sum(
                difference, operator.neighbors, fields, (q, None),
                finish=multiply, reduce=(None, "sum"), s=s,
            )  # fmt: skip
            if pq <= 0.0:
                break
            rz_old = rz
            rz, error = backend.pointwise(
                advance, fields, (x, r, z, None, None),
                reduce=(None, None, None, "sum", "sum"), alpha=rz / pq, s=s,
            )  # fmt: skip
            iterations += 1
            if error <= residual:
                break
            if multigrid:
                rz = multigrid.correct(r, z, mask)
            backend.pointwise(turn, fields, p, beta=rz / rz_old)
        return iterations

    def _prepared(self, C: Any, mask: Any, s: float) -> Multigrid | None:
        """Multigrid for this matrix, where it is stiff; levels are built when first needed."""
        fields = {"C": C, "S": self.operator.total, "mask": mask}
        (stiffest,) = self.backend.pointwise(stiffness, fields, (None,), reduce=("max",))
        if s * stiffest <= STIFF:
            return None
        if self._multigrid is None:
            self._multigrid = Multigrid(self.backend, self.operator, self.solution.shape[0])
        if not self._multigrid.levels:
            return None
        self._multigrid.prepare(C, mask, s)
        return self._multigrid
