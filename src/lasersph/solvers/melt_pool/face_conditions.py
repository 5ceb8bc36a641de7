"""Conditions at the faces of the domain, as what the ghosts beyond each face carry.

For the flow a ghost has the velocity

    v_k = S v_s + c + 2 d tau / eta t

of its source s: S = -1 for components that vanish at the face (the normal one at any face, both at
a wall), c = 2 v_wall at a moving wall, and under a free surface the slope that the stress tau asks
for over the distance 2 d between source and ghost [Demuth2020, eq. (15)]. Pressure is mirrored,
dp/dn = 0. For heat a ghost carries its source's state where no heat crosses; beyond a Dirichlet
face P_w is extrapolated as in `boundaries.dirichlet_faces`, beyond a Neumann face as in
`boundaries.neumann_faces`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries import Boundaries
from lasersph.boundaries.flow_conditions import FREE, FlowConditions
from lasersph.boundaries.settings import DIRICHLET, NEUMANN
from lasersph.boundaries.surface import Surface
from lasersph.particles.faces import BOTTOM, PLANE, SURFACE, face_pairs
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

Array = NDArray[np.float64]
FACES = face_pairs(2)
ENDS = (LOWER, UPPER)


def _across(face: str, surface: Surface | None) -> bool:
    """Whether ghosts beyond a face lie across the local tangent of a surface."""
    return face == SURFACE and surface is not None and surface.ghosts is not None


@dataclass(frozen=True)
class GhostRules:
    """What ghosts carry by their type, host arrays.

    Attributes:
        factor, added: (2, w) S and c [m/s]. slope: (w,) how often 2 d tau / eta is added to the
            tangential velocity, -1, 0 or 1.
        dirichlet: (w,) 1 beyond a Dirichlet face. wall_temperature: (w,) [K], its mean where it
            varies along the face, as `varies` (w,) says. flux: (w,) into the body [W/m^2]. normal:
            (2, w) outward, plane: (w,) place of the face along it [m]. heat_face: (w,) number
            of the face, from 1 in the order of `PLANE`, whose heat condition holds. walls: (2, w)
            those across x and across z that lie between for the flow. Else 0.
    """

    factor: Array
    added: Array
    slope: Array
    dirichlet: Array
    wall_temperature: Array
    varies: NDArray[np.bool_]
    flux: Array
    normal: Array
    plane: Array
    heat_face: Array
    walls: Array

    @property
    def wall(self) -> Array:
        """(w,) number of the one face that lies between for the flow; 0 of none and of two."""
        return np.where((self.walls > 0.0).all(axis=0), 0.0, self.walls.max(axis=0))


class FaceConditions:
    """Heat and flow at the four faces of a 2-D domain.

    Args:
        box: ((x0, x1), (z0, z1)) [m]. flow: None for a pool in a block: its lateral faces mirror or
            repeat as the heat does, its surface is free, its bottom rests.

    Attributes:
        interval: begin and end of the step, for what varies with time [s].
    """

    def __init__(
        self,
        box: tuple[tuple[float, float], tuple[float, float]],
        boundaries: Boundaries,
        flow: FlowConditions | None,
        initial_temperature: float,
    ) -> None:
        self.box, self.boundaries, self.flow = box, boundaries, flow
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

    def ghost_faces(
        self, surface: Surface | None, *, has_bottom: bool
    ) -> tuple[FacePair, FacePair]:
        """Faces beyond which ghosts lie; without the bottom where particles go on below."""
        pairs = []
        for (lower, upper), (low, high) in zip(FACES, self.box, strict=True):
            is_periodic = self.flow_kind(lower) == "periodic"
            kind = PERIODIC if is_periodic else MIRROR
            below = OPEN if lower == BOTTOM and not has_bottom else kind
            above = TANGENT if _across(upper, surface) else kind
            pairs.append(FacePair(below, above, low, high))
        return pairs[0], pairs[1]

    def wall_velocity(self, face: str) -> float:
        """Velocity of a moving wall along itself [m/s]."""
        return self.flow.faces[face].velocity if self.flow is not None else 0.0

    def largest_wall_speed(self) -> float:
        """Largest speed of a wall [m/s]."""
        return max(abs(self.wall_velocity(face)) for pair in FACES for face in pair)

    def rules(self, ghost_types: GhostTypes, surface: Surface | None) -> GhostRules:
        """Rules for ghosts of these types."""
        count = ghost_types.count
        slope, dirichlet, temperature = np.zeros(count), np.zeros(count), np.zeros(count)
        flux, normal, plane = np.zeros(count), np.zeros((2, count)), np.zeros(count)
        heat_face, walls, varies = np.zeros(count), np.zeros((2, count)), np.zeros(count, bool)
        for axis, face, chosen, at, outward in self._crossings(ghost_types):
            kind = self.boundaries.kind_of(face)
            walls[axis, chosen] = 1.0 + PLANE.index(face)
            # the first Dirichlet face in a corner, else the first Neumann face
            mine = chosen & (heat_face == 0.0)
            if surface is not None and self.flow_kind(face) in FREE:
                slope[chosen] = ghost_types.sign[1 - axis, chosen]
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
            heat_face[mine] = 1.0 + PLANE.index(face)
        factor, added = self._velocities(ghost_types, surface)
        return GhostRules(
            factor,
            added,
            slope,
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
        for axis, names in enumerate(FACES):
            for end, face, at in zip(ENDS, names, self.box[axis], strict=True):
                chosen = ghost_types.crossed[axis] == end
                if self.flow_kind(face) != "periodic" and chosen.any():
                    yield axis, face, chosen, at, 1.0 if end == UPPER else -1.0

    def _velocities(self, ghost_types: GhostTypes, surface: Surface | None) -> tuple[Array, Array]:
        """S and c.

        In a corner the rule for the tangential component comes before that for the normal one. The
        velocity of a moving wall ends there: carried on, it would pump fluid through the corner;
        reversed, as an impermeable face asks for, its jump would empty the corner of particles.
        Half of the leak remains, which shrinks with the spacing.
        """
        factor, added = np.ones((2, ghost_types.count)), np.zeros((2, ghost_types.count))
        crossings = list(self._crossings(ghost_types))
        for axis, face, chosen, _, _ in crossings:
            if self.flow_kind(face) in ("no-slip", "moving-wall"):
                factor[1 - axis, chosen] = -1.0
                added[1 - axis, chosen] = 2.0 * self.wall_velocity(face)
        for axis, face, chosen, _, _ in crossings:
            if _across(face, surface):  # no component is turned around across a tangent
                continue
            factor[axis, chosen] *= -1.0
            added[axis, chosen] = 0.0
            if surface is not None and self.flow_kind(face) in FREE:
                added[axis, chosen] = 2.0 * surface.normal_velocity
        return factor, added
