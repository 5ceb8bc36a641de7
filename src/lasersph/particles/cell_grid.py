"""`CellGrid`: a box cut into equal cells, and the cell that each particle is in."""

from __future__ import annotations

from collections.abc import Sequence
from math import floor

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend


def place_along(x, low, inverse, count, wraps):
    """Place along an axis in cells from the lower end, within the `count` cells where that wraps.

    Args:
        x: coordinate [m]. low: of the box [m]. inverse: 1 / width of a cell [1/m].
    """
    u = (x - low) * inverse
    # a place in a period, counted from its lower end
    return u - count * floor(u / count) if wraps > 0 else u


def cell_along(u, count):
    """Number of the cell at a place along an axis, that at the end for what is outside."""
    return min(max(int(u), 0), count - 1)


def cell_number(x, low, inverse, shape):
    """Number of the cell at x [m], with the last axis fastest."""
    number = cell_along((x[0] - low[0]) * inverse[0], int(shape[0]))
    # the last axis runs fastest
    if len(x) > 1:
        number = number * int(shape[1])
        number = number + cell_along((x[1] - low[1]) * inverse[1], int(shape[1]))
    if len(x) > 2:
        number = number * int(shape[2])
        number = number + cell_along((x[2] - low[2]) * inverse[2], int(shape[2]))
    return number


Numbers = Sequence[float] | np.ndarray


class CellGrid:
    """Equal cells of a box.

    Args:
        low: lower corner [m]. shape: cells along each axis. inverse: 1 / width of a cell [1/m].

    Attributes:
        width: of a cell along each axis [m].
        count: of all cells, which are numbered with the last axis fastest.
        constants: of the loops that use `cell_number`.
    """

    def __init__(self, low: Numbers, shape: Numbers, inverse: Numbers) -> None:
        self.shape = tuple(map(int, shape))
        self.count, self.width = int(np.prod(self.shape)), tuple(1.0 / float(k) for k in inverse)
        self.constants = {"low": tuple(map(float, low)), "shape": self.shape}
        self.constants["inverse"] = tuple(map(float, inverse))

    @classmethod
    def over(cls, low: np.ndarray, extent: np.ndarray, width: float) -> CellGrid:
        """Cells that fill a box, at least as wide as asked for [m] where the box is.

        Args:
            low: lower corner of the box [m]. extent: along each axis [m].
        """
        # at least as wide as asked for, so rounded down
        shape = np.maximum(1, np.floor(extent / width))
        return cls(low, shape, shape / np.maximum(extent, width))

    def find_cells(self, backend: Backend, position: Array) -> Array:
        """Number of the cell of each position (dim, n) [m], (n,) of kind "index"."""
        cell = backend.zeros(position.shape[1], "index")
        backend.pointwise(cell_number, {"x": position}, cell, **self.constants)
        return cell
