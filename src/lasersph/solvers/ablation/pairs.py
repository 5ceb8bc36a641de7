"""`Pairs`: who is near whom, found anew once particles have moved far enough.

A list holds all pairs within the support and a skin. It is good while no two particles near each
other have moved further relative to each other than the skin; what leaves only parts from its
neighbors. That is so while twice the way of the fastest condensed particle is shorter, and mostly
for some steps more (`relative_motion`). The slower the particles, the thinner the skin. Where
nothing moves it is a millionth of a spacing: a pair that enters the support by less than that
weighs 1e-12 of its neighbors.
"""

from __future__ import annotations

from collections.abc import Callable
from math import floor, sqrt
from typing import Any, NamedTuple

from lasersph.compute import search
from lasersph.compute.vectors import dot, vector
from lasersph.particles.neighbors import NeighborList
from lasersph.particles.support import common
from lasersph.physics.ejection import CONDENSED
from lasersph.solvers.ablation.particle_state import ParticleState
from lasersph.solvers.ablation.relative_motion import RelativeMotion
from lasersph.sph.kernels import Kernel

LEAST_SKIN = 1e-6
"""In spacings."""
LIST_COST = 1.5
"""Time to find the pairs over that of a sum over them."""
WORTHWHILE = 0.5
"""Relative motion of near particles over twice the way of the fastest below which to look at it."""

Finder = Callable[[Any, Any], tuple[Any, Any]]
"""From places (dim, N) and supports (N,) to row_start and neighbor."""


class Stride(NamedTuple):
    """A step [s], and the largest speed [m/s] and acceleration [m/s^2] in it."""

    step: float
    speed: float
    acceleration: float

    @property
    def push(self) -> float:
        """Way beyond that at the present velocity [m]."""
        return self.step * self.step * self.acceleration

    @property
    def way(self) -> float:
        """Way of the fastest [m]."""
        return self.step * self.speed + self.push


REST = Stride(0.0, 0.0, 0.0)


def folded(x, low, width):
    """Coordinate [m] within the period of given width that begins at `low`; width 0: as it is."""
    return x - width * floor((x - low) / width) if width > 0.0 else x


def within(x, low, width):
    """Position [m] with each coordinate `folded`."""
    if len(x) == 1:
        return vector(folded(x[0], low[0], width[0]))
    if len(x) == 2:
        return vector(folded(x[0], low[0], width[0]), folded(x[1], low[1], width[1]))
    return vector(
        folded(x[0], low[0], width[0]),
        folded(x[1], low[1], width[1]),
        folded(x[2], low[2], width[2]),
    )


def placed(x, x_listed, opaque):
    """Place for the list: where the particle is; where it was once it has left."""
    return opaque * x + (1.0 - opaque) * x_listed


def displaced(x, x_listed, kind):
    """Square of the way since the pairs were found [m^2], of what is condensed."""
    way = x - x_listed
    return dot(way, way) if kind == CONDENSED else 0.0 * dot(way, way)


def reaching(support, margin):
    """Support with the skin [m]."""
    return support + margin


