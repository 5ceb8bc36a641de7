"""Heat and momentum that the liquid of a box exchanges with each face, as the steps exchange it.

Heat is that of the implicit step: the sums over the pairs with ghosts beyond a Dirichlet or Neumann
face that balance the enthalpies of the particles beside it,

    Q = dt sum_i sum_k [ g_ik c_ik (P_w - P_i) + 2 g_ik q n_k ],   k beyond the face

(`block_terms.wall_terms`). Where no heat crosses, a ghost gives its source what that gives back,
and nothing is booked. Momentum along a face f is that of the viscous step, each component c of a
pair by the share s_fc that the face has of it (`FaceConditions.force_shares`),

    I_fc = dt rho nu sum_i sum_k s_fc g_ik (v_k - v_i)_c                             c along f

with nu at the liquidus, and the weights and velocities from which the step takes its forces
(`physics.viscosity`; its transposed gradient is a force on the particles, none of a face); pressure
exerts none. Across the face, n outward, it is that of the pressure and of the same viscous step,

    J_f = dt sum_i sum_k s_fc [ V_i (p_i C_i + p_k C_k) G_ik - rho nu g_ik (v_k - v_i) ] . n
          + dt p_0 A

Steps take p over the lowest one p_0; what that constant presses on a face of area A, in a section
the length of it, is taken off, so that J is the impulse of the pressure that particles store, whose
mean in a closed box is 0. Below a surface that moves, and between planes of symmetry alone, the
gradient is one of differences: its sum over ghosts is not what presses on a wall, since the forces
of two particles on each other are not opposite. J is not booked there.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import prod

from lasersph.boundaries.settings import DIRICHLET, NEUMANN
from lasersph.compute.array_types import Array, Constants, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.graph import graph
from lasersph.compute.vectors import outer
from lasersph.particles.faces import AXES, ENDS
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.block_terms import wall_terms
from lasersph.solvers.melt_pool.face_conditions import FaceConditions
from lasersph.solvers.melt_pool.flow import Flow
from lasersph.sph.correction import corrected_symmetric_term

OUTWARD = (-1.0, 1.0)
"""Sign of the outward normal at an end of an axis. Format: 0 is its lower end, 1 its upper one."""


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


def on_faces(force, lower, upper, ones):
    """Parts of a force on the lower and on the upper face of each axis, (d, d) each, by shares."""
    each = outer(ones, force)
    return lower * each, upper * each


def viscous_force(g_ij, v_i, v_j, ghost_type_j, lower, upper, ones):
    """Viscous force on i over eta, on each face [m^(d-1)/s]; 0 where j is a particle (type 0)."""
    force = g_ij * (v_j - v_i)
    return on_faces(force, lower[ghost_type_j], upper[ghost_type_j], ones)


def pressure_force(p_i, p_j, C_i, C_j, G_ij, ghost_type_j, lower, upper, ones):
    """Share of a pair in grad p, on each face [Pa/m]; 0 where j is a particle (type 0)."""
    force = corrected_symmetric_term(p_i, p_j, C_i, C_j, G_ij)
    return on_faces(force, lower[ghost_type_j], upper[ghost_type_j], ones)


def force_of_row(total_0, total_1, V):
    """V grad p of a row on each face [N per (3 - d) lengths]."""
    return V * total_0, V * total_1


def names_along(face: str, dimension: int) -> dict[int, str]:
    """Names of what a face does along itself, by axis: surface_x and surface_y, or surface."""
    axes = (c for c in range(dimension) if c != ENDS[face][0] % dimension)
    return {c: f"{face}_{AXES[c]}" if dimension == 3 else face for c in axes}


class FaceExchange:
    """Heat and momentum that a box has exchanged with its faces since the start.

    Args:
        count: particles of the body. potential: of heat, at the end of each step, (count,) [W/m];
            None for a pool, of which nothing is booked. books_pressing: whether the gradient of
            the pressure is symmetric.

    Attributes:
        heat: into the box by face [J], of a section [J/m]. impulse: of the face on the liquid along
            it, by the face and in 3-D its axis, as surface_x [N s], of a section [N s/m]. pressing:
            of the liquid on the face, outward, likewise.
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
        self.backend, self.potential = backend, potential
        self.books_pressing = books_pressing
        dimension, faces = len(conditions.faces), [face for two in conditions.faces for face in two]
        # axis and end of each face, 0 or 1, and names of its impulses by the axes along it
        self._sides = {face: (ENDS[face][0] % dimension, ENDS[face][1]) for face in faces}
        self._along = {face: names_along(face, dimension) for face in faces}
        self.heat = dict.fromkeys(faces, 0.0)
        self.impulse = {name: 0.0 for names in self._along.values() for name in names.values()}
        self.pressing = dict.fromkeys(faces, 0.0)
        self._dimension = dimension
        self._ones: Constants = {"ones": (1.0,) * dimension}

        # A and A P_w + b of each particle, by the faces that heat crosses
        kinds = (*DIRICHLET, NEUMANN)
        crossed = [face for face in faces if conditions.boundaries.kind_of(face) in kinds]
        self._numbers = {face: conditions.number_of(face) for face in crossed}
        size = 0 if potential is None else count
        self._of_face = {face: (backend.zeros(size), backend.zeros(size)) for face in crossed}

    def find_walls(self, block: Block) -> None:
        """Sums over the pairs with each face, while weights toward ghosts are not yet set to 0."""
        if self.potential is not None and block.walls.exchange_heat:
            self.sum_walls(block)

    @graph
    def sum_walls(self, block: Block) -> None:
        """A and A P_w + b of each row near a face, face by face."""
        fields = {"g_ij": block.heat_weights, "heat_face": block.walls.heat_face}
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
        factor = step * flow.liquid.density * flow.liquid.viscosity
        # components along a face are drag, that along its normal presses
        for face, force in self._by_face(self.sum_viscous_forces(block, flow)):
            for axis, name in self._along[face].items():
                self.impulse[name] += factor * force[axis]
            if self.books_pressing:
                axis, end = self._sides[face]
                self.pressing[face] -= OUTWARD[end] * (factor * force[axis])

    @graph
    def sum_viscous_forces(self, block: Block, flow: Flow) -> None:
        """Reduce the components of the viscous force over eta on each face."""
        v = flow.extend_velocity(flow.viscous.velocity)
        fields = {"v": v, "g_ij": block.viscous_weights}
        self.backend.pair_sum(
            viscous_force,
            block.pairs,
            fields | self._types(block),
            (None, None),
            rows=block.rows_near_faces,
            reduce=("sum", "sum"),
            **block.walls.force_shares,
            **self._ones,
        )

    def book_pressure(self, block: Block, flow: Flow, step: float) -> None:
        """Add the momentum of the pressure that has just corrected the velocity."""
        if self.potential is None or not self.books_pressing:
            return
        found = self.sum_pressure(block, flow.projection.gradient_fields)
        # dt times the force on the face, and the constant p_0 over its area
        edges = [high - low for low, high in block.conditions.box]
        for face, force in self._by_face(found):
            axis, end = self._sides[face]
            area = prod(edge for k, edge in enumerate(edges) if k != axis)
            self.pressing[face] += step * OUTWARD[end] * force[axis]
            self.pressing[face] += step * area * flow.projection.lowest

    @graph
    def sum_pressure(self, block: Block, fields: dict[str, Array]) -> None:
        """Reduce the components of the force of the pressure on each face."""
        self.backend.pair_sum(
            pressure_force,
            block.pairs,
            fields | self._types(block) | {"V": block.volume},
            (None, None),
            finish=force_of_row,
            rows=block.rows_near_faces,
            reduce=("sum", "sum"),
            **block.walls.force_shares,
            **self._ones,
        )

    def _types(self, block: Block) -> dict[str, Array]:
        """Types of particles and ghosts, by which faces have their shares."""
        return {"ghost_type": block.ghosts.particles.ghost_type}

    def _by_face(self, found: tuple[float, ...]) -> Iterator[tuple[str, tuple[float, ...]]]:
        """Components of the force on each face, of those of all lower and then all upper faces."""
        d = self._dimension
        for face, (axis, end) in self._sides.items():
            first = (end * d + axis) * d
            yield face, found[first : first + d]

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers that survive a step."""
        parts = {"heat": self.heat, "impulse": self.impulse, "pressing": self.pressing}
        return {f"{part}.{face}": x for part, sums in parts.items() for face, x in sums.items()}

    def restore(self, numbers: Mapping[str, float]) -> None:
        """Continue from the numbers of `checkpoint_scalars`."""
        self.heat = {face: numbers[f"heat.{face}"] for face in self.heat}
        self.impulse = {face: numbers[f"impulse.{face}"] for face in self.impulse}
        self.pressing = {face: numbers[f"pressing.{face}"] for face in self.pressing}
