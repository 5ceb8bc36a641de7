"""Conditions at the faces of the domain, as what the ghosts beyond each face carry.

For the flow a ghost has the velocity

    v_k = F (v_s + 2 d tau / eta t) + v_0

of its source s: F = -1 for components that vanish at the face (the normal one at any face, all at
a wall), v_0 = 2 v_wall at a moving wall, and under a free surface the slope that the stress tau
asks for over the distance 2 d between source and ghost [Demuth2020, eq. (15)]. Beyond an edge or a
corner the factors of the faces between are multiplied. Pressure is mirrored, dp/dn = 0. For heat a
ghost carries its source's state where no heat crosses; beyond a Dirichlet face P_w is extrapolated
as in `boundaries.dirichlet_faces`, beyond a Neumann face as in `boundaries.neumann_faces`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries import Boundaries
from lasersph.boundaries.flow_conditions import FREE, WALLS, FlowConditions
from lasersph.boundaries.settings import DIRICHLET, NEUMANN
from lasersph.particles.faces import BOTTOM, SURFACE, VERTICAL, face_pairs
from lasersph.particles.ghosts import (
    LOWER,
    MIRROR,
    OPEN,
    PERIODIC,
    TANGENT,
    UPPER,
    FacePair,
    GhostTypes,
)
from lasersph.surface.surface import Surface

Array = NDArray[np.float64]
ENDS = (LOWER, UPPER)


def _has_tangent(face: str, surface: Surface) -> bool:
    """Whether ghosts beyond a face lie across the local tangent of a surface."""
    return face == SURFACE and surface.moves


@dataclass(frozen=True)
class GhostRules:
    """Rules of what ghosts carry, by their type, host arrays.

    Attributes:
        factor, added: (d, w) diagonal of F, and v_0 [m/s]. stressed: (w,) 1 beyond a free surface,
            where 2 d tau / eta is added to the velocity of the source.
        dirichlet: (w,) 1 beyond a Dirichlet face. wall_temperature: (w,) [K], its mean where it
            varies along the face, as `varies` (w,) says. flux: (w,) into the body [W/m^2]. normal:
            (d, w) outward, plane: (w,) place of the face along it [m]. heat_face: (w,) number
            of the face whose heat condition holds, see `FaceConditions.number_of`. walls: (d, w)
            those across each axis that lie between for the flow. Else 0.
    """

    factor: Array
    added: Array
    stressed: Array
    dirichlet: Array
    wall_temperature: Array
    varies: NDArray[np.bool_]
    flux: Array
    normal: Array
    plane: Array
    heat_face: Array
    walls: Array

    @property
    def has_one_wall(self) -> NDArray[np.bool_]:
        """(w,) whether one face lies between for the flow, and no edge or corner."""
        return np.count_nonzero(self.walls, axis=0) == 1


class FaceConditions:
    """Heat and flow at the faces of a box.

    Args:
        box: lower and upper end of each axis, z last [m]. flow: None for a pool in a block: its
            lateral faces mirror or repeat as the heat does, its surface is free, its bottom rests.

    Attributes:
        faces: names of the lower and the upper face of each axis. interval: begin and end of the
            step, for what varies with time [s].
    """

    def __init__(
        self,
        box: tuple[tuple[float, float], ...],
        boundaries: Boundaries,
        flow: FlowConditions | None,
        initial_temperature: float,
    ) -> None:
        self.box, self.boundaries, self.flow = box, boundaries, flow
        self.faces = face_pairs(len(box))
        self.initial_temperature = initial_temperature
        self.interval = (0.0, 0.0)

    def flow_kind(self, face: str) -> str:
        """Kind of a face for the flow."""
        if self.flow is not None:
            return self.flow.faces[face].kind
        if face == SURFACE:
            return "free-surface"
        if face == BOTTOM:
            return "no-slip"
        return "periodic" if self.boundaries.kind_of(face) == "periodic" else "symmetry"

    def number_of(self, face: str) -> float:
        """Number of a face in loops, from 1 in the order of `faces`; 0 is none."""
        return 1.0 + [name for pair in self.faces for name in pair].index(face)

    def ghost_faces(self, surface: Surface, *, has_bottom: bool) -> tuple[FacePair, ...]:
        """Faces beyond which ghosts lie; without the bottom where particles go on below."""
        pairs = []
        for (lower, upper), (low, high) in zip(self.faces, self.box, strict=True):
            is_periodic = self.flow_kind(lower) == "periodic"
            kind = PERIODIC if is_periodic else MIRROR
            below = OPEN if lower == BOTTOM and not has_bottom else kind
            above = TANGENT if _has_tangent(upper, surface) else kind
            pairs.append(FacePair(below, above, low, high))
        return tuple(pairs)

    def wall_velocity(self, face: str) -> float:
        """Velocity of a moving wall along itself [m/s]."""
        return self.flow.faces[face].velocity if self.flow is not None else 0.0

    def largest_wall_speed(self) -> float:
        """Largest speed of a wall [m/s]."""
        return max(abs(self.wall_velocity(face)) for pair in self.faces for face in pair)

    def rules(self, ghost_types: GhostTypes, surface: Surface) -> GhostRules:
        """Rules for ghosts of these types."""
        dimension, count = ghost_types.sign.shape
        stressed, dirichlet, temperature = np.zeros(count), np.zeros(count), np.zeros(count)
        flux, heat_face, plane = np.zeros(count), np.zeros(count), np.zeros(count)
        normal, walls = np.zeros((dimension, count)), np.zeros((dimension, count))
        varies = np.zeros(count, bool)
        for axis, face, chosen, at, outward in self._crossings(ghost_types):
            kind = self.boundaries.kind_of(face)
            walls[axis, chosen] = self.number_of(face)
            # the first Dirichlet face in a corner, else the first Neumann face
            mine = chosen & (heat_face == 0.0)
            if self.flow_kind(face) in FREE:
                stressed[chosen] = 1.0
                flux[mine] = surface.heat_flux
            if kind in DIRICHLET:
                mine = chosen & (dirichlet == 0.0)
                dirichlet[mine] = 1.0
                temperature[mine] = self.boundaries.temperature_of(face, self.initial_temperature)
                varies[mine] = (
                    face == SURFACE and self.boundaries.surface_temperature_wave is not None
                )
            elif kind == NEUMANN:
                flux[mine] = self.boundaries.flux_of(face)
            elif not flux[mine].any():
                continue
            normal[:, mine] = 0.0
            normal[axis, mine], plane[mine] = outward, outward * at
            heat_face[mine] = self.number_of(face)
        factor, added = self._velocities(ghost_types, surface)
        return GhostRules(
            factor,
            added,
            stressed,
            dirichlet,
            temperature,
            varies,
            flux,
            normal,
            plane,
            heat_face,
            walls,
        )

    def varying_temperature(self, x: Array) -> Array:
        """Temperature of a face that varies along it, at places x [m] in the `interval`, [K]."""
        T_0 = self.initial_temperature
        return self.boundaries.temperature_along(SURFACE, x, T_0, self.interval)

    def _crossings(
        self, ghost_types: GhostTypes
    ) -> Iterator[tuple[int, str, NDArray[np.bool_], float, float]]:
        """Axis, face, types beyond it, its place [m] and -1 or 1, for all faces but periodic."""
        for axis, names in enumerate(self.faces):
            for end, face, at in zip(ENDS, names, self.box[axis], strict=True):
                chosen = ghost_types.crossed[axis] == end
                if self.flow_kind(face) != "periodic" and chosen.any():
                    yield axis, face, chosen, at, 1.0 if end == UPPER else -1.0

    def _velocities(self, ghost_types: GhostTypes, surface: Surface) -> tuple[Array, Array]:
        """Diagonal of F, and v_0.

        Walls turn all components around, other faces the normal one; factors of several faces are
        multiplied. The velocity of a moving wall ends in edges and corners with faces that it meets
        and with other walls: carried on, it would pump fluid through the corner; reversed, as an
        impermeable face asks for, its jump would empty the corner of particles. Half of the leak
        remains, which shrinks with the spacing.
        """
        factor, added = np.ones(ghost_types.sign.shape), np.zeros(ghost_types.sign.shape)
        crossings = list(self._crossings(ghost_types))
        walls = [one for one in crossings if self.flow_kind(one[1]) in WALLS]
        has_one_wall = np.sum([chosen for _, _, chosen, _, _ in walls], axis=0) == 1
        # components along walls, and what a wall that moves along x or up adds to them
        for axis, face, chosen, _, _ in walls:
            factor[np.ix_(np.arange(len(factor)) != axis, chosen)] *= -1.0
            along = 0 if face in VERTICAL else -1
            added[along, chosen & has_one_wall] = 2.0 * self.wall_velocity(face)
        # components across any face
        for axis, face, chosen, _, _ in crossings:
            if _has_tangent(face, surface):  # no component is turned around across a tangent
                continue
            factor[axis, chosen] *= -1.0
            added[axis, chosen] = 0.0
            if self.flow_kind(face) in FREE:
                added[axis, chosen] = 2.0 * surface.normal_velocity
        return factor, added
