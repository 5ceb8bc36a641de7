"""`CellGrid`: a box cut into equal cells along d axes, and the cell that each position is in.

The cell with the index (c_0, ..., c_d-1) has the number

    (c_0 N_1 + c_1) N_2 + c_2

for N_k cells along axis k: the last axis runs fastest. Along an axis that repeats the last cell
touches the first. The number behind the last one, `count`, stands for every place outside.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from itertools import product
from math import floor, prod

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.array_types import Array, Constants
from lasersph.compute.backend import Backend

Numbers = Sequence[float] | np.ndarray


def place_along(x, low, inverse, count, repeats):
    """Place along an axis in cells from the lower end, within the `count` cells where it repeats.

    Args:
        x: coordinate [m]. low: of the box [m]. inverse: 1 / width of a cell [1/m].
    """
    u = (x - low) * inverse
    # a place in a period, counted from its lower end
    return u - count * floor(u / count) if repeats > 0 else u


def cell_along(u, count):
    """Number of the cell at a place along an axis, that at the end for what is outside."""
    return min(max(int(u), 0), count - 1)


def cell_number(x, low, inverse, shape, repeats):
    """Number of the cell at x [m], with the last axis fastest."""
    number = 0 * int(shape[0])
    for k in range(len(x)):
        u = place_along(x[k], low[k], inverse[k], shape[k], repeats[k])
        number = number * int(shape[k]) + cell_along(u, int(shape[k]))
    return number


class CellGrid:
    """Equal cells of a box.

    Args:
        low: lower corner [m]. shape: cells along each axis. inverse: 1 / width of a cell [1/m].
            repeats: whether each axis does; None where none does.

    Attributes:
        width: of a cell along each axis [m]. count: of all cells.
        constants: of the loops that use `cell_number`.
    """

    def __init__(
        self,
        low: Numbers,
        shape: Numbers,
        inverse: Numbers,
        repeats: Sequence[bool] | None = None,
    ) -> None:
        self.shape = tuple(map(int, shape))
        self.repeats = tuple(map(bool, repeats or (False,) * len(self.shape)))
        self.low, self.inverse = tuple(map(float, low)), tuple(map(float, inverse))
        self.count, self.width = prod(self.shape), tuple(1.0 / k for k in self.inverse)
        self.constants: Constants = {"low": self.low, "inverse": self.inverse}
        self.constants |= {"shape": self.shape, "repeats": self.repeats}

    @classmethod
    def over(
        cls,
        low: np.ndarray,
        extent: np.ndarray,
        width: float,
        repeats: Sequence[bool] | None = None,
    ) -> CellGrid:
        """Cells that fill a box, at least as wide as asked for [m] where the box is.

        Args:
            low: lower corner of the box [m]. extent: along each axis [m].
        """
        # at least as wide as asked for, so rounded down
        shape = np.maximum(1, np.floor(extent / width))
        return cls(low, shape, shape / np.maximum(extent, width), repeats)

    @classmethod
    def of_width(cls, low: np.ndarray, high: np.ndarray, width: float, most: int) -> CellGrid:
        """Cells of one width [m] that cover a box, wider ones where there were more than `most`."""
        extent = [float(length) for length in high - low]
        while True:
            shape = [floor(length / width) + 1 for length in extent]
            if prod(shape) <= most:
                return cls(low, shape, (1.0 / width,) * len(shape))
            width *= 1.25

    def find_cells(self, backend: Backend, position: Array) -> Array:
        """Number of the cell of each position (dim, n) [m], (n,) of kind "index"."""
        cell = backend.zeros(position.shape[1], "index")
        backend.pointwise(cell_number, {"x": position}, cell, **self.constants)
        return cell

    @property
    def index(self) -> NDArray[np.int64]:
        """Index of each cell, (dim, count)."""
        return np.indices(self.shape).reshape(len(self.shape), -1)

    def numbers(self, index: NDArray[np.int64]) -> NDArray[np.int64]:
        """Numbers of cells from their indices, (...,) from (dim, ...); `count` for any outside."""
        number, is_outside = 0, False
        for along, cells, repeats in zip(index, self.shape, self.repeats, strict=True):
            # a place in a period, or outside
            if repeats:
                along = along % cells
            else:
                is_outside = is_outside | (along < 0) | (along >= cells)
            number = number * cells + along
        return np.where(is_outside, self.count, number)

    def around(self) -> NDArray[np.int64]:
        """Numbers of the cells that touch each one by a side, an edge or a corner, in the order of
        `steps_around`, (3^dim - 1, count)."""
        return self.numbers(self.index[:, None, :] + steps_around(len(self.shape))[:, :, None])

    def grown(self, cells: NDArray[np.bool_], distance: int) -> NDArray[np.bool_]:
        """The marked cells and all within `distance` of them, shaped as the grid."""
        grown = cells.copy()
        # along one axis after the other: a square or cube around each
        for axis in range(cells.ndim):
            before = grown.copy()
            for shift in range(1, min(distance, cells.shape[axis] - 1) + 1):
                if self.repeats[axis]:
                    grown |= np.roll(before, shift, axis) | np.roll(before, -shift, axis)
                    continue
                low, high = [slice(None)] * cells.ndim, [slice(None)] * cells.ndim
                low[axis], high[axis] = slice(None, -shift), slice(shift, None)
                grown[tuple(high)] |= before[tuple(low)]
                grown[tuple(low)] |= before[tuple(high)]
        return grown


@cache
def steps_around(dimension: int) -> NDArray[np.int64]:
    """Steps -1, 0 or 1 along each axis from a cell to those that touch it, (dim, 3^dim - 1)."""
    steps = [step for step in product((-1, 0, 1), repeat=dimension) if any(step)]
    return np.array(steps, np.int64).T
