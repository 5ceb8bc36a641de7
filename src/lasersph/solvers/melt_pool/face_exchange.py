"""What the liquid of a box exchanges with each face, as the steps exchange it.

Heat is that of the implicit step: the sums over the pairs with ghosts beyond a Dirichlet or Neumann
face that balance the enthalpies of the particles beside it,

    Q = dt sum_i sum_k [ g_ik c_ik (P_w - P_i) + 2 g_ik q n_k ]

(`block.wall_terms`). Where no heat crosses, a ghost gives its source what that gives back, and
nothing is booked. Momentum is that of the viscous step along the face, t its tangent,

    I = dt rho nu sum_i sum_k g_ik (v_k - v_i) . t

with the velocities from which the step takes its forces. Along a face pressure exerts none.
"""

from __future__ import annotations

from collections.abc import Mapping

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.particles.faces import PLANE
from lasersph.solvers.melt_pool.block import Block, wall_terms
from lasersph.solvers.melt_pool.flow import Flow


def of_face(q, face):
    """A share of a pair for the face beyond which its ghost lies: left, right, bottom, surface."""
    return (
        q if face == 1.0 else 0.0 * q,
        q if face == 2.0 else 0.0 * q,
        q if face == 3.0 else 0.0 * q,
        q if face == 4.0 else 0.0 * q,
    )


def heat_terms(
    g_ij, dirichlet_j, P_w_j, T_w_j, flux_j, normal_j, plane_j, heat_face_j, x_i, x_j, closest
):
    """Shares of a pair in A of each face, and in A P_w + b of each."""
    A, flow, _, b = wall_terms(
        g_ij, dirichlet_j, P_w_j, T_w_j, flux_j, normal_j, plane_j, x_i, x_j, closest
    )
    a_0, a_1, a_2, a_3 = of_face(A, heat_face_j)
    b_0, b_1, b_2, b_3 = of_face(flow + b, heat_face_j)
    return a_0, a_1, a_2, a_3, b_0, b_1, b_2, b_3


def heat_sums(total_0, total_1, total_2, total_3, total_4, total_5, total_6, total_7):
    """Sums of a row."""
    return total_0, total_1, total_2, total_3, total_4, total_5, total_6, total_7


def heat_of_row(P, a_0, a_1, a_2, a_3, b_0, b_1, b_2, b_3):
    """Heat that flows into a particle over each face [W/m]."""
    return b_0 - a_0 * P, b_1 - a_1 * P, b_2 - a_2 * P, b_3 - a_3 * P


def drag_terms(g_ij, v_i, v_j, wall_j):
    """Viscous force on i along each face, over eta [m/s]: along x at bottom and surface, else z."""
    force = g_ij * (v_j - v_i)
    return of_face(force[0] if wall_j > 2.0 else force[1], wall_j)


def of_row(total_0, total_1, total_2, total_3):
    """Sums of a row."""
    return total_0, total_1, total_2, total_3


class FaceExchange:
    """Heat and momentum that a box has exchanged with its faces since the start.

    Args:
        count: particles of the body. potential: of heat, at the end of each step, (count,) [W/m];
            None for a pool, of which nothing is booked.

    Attributes:
        heat: into the box by face [J/m]. impulse: of the face on the liquid, along x at bottom and
            surface, along z at left and right [N s/m].
    """

    def __init__(self, backend: Backend, count: int, potential: Array | None) -> None:
        self.backend, self.potential = backend, potential
        self.heat: dict[str, float] = dict.fromkeys(PLANE, 0.0)
        self.impulse: dict[str, float] = dict.fromkeys(PLANE, 0.0)
        names = [f"{name}_{k}" for name in "ab" for k in range(len(PLANE))]
        self._sums = {name: backend.zeros(count) for name in names}

    def find_walls(self, block: Block) -> None:
        """Sums over the pairs with each face, while weights toward ghosts are not yet set to 0."""
        if self.potential is not None and block.has_walls:
            fields = {"g_ij": block.weights, "heat_face": block.of_type(block.heat_face)}
            self.backend.pair_sum(
                heat_terms,
                block.pairs,
                fields | block.rules,
                tuple(self._sums.values()),
                finish=heat_sums,
                rows=block.rows_near_faces,
                closest=block.closest,
            )

    def book_heat(self, block: Block, step: float) -> None:
        """Add the heat of a step that has just been taken."""
        if self.potential is not None and block.has_walls:
            found = self.backend.pointwise(
                heat_of_row,
                {"P": self.potential} | self._sums,
                (None,) * len(PLANE),
                rows=block.rows_near_faces,
                reduce=("sum",) * len(PLANE),
            )
            add_to(self.heat, found, step)

    def book_drag(self, block: Block, flow: Flow, step: float) -> None:
        """Add the momentum of a viscous step that has just been taken."""
        if self.potential is None:
            return
        fields = {"v": flow.extend_velocity(flow.viscous.velocity), "g_ij": block.weights}
        found = self.backend.pair_sum(
            drag_terms,
            block.pairs,
            fields | {"wall": block.of_type(block.wall)},
            (None,) * len(PLANE),
            finish=of_row,
            rows=block.rows_near_faces,
            reduce=("sum",) * len(PLANE),
        )
        add_to(self.impulse, found, step * flow.liquid.density * flow.liquid.viscosity)

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers that survive a step."""
        parts = {"heat": self.heat, "impulse": self.impulse}
        return {f"{part}.{face}": x for part, sums in parts.items() for face, x in sums.items()}

    def restore(self, numbers: Mapping[str, float]) -> None:
        """Continue from the numbers of `checkpoint_scalars`."""
        self.heat = {face: numbers[f"heat.{face}"] for face in PLANE}
        self.impulse = {face: numbers[f"impulse.{face}"] for face in PLANE}


def add_to(sums: dict[str, float], found: tuple[float, ...], factor: float) -> None:
    """Add numbers of each face times a factor."""
    for face, total in zip(PLANE, found, strict=True):
        sums[face] += factor * total
