"""Preconditioned conjugate gradients, for a diagonal plus a sum over pairs.

    A = C + s G,    (G p)_i = sum_j g_ij (p_i - p_j) + a_i p_i

on the particles whose mask is 1; the others keep 0. All vectors stay on the backend, products and
dot products are fused into the loops. Symmetric positive definite for g_ij = g_ji >= 0, C > 0.

The preconditioner follows the stiffness s max(sum_j g_ij / C_i). Up to `FACTORED` it is that of
`incomplete_factors`, whose iterations grow with its fourth root, as long as particles that are said
to rest have not moved: arranging their pairs takes as long as some thirty iterations.
Else it is Jacobi's, whose iterations grow with the root of the stiffness; where that exceeds
`STIFF`, `multigrid` corrects it and they do not. Any iteration reads the weights once, and takes as
long as that: q = A p follows from A z, so that the product is summed in the same loop that turns
the direction, and inexact Newton iterations may read weights rounded to float32.
Reference: [Saad2003], Algorithm 9.1.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.graph import graph
from lasersph.compute.kept_array import KeptArray
from lasersph.compute.sweeps import ordered_pairs
from lasersph.linear_solvers.incomplete_factors import IncompleteFactors
from lasersph.linear_solvers.iteration import conjugate_gradients
from lasersph.linear_solvers.multigrid import Multigrid, are_same
from lasersph.particles.neighbor_lists import NeighborList

STIFF = 20.0
"""Stiffness above which setting up and applying multigrid costs less than it saves Jacobi."""
FACTORED = 100.0
"""Stiffness up to which incomplete factors take less time than multigrid."""

VECTORS = ("x", "r", "z", "p", "q", "d")


@dataclass
class PairOperator:
    """Weights g_ij on a list of pairs, and the boundary coefficient a_i toward a fixed value.

    Whoever moves the particles replaces what has changed.

    Attributes:
        neighbors: list of pairs. weights: (pairs,) g_ij. boundary_coefficient: (n,) a_i >= 0.
        total: (n,) sum_j g_ij. first: pairs and weights that it began with, until
            a solver has made its levels from them.
    """

    neighbors: NeighborList
    weights: Array
    boundary_coefficient: Array
    total: Array
    first: tuple[NeighborList, Array] = field(init=False)

    def __post_init__(self) -> None:
        self.first = self.neighbors, self.weights


def start(b, C, S, a, mask, s):
    """x = 0, r = b, z = r / d, p = q = 0 and the diagonal d, which is 0 where held.

    Reduces r z, |r| and the stiffness, a particle's weights over the rest of its diagonal.
    """
    r, d = mask * b, mask * (C + s * (S + a))
    z = quotient(r, d)
    return 0.0 * b, r, z, 0.0 * b, 0.0 * b, d, r * z, abs(r), mask * s * S / C


def quotient(r, d):
    """r / d, 0 where held."""
    return r / d if d > 0.0 else 0.0 * r


def neighbor(g_ij, z_j):
    """Term of sum_j g_ij z_j."""
    return g_ij * z_j


def new_direction(total, z, p, q, d, beta, s):
    """Direction p = z + beta p, q = A p = A z + beta q, and p q for the step length."""
    product = d * z - s * total if d > 0.0 else 0.0 * z
    new, turned = z + beta * p, product + beta * q
    return new, turned, new * turned


def advance(x, r, p, q, d, alpha):
    """x += alpha p, r -= alpha q, z = r / d; reduces r z and |r|."""
    new_r = r - alpha * q
    z = quotient(new_r, d)
    return x + alpha * p, new_r, z, new_r * z, abs(new_r)


class ConjugateGradient:
    """Solver with its work vectors.

    Args:
        rounds: read the weights in float32. The solution is then that of weights which are off
            by up to 6e-8 of themselves.
        rests: the pairs and weights that the operator has now are worth arranging. The factors are
            used until it is given others.

    Attributes:
        solution: (n,) x after `solve`. residual: the sum of |r_i| then. factors: incomplete
            factors, where a solve has used them.
    """

    def __init__(
        self,
        backend: Backend,
        operator: PairOperator,
        count: int,
        *,
        rounds: bool = False,
        rests: bool = False,
    ) -> None:
        self.backend, self.operator, self.rounds = backend, operator, rounds
        self._used = replace(operator, weights=None)
        self._bound: tuple = ()
        self._rounded = KeptArray(backend, kind="single")
        self._v = {name: backend.zeros(count) for name in VECTORS}
        self.solution, self.residual = self._v["x"], 0.0
        self._multigrid: Multigrid | None = None
        self._is_set_up = False
        # held no longer than the operator has them: as much memory as the pairs in use
        self._given: tuple = (operator.neighbors, operator.weights) if rests else ()
        self.factors: IncompleteFactors | None = None

    def solve(
        self,
        b: Array,
        C: Array,
        mask: Array,
        s: float,
        *,
        residual: float,
        max_iterations: int,
        renews: bool = True,
    ) -> int:
        """Solve A x = b until the sum of |r_i| is at most `residual`; returns the iterations.

        Stops at `max_iterations` with the best x so far: the caller judges.

        Args:
            renews: False keeps the multigrid of an earlier solve, whose C and mask were similar.
        """
        self._is_set_up = self._is_set_up and not renews
        v, operator = self._v, self.operator
        if self._given and not are_same((operator.neighbors, operator.weights), self._given):
            self._given, self.factors = (), None

        # where it is not stiff: incomplete factors of pairs that rest
        rz, error, stiffest = self.begin(b, C, mask, s)
        factors = self._factored() if stiffest <= FACTORED and error > residual else None
        if factors:
            iterations, self.residual = factors.solve(
                C,
                operator.boundary_coefficient,
                mask,
                s,
                residual=residual,
                max_iterations=max_iterations,
            )
            return iterations

        # else Jacobi's preconditioner, corrected by multigrid where it is stiff
        self._take_pairs()
        multigrid = self._prepared(C, mask, s) if stiffest > STIFF else None
        precondition = None
        if multigrid:
            precondition = partial(multigrid.correct, v["r"], v["z"], mask, s)
            (rz,) = multigrid.correct(v["r"], v["z"], mask, s)

        # until |r| is small
        iterations, _, self.residual = self.backend.iterate(
            conjugate_gradients,
            (partial(self.set_direction, s), self.approach, precondition),
            float(bool(multigrid)),
            rz,
            error,
            residual,
            max_iterations,
        )[:3]
        return int(iterations)

    @graph
    def begin(self, b: Array, C: Array, mask: Array, s: float) -> None:
        """Vectors at x = 0; reduces r z, |r| and the stiffness, see `start`."""
        operator = self.operator
        fields = {"C": C, "S": operator.total, "a": operator.boundary_coefficient}
        fields |= {"mask": mask, "b": b}
        out = (*[self._v[name] for name in VECTORS], None, None, None)
        reduce = (None,) * len(VECTORS) + ("sum", "sum", "max")
        self.backend.pointwise(start, fields, out, reduce=reduce, s=s)

    @graph
    def set_direction(self, s: float, beta: float) -> None:
        """Direction p = z + beta p, and q = A p; reduces p q."""
        used, v = self._used, self._v
        self.backend.pair_sum(
            neighbor,
            used.neighbors,
            v | {"g_ij": used.weights},
            (v["p"], v["q"], None),
            finish=new_direction,
            reduce=(None, None, "sum"),
            beta=beta,
            s=s,
        )

    @graph
    def approach(self, alpha: float) -> None:
        """x += alpha p, r -= alpha q, z = r / d; reduces r z and |r|."""
        v = self._v
        out, reduce = (v["x"], v["r"], v["z"], None, None), (None, None, None, "sum", "sum")
        self.backend.pointwise(advance, v, out, reduce=reduce, alpha=alpha)

    def _factored(self) -> IncompleteFactors | None:
        """Incomplete factors of the pairs that the solver was made with, while they stay."""
        if not self._given:
            return self.factors
        if self.factors is None:
            weights = self._as_read(self.operator.weights)
            pairs = ordered_pairs(self.backend, self.operator.neighbors, weights)
            if pairs is None:
                self._given = ()
            else:
                count = self.solution.shape[0]
                self.factors = IncompleteFactors(self.backend, pairs, self._v, count)
        return self.factors

    def _as_read(self, weights: Array, into: Callable[[int], Array] | None = None) -> Array:
        """Weights as they are read; rounded ones in an array that is kept, if one is given."""
        return self.backend.single(weights, into) if self.rounds else weights

    def _take_pairs(self) -> None:
        """Use the pairs and weights that the operator has now, as they are read."""
        operator, used = self.operator, self._used
        now = (operator.neighbors, operator.weights)
        if not are_same(now, self._bound):
            self._bound = now
            weights = self._as_read(operator.weights, self._rounded.of)
            used.neighbors, used.weights = used.first = operator.neighbors, weights

    def _prepared(self, C: Array, mask: Array, s: float) -> Multigrid | None:
        """Multigrid for this matrix; levels are built when first needed, from the first pairs,
        so that they do not depend on when that is."""
        if self._multigrid is None:
            count = self.solution.shape[0]
            operator = self.operator
            self._multigrid = Multigrid(self.backend, operator.first, self._used, count)
            operator.first = operator.neighbors, operator.weights  # others are held no longer
        if not self._multigrid.levels:
            return None
        if not self._is_set_up:
            self._multigrid.prepare(C, mask, s)
            self._is_set_up = True
        return self._multigrid
