"""Heat and momentum that the liquid of a box exchanges with each face, as the steps exchange it.

Heat is that of the implicit step: the sums over the pairs with ghosts beyond a Dirichlet or Neumann
face that balance the enthalpies of the particles beside it,

    Q = dt sum_i sum_k [ g_ik c_ik (P_w - P_i) + 2 g_ik q n_k ]

(`block_terms.wall_terms`). Where no heat crosses, a ghost gives its source what that gives back,
and nothing is booked. Momentum along the face is that of the viscous step, t its tangent,

    I = dt rho nu sum_i sum_k g_ik (v_k - v_i) . t

with nu at the liquidus, and the weights and velocities from which the step takes its forces
(`physics.viscosity`; its transposed gradient is a force on the particles, none of a face); pressure
exerts none. Across the face, n outward, it is that of the pressure and of the same viscous step,

    J = dt sum_i sum_k [ V_i (p_i C_i + p_k C_k) G_ik - rho nu g_ik (v_k - v_i) ] . n + dt p_0 l

Steps take p over the lowest one p_0; what that constant presses on a face of length l is taken off,
so that J is the impulse of the pressure that particles store, whose mean in a closed box is 0.
Below a surface that moves the gradient is one of differences: its sum over ghosts is not what
presses on a wall, since the forces of two particles on each other are not opposite. J is not
booked there.
"""

from __future__ import annotations

from collections.abc import Mapping

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.graph import graph
from lasersph.particles.faces import PLANE
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.block_terms import wall_terms
from lasersph.solvers.melt_pool.flow import Flow
from lasersph.sph.correction import corrected_symmetric_term


def of_face(q, face):
    """A share of a pair for the face beyond which its ghost lies: left, right, bottom, surface."""
    return (
        q if face == 1.0 else 0.0 * q,
        q if face == 2.0 else 0.0 * q,
        q if face == 3.0 else 0.0 * q,
        q if face == 4.0 else 0.0 * q,
    )


def heat_terms(
    g_ij, dirichlet_j, P_w_j, T_w_j, flux_j, normal_j, plane_j, heat_face_j, x_i, x_j, min_distance
):
    """Shares of a pair in A of each face, and in A P_w + b of each."""
    A, flow, _, b = wall_terms(
        g_ij, dirichlet_j, P_w_j, T_w_j, flux_j, normal_j, plane_j, x_i, x_j, min_distance
    )
    a_0, a_1, a_2, a_3 = of_face(A, heat_face_j)
    b_0, b_1, b_2, b_3 = of_face(flow + b, heat_face_j)
    return a_0, a_1, a_2, a_3, b_0, b_1, b_2, b_3


def heat_of_row(P, a_0, a_1, a_2, a_3, b_0, b_1, b_2, b_3):
    """Heat that flows into a particle over each face [W/m]."""
    return b_0 - a_0 * P, b_1 - a_1 * P, b_2 - a_2 * P, b_3 - a_3 * P


def along_and_across(force, wall):
    """Components of a force along each face and then across it.

    In a corner both are across: each component is that of one face.
    """
    a_0, a_1, _, _ = of_face(force[1], wall[0] if wall[1] == 0.0 else 0.0)
    _, _, a_2, a_3 = of_face(force[0], wall[1] if wall[0] == 0.0 else 0.0)
    c_0, c_1, _, _ = of_face(force[0], wall[0])
    _, _, c_2, c_3 = of_face(force[1], wall[1])
    return a_0, a_1, a_2, a_3, c_0, c_1, c_2, c_3


def viscous_terms(g_ij, v_i, v_j, wall_j):
    """Viscous force on i over eta, along and across each face [m/s]."""
    return along_and_across(g_ij * (v_j - v_i), wall_j)


def pressure_terms(p_i, p_j, C_i, C_j, G_ij, wall_j):
    """Share of a pair in grad p, along and across each face [Pa/m]."""
    grad = corrected_symmetric_term(p_i, p_j, C_i, C_j, G_ij)
    return along_and_across(grad, wall_j)


def force_across(total_0, total_1, total_2, total_3, total_4, total_5, total_6, total_7, V):
    """V grad p of a row across each face [N/m]."""
    return V * total_4, V * total_5, V * total_6, V * total_7


