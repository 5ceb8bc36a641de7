"""`NearMelt`: which particles of a block may have a fluid one as a neighbor.

Pairs are found anew for them alone. A particle sees as far as the mean support of itself and of the
finest, which are all that flow. It is not near melt where it lies deeper than that below all of it,
nor where no cell around it holds a fluid particle.

Particles and their neighbors lie in cells, as wide as the search radius or wider, that touch each
other, corners included. A cell is marked where it or one that touches it holds a fluid particle;
along a period, which whole cells fill, the last cells touch the first. The finest particles, most
of all, have narrower cells of their own.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lasersph.compute import search
from lasersph.compute.array_types import Array, Constants, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.cell_grid import CellGrid, cell_number

MOVED = 1.2
"""Distance within which a particle looks for melt over that at which it sees some. Geometry: what
moves in a step."""
COLUMNS = 2.0
"""Columns beside the melt in which a surface that moves changes. Geometry: the slope of a column is
that between its neighbors, and its curvature that between theirs."""


def cells_of(
    x, fluid, least, most, low, inverse, shape, count, fine_low, fine_inverse, fine_shape,
    fine_count, repeats,
):  # fmt: skip
    """Cell of a particle among the wide and the fine ones; that of a fluid one in either, else the
    number behind the last; 1 where it has escaped; depth of a fluid one below z = 0 [m], far above
    it where it is none."""
    for k in range(len(x)):
        if not (x[k] >= least[k] and x[k] <= most[k]):
            return 0 * count, 0 * count, count + 1, fine_count + 1, 1.0, -1.0
    cell = cell_number(x, low, inverse, shape, repeats)
    fine = cell_number(x, fine_low, fine_inverse, fine_shape, repeats)
    if fluid > 0.0:
        return cell, fine, cell, fine, 0.0, -x[-1]
    return cell, fine, count + 1, fine_count + 1, 0.0, -1.0


def near_fluid(k, around, fluid_count):
    """1 where a cell or one that touches it holds a fluid particle."""
    if fluid_count[k] > 0:
        return 1.0
    for n in range(len(around)):
        if fluid_count[around[n]] > 0:
            return 1.0
    return 0.0


def within_reach(x, cell, fine_cell, reach, marks, fine_marks, finest, melt_depth):
    """1 where a particle may have a fluid neighbor: near one by the cells, those of the finest
    particles where it sees no further, and not deeper below the melt than it sees [m]."""
    near = fine_marks[fine_cell] if reach <= finest else marks[cell]
    return near if -x[-1] - melt_depth < MOVED * reach else 0.0 * near


class NearMelt:
    """Who may have fluid neighbors, among the first particles.

    Args:
        reach: (count,) host array, within which each sees those that move [m]. column: width of the
            columns of the finest [m]. bounds: lower and upper end along each axis, which particles
            may pass by what the finest see. repeats: whether each axis does.
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
        # round-off makes no particle a coarse one
        self._finest = float(reach.min()) * (1.0 + 1e-9)
        fine, (low, high) = self._finest + COLUMNS * column, np.array(bounds, float).T
        self._low, self._high = (tuple(map(float, end)) for end in (low - fine, high + fine))
        self._wide_cells, self._fine_cells = (
            _MeltCells(backend, low, high, radius, repeats) for radius in (float(reach.max()), fine)
        )

        # cells of the particles, and of those that flow
        self._reach = backend.asarray(reach)
        self._cell, self._fine_cell, self._fluid_cell, self._fine_fluid_cell = (
            backend.zeros(reach.size, "index") for _ in range(4)
        )
        fine_grid = self._fine_cells.grid.constants
        self._constants: Constants = {"least": self._low, "most": self._high}
        self._constants |= {"count": self._wide_cells.grid.count, **self._wide_cells.grid.constants}
        self._constants |= {"fine_count": self._fine_cells.grid.count}
        self._constants |= {f"fine_{name}": fine_grid[name] for name in ("low", "inverse", "shape")}

    def find(self, position: Array, fluid: Array) -> Array:
        """(count,) 1 for particles that may have a fluid neighbor, else 0.

        Args:
            position: (d, n) [m]. fluid: (n,) 1 where a particle flows or did so one step ago.

        Raises:
            EscapedParticle: a position is not finite or beyond the bounds.
        """
        # cells of all and of those that flow, and the deepest melt
        backend, x = self.backend, self.backend.head(position, self.count)
        cells = self._cell, self._fine_cell, self._fluid_cell, self._fine_fluid_cell
        fields = {"x": x, "fluid": backend.head(fluid, self.count)}
        reduce = (None,) * len(cells) + ("max", "max")
        escaped, depth = backend.pointwise(
            cells_of, fields, (*cells, None, None), reduce=reduce, **self._constants
        )
        if escaped > 0.0:
            search.refuse_escape(backend.to_host(x), self._low, self._high)

        # by marks of the cells, and by the depth
        found = backend.zeros(self.count)
        fields = {"x": x, "cell": self._cell, "fine_cell": self._fine_cell, "reach": self._reach}
        given: Constants = {"finest": self._finest, "melt_depth": depth}
        given |= {"marks": self._wide_cells.mark(self._fluid_cell)}
        given |= {"fine_marks": self._fine_cells.mark(self._fine_fluid_cell)}
        backend.pointwise(within_reach, fields, found, **given)
        return found


class _MeltCells:
    """Cells of a box between two corners [m], at least as wide as a radius [m], and their marks."""

    def __init__(
        self,
        backend: Backend,
        low: np.ndarray,
        high: np.ndarray,
        radius: float,
        repeats: Sequence[bool],
    ) -> None:
        # whole cells fill a period; elsewhere they reach a radius beyond the ends
        margin = np.where(repeats, 0.0, radius)
        self.backend = backend
        self.grid = CellGrid.over(low - margin, high - low + 2.0 * margin, radius, repeats)
        self._cells = {"k": backend.asarray(np.arange(self.grid.count), "index")}
        self._cells["around"] = backend.asarray(self.grid.around(), "index")
        self._marks = backend.zeros(self.grid.count)

    def mark(self, fluid_cell: Rows) -> Array:
        """(cells,) 1 for cells that hold a fluid particle or touch one that does.

        Args:
            fluid_cell: (count,) cell of each fluid particle, the number behind the last of others.
        """
        # no fluid particle is in the cell of the number `count`, which stands for those outside
        backend, count = self.backend, self.grid.count
        fluid_count = backend.count_by_key(fluid_cell, count + 2)
        backend.pointwise(near_fluid, self._cells, self._marks, fluid_count=fluid_count)
        return self._marks
