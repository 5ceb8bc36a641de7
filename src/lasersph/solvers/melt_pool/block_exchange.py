"""Heat and momentum that a box in 3-D exchanges with each face, as the steps exchange it.

The sums are those of `face_exchange`; heat face by face of those that it crosses,

    Q = dt sum_i sum_k [ g_ik c_ik (P_w - P_i) + 2 g_ik q n_k ],   k beyond the face

and the force of all faces in one sum over pairs with ghosts, each component c of a pair by the
share s_fc that each face f has of it (`FaceConditions.force_shares`),

    I_fc = dt rho nu sum_i sum_k s_fc g_ik (v_k - v_i)_c                             c along f
    J_f  = dt sum_i sum_k s_fc [ V_i (p_i C_i + p_k C_k) G_ik - rho nu g_ik (v_k - v_i) ] . n
           + dt p_0 A
"""

from __future__ import annotations

from collections.abc import Iterator
from math import prod

from lasersph.boundaries.settings import DIRICHLET, NEUMANN
from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.graph import graph
from lasersph.particles.faces import AXES, ENDS
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.block_terms import wall_terms
from lasersph.solvers.melt_pool.face_conditions import FaceConditions
from lasersph.solvers.melt_pool.face_exchange import FaceExchange
from lasersph.solvers.melt_pool.flow import Flow
from lasersph.sph.correction import corrected_symmetric_term
from lasersph.surface.surface import Surface


def heat_of_pair(
    g_ij,
    dirichlet_j,
    P_w_j,
    T_w_j,
    flux_j,
    normal_j,
    plane_j,
    heat_face_j,
    x_i,
    x_j,
    min_distance,
    face,
):
    """Shares of a pair in A, and in A P_w + b, of one face."""
    if heat_face_j != face:
        return 0.0 * g_ij, 0.0 * g_ij
    A, flow, _, b = wall_terms(
        g_ij, dirichlet_j, P_w_j, T_w_j, flux_j, normal_j, plane_j, x_i, x_j, min_distance
    )
    return A, flow + b


def heat_of_particle(P, a, b):
    """Heat that flows into a particle over the face [W], A P_w + b - A P."""
    return b - a * P


def on_faces(force, shares):
    """Shares of a force on each of six faces, vectors."""
    left, right, front, back, bottom, surface = shares
    return left * force, right * force, front * force, back * force, bottom * force, surface * force


def viscous_force(g_ij, v_i, v_j, ghost_type_j, left, right, front, back, bottom, surface):
    """Viscous force on i over eta, on each face [m^2/s]; 0 where j is a particle (type 0)."""
    k = ghost_type_j
    shares = left[k], right[k], front[k], back[k], bottom[k], surface[k]
    return on_faces(g_ij * (v_j - v_i), shares)


def pressure_force(
    p_i, p_j, C_i, C_j, G_ij, ghost_type_j, left, right, front, back, bottom, surface
):
    """Share of a pair in grad p, on each face [Pa/m]; 0 where j is a particle (type 0)."""
    k = ghost_type_j
    shares = left[k], right[k], front[k], back[k], bottom[k], surface[k]
    return on_faces(corrected_symmetric_term(p_i, p_j, C_i, C_j, G_ij), shares)


def all_components(total_0, total_1, total_2, total_3, total_4, total_5):
    """Components along x, y and z of the forces on six faces, face by face."""
    return (
        total_0[0], total_0[1], total_0[2], total_1[0], total_1[1], total_1[2],
        total_2[0], total_2[1], total_2[2], total_3[0], total_3[1], total_3[2],
        total_4[0], total_4[1], total_4[2], total_5[0], total_5[1], total_5[2],
    )  # fmt: skip


def components_across(total_0, total_1, total_2, total_3, total_4, total_5, V):
    """V grad p of a row across each of six faces [N]."""
    return (
        V * total_0[0], V * total_1[0], V * total_2[1], V * total_3[1],
        V * total_4[2], V * total_5[2],
    )  # fmt: skip


