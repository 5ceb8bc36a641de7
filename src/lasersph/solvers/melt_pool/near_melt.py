"""`NearMelt`: which particles of a block may have a fluid one as a neighbor.

Pairs are found anew for them alone. A particle sees as far as the mean support of itself and of the
finest, which are all that flow. It is not near melt where it lies deeper than that below all of it,
nor where no cell around it holds a fluid particle.

Particles and their neighbors lie in cells, as wide as the search radius or wider, that touch each
other, corners included. A cell is marked where it or one that touches it holds a fluid particle;
along a period, which whole cells fill, the last cells touch the first.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lasersph.compute import search
from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.cell_grid import CellGrid, cell_number
from lasersph.compute.vectors import element

MOVED = 1.2
"""Distance within which a particle looks for melt over that at which it sees some. Geometry: what
moves in a step."""
COLUMNS = 2.0
"""Columns beside the melt in which a surface that moves changes. Geometry: the slope of a column is
that between its neighbors, and its curvature that between theirs."""


def depth_of_fluid(x, fluid):
    """Depth of a fluid particle below z = 0 [m]; far above it where it is none."""
    return -x[-1] if fluid > 0.0 else -1.0


def within_reach(x, near, near_fine, reach, finest, melt_depth):
    """1 where a particle may have a fluid neighbor: near one by the cells, those of the finest
    particles where it sees no further, and not deeper below the melt than it sees [m]."""
    by_cells = near_fine if reach <= finest else near
    return by_cells if -x[-1] - melt_depth < MOVED * reach else 0.0 * near


def cell_of(x, fluid, least, most, count, low, inverse, shape, repeats):
    """Cell of a particle; that of a fluid one, else the number behind `count`; 1 where it has
    escaped."""
    for k in range(len(x)):
        if not (x[k] >= least[k] and x[k] <= most[k]):
            return 0 * count, count + 1, 1.0
    cell = cell_number(x, low, inverse, shape, repeats)
    if fluid > 0.0:
        return cell, cell, 0.0
    return cell, count + 1, 0.0


def near_fluid(k, around, fluid_count):
    """1 where a cell or one that touches it holds a fluid particle."""
    if fluid_count[k] > 0:
        return 1.0
    for n in range(len(around)):
        if fluid_count[around[n]] > 0:
            return 1.0
    return 0.0


class NearMelt:
    """Who may have fluid neighbors, among the first particles.

    Args:
        reach: (count,) host array, within which each sees those that move [m]. column: width of the
            columns of the finest [m]. bounds, repeats: see `MeltCells`.
    """

    def __init__(
        self,
        backend: Backend,
        reach: np.ndarray,
        column: float,
        bounds: Sequence[tuple[float, float]],
        *,
        repeats: Sequence[bool],
    ) -> None:
        self.backend, self.count = backend, reach.size
        finest, widest = float(reach.min()), float(reach.max())
        self._is_graded = finest < widest
        # round-off makes no particle a coarse one
        self._finest = finest * (1.0 + 1e-9)
        fine = self._finest + COLUMNS * column
        self._cells, self._fine_cells = (
            MeltCells(backend, reach.size, bounds, radius, repeats=repeats)
            for radius in (widest, fine)
        )
        self._reach = backend.asarray(reach)

    def find(self, position: Array, fluid: Array) -> Array:
        """(count,) 1 for particles that may have a fluid neighbor, else 0.

        Args:
            position: (d, n) [m]. fluid: (n,) 1 where a particle flows or did so one step ago.

        Raises:
            EscapedParticle: a position is not finite or beyond the faces.
        """
        # by cells as wide as the coarsest see
        backend, near = self.backend, self._cells.find(position, fluid)
        if not self._is_graded:
            return near
        # by cells of the finest, most of all, and by the deepest melt
        fine, x = self._fine_cells.find(position, fluid), backend.head(position, self.count)
        fields = {"x": x, "fluid": backend.head(fluid, self.count)}
        (depth,) = backend.pointwise(depth_of_fluid, fields, (None,), reduce=("max",))
        fields |= {"near": near, "near_fine": fine, "reach": self._reach}
        backend.pointwise(within_reach, fields, near, finest=self._finest, melt_depth=depth)
        return near


class MeltCells:
    """Cells around the first `count` particles.

    Args:
        bounds: lower and upper end along each axis that particles may pass by `radius` [m].
            repeats: whether each axis does.
    """

    def __init__(
        self,
        backend: Backend,
        count: int,
        bounds: Sequence[tuple[float, float]],
        radius: float,
        *,
        repeats: Sequence[bool],
    ) -> None:
        self.backend, self.count = backend, count
        low, high = np.array(bounds, float).T
        self._low, self._high = (tuple(map(float, end)) for end in (low - radius, high + radius))

        # whole cells fill a period; elsewhere they reach a radius beyond the ends
        margin = np.where(repeats, 0.0, radius)
        self._grid = CellGrid.over(low - margin, high - low + 2.0 * margin, radius, repeats)
        cells = self._grid.count
        self._bounds = {"least": self._low, "most": self._high, "count": cells}
        self._cells = {"k": backend.asarray(np.arange(cells), "index")}
        self._cells["around"] = backend.asarray(self._grid.around(), "index")
        self._marks = backend.zeros(cells)
        self._cell, self._fluid_cell = (backend.zeros(count, "index") for _ in range(2))

    def find(self, position: Array, fluid: Array) -> Array:
        """(count,) 1 for particles within the radius of a fluid one, else 0.

        Args:
            position: (d, n) [m]. fluid: (n,) 1 where a particle flows or did so one step ago.

        Raises:
            EscapedParticle: a position is not finite or beyond the bounds.
        """
        backend, marks, cells = self.backend, self._marks, self._cells
        place = backend.head(position, self.count)
        fields = {"x": place, "fluid": backend.head(fluid, self.count)}
        out, reduce = (self._cell, self._fluid_cell, None), (None, None, "max")
        (escaped,) = backend.pointwise(
            cell_of, fields, out, reduce=reduce, **self._bounds, **self._grid.constants
        )
        if escaped > 0.0:
            search.refuse_escape(backend.to_host(place), self._low, self._high)
        # no fluid particle is in the cell of the number `count`, which stands for those outside
        fluid_count = backend.count_by_key(self._fluid_cell, marks.shape[0] + 2)
        backend.pointwise(near_fluid, cells, marks, fluid_count=fluid_count)
        found = backend.zeros(self.count)
        backend.pointwise(element, {"place": self._cell}, found, table=marks)
        return found
