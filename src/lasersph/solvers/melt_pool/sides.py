"""Sides of the domain as moving particles meet them: what images beyond each side carry.

For the flow an image has the velocity

    v_k = S v_s + c + 2 d tau / eta t

of its source s: S = -1 for components that vanish at the side (the normal one at any face, both at
a wall), c = 2 v_wall at a moving wall, and under a free surface the slope that the stress tau asks
for over the distance 2 d between source and image [Demuth2020, eq. (15)]. Pressure is mirrored,
dp/dn = 0. For heat an image carries its source's state where no heat crosses; beyond a held face
P_w is extrapolated as in `boundaries.held_faces`, beyond a heated one as in `heated_faces`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries import Boundaries
from lasersph.boundaries.flow_sides import FlowSides
from lasersph.boundaries.lid import FlatLid
from lasersph.boundaries.settings import FLUX, HELD
from lasersph.particles.images import LOWER, MIRROR, OPEN, PERIODIC, UPPER, FacePair, Images

Array = NDArray[np.float64]
FACES = (("left", "right"), ("bottom", "surface"))
"""Names of the lower and the upper side along x and z."""
ENDS = (LOWER, UPPER)


@dataclass(frozen=True)
class ImageRules:
    """What k images carry, host arrays.

    Attributes:
        factor, added: (2, k) S and c [m/s]. slope: (k,) how often 2 d tau / eta is added to the
            tangential velocity, -1, 0 or 1.
        held: (k,) 1 beyond a held face. wall_temperature: (k,) [K]. flux: (k,) into the body
            [W/m^2]. normal: (2, k) outward, plane: (k,) place of the face along it [m].
    """

    factor: Array
    added: Array
    slope: Array
    held: Array
    wall_temperature: Array
    flux: Array
    normal: Array
    plane: Array


class Sides:
    """The four sides of a 2-D domain.

    Args:
        box: ((x0, x1), (z0, z1)) [m]. flow: None for a pool in a block: its sides mirror or
            repeat as the heat does, its surface is free, its bottom rests.
    """

    def __init__(
        self,
        box: tuple[tuple[float, float], tuple[float, float]],
        boundaries: Boundaries,
        flow: FlowSides | None,
        initial_temperature: float,
    ) -> None:
        self.box, self.boundaries, self.flow = box, boundaries, flow
        self.initial_temperature = initial_temperature

    def flow_kind(self, side: str) -> str:
        """Kind of a side for the flow."""
        if self.flow is not None:
            return self.flow.sides[side].kind
        if side == "surface":
            return "free-surface"
        if side == "bottom":
            return "no-slip"
        return "periodic" if self.boundaries.kind_of(side) == "periodic" else "symmetry"

    def face_pairs(self, *, has_bottom: bool) -> tuple[FacePair, FacePair]:
        """Faces beyond which images lie; without the bottom where particles go on below."""
        pairs = []
        for (lower, _upper), (low, high) in zip(FACES, self.box, strict=True):
            is_periodic = self.flow_kind(lower) == "periodic"
            kind = PERIODIC if is_periodic else MIRROR
            below = OPEN if lower == "bottom" and not has_bottom else kind
            pairs.append(FacePair(below, kind, low, high))
        return pairs[0], pairs[1]

    def wall_velocity(self, side: str) -> float:
        """Velocity of a moving wall along itself [m/s]."""
        return self.flow.sides[side].velocity if self.flow is not None else 0.0

    def fastest_wall(self) -> float:
        """Largest speed of a wall [m/s]."""
        return max(abs(self.wall_velocity(side)) for pair in FACES for side in pair)

    def rules(self, images: Images, position: Array) -> ImageRules:
        """Rules for images of particles at `position`, shape (2, n) [m]."""
        count = images.count
        slope, held, temperature = np.zeros(count), np.zeros(count), np.zeros(count)
        flux, normal, plane = np.zeros(count), np.zeros((2, count)), np.zeros(count)
        place = images.sign * position[:, images.source] + images.offset
        for axis, side, chosen, at, outward in self._crossings(images):
            if self.flow_kind(side) == "free-surface":
                slope[chosen] = images.sign[1 - axis, chosen]
                flux[chosen] = FlatLid.heat_flux
            self._heat(side, axis, chosen & (held == 0.0), place, held, temperature, flux)
            mine = chosen & ((np.abs(normal).sum(axis=0) == 0.0) | self._carries_heat(side))
            normal[:, mine] = 0.0
            normal[axis, mine], plane[mine] = outward, outward * at
        factor, added = self._velocities(images)
        return ImageRules(factor, added, slope, held, temperature, flux, normal, plane)

    def _crossings(
        self, images: Images
    ) -> Iterator[tuple[int, str, NDArray[np.bool_], float, float]]:
        """Axis, side, images beyond it, its place [m] and -1 or 1, for all sides but periodic."""
        for axis, names in enumerate(FACES):
            for end, side, at in zip(ENDS, names, self.box[axis], strict=True):
                chosen = images.crossed[axis] == end
                if self.flow_kind(side) != "periodic" and chosen.any():
                    yield axis, side, chosen, at, 1.0 if end == UPPER else -1.0

    def _velocities(self, images: Images) -> tuple[Array, Array]:
        """S and c.

        In a corner the rule for the tangential component comes before that for the normal one. The
        velocity of a moving wall ends there: carried on, it would pump fluid through the corner;
        reversed, as an impermeable side asks for, its jump would empty the corner of particles.
        Half of the leak remains, which shrinks with the spacing.
        """
        factor, added = np.ones((2, images.count)), np.zeros((2, images.count))
        crossings = list(self._crossings(images))
        for axis, side, chosen, _, _ in crossings:
            if self.flow_kind(side) in ("no-slip", "moving-wall"):
                factor[1 - axis, chosen] = -1.0
                added[1 - axis, chosen] = 2.0 * self.wall_velocity(side)
        for axis, _, chosen, _, _ in crossings:
            factor[axis, chosen] *= -1.0
            added[axis, chosen] = 2.0 * self._normal_velocity(side)
        return factor, added

    def _normal_velocity(self, side: str) -> float:
        """Of a side itself [m/s]."""
        return FlatLid.normal_velocity if self.flow_kind(side) == "free-surface" else 0.0

    def _carries_heat(self, side: str) -> bool:
        kind = self.boundaries.kind_of(side)
        return kind in HELD or kind == FLUX

    def _heat(
        self,
        side: str,
        axis: int,
        chosen: NDArray[np.bool_],
        place: Array,
        held: Array,
        temperature: Array,
        flux: Array,
    ) -> None:
        """Temperature or flux of the chosen images beyond a side."""
        kind = self.boundaries.kind_of(side)
        if kind in HELD:
            along = place[1 - axis, chosen]
            held[chosen] = 1.0
            temperature[chosen] = self.boundaries.temperature_along(
                side, along, self.initial_temperature
            )
        elif kind == FLUX:
            flux[chosen] = self.boundaries.flux_of(side)
