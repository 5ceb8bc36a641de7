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
from lasersph.boundaries.settings import DIRICHLET, NEUMANN
from lasersph.particles.images import LOWER, MIRROR, OPEN, PERIODIC, UPPER, FacePair, Ways

Array = NDArray[np.float64]
FACES = (("left", "right"), ("bottom", "surface"))
"""Names of the lower and the upper side along x and z."""
ENDS = (LOWER, UPPER)
WAVY = "surface"
"""The side whose temperature may vary along it."""


@dataclass(frozen=True)
class ImageRules:
    """What images carry by the way they came about, host arrays.

    Attributes:
        factor, added: (2, w) S and c [m/s]. slope: (w,) how often 2 d tau / eta is added to the
            tangential velocity, -1, 0 or 1.
        held: (w,) 1 beyond a held face. wall_temperature: (w,) [K], its mean where it varies along
            the face, as `varies` (w,) says. flux: (w,) into the body [W/m^2]. normal: (2, w)
            outward, plane: (w,) place of the face along it [m].
    """

    factor: Array
    added: Array
    slope: Array
    held: Array
    wall_temperature: Array
    varies: NDArray[np.bool_]
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

    def rules(self, ways: Ways) -> ImageRules:
        """Rules for images that come about by these ways."""
        count = ways.count
        slope, held, temperature = np.zeros(count), np.zeros(count), np.zeros(count)
        flux, normal, plane = np.zeros(count), np.zeros((2, count)), np.zeros(count)
        varies = np.zeros(count, bool)
        for axis, side, chosen, at, outward in self._crossings(ways):
            if self.flow_kind(side) == "free-surface":
                slope[chosen] = ways.sign[1 - axis, chosen]
                flux[chosen] = FlatLid.heat_flux
            kind, free = self.boundaries.kind_of(side), chosen & (held == 0.0)
            if kind in DIRICHLET:
                held[free] = 1.0
                temperature[free] = self.boundaries.temperature_of(side, self.initial_temperature)
                varies[free] = side == WAVY and self.boundaries.surface_temperature_wave is not None
            elif kind == NEUMANN:
                flux[free] = self.boundaries.flux_of(side)
            mine = chosen & ((np.abs(normal).sum(axis=0) == 0.0) | self._carries_heat(side))
            normal[:, mine] = 0.0
            normal[axis, mine], plane[mine] = outward, outward * at
        factor, added = self._velocities(ways)
        return ImageRules(factor, added, slope, held, temperature, varies, flux, normal, plane)

    def varying_temperature(self, x: Array) -> Array:
        """Temperature of a face that varies along it, at places x [m], [K]."""
        return self.boundaries.temperature_along(WAVY, x, self.initial_temperature)

    def _crossings(self, ways: Ways) -> Iterator[tuple[int, str, NDArray[np.bool_], float, float]]:
        """Axis, side, ways beyond it, its place [m] and -1 or 1, for all sides but periodic."""
        for axis, names in enumerate(FACES):
            for end, side, at in zip(ENDS, names, self.box[axis], strict=True):
                chosen = ways.crossed[axis] == end
                if self.flow_kind(side) != "periodic" and chosen.any():
                    yield axis, side, chosen, at, 1.0 if end == UPPER else -1.0

    def _velocities(self, ways: Ways) -> tuple[Array, Array]:
        """S and c.

        In a corner the rule for the tangential component comes before that for the normal one. The
        velocity of a moving wall ends there: carried on, it would pump fluid through the corner;
        reversed, as an impermeable side asks for, its jump would empty the corner of particles.
        Half of the leak remains, which shrinks with the spacing.
        """
        factor, added = np.ones((2, ways.count)), np.zeros((2, ways.count))
        crossings = list(self._crossings(ways))
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
        return kind in DIRICHLET or kind == NEUMANN
