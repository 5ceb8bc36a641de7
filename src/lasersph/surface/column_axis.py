"""`ColumnAxis`: columns along one axis of a grid, and what a pool sees beyond its ends."""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from lasersph.surface.smoothing import ORDER

Array = NDArray[np.float64]
Numbers = NDArray[np.int64]
RING = 2
"""Columns around a pool to which its field goes on. Geometry: derivatives of fourth order reach two
columns far, and so do blocks of differences of the fourth order around a column."""


class ColumnAxis:
    """Columns along one axis, and what is seen beyond its ends.

    Attributes:
        low: first place that is known; places count from it. column: column that is seen at each
            place, -1 for none; beyond walls they go on by `RING`. is_mirrored: whether it is an
            image. is_inside: whether the place itself lies in the domain.
    """

    def __init__(self, count: int, ends: tuple[str, str]) -> None:
        margin = RING + ORDER
        self.low, self.period = -margin, count if ends[0] == "periodic" else 0
        place = np.arange(-margin, count + margin)
        self.is_inside = (place >= 0) & (place < count)
        self.column, self.is_mirrored = place.copy(), np.zeros(place.size, bool)
        for is_beyond, end, image in (
            (place < 0, ends[0], -1 - place),
            (place >= count, ends[1], 2 * count - 1 - place),
        ):
            if end == "periodic":
                self.column[is_beyond] %= count
            elif end == "mirror":
                self.column[is_beyond] = image[is_beyond]
                self.is_mirrored |= is_beyond
            else:
                # the ring around a pool that ends at a wall lies beyond it
                depth = np.where(place < 0, -place, place - count + 1)
                self.column[is_beyond & (depth > RING)] = -RING - 1
                self.is_inside |= is_beyond & (depth <= RING)

    def seen(self, place: Numbers) -> Numbers:
        """Column at places, less than -RING for none."""
        return self.column[place - self.low]

    def mirrored(self, place: Numbers) -> NDArray[np.bool_]:
        """Whether places are seen as images."""
        return self.is_mirrored[place - self.low]

    def sign(self, place: Numbers, parity: float) -> Array:
        """Sign with which a field of a parity is seen at places."""
        return np.where(self.mirrored(place), parity, 1.0)

    def blocks(self, columns: Numbers, order: int) -> tuple[Numbers, Array]:
        """Places (blocks, order + 1) of the differences of an order around columns, and the share
        (blocks,) with which each counts: planes of symmetry leave half of those across them."""
        first, last = int(columns.min()) - RING - order, int(columns.max()) + RING
        low, high = self.low, self.low + self.column.size - 1
        begin = np.arange(max(first, low), min(last, high - order) + 1)
        if self.period:
            begin = np.arange(self.period)
        place = begin[:, None] + np.arange(order + 1)
        inside = self.is_inside[place - self.low] if not self.period else np.ones(place.shape, bool)
        place, inside = place[inside.any(axis=1)], inside[inside.any(axis=1)]
        return place, np.where(inside.all(axis=1), 1.0, sqrt(0.5))
