"""Heat that the liquid of a block in 3-D exchanges with each face, as the steps exchange it.

The sums are those of `face_exchange`, face by face of those that heat crosses,

    Q = dt sum_i sum_k [ g_ik c_ik (P_w - P_i) + 2 g_ik q n_k ],   k beyond the face

The forces that walls and liquid exert on each other are left out.
"""

from __future__ import annotations

from collections.abc import Iterator

from lasersph.boundaries.settings import DIRICHLET, NEUMANN
from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.graph import graph
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.block_terms import wall_terms
from lasersph.solvers.melt_pool.face_conditions import FaceConditions
from lasersph.solvers.melt_pool.face_exchange import FaceExchange
from lasersph.solvers.melt_pool.flow import Flow
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


class BlockExchange(FaceExchange):
    """Heat that a box of three dimensions has exchanged with its faces since the start."""

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
        self.impulse, self.pressing = {}, {}

    @graph
    def sum_walls(self, block: Block) -> None:
        """A and A P_w + b of each row near a face, face by face."""
        fields = {"g_ij": block.weights, "heat_face": block.walls.faces["heat_face"]}
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
        """Nothing is booked."""

    def book_pressure(self, block: Block, flow: Flow, step: float) -> None:
        """Nothing is booked."""


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
