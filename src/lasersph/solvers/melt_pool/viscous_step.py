"""Viscous forces of a step: explicit as published, or those at the end of the step.

Implicit: (V_i + s sum_j g_ij) v_i - s sum_j g_ij v_j = V_i (v_i + dt b_i), s = nu dt, for the fluid
particles, all components at once, by conjugate gradients from the present velocity. Ghosts
count with the velocity that the faces give them, resting particles with zero; the system is
symmetric and positive, since a ghost changes at most the sign of a component. Rings resist by their
hoop stress, too (`sph.rings`): V_i counts for V_i + s K_i where u_i is solved for, and v* is less.
"""

from __future__ import annotations

from functools import partial

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.graph import graph
from lasersph.compute.vectors import dot, vector
from lasersph.linear_solvers.iteration import conjugate_gradients
from lasersph.physics.viscosity import forced, predict
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.flow_terms import FlowTerms
from lasersph.solvers.melt_pool.particle_kinds import ParticleKinds

TOLERANCE = 1e-8
"""Residual over that of the first guess, in 2-norms. Accuracy: four orders below what the pressure
is solved to."""
MAX_ITERATIONS = 200
"""Iterations of a step at most. Guard: the step limit keeps the matrix near its diagonal, so that
few are usual."""


def first_residual(total, v, V, v_star, g_sum, s):
    """Residual r = V (v* - v) + s sum g (v_j - v_i), its scaled form z, and r . z, r . r."""
    # Jacobi: the diagonal of the matrix is V + s sum g
    r = V * (v_star - v) + s * total
    z = 1.0 / (V + s * g_sum) * r
    return r, z, dot(r, z), dot(r, r)


def resisted(total_0, total_1, v_star, v, V, s):
    """Diagonal of the pairs, v* less what the hoop stress takes in the step, and V + s K of each
    component; K is the second sum."""
    k = vector(s * total_1, 0.0 * total_1)
    return total_0, v_star - 1.0 / V * k * v, V + k


def matrix_product(total, d, V, s):
    """q = A d, and d . q; `total` is the sum of g_ij (d_j - d_i)."""
    q = V * d - s * total
    return q, dot(d, q)


def next_solution(v, r, d, q, V, g_sum, alpha, s):
    """v += alpha d, r -= alpha q, z scaled; reduces r . z and r . r."""
    residual = r - alpha * q
    z = 1.0 / (V + s * g_sum) * residual
    return v + alpha * d, residual, z, dot(residual, z), dot(residual, residual)


def next_direction(z, d, beta):
    """New direction z + beta d."""
    return z + beta * d