class FaceExchange:
    """Heat and momentum that a box has exchanged with its faces since the start.

    Args:
        count: particles of the body. potential: of heat, at the end of each step, (count,) [W/m];
            None for a pool, of which nothing is booked. books_pressing: whether the gradient of
            the pressure is symmetric.

    Attributes:
        heat: into the box by face [J/m]. impulse: of the face on the liquid, along x at bottom and
            surface, along z at left and right [N s/m]. pressing: of the liquid on the face, outward
            [N s/m].
    """

    def __init__(
        self, backend: Backend, count: int, potential: Array | None, *, books_pressing: bool
    ) -> None:
        self.backend, self.potential = backend, potential
        self.books_pressing = books_pressing
        self.heat: dict[str, float] = dict.fromkeys(PLANE, 0.0)
        self.impulse: dict[str, float] = dict.fromkeys(PLANE, 0.0)
        self.pressing: dict[str, float] = dict.fromkeys(PLANE, 0.0)
        faces = range(0 if potential is None else len(PLANE))
        names = [f"{name}_{k}" for name in "ab" for k in faces]
        self._sums = {name: backend.zeros(count) for name in names}

    def find_walls(self, block: Block) -> None:
        """Sums over the pairs with each face, while weights toward ghosts are not yet set to 0."""
        if self.potential is not None and block.walls.exchange_heat:
            self.sum_walls(block)

    @graph
    def sum_walls(self, block: Block) -> None:
        """A and A P_w + b of each row near a face, by face."""
        fields = {"g_ij": block.heat_weights, "heat_face": block.walls.faces["heat_face"]}
        self.backend.pair_sum(
            heat_terms,
            block.pairs,
            fields | block.walls.rules,
            tuple(self._sums.values()),
            rows=block.rows_near_faces,
            min_distance=block.walls.min_distance,
        )

    def book_heat(self, block: Block, step: float) -> None:
        """Add the heat of a step that has just been taken."""
        if self.potential is not None and block.walls.exchange_heat:
            add_to(self.heat, self.sum_heat(block.rows_near_faces), step)

    @graph
    def sum_heat(self, rows: Rows) -> None:
        """Reduce the heat that flows in over each face [W/m]."""
        assert self.potential is not None
        fields, out = {"P": self.potential} | self._sums, (None,) * len(PLANE)
        reduce = ("sum",) * len(PLANE)
        self.backend.pointwise(heat_of_row, fields, out, rows=rows, reduce=reduce)

    def book_viscous_forces(self, block: Block, flow: Flow, step: float) -> None:
        """Add the momentum of a viscous step that has just been taken."""
        if self.potential is None:
            return
        # dt rho nu times the sums, along each face and across it
        found = self.sum_viscous_forces(block, flow)
        factor = step * flow.liquid.density * flow.liquid.viscosity
        add_to(self.impulse, found[: len(PLANE)], factor)
        if self.books_pressing:
            add_to(self.pressing, outward(found[len(PLANE) :]), -factor)

    @graph
    def sum_viscous_forces(self, block: Block, flow: Flow) -> None:
        """Reduce the viscous force over eta, along and across each face [m^2/s]."""
        v, weights = flow.extend_velocity(flow.viscous.velocity), block.viscous_weights
        fields = {"v": v, "g_ij": weights}
        self.backend.pair_sum(
            viscous_terms,
            block.pairs,
            fields | block.walls.faces,
            (None,) * (2 * len(PLANE)),
            rows=block.rows_near_faces,
            reduce=("sum",) * (2 * len(PLANE)),
        )

    def book_pressure(self, block: Block, flow: Flow, step: float) -> None:
        """Add the momentum of the pressure that has just corrected the velocity."""
        if self.potential is None or not self.books_pressing:
            return
        # dt times the force on the face, and the constant p_0 over its length
        found = self.sum_pressure(block, flow.projection.gradient_fields)
        add_to(self.pressing, outward(found), step)
        (x_0, x_1), (z_0, z_1) = block.conditions.box
        width, height = x_1 - x_0, z_1 - z_0
        add_to(self.pressing, (height, height, width, width), step * flow.projection.lowest)

    @graph
    def sum_pressure(self, block: Block, fields: dict[str, Array]) -> None:
        """Reduce the force of the pressure across each face [N/m]."""
        self.backend.pair_sum(
            pressure_terms,
            block.pairs,
            fields | block.walls.faces | {"V": block.volume},
            (None,) * len(PLANE),
            finish=force_across,
            rows=block.rows_near_faces,
            reduce=("sum",) * len(PLANE),
        )

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers that survive a step."""
        parts = {"heat": self.heat, "impulse": self.impulse, "pressing": self.pressing}
        return {f"{part}.{face}": x for part, sums in parts.items() for face, x in sums.items()}

    def restore(self, numbers: Mapping[str, float]) -> None:
        """Continue from the numbers of `checkpoint_scalars`."""
        self.heat = {face: numbers[f"heat.{face}"] for face in self.heat}
        self.impulse = {face: numbers[f"impulse.{face}"] for face in self.impulse}
        self.pressing = {face: numbers[f"pressing.{face}"] for face in self.pressing}


def outward(components: tuple[float, ...]) -> tuple[float, ...]:
    """Components along x, x, z, z at each face, as components out of the box."""
    left, right, bottom, surface = components
    return -left, right, -bottom, surface


def add_to(sums: dict[str, float], found: tuple[float, ...], factor: float) -> None:
    """Add numbers of each face times a factor."""
    for face, total in zip(PLANE, found, strict=True):
        sums[face] += factor * total
