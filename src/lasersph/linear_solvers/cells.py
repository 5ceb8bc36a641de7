"""Cells of equal edges around a set of particles, which follow these, along d axes.

The smallest box of cells around the particles with mask 1, made anew from their positions, so that
nothing of it needs to survive a step. On a periodic axis whole cells fill the period.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, floor

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.cell_grid import CellGrid, cell_along, place_along
from lasersph.compute.vectors import vector
from lasersph.particles.neighbor_lists import members_of

EXCLUDED_COORDINATE = 1e30
"""Coordinate of what does not count [m]. Format: farther than any particle."""


@dataclass(frozen=True)
class Axis:
    """Cells along one axis, and the nodes between them.

    Attributes:
        cells: their number. spacing: their width [m]. wraps: whether the axis is periodic.
    """

    cells: int
    spacing: float
    wraps: bool

    @property
    def nodes(self) -> int:
        """Number of nodes."""
        return self.cells if self.wraps else self.cells + 1

    @property
    def step(self) -> int:
        """2 where the next coarser axis has every other node, 0 where one, 1 where the same."""
        if self.nodes <= 2:
            return 0 if self.nodes == 2 else 1
        return 1 if self.wraps and self.cells % 2 else 2

    def coarser(self) -> Axis:
        """The next coarser axis."""
        if self.step == 0:
            return Axis(0, self.spacing, False)
        if self.step == 1:
            return self
        return Axis(ceil(self.cells / 2), 2.0 * self.spacing, self.wraps)


def box(x, mask):
    """Coordinates of a particle with mask 1, for the smallest box around all of them: those for
    the lower corner, then those for the upper one."""
    low = x if mask > 0.0 else 0.0 * x + EXCLUDED_COORDINATE
    high = x if mask > 0.0 else 0.0 * x - EXCLUDED_COORDINATE
    if len(x) == 1:
        return low[0], high[0]
    if len(x) == 2:
        return low[0], low[1], high[0], high[1]
    return low[0], low[1], low[2], high[0], high[1], high[2]


def place_in_cell(x, mask, low, inverse, shape, repeats, count):
    """Place in its cell, from 0 to 1 along each axis, and number of the cell; their `count` where
    the mask is 0."""
    # u: in cells from the lower corner of the grid; c: index of the cell
    u = vector(
        *(place_along(x[k], low[k], inverse[k], shape[k], repeats[k]) for k in range(len(x)))
    )
    c = vector(*(cell_along(u[k], int(shape[k])) for k in range(len(x))))
    number = 0 * count
    for k in range(len(x)):
        number = number * int(shape[k]) + int(c[k])
    return u - c, (number if mask > 0.0 else count)


class Cells:
    """Cells for `count` particles.

    Args:
        width: wanted width of a cell [m]. period: per axis [m], 0.0 where there is none.

    Attributes:
        axes: of the cells. grid: the cells. place: (dim, n) place of each particle in its cell.
        number: (n,) kind "index", cell of each particle; `grid.count` where the mask is 0.
    """

    def __init__(self, backend: Backend, count: int, width: float, period: Sequence[float]) -> None:
        self.backend, self.width, self.period = backend, width, tuple(period)
        self.place = backend.zeros((len(self.period), count))
        self.number = backend.zeros(count, "index")
        self.axes = (Axis(1, width, False),) * len(self.period)
        self.grid = _grid((0.0,) * len(self.period), self.axes)

    def update(self, position: Array, mask: Array) -> None:
        """Make the cells around the particles with mask 1; position (dim, n) [m], mask (n,)."""
        # smallest box around the particles
        fields, d = {"x": position, "mask": mask}, len(self.period)
        reduce = ("min",) * d + ("max",) * d
        bounds = self.backend.pointwise(box, fields, (None,) * (2 * d), reduce=reduce)

        # cells along each axis that cover it
        ends = zip(self.period, bounds[:d], bounds[d:], strict=True)
        low, self.axes = zip(*(_axis(self.width, *end) for end in ends), strict=True)
        self.grid = _grid(low, self.axes)

        # where each particle lies in them
        grid = self.grid
        out = (self.place, self.number)
        self.backend.pointwise(place_in_cell, fields, out, **grid.constants, count=grid.count)


class FilledCells(Cells):
    """Cells that know which particles they hold.

    Attributes:
        members: particles of each cell, in the order of the cells.
    """

    def __init__(self, backend: Backend, count: int, width: float, period: Sequence[float]) -> None:
        super().__init__(backend, count, width, period)
        self.members = members_of(backend, self.number, self.grid.count)

    def update(self, position: Array, mask: Array) -> None:
        """Make the cells around the particles with mask 1, and sort these by their cells."""
        super().update(position, mask)
        count = self.grid.count
        kept = self.members if self.members.row_start.shape[0] == count + 1 else None
        self.members = members_of(self.backend, self.number, count, into=kept)


def _grid(low: Sequence[float], axes: Sequence[Axis]) -> CellGrid:
    """Cells of these axes from their lower ends on [m]."""
    shape, inverse = [axis.cells for axis in axes], [1.0 / axis.spacing for axis in axes]
    return CellGrid(low, shape, inverse, [axis.wraps for axis in axes])


def _axis(width: float, period: float, low: float, high: float) -> tuple[float, Axis]:
    """Lower end [m] and cells of an axis; those of a period can be joined by twos down to eight."""
    if period:
        cells = max(period / width, 2.0)
        pairs = 2 ** max(int(np.log2(cells)) - 2, 0)
        cells = round(cells / pairs) * pairs
        return 0.0, Axis(cells, period / cells, True)
    if high < low:
        return 0.0, Axis(1, width, False)
    first = floor(low / width)
    return first * width, Axis(floor(high / width) - first + 1, width, False)
