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
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries import Boundaries
from lasersph.boundaries.flow_conditions import FREE, WALLS, FlowConditions
from lasersph.boundaries.settings import DIRICHLET, NEUMANN
from lasersph.particles.faces import BOTTOM, LEFT, SURFACE, VERTICAL, face_pairs
from lasersph.particles.ghosts import (
    LOWER,
    MIRROR,
    OPEN,
    PERIODIC,
    UPPER,
    FacePair,
    GhostTypes,
)
from lasersph.surface.surface import Surface

Array = NDArray[np.float64]
ENDS = (LOWER, UPPER)


@dataclass(frozen=True)
class GhostRules:
    """Rules of what ghosts carry, by their type, host arrays.

    Attributes:
        sign: (d, w) diagonal of S, see `particles.ghosts`. factor, added: (d, w) diagonal of F, and
            v_0 [m/s]. stressed: (w,) 1 beyond a free surface, where 2 d tau / eta is added to the
            velocity of the source.
        dirichlet: (w,) 1 beyond a Dirichlet face. wall_temperature: (w,) [K], its mean where it
            varies along the face, as `varies` (w,) says. flux: (w,) into the body [W/m^2]. normal:
            (d, w) outward, plane: (w,) place of the face along it [m]. heat_face: (w,) number
            of the face whose heat condition holds, see `FaceConditions.number_of`. sticks: (d, w)
            1 where a face across an axis lies between along which no liquid slips. Else 0.
    """

    sign: Array
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
    sticks: Array

    @property
    def velocity(self) -> dict[str, Array]:
        """Tables of velocities as viscosity sees them, F (v_s + t j_s) + v_0."""
        return {"stressed": self.stressed, "factor": self.factor, "added": self.added}

    @property
    def mirrored_velocity(self) -> dict[str, Array]:
        """Tables of velocities as the divergence sees them, S (v_s + t j_s): nothing crosses."""
        return {"stressed": self.stressed, "factor": self.sign, "added": 0.0 * self.added}

    @property
    def velocity_change(self) -> dict[str, Array]:
        """Tables of a change of velocities, F d_s."""
        return {"factor": self.factor}

    @property
    def has_one_wall(self) -> NDArray[np.bool_]:
        """(w,) whether one wall along which no liquid slips lies between, and no edge of two;
        planes of symmetry may lie beside it."""
        return np.count_nonzero(self.sticks, axis=0) == 1


class Crossing(NamedTuple):
    """A face between ghosts and their sources: normal to an axis, its name, types (w,) of these
    ghosts, its place [m], and -1 at the lower or 1 at the upper end of the axis."""

    axis: int
    face: str
    types: NDArray[np.bool_]
    at: float
    outward: float


