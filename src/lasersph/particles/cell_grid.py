"""`CellGrid`: a box cut into equal parts, and the part that each particle is in."""

from __future__ import annotations

from math import floor
from typing import Any

import numpy as np

from lasersph.compute.backend import Backend
from lasersph.compute.vectors import dot


def along(x, axis, low, inverse, count):
    """Number of the tile along an axis, that at the end for what is outside.

    Args:
        x: position [m]. axis: unit vector. low: of the box [m]. inverse: 1 / width [1/m].
    """
    return min(max(floor((dot(x, axis) - low) * inverse), 0.0), count - 1.0)


def tile_number(tile, place, count):
    """Number of a tile after one more axis."""
    return int(tile * count + place)


def as_number(tile, place, count):
    """`tile_number` as a real number, for the axes before the last."""
    return tile * count + place


class CellGrid:
    """Equal tiles of a box, at least as wide as asked for where the box is.

    Args:
        low: lower corner of the box [m]. extent: along each axis [m]. width: [m].

    Attributes:
        shape: tiles along each axis; they are numbered with the last axis fastest. count: of all.
        width: along each axis [m].
    """

    def __init__(self, backend: Backend, low: np.ndarray, extent: np.ndarray, width: float) -> None:
        self.backend = backend
        self.shape = np.maximum(1, np.floor(extent / width)).astype(np.int64)
        self.count = int(np.prod(self.shape))
        self._low, self._inverse = low, self.shape / np.maximum(extent, width)
        self.width = 1.0 / self._inverse

    def find(self, position: Any, tile: Any) -> None:
        """Number of the tile of each position (dim, n) [m], into `tile` (n,) of kind "index"."""
        backend, last = self.backend, len(self.shape) - 1
        place, number = backend.zeros(tile.shape[0]), backend.zeros(tile.shape[0])
        for axis, count in enumerate(self.shape):
            unit = tuple(float(k == axis) for k in range(last + 1))
            backend.pointwise(
                along, {"x": position}, place, axis=unit, low=float(self._low[axis]),
                inverse=float(self._inverse[axis]), count=float(count),
            )  # fmt: skip
            join, out = (tile_number, tile) if axis == last else (as_number, number)
            backend.pointwise(join, {"tile": number, "place": place}, out, count=float(count))