class BlockExchange(FaceExchange):
    """Heat and momentum that a box of three dimensions has exchanged with its faces since the
    start.

    Attributes:
        heat: into the box by face [J]. impulse: of the face on the liquid, by the face and the axis
            along it, as surface_x [N s]. pressing: of the liquid on the face, outward [N s].
    """

    def __init__(
        self,
        backend: Backend,
        count: int,
        potential: Array | None,
        conditions: FaceConditions,
        *,
        books_pressing: bool,
    ) -> None:
        super().__init__(backend, count, None, books_pressing=books_pressing)
        self.potential = potential
        kinds = (*DIRICHLET, NEUMANN)
        crossed = [
            face
            for pair in conditions.faces
            for face in pair
            if conditions.boundaries.kind_of(face) in kinds
        ]
        # A and A P_w + b of each particle, by the faces that heat crosses
        self._numbers = {face: conditions.number_of(face) for face in crossed}
        self._of_face = {face: (backend.zeros(count), backend.zeros(count)) for face in crossed}
        self.heat = {face: 0.0 for pair in conditions.faces for face in pair}
        # forces along each face, and across it
        along = [f"{face}_{AXES[c]}" for face in self.heat for c in range(3) if c != axis_of(face)]
        self.impulse = dict.fromkeys(along, 0.0)
        self.pressing = dict.fromkeys(self.heat, 0.0)

    @graph
    def sum_walls(self, block: Block) -> None:
        """A and A P_w + b of each row near a face, face by face."""
        fields = {"g_ij": block.heat_weights, "heat_face": block.walls.faces["heat_face"]}
        for face, number in self._numbers.items():
            self.backend.pair_sum(
                heat_of_pair,
                block.pairs,
                fields | block.walls.rules,
                self._of_face[face],
                rows=block.rows_near_faces,
                min_distance=block.walls.min_distance,
                face=number,
            )

    def book_heat(self, block: Block, step: float) -> None:
        """Add the heat of a step that has just been taken."""
        if self.potential is None or not block.walls.exchange_heat:
            return
        for face, power in self._powers(block.rows_near_faces):
            self.heat[face] += step * power

    def _powers(self, rows: Rows) -> Iterator[tuple[str, float]]:
        """Each face that heat crosses, and the heat that flows in over it [W]."""
        assert self.potential is not None
        for face, (a, b) in self._of_face.items():
            fields = {"P": self.potential, "a": a, "b": b}
            (power,) = self.backend.pointwise(
                heat_of_particle, fields, (None,), rows=rows, reduce=("sum",)
            )
            yield face, power

    def book_viscous_forces(self, block: Block, flow: Flow, step: float) -> None:
        """Add the momentum of a viscous step that has just been taken."""
        if self.potential is None:
            return
        found = self.sum_viscous_forces(block, flow)
        factor = step * flow.liquid.density * flow.liquid.viscosity
        # three components a face: two are drag, that along its normal presses
        components = iter(found)
        for face in self.heat:
            for axis in range(3):
                force = factor * next(components)
                if axis != axis_of(face):
                    self.impulse[f"{face}_{AXES[axis]}"] += force
                elif self.books_pressing:
                    self.pressing[face] -= outward_sign(face) * force

    @graph
    def sum_viscous_forces(self, block: Block, flow: Flow) -> None:
        """Reduce the components of the viscous force over eta on each face [m^2/s]."""
        v = flow.extend_velocity(flow.viscous.velocity)
        fields = {"v": v, "g_ij": block.viscous_weights, **self._types(block)}
        self.backend.pair_sum(
            viscous_force,
            block.pairs,
            fields,
            (None,) * 18,
            finish=all_components,
            rows=block.rows_near_faces,
            reduce=("sum",) * 18,
            **block.walls.force_shares,
        )

    def book_pressure(self, block: Block, flow: Flow, step: float) -> None:
        """Add the momentum of the pressure that has just corrected the velocity."""
        if self.potential is None or not self.books_pressing:
            return
        found = self.sum_pressure(block, flow.projection.gradient_fields)
        # dt times the force on the face, and the constant p_0 over its area
        edges = [high - low for low, high in block.conditions.box]
        for face, force in zip(self.heat, found, strict=True):
            axis = axis_of(face)
            area = prod(edge for k, edge in enumerate(edges) if k != axis)
            self.pressing[face] += step * outward_sign(face) * force
            self.pressing[face] += step * area * flow.projection.lowest

    @graph
    def sum_pressure(self, block: Block, fields: dict[str, Array]) -> None:
        """Reduce the force of the pressure across each face [N]."""
        self.backend.pair_sum(
            pressure_force,
            block.pairs,
            fields | {"V": block.volume, **self._types(block)},
            (None,) * 6,
            finish=components_across,
            rows=block.rows_near_faces,
            reduce=("sum",) * 6,
            **block.walls.force_shares,
        )

    def _types(self, block: Block) -> dict[str, Array]:
        """Types of particles and ghosts, by which faces have their shares."""
        return {"ghost_type": block.ghosts.particles.ghost_type}


def axis_of(face: str) -> int:
    """Axis across which a face of a block lies, 0 to 2."""
    return ENDS[face][0] % 3


def outward_sign(face: str) -> float:
    """1 of a face at the upper end of its axis, -1 at the lower end."""
    return 1.0 if ENDS[face][1] else -1.0


def exchange_of(
    backend: Backend,
    count: int,
    potential: Array | None,
    conditions: FaceConditions,
    surface: Surface,
) -> FaceExchange:
    """Exchange of a box below a surface with its faces; other args as of `FaceExchange`."""
    books = surface.pressure_gradient.is_symmetric
    if len(conditions.box) == 2:
        return FaceExchange(backend, count, potential, books_pressing=books)
    return BlockExchange(backend, count, potential, conditions, books_pressing=books)
