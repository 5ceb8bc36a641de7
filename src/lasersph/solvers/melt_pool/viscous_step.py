"""Viscous forces of a step: explicit as published, or those at the end of the step.

Implicit: (V_i + s sum_j g_ij) v_i - s sum_j g_ij v_j = V_i (v_i + dt b_i), s = nu dt, for the fluid
particles, both components at once, by conjugate gradients from the present velocity. Ghosts
count with the velocity that the faces give them, resting particles with zero; the system is
symmetric and positive, since a ghost changes at most the sign of a component.
"""

from __future__ import annotations

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.launch import Launch
from lasersph.compute.routine import Step
from lasersph.linear_solvers.iteration import conjugate_gradients
from lasersph.physics.viscosity import (
    advance,
    forced,
    momentum,
    multiply,
    predict,
    start,
    turn,
    weight_of,
)
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.particle_kinds import ParticleKinds

TOLERANCE = 1e-8
"""Residual over that of the first guess, in 2-norms. Accuracy: four orders below what the pressure
is solved to."""
MOST = 200
"""Iterations of a step at most. Guard: the step limit keeps the matrix near its diagonal, so that
few are usual."""


class ViscousStep:
    """The prediction of velocities with its work vectors.

    Args:
        volume: (n,) V [m^2]. viscosity: nu at the liquidus [m^2/s]; at other temperatures the
            weights of the pairs differ. kind: "implicit" or "explicit".

    Attributes:
        velocity: (2, n) from which the forces of the last step follow [m/s].
    """

    def __init__(self, backend: Backend, volume: Array, viscosity: float, kind: str) -> None:
        count, self.volume = volume.shape[0], volume
        self.backend, self.nu, self.is_implicit = backend, viscosity, kind == "implicit"
        vectors = 5 if self.is_implicit else 1
        self._star, *self._work = (backend.zeros((2, count)) for _ in range(vectors))
        self._g_sum, self.velocity = backend.zeros(count), backend.zeros((2, count))
        self._launches: tuple[Launch | None, ...] = (None,) * 4
        self._begin = backend.phase(ViscousStep._run_begin)

    def advance(
        self, block: Block, v: Array, b: Array, extended: Array, kinds: ParticleKinds, step: float
    ) -> int:
        """Advance v (2, n) [m/s] under viscosity and the body force b [m/s^2]; iterations.

        Args:
            extended: (2, M) v with that of the ghosts [m/s].
        """
        backend = self.backend
        rows = kinds.fluid_rows
        if rows.shape[0] == 0:
            return 0
        fields = {"v": extended, "g_ij": block.viscous_weights, "V": block.V, "b": b}
        if not self.is_implicit:
            pairs, star, nu = block.pairs, self._star, self.nu
            backend.copy(v, self.velocity)
            backend.pair_sum(
                momentum, pairs, fields, star, rows=rows, finish=predict, nu=nu, step=step
            )
            backend.copy(self._star, v)
            return 0
        r_z, r_r = self._begin(
            self,
            block,
            v,
            b,
            extended,
            rows,
            reads=(v, b, extended, block.viscous_weights, *block.arrays),
            rows=(rows,),
            s=self.nu * step,
            step=step,
        )
        iterations, *_ = backend.routine(
            conjugate_gradients, self._steps, 0.0, r_z, r_r, TOLERANCE**2 * r_r, MOST
        )
        backend.copy(v, self.velocity)
        return int(iterations)

    def _run_begin(
        self, block: Block, v: Array, b: Array, extended: Array, rows: Rows, s: float, step: float
    ) -> None:
        """Prepare the iteration; reduces r z and r r of the first guess."""
        backend, fields = self.backend, {"g_ij": block.viscous_weights, "V": block.V}
        r, z, d, q = self._work
        backend.fill(d, 0.0)  # which ghosts read beyond the rows
        backend.pair_sum(weight_of, block.pairs, fields, self._g_sum, rows=rows)
        backend.pointwise(forced, {"v": v, "b": b}, self._star, step=step)
        given = fields | {"v": extended, "b": b, "v_star": self._star, "g_sum": self._g_sum}
        out, reduce = (r, z, None, None), (None, None, "sum", "sum")
        backend.pair_sum(
            momentum, block.pairs, given, out, rows=rows, finish=start, reduce=reduce, s=s
        )
        points = {"v": v, "r": r, "z": z, "d": d, "q": q, "V": self.volume, "g_sum": self._g_sum}
        changes = backend.zeros((2, block.total))
        turned, ghosts, multiplied, advanced = self._launches
        turned = backend.prepare(turn, points, d, rows=rows, again=turned, beta=0.0)
        ghosts = block.prepare_velocity_change(d, changes, again=ghosts)
        multiplied = backend.prepare(
            momentum,
            fields | {"v": changes, "d": d},
            (q, None),
            neighbors=block.pairs,
            rows=rows,
            finish=multiply,
            reduce=(None, "sum"),
            again=multiplied,
            s=s,
        )
        advanced = backend.prepare(
            advance,
            points,
            (v, r, z, None, None),
            rows=rows,
            reduce=(None, None, None, "sum", "sum"),
            again=advanced,
            alpha=0.0,
            s=s,
        )
        self._launches = turned, ghosts, multiplied, advanced
        turns = Step([turned, ghosts, multiplied], "beta")
        self._steps = turns, Step([advanced], "alpha"), Step([])
