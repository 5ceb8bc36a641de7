"""`VerletList`: pairs of particles that move, found anew once near ones have moved far enough.

A list holds all pairs within the support and a skin. It is good while no two particles near each
other have moved further relative to each other than the skin; what leaves only parts from its
neighbors. That is so while twice the displacement of the fastest interior particle is smaller, and
mostly for some steps more (`relative_displacement`). The slower the particles, the thinner the
skin. Where nothing moves it is a millionth of a spacing: a pair that enters the support by less
than that weighs 1e-12 of its neighbors.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import floor, sqrt
from typing import Any, NamedTuple

from lasersph.compute import search
from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import dot, vector
from lasersph.particles.kinds import INTERIOR
from lasersph.particles.neighbor_lists import Box, NeighborList, Subset, search_pairs
from lasersph.particles.relative_displacement import RelativeDisplacement
from lasersph.particles.support import common

LEAST_SKIN = 1e-6
"""In spacings."""
LIST_COST = 1.5
"""Time to find the pairs over that of a sum over them."""
WORTHWHILE = 0.5
"""Relative displacement of near particles over twice the largest one below which to look at it."""


class LargestMotion(NamedTuple):
    """A step [s], and the largest speed [m/s] and acceleration [m/s^2] in it."""

    step: float
    speed: float
    acceleration: float

    @property
    def beyond(self) -> float:
        """Displacement beyond that at the present velocity [m]."""
        return self.step * self.step * self.acceleration

    @property
    def displacement(self) -> float:
        """Displacement of the fastest [m]."""
        return self.step * self.speed + self.beyond


REST = LargestMotion(0.0, 0.0, 0.0)


def fold(x, low, width):
    """Coordinate [m] within the period of given width that begins at `low`; width 0: as it is."""
    return x - width * floor((x - low) / width) if width > 0.0 else x


def fold_position(x, low, width):
    """Position [m] with each coordinate within its period."""
    return vector(*(fold(x[k], low[k], width[k]) for k in range(len(x))))


def position_to_list(x, x_listed, opaque):
    """Position for the list [m]: where the particle is; where it was once it has left."""
    return opaque * x + (1.0 - opaque) * x_listed


def displacement_square(x, x_listed, kind):
    """Square of the displacement since the pairs were found [m^2], of the interior."""
    d = x - x_listed
    return dot(d, d) if kind == INTERIOR else 0.0 * dot(d, d)


def search_radius(support, skin):
    """Support with the skin [m]."""
    return support + skin


class VerletList:
    """Neighbor lists of the start and of the middle of a step.

    Args:
        fields: by symbol: x, v, kind, opaque, x_listed, and supports l, all the same. half:
            (dim, N) positions in the middle of a step [m]. box: around all particles. spacing: [m].
            largest_skin: [m].

    Attributes:
        listed: (dim, N) positions when the pairs were found [m]. skin: of the list [m], 0 before
            the first. is_compared: whether near particles are compared with each other before it
            is given up. now, half: the list with the positions of either level. subset: who is
            searched; None for all.
    """

    now: NeighborList
    half: NeighborList

    def __init__(
        self,
        backend: Backend,
        fields: Mapping[str, Array],
        half: Array,
        kernel: Any,
        box: Box,
        spacing: float,
        largest_skin: float,
    ) -> None:
        self.backend, self.kernel, self.box = backend, kernel, box
        self.largest_skin, self._least_skin = largest_skin, LEAST_SKIN * spacing
        self.subset: Subset | None = None
        self.listed, self._fields = fields["x_listed"], dict(fields)
        backend.copy(fields["x"], self.listed)
        self._positions = fields["x"], half
        self.skin, self.is_compared = 0.0, False
        self._radius, self._room = backend.zeros(half.shape[1]), search.Room()
        self._support = float(backend.host_view(fields["l"])[0])
        self._relative = RelativeDisplacement(backend, fields, box, self._support + largest_skin)

    def is_stale(self, motion: LargestMotion, rows: Rows | None = None) -> bool:
        """Whether particles may come nearer than listed in a step."""
        if self.skin == 0.0:
            return True
        (square,) = self.backend.pointwise(
            displacement_square, self._fields, (None,), rows=rows, reduce=("max",)
        )
        # twice the fastest: two particles may run at each other
        approach = 2.0 * (sqrt(max(square, 0.0)) + motion.displacement)
        is_far = approach > self._relative.clear - self._support

        # near particles mostly move along: the closer bound, while no others can come into reach
        if self.is_compared and self.skin < approach and not is_far:
            approach = self._relative_displacement(motion)
        return approach > self.skin

    def rebuild(self, motion: LargestMotion, rows: Rows | None = None) -> None:
        """Find the pairs anew, with a skin for such steps.

        Raises:
            EscapedParticle: a position is not finite.
        """
        backend, (low, _, period), x = self.backend, self.box, self._fields["x"]
        if any(period):
            backend.pointwise(fold_position, {"x": x}, x, rows=rows, low=low, width=period)
        backend.pointwise(position_to_list, self._fields, self.listed, rows=rows)
        self._relative.reset()
        self._search(self._best_skin(motion, rows))

    def _relative_displacement(self, motion: LargestMotion) -> float:
        """How far near particles will have moved relative to each other after a step [m]."""
        return self._relative.bound(motion.step) + 2.0 * motion.beyond

    def _best_skin(self, motion: LargestMotion, rows: Rows | None) -> float:
        """The skin [m] with which steps and lists cost least together.

        With a skin s a sum over the pairs takes (1 + s / l)^d times as long, and where particles
        come nearer by w in a step a list lasts s / w steps of two sums each;
        s^2 = LIST_COST w l / (2 d) makes the whole least. What is inactive beside `rows` is in no
        cell, so that then the fastest alone decides.
        """
        # nothing moves: the thinnest skin there is
        self.is_compared, least = False, self._least_skin
        approach = 2.0 * motion.displacement
        if approach < least:
            return least

        # the closer bound, where it pays for the time that it takes
        if rows is None:
            relative = self._relative_displacement(motion)
            self.is_compared = relative < WORTHWHILE * approach
            approach = relative if self.is_compared else approach

        # s^2 = LIST_COST w l / (2 d), a step at least
        best = sqrt(0.5 * LIST_COST * approach * self._support / self.listed.shape[0])
        return min(max(best, approach, least), self.largest_skin)

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers that survive a step beside the listed positions."""
        return {"skin": self.skin, "is_compared": float(self.is_compared)}

    def restore(self, scalars: Mapping[str, float]) -> None:
        """Find the pairs of the listed positions again, with the `checkpoint_scalars`."""
        self._relative.reset()
        self.skin, self.is_compared = scalars["skin"], scalars["is_compared"] > 0.0
        if self.skin > 0.0:
            self._search(self.skin)

    def _search(self, skin: float) -> None:
        """Find the pairs of the listed positions within the support and a skin [m]."""
        backend, period = self.backend, self.box.period
        self.skin = 0.0  # there is no list should the search fail
        support = self._fields["l"]
        backend.pointwise(search_radius, {"support": support}, self._radius, skin=skin)
        row_start, neighbor = search_pairs(
            backend, self.listed, self._radius, period, self.subset, self._room
        )
        # one list, read with the positions of both levels
        self.now, self.half = (
            NeighborList(row_start, neighbor, x, support, self.kernel, common, period)
            for x in self._positions
        )
        self.skin = skin
