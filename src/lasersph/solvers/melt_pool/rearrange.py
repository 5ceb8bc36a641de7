"""Shifting of the particles and adjustment of what they carry [Demuth2020, eqs. (73)-(75)].

    x~ = x + C a R,    v~ = v + grad v . (x~ - x),    h~ = h + grad h . (x~ - x)

Deviations from the paper: no value leaves the range of the neighbors and the particle's own; h is
taken along only between particles of one kind (both melt, or both on the vaporization plateau),
since at a front its gradient is the latent heat over a spacing; and the gains and losses of h are
scaled to the same sum, so that energy is conserved. A shift is at most a tenth of a spacing, and no
particle comes closer to a side than three tenths.
"""

from __future__ import annotations

from typing import Any

from lasersph.compute.backend import Backend
from lasersph.compute.vectors import dot, matvec, outer, vector
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.roles import Roles
from lasersph.sph.shifting import repulsion_terms, shift

LARGEST = 0.1
"""Largest shift over the spacing."""
CLOSEST = 0.3
"""Least distance from a side over the spacing."""


def velocity_terms(v_i, v_j, V_j, x_ij, r_ij, dW_ij):
    """Terms of grad v, and the neighbors' velocity for its range."""
    return V_j * dW_ij / r_ij * outer(v_j - v_i, x_ij), 1.0 * v_j, 1.0 * v_j


def adjusted_velocity(total_0, total_1, total_2, v, C, shifted, e_x, e_z):
    """v + grad v . shift, within the range of the neighbors [m/s] (74)."""
    new = v + matvec(total_0, matvec(C, shifted))
    return (
        bounded(dot(new, e_x), dot(v, e_x), dot(total_1, e_x), dot(total_2, e_x)) * e_x
        + bounded(dot(new, e_z), dot(v, e_z), dot(total_1, e_z), dot(total_2, e_z)) * e_z
    )


def bounded(new, old, low, high):
    """`new` within the range of low, high and `old`."""
    return min(max(new, min(low, old)), max(high, old))


def kind_of(fluid, f_v):
    """0 at rest, 1 melt, 2 melt on the vaporization plateau."""
    if f_v > 0.0:
        return 2.0 * fluid
    return 1.0 * fluid


def face_enthalpy(h, held, wall_enthalpy):
    """Enthalpy of an image [J/kg]: that of its source, or odd about a held face."""
    return h + 2.0 * held * (wall_enthalpy - h)


def enthalpy_terms(h_i, h_j, kind_i, kind_j, V_j, x_ij, r_ij, dW_ij):
    """Terms of grad h between particles of one kind, and the range of such neighbors [J/kg]."""
    h = h_j if kind_i == kind_j else h_i
    return V_j * (h - h_i) * dW_ij / r_ij * x_ij, h, h


def enthalpy_change(total_0, total_1, total_2, h, m, C, shifted):
    """grad h . shift within the range of the neighbors [J/kg] (75), gain and loss of heat [J]."""
    new = bounded(h + dot(matvec(C, total_0), shifted), h, total_1, total_2)
    change = new - h
    return change, m * max(change, 0.0), m * max(-change, 0.0)


def balanced(h, change, up, down):
    """h after a change whose gains are scaled by `up` and losses by `down` [J/kg]."""
    if change > 0.0:
        return h + up * change
    return h + down * change


def settled(x, shifted, fluid, low, high, width, gap, e_x, e_z):
    """x~ = x + shift [m], for fluid at least `gap` inside the sides; one period back where
    a width is given."""
    moved = x + shifted
    if fluid <= 0.0:
        return moved
    return vector(
        placed(dot(moved, e_x), dot(low, e_x), dot(high, e_x), dot(width, e_x), gap),
        placed(dot(moved, e_z), dot(low, e_z), dot(high, e_z), dot(width, e_z), gap),
    )