class FaceConditions:
    """Heat and flow at the faces of a box.

    Args:
        box: lower and upper end of each axis, z last [m]. flow: None for a pool in a block: its
            lateral faces mirror or repeat as the heat does, its surface is free, its bottom rests.
            has_axis: whether the left face is the axis of a section (r, z).

    Attributes:
        faces: names of the lower and the upper face of each axis. periods: width along each axis
            that repeats, else 0 [m]. interval: begin and end of the
            step, for what varies with time [s].
    """

    def __init__(
        self,
        box: tuple[tuple[float, float], ...],
        boundaries: Boundaries,
        flow: FlowConditions | None,
        initial_temperature: float,
        *,
        has_axis: bool = False,
    ) -> None:
        self.box, self.boundaries, self.flow, self.has_axis = box, boundaries, flow, has_axis
        self.faces = face_pairs(len(box))
        self.periods = tuple(
            high - low if self.flow_kind(lower) == "periodic" else 0.0
            for (lower, _), (low, high) in zip(self.faces, box, strict=True)
        )
        self.initial_temperature = initial_temperature
        self.interval = (0.0, 0.0)

    def flow_kind(self, face: str) -> str:
        """Kind of a face for the flow."""
        if face == LEFT and self.has_axis:
            return "symmetry"
        if self.flow is not None:
            return self.flow.faces[face].kind
        if face == SURFACE:
            return "free-surface"
        if face == BOTTOM:
            return "no-slip"
        return "periodic" if self.boundaries.kind_of(face) == "periodic" else "symmetry"

    @property
    def are_mirrors(self) -> bool:
        """Whether all faces are planes of symmetry."""
        return all(self.flow_kind(face) == "symmetry" for pair in self.faces for face in pair)

    def number_of(self, face: str) -> float:
        """Number of a face in loops, from 1 in the order of `faces`; 0 is none."""
        return 1.0 + [name for pair in self.faces for name in pair].index(face)

    def ghost_faces(self, surface: Surface, *, has_bottom: bool) -> tuple[FacePair, ...]:
        """Faces beyond which ghosts lie; without the bottom where particles go on below."""
        pairs = []
        for (lower, upper), (low, high) in zip(self.faces, self.box, strict=True):
            below = above = PERIODIC
            if self.flow_kind(lower) != "periodic":
                below = OPEN if lower == BOTTOM and not has_bottom else MIRROR
                above = surface.crossing if upper == SURFACE else MIRROR
            pairs.append(FacePair(below, above, low, high))
        return tuple(pairs)

    def wall_velocity(self, face: str) -> float:
        """Velocity of a moving wall along itself [m/s]."""
        return self.flow.faces[face].velocity if self.flow is not None else 0.0

    def away_from_walls(self, distance: float) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Lower and upper places on each axis [m] between which no wall along which nothing slips
        is nearer than a distance [m]; infinite where an axis ends otherwise."""
        ends = list(zip(self.faces, self.box, strict=True))
        low = tuple(z + distance if self._is_wall(name) else -np.inf for (name, _), (z, _) in ends)
        high = tuple(z - distance if self._is_wall(name) else np.inf for (_, name), (_, z) in ends)
        return low, high

    def _is_wall(self, face: str) -> bool:
        """Whether nothing slips along a face."""
        return self.flow_kind(face) in WALLS

    def largest_wall_speed(self) -> float:
        """Largest speed of a wall [m/s]."""
        return max(abs(self.wall_velocity(face)) for pair in self.faces for face in pair)

    def rules(self, ghost_types: GhostTypes) -> GhostRules:
        """Rules for ghosts of these types."""
        shape = ghost_types.sign.shape
        factor, added = self._velocities(ghost_types)
        numbers = ("stressed", "dirichlet", "wall_temperature", "flux", "plane", "heat_face")
        rules = GhostRules(
            sign=ghost_types.sign,
            factor=factor,
            added=added,
            varies=np.zeros(shape[1], bool),
            normal=np.zeros(shape),
            sticks=np.zeros(shape),
            **{name: np.zeros(shape[1]) for name in numbers},
        )
        for one in self._crossings(ghost_types):
            if self._is_wall(one.face):
                rules.sticks[one.axis, one.types] = 1.0
            if self.flow_kind(one.face) in FREE:
                rules.stressed[one.types] = 1.0
            self._set_heat(rules, one)
        return rules

    def force_shares(self, ghost_types: GhostTypes) -> dict[str, Array]:
        """Shares (d, d, w) that the lower and the upper face of each axis have of each component of
        a force between a particle and a ghost, by the type of that.

        A component across one of the faces between is that face's, one along all of them is shared
        evenly. Planes of symmetry have a share only where no other face lies between: beyond both
        lies the image of a pair of that face.
        """
        crossings = list(self._crossings(ghost_types))
        is_plane = [self.flow_kind(one.face) == "symmetry" for one in crossings]
        has_wall = np.zeros(ghost_types.sign.shape[1], bool)
        for one, mirrors in zip(crossings, is_plane, strict=True):
            has_wall |= one.types & (not mirrors)
        counted = [
            (one, one.types & ~(has_wall & mirrors))
            for one, mirrors in zip(crossings, is_plane, strict=True)
        ]
        # evenly, then each component across a face to that face alone
        number = np.maximum(np.sum([types for _, types in counted], axis=0), 1)
        axes, size = ghost_types.sign.shape
        lower, upper = np.zeros((axes, axes, size)), np.zeros((axes, axes, size))
        for one, types in counted:
            mine = lower if one.outward < 0.0 else upper
            mine[one.axis][:, types] = 1.0 / number[types]
        for one, types in counted:
            for shares in (lower, upper):
                shares[:, one.axis, types] = 0.0
            mine = lower if one.outward < 0.0 else upper
            mine[one.axis, one.axis, types] = 1.0
        return {"lower": lower, "upper": upper}

    def _set_heat(self, rules: GhostRules, crossing: Crossing) -> None:
        """Let the heat condition of a face hold for the types of ghosts beyond it.

        In an edge or a corner the first Dirichlet face holds, else the first Neumann face.
        """
        axis, face, types, at, outward = crossing
        kind = self.boundaries.kind_of(face)
        if kind in DIRICHLET:
            mine = types & (rules.dirichlet == 0.0)
            rules.dirichlet[mine] = 1.0
            rules.wall_temperature[mine] = self.boundaries.temperature_of(
                face, self.initial_temperature
            )
            drive = self.boundaries.temperature_drive
            rules.varies[mine] = face == SURFACE and drive is not None
        elif kind == NEUMANN:
            mine = types & (rules.heat_face == 0.0)
            rules.flux[mine] = self.boundaries.flux_of(face)
        else:
            return
        rules.normal[:, mine] = 0.0
        rules.normal[axis, mine] = outward
        rules.plane[mine] = outward * at
        rules.heat_face[mine] = self.number_of(face)

    def varying_temperature(self, places: Array) -> Array:
        """Temperature of a face that varies along it, at places (d - 1, n) along x, and y where
        there is one [m], in the `interval`, [K]."""
        T_0 = self.initial_temperature
        return self.boundaries.temperature_along(SURFACE, tuple(places), T_0, self.interval)

    def _crossings(self, ghost_types: GhostTypes) -> Iterator[Crossing]:
        """All faces but periodic ones that lie between ghosts and their sources."""
        for axis, names in enumerate(self.faces):
            for end, face, at in zip(ENDS, names, self.box[axis], strict=True):
                types = ghost_types.crossed[axis] == end
                if self.flow_kind(face) != "periodic" and types.any():
                    yield Crossing(axis, face, types, at, 1.0 if end == UPPER else -1.0)

    def _velocities(self, ghost_types: GhostTypes) -> tuple[Array, Array]:
        """Diagonal of F, and v_0.

        Walls turn all components around, other planes the normal one, tangents none; factors of
        several faces are multiplied. The velocity of a moving wall ends in edges and corners with
        faces that it meets and with other walls: carried on, it would pump fluid through the
        corner; reversed, as an impermeable face asks for, its jump would empty the corner of
        particles. Half of the leak remains, which shrinks with the spacing.
        """
        factor, added = ghost_types.sign.copy(), np.zeros(ghost_types.sign.shape)
        walls = [one for one in self._crossings(ghost_types) if self._is_wall(one.face)]
        has_one_wall = np.sum([one.types for one in walls], axis=0) == 1
        # components along walls, and what a wall that moves along x or up adds to them
        for one in walls:
            factor[np.ix_(np.arange(len(factor)) != one.axis, one.types)] *= -1.0
            along = 0 if one.face in VERTICAL else -1
            added[along, one.types & has_one_wall] = 2.0 * self.wall_velocity(one.face)
        # nothing moves across a plane
        added[ghost_types.sign < 0.0] = 0.0
        return factor, added