class Pairs:
    """Neighbor lists of the start and of the middle of a step.

    Attributes:
        skin: thickest skin [m].
        listed: (dim, N) places when the pairs were found [m]. margin: skin of the list [m], 0
            before the first. is_compared: whether near particles are compared with each other
            before it is given up. now, half: the list with the positions of either level.
    """

    def __init__(
        self, particles: ParticleState, kernel: Kernel, skin: float, finder: Finder | None = None
    ) -> None:
        backend = particles.backend
        self.particles, self.kernel = particles, kernel
        self.skin = skin * particles.geometry.spacing
        self.listed = backend.zeros(particles.now.x.shape)
        backend.copy(particles.now.x, self.listed)
        self.margin, self.is_compared = 0.0, False
        self._reach, self._room = backend.zeros(particles.total), search.Room()
        self._finder = finder or self._all
        self._support = float(backend.look(particles.support)[0])
        self._low = tuple(lower for lower, _upper in particles.geometry.bounds)
        self._relative = RelativeMotion(particles, self.listed, self._support + self.skin)

    def is_stale(self, stride: Stride, rows: Any = None) -> bool:
        """Whether particles may come nearer than listed in a step."""
        if self.margin == 0.0:
            return True
        fields = {"x": self.particles.now.x, "x_listed": self.listed, "kind": self.particles.kind}
        (square,) = self.particles.backend.pointwise(
            displaced, fields, (None,), rows=rows, reduce=("max",)
        )
        nearer = 2.0 * (sqrt(max(square, 0.0)) + stride.way)
        is_far = nearer > self._relative.clear - self._support
        if self.is_compared and self.margin < nearer and not is_far:
            nearer = self._relative_way(stride)
        return nearer > self.margin

    def renew(self, stride: Stride, rows: Any = None) -> None:
        """Find the pairs anew, with a skin for such steps.

        Raises:
            EscapedParticle: a place is not finite.
        """
        particles, backend = self.particles, self.particles.backend
        period = particles.geometry.period
        if any(period):
            fields = {"x": particles.now.x}
            backend.pointwise(
                within, fields, particles.now.x, rows=rows, low=self._low, width=period
            )
        fields = {"x": particles.now.x, "x_listed": self.listed, "opaque": particles.opaque}
        backend.pointwise(placed, fields, self.listed, rows=rows)
        self._relative.forget()
        self.margin = self._skin_for(stride, rows)
        self.find()

    def _relative_way(self, stride: Stride) -> float:
        """How far near particles will have moved relative to each other after a step [m]."""
        return self._relative.bound(stride.step) + 2.0 * stride.push

    def _skin_for(self, stride: Stride, rows: Any) -> float:
        """The skin [m] with which steps and lists cost least together.

        With a skin s a sum over the pairs takes (1 + s / l)^d times as long, and where particles
        come nearer by w in a step a list lasts s / w steps of two sums each;
        s^2 = LIST_COST w l / (2 d) makes the whole least. What sleeps beside `rows` is in no
        tile, so that then the fastest alone decides.
        """
        geometry, self.is_compared = self.particles.geometry, False
        least, nearer = LEAST_SKIN * geometry.spacing, 2.0 * stride.way
        if nearer < least:
            return least
        if rows is None:
            relative = self._relative_way(stride)
            self.is_compared = relative < WORTHWHILE * nearer
            nearer = relative if self.is_compared else nearer
        best = sqrt(0.5 * LIST_COST * nearer * self._support / geometry.dimension)
        return min(max(best, nearer, least), self.skin)

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers that survive a step beside the listed places."""
        return {"margin": self.margin, "compared": float(self.is_compared)}

    def resume(self, numbers: dict[str, float]) -> None:
        """Find the pairs of the listed places again, with the numbers of `checkpoint_scalars`."""
        self._relative.forget()
        self.margin, self.is_compared = numbers["margin"], numbers["compared"] > 0.0
        if self.margin > 0.0:
            self.find()

    def find(self) -> None:
        """Find the pairs of the listed places."""
        particles, backend = self.particles, self.particles.backend
        margin, self.margin = self.margin, 0.0  # there is no list should the search fail
        backend.pointwise(reaching, {"support": particles.support}, self._reach, margin=margin)
        row_start, neighbor = self._finder(self.listed, self._reach)
        self.now, self.half = (
            NeighborList(
                row_start, neighbor, level.x, particles.support, self.kernel, common,
                particles.geometry.period,
            )
            for level in (particles.now, particles.half)
        )  # fmt: skip
        self.margin = margin

    def _all(self, place: Any, reach: Any) -> tuple[Any, Any]:
        """Pairs of all particles."""
        return search.neighbor_list(
            self.particles.backend, place, reach, self.particles.total, mean=common,
            period=self.particles.geometry.period, room=self._room,
        )  # fmt: skip
