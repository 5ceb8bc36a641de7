"""Viscous forces of a step: explicit as published, or those at the end of the step.

Implicit: (V_i + s sum_j g_ij + s K_i) v_i - s sum_j g_ij v_j = V_i (v_i + dt b_i), s = nu dt, for
the fluid particles, all components at once, by conjugate gradients from the present velocity. K_i
is what a ring resists by its hoop stress beside its pairs (`sph.rings`), 0 in a plane. Ghosts
count with the velocity that the faces give them, resting particles with zero; the system is
symmetric and positive, since a ghost changes at most the sign of a component.
"""

from __future__ import annotations

from functools import partial

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.graph import graph
from lasersph.compute.vectors import dot
from lasersph.linear_solvers.iteration import conjugate_gradients
from lasersph.physics.viscosity import predict
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.flow_terms import FlowTerms
from lasersph.solvers.melt_pool.particle_kinds import ParticleKinds

TOLERANCE = 1e-8
"""Residual over that of the first guess, in 2-norms. Accuracy: four orders below what the pressure
is solved to."""
MAX_ITERATIONS = 200
"""Iterations of a step at most. Guard: the step limit keeps the matrix near its diagonal, so that
few are usual."""


def first_residual(total_0, total_1, total_2, v, V, b, s, step):
    """Residual r = V dt b + s (sum g (v_j - v_i) - K v), its scaled form z, diagonal D and K; and
    r . z, r . r."""
    r = V * (step * b) + s * (total_0 - total_2 * v)
    # Jacobi: the diagonal of the matrix is V + s (sum g + K)
    D = V + s * (total_1 + total_2)
    z = 1.0 / D * r
    return r, z, D, total_2, dot(r, z), dot(r, r)


def matrix_product(total, d, V, K, s):
    """q = A d, and d . q; `total` is the sum of g_ij (d_j - d_i)."""
    q = V * d - s * (total - K * d)
    return q, dot(d, q)


def next_solution(v, r, d, q, D, alpha):
    """v += alpha d, r -= alpha q, z scaled; reduces r . z and r . r."""
    residual = r - alpha * q
    z = 1.0 / D * residual
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
        # r, z, d and q of conjugate gradients, or the velocity after an explicit step
        vectors = 4 if self.is_implicit else 1
        self._work = [backend.zeros((dimension, count)) for _ in range(vectors)]
        self._D, self._K = (backend.zeros((*terms.diagonal_shape, count)) for _ in range(2))
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
            (new,), pairs, nu = self._work, block.pairs, self.nu
            backend.copy(v, self.velocity)
            backend.pair_sum(
                terms.all_momentum, pairs, fields, new, rows=rows, finish=predict, nu=nu, step=step
            )
            backend.copy(new, v)
            return 0
        s = self.nu * step
        r_z, r_r = self.find_first_residual(block, v, b, extended, rows, s, step)
        steps = (
            partial(self.set_direction, block, rows, s),
            partial(self.approach, v, rows),
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

    @graph
    def find_first_residual(
        self, block: Block, v: Array, b: Array, extended: Array, rows: Rows, s: float, step: float
    ) -> None:
        """Residual of the first guess, and the diagonal; reduces r z and r r."""
        backend, terms = self.backend, self.terms
        r, z, d, _ = self._work
        backend.fill(d, 0.0)  # which ghosts read beyond the rows
        self._changes = backend.zeros((extended.shape[0], block.ghosts.size))

        # r = V v* - A v with v* = v + dt b, z = r / D
        backend.pair_sum(
            terms.all_momentum,
            block.pairs,
            self._fields(block) | {"v": extended, "b": b},
            (r, z, self._D, self._K, None, None),
            rows=rows,
            finish=first_residual,
            reduce=(None, None, None, None, "sum", "sum"),
            s=s,
            step=step,
        )

    @graph
    def set_direction(self, block: Block, rows: Rows, s: float, beta: float) -> None:
        """Direction d = z + beta d, and q = A d; reduces d q."""
        _, z, d, q = self._work
        self.backend.pointwise(next_direction, {"z": z, "d": d}, d, rows=rows, beta=beta)
        block.ghosts.extend_velocity_change(d, self._changes)
        fields = self._fields(block) | {"v": self._changes, "d": d, "K": self._K}
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
    def approach(self, v: Array, rows: Rows, alpha: float) -> None:
        """v += alpha d, r -= alpha q, z = r / diagonal; reduces r z and r r."""
        r, z, d, q = self._work
        fields = {"v": v, "r": r, "z": z, "d": d, "q": q, "D": self._D}
        out, reduce = (v, r, z, None, None), (None, None, None, "sum", "sum")
        self.backend.pointwise(next_solution, fields, out, rows=rows, reduce=reduce, alpha=alpha)