class ViscousStep:
    """The prediction of velocities with its work vectors.

    Args:
        volume: (n,) V [m^2], of rings [m^3]. viscosity: nu at the liquidus [m^2/s]; at other
            temperatures the weights of the pairs differ. kind: "implicit" or "explicit". terms: of
            the geometry. dimension: d.

    Attributes:
        velocity: (d, n) from which the forces of the last step follow [m/s].
    """

    def __init__(
        self,
        backend: Backend,
        volume: Array,
        viscosity: float,
        kind: str,
        terms: FlowTerms,
        dimension: int,
    ) -> None:
        count, self.volume, self.terms = volume.shape[0], volume, terms
        self.backend, self.nu, self.is_implicit = backend, viscosity, kind == "implicit"
        vectors = 5 if self.is_implicit else 1
        self._star, *self._work = (backend.zeros((dimension, count)) for _ in range(vectors))
        self._g_sum = backend.zeros((*terms.diagonal_shape, count))
        # V, of rings with what their hoop stress resists
        self._inertia = volume
        if terms.has_hoop_stress:
            self._inertia = backend.zeros((dimension, count))
        self.velocity = backend.zeros((dimension, count))
        self._changes = backend.zeros((dimension, 0))

    def advance(
        self, block: Block, v: Array, b: Array, extended: Array, kinds: ParticleKinds, step: float
    ) -> int:
        """Advance v (d, n) [m/s] under viscosity and the body force b [m/s^2]; iterations.

        Args:
            extended: (d, M) v with that of the ghosts [m/s].
        """
        backend = self.backend
        rows = kinds.fluid_rows
        if rows.shape[0] == 0:
            return 0
        terms, fields = self.terms, self._fields(block) | {"v": extended, "b": b}
        if not self.is_implicit:
            pairs, star, nu = block.pairs, self._star, self.nu
            backend.copy(v, self.velocity)
            backend.pair_sum(
                terms.momentum, pairs, fields, star, rows=rows, finish=predict, nu=nu, step=step
            )
            if terms.has_hoop_stress:
                self._find_diagonal(block, v, rows, self.nu * step)
            backend.copy(self._star, v)
            return 0
        s = self.nu * step
        r_z, r_r = self.find_first_residual(block, v, b, extended, rows, s, step)
        steps = (
            partial(self.set_direction, block, rows, s),
            partial(self.approach, v, rows, s),
            None,
        )
        iterations, *_ = backend.iterate(
            conjugate_gradients, steps, 0.0, r_z, r_r, TOLERANCE**2 * r_r, MAX_ITERATIONS
        )
        backend.copy(v, self.velocity)
        return int(iterations)

    def _fields(self, block: Block) -> dict[str, Array]:
        """Weights and volumes that every sum reads."""
        return {"g_ij": block.viscous_weights, "V": self.volume, **block.ring_fields}

    def _find_diagonal(self, block: Block, v: Array, rows: Rows, s: float) -> None:
        """Diagonal of the pairs; the hoop stress of rings acts on v*, at the velocities (d, n)
        [m/s]."""
        sum_of, pairs, shares = self.backend.pair_sum, block.pairs, self.terms.shares
        fields = self._fields(block) | {"v_star": self._star, "v": v}
        if self.terms.has_hoop_stress:
            out = (self._g_sum, self._star, self._inertia)
            sum_of(shares, pairs, fields, out, rows=rows, finish=resisted, s=s)
        else:
            sum_of(shares, pairs, fields, self._g_sum, rows=rows)

    @graph
    def find_first_residual(
        self, block: Block, v: Array, b: Array, extended: Array, rows: Rows, s: float, step: float
    ) -> None:
        """Residual of the first guess, and the diagonal; reduces r z and r r."""
        backend, terms, fields = self.backend, self.terms, self._fields(block)
        r, z, d, _ = self._work
        backend.fill(d, 0.0)  # which ghosts read beyond the rows
        self._changes = backend.zeros((extended.shape[0], block.ghosts.size))

        # v* = v + dt b and sum_j g_ij
        backend.pointwise(forced, {"v": v, "b": b}, self._star, step=step)
        self._find_diagonal(block, v, rows, s)

        # r = V v* - A v, z = r / diagonal
        given = fields | {"v": extended, "b": b, "v_star": self._star, "g_sum": self._g_sum}
        out, reduce = (r, z, None, None), (None, None, "sum", "sum")
        pairs, finish = block.pairs, first_residual
        backend.pair_sum(
            terms.momentum, pairs, given, out, rows=rows, finish=finish, reduce=reduce, s=s
        )

    @graph
    def set_direction(self, block: Block, rows: Rows, s: float, beta: float) -> None:
        """Direction d = z + beta d, and q = A d; reduces d q."""
        _, z, d, q = self._work
        self.backend.pointwise(next_direction, {"z": z, "d": d}, d, rows=rows, beta=beta)
        block.ghosts.extend_velocity_change(d, self._changes)
        fields = self._fields(block) | {"v": self._changes, "d": d, "V": self._inertia}
        self.backend.pair_sum(
            self.terms.momentum,
            block.pairs,
            fields,
            (q, None),
            rows=rows,
            finish=matrix_product,
            reduce=(None, "sum"),
            s=s,
        )

    @graph
    def approach(self, v: Array, rows: Rows, s: float, alpha: float) -> None:
        """v += alpha d, r -= alpha q, z = r / diagonal; reduces r z and r r."""
        r, z, d, q = self._work
        fields = {"v": v, "r": r, "z": z, "d": d, "q": q, "V": self.volume, "g_sum": self._g_sum}
        out, reduce = (v, r, z, None, None), (None, None, None, "sum", "sum")
        self.backend.pointwise(
            next_solution, fields, out, rows=rows, reduce=reduce, alpha=alpha, s=s
        )