def placed(x, low, high, width, gap):
    """One coordinate between its sides, or within its period."""
    if width > 0.0:
        if x < low:
            return x + width
        if x >= high:
            return x - width
        return x
    return min(max(x, low + gap), high - gap)


class Rearrangement:
    """Shift and adjustment with their work vectors.

    Args:
        factor: C of (73). spacing: of the particles that move [m]. box, periods: of the domain.
    """

    def __init__(
        self,
        backend: Backend,
        count: int,
        factor: float,
        spacing: float,
        box: tuple[tuple[float, float], tuple[float, float]],
        periods: tuple[float, float],
    ) -> None:
        self.backend, self.factor, self.spacing = backend, factor, spacing
        self.box, self.periods = box, periods
        self.shifted, self._v = backend.zeros((2, count)), backend.zeros((2, count))
        self._kind, self._change = backend.zeros(count), backend.zeros(count)

    def shift(self, block: Block, roles: Roles, at_face: Any, speed: float, step: float) -> None:
        """Find the displacement of each fluid particle (73), 0 of the others."""
        backend = self.backend
        backend.fill(self.shifted, 0.0)
        if self.factor == 0.0:
            return
        fields = {"is_fluid": roles.fluid, "at_face": at_face}
        backend.pair_sum(
            repulsion_terms, block.pairs, fields, self.shifted, finish=shift,
            rows=roles.fluid_rows, normal=(0.0, 1.0),
            scale=self.factor * speed * step, limit=LARGEST * self.spacing,
        )  # fmt: skip

    def adjust_velocity(self, block: Block, roles: Roles, v: Any, reach: Any, C: Any) -> None:
        """v at the shifted positions (74)."""
        if self.factor == 0.0:
            return
        backend = self.backend
        backend.copy(v, self._v)
        fields = {"v": block.velocity(v, reach), "V": block.V, "C": C, "shifted": self.shifted}
        backend.pair_sum(
            velocity_terms, block.pairs, fields, self._v, finish=adjusted_velocity,
            rows=roles.fluid_rows, combine=("sum", "min", "max"),
            e_x=(1.0, 0.0), e_z=(0.0, 1.0),
        )  # fmt: skip
        backend.copy(self._v, v)

    def adjust_enthalpy(self, block: Block, roles: Roles, h: Any, f_v: Any, m: Any, C: Any) -> None:
        """h at the shifted positions (75)."""
        if self.factor == 0.0:
            return
        backend = self.backend
        backend.pointwise(kind_of, {"fluid": roles.fluid, "f_v": f_v}, self._kind)
        heat = block.gather(h)
        backend.pointwise(face_enthalpy, {"h": heat} | block.rules, heat)
        fields = {
            "h": heat, "kind": block.gather(self._kind), "V": block.V, "C": C, "m": m,
            "shifted": self.shifted,
        }  # fmt: skip
        backend.fill(self._change, 0.0)
        gain, loss = backend.pair_sum(
            enthalpy_terms, block.pairs, fields, (self._change, None, None),
            finish=enthalpy_change, rows=roles.fluid_rows,
            combine=("sum", "min", "max"), reduce=(None, "sum", "sum"),
        )  # fmt: skip
        least = min(gain, loss)
        fields = {"h": h, "change": self._change}
        backend.pointwise(
            balanced, fields, h, up=least / gain if gain else 0.0,
            down=least / loss if loss else 0.0,
        )  # fmt: skip

    def settle(self, position: Any, roles: Roles) -> None:
        """Move the particles to their shifted positions, inside the sides."""
        (x0, x1), (z0, z1) = self.box
        fields = {"x": position, "shifted": self.shifted, "fluid": roles.fluid}
        self.backend.pointwise(
            settled, fields, position, low=(x0, z0), high=(x1, z1), width=self.periods,
            gap=CLOSEST * self.spacing, e_x=(1.0, 0.0), e_z=(0.0, 1.0),
        )  # fmt: skip
