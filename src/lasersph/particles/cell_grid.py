"""`CellGrid`: a box cut into equal cells, and the cell that each particle is in."""

from __future__ import annotations

from math import floor

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import dot


def cell_along(x, axis, low, inverse, count):
    """Number of the cell along an axis, that at the end for what is outside.

    Args:
        x: position [m]. axis: unit vector. low: of the box [m]. inverse: 1 / width [1/m].
    """
    return min(max(floor((dot(x, axis) - low) * inverse), 0.0), count - 1.0)


def cell_number(number, place, count):
    """Number of a cell after one more axis."""
    return int(number * count + place)


def partial_number(number, place, count):
    """`cell_number` as a real number, for the axes before the last."""
    return number * count + place


class CellGrid:
    """Equal cells of a box, at least as wide as asked for where the box is.

    Args:
        low: lower corner of the box [m]. extent: along each axis [m]. width: [m].

    Attributes:
        shape: cells along each axis; they are numbered with the last axis fastest. count: of all.
        width: along each axis [m].
    """

    def __init__(self, backend: Backend, low: np.ndarray, extent: np.ndarray, width: float) -> None:
        self.backend = backend
        self.shape = np.maximum(1, np.floor(extent / width)).astype(np.int64)
        self.count = int(np.prod(self.shape))
        self._low, self._inverse = low, self.shape / np.maximum(extent, width)
        self.width = 1.0 / self._inverse

    def find_cells(self, position: Array) -> Array:
        """Number of the cell of each position (dim, n) [m], (n,) of kind "index"."""
        backend, last, size = self.backend, len(self.shape) - 1, position.shape[1]
        place, number = backend.zeros(size), backend.zeros(size)
        cell = backend.zeros(size, "index")
        for axis, count in enumerate(self.shape):
            unit = tuple(float(k == axis) for k in range(last + 1))
            constants = {"axis": unit, "low": float(self._low[axis]), "count": float(count)}
            inverse = float(self._inverse[axis])
            backend.pointwise(cell_along, {"x": position}, place, inverse=inverse, **constants)
            join, out = (cell_number, cell) if axis == last else (partial_number, number)
            fields = {"number": number, "place": place}
            backend.pointwise(join, fields, out, count=float(count))
        return cell
