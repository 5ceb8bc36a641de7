"""`NearMelt`: which particles of a block are within the support of a fluid one, or nearly so.

Particles and their neighbors lie in cells, as wide as the search radius, that touch each other,
corners included. A cell is marked where it or one that touches it holds a fluid particle; on a
period the columns near both ends share their marks.
"""

from __future__ import annotations

import numpy as np

from lasersph.compute import search
from lasersph.compute.array_types import Array, Constants
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import element
from lasersph.particles.cell_grid import CellGrid, cell_number

AT_ENDS = 5
"""Columns at either end of a period whose marks are shared. Geometry: two outside, two of ghosts,
one of their own."""


def cell_of(x, fluid, least, most, count, low, inverse, shape):
    """Cell of a particle; that of a fluid one, else the number of cells; 1 where it has escaped."""
    is_across = x[0] >= least[0] and x[0] <= most[0]
    if not (is_across and x[1] >= least[1] and x[1] <= most[1]):
        return 0 * count, count, 1.0
    cell = cell_number(x, low, inverse, shape)
    if fluid > 0.0:
        return cell, cell, 0.0
    return cell, count, 0.0


def near_fluid(k, fluid_count, columns, lines):
    """1 where a cell or one that touches it holds a fluid particle."""
    c = k // lines
    m = k % lines
    for i in range(max(c - 1, 0), min(c + 2, columns)):
        for j in range(max(m - 1, 0), min(m + 2, lines)):
            if fluid_count[i * lines + j] > 0:
                return 1.0
    return 0.0


def at_ends(k, marks, columns, lines, last):
    """1 where a cell of line k in the first columns, or from the last ones on, has a mark."""
    for i in range(AT_ENDS):
        if marks[i * lines + k] > 0.0:
            return 1.0
    for i in range(last, columns):
        if marks[i * lines + k] > 0.0:
            return 1.0
    return 0.0


def periodic_mark(k, mark, line_marks, lines, last):
    """Mark of a cell, which near the ends is that of its line."""
    c = k // lines
    if c < AT_ENDS or c >= last:
        return line_marks[k % lines]
    return mark


class NearMelt:
    """Cells around the first `count` particles.

    Args:
        bounds: ((x0, x1), (z0, z1)) that particles may pass by `radius` [m]. repeats: whether
            those along x do.
    """

    def __init__(
        self,
        backend: Backend,
        count: int,
        bounds: tuple[tuple[float, float], tuple[float, float]],
        radius: float,
        *,
        repeats: bool,
    ) -> None:
        self.backend, self.count, self.repeats = backend, count, repeats
        self._low, self._high = (
            tuple(pair[end] + outward * radius for pair in bounds)
            for end, outward in ((0, -1.0), (1, 1.0))
        )
        width = [int((high - low) / radius) + AT_ENDS for low, high in bounds]
        self._shape: Constants = {"columns": width[0], "lines": width[1]}
        corner = tuple(low - 2.0 * radius for low, _ in bounds)
        self._grid = CellGrid(corner, width, (1.0 / radius, 1.0 / radius))
        self._bounds = {"least": self._low, "most": self._high, "count": self._grid.count}
        (x0, x1), _ = bounds
        self._last = max(round((x1 - x0) / radius) - 1, 0)
        self._cells = {"k": backend.asarray(np.arange(self._grid.count), "index")}
        self._marks = backend.zeros(self._grid.count)
        self._line_marks = backend.zeros(width[1])
        self._cell, self._fluid_cell = (backend.zeros(count, "index") for _ in range(2))

    def find(self, position: Array, fluid: Array) -> Array:
        """(count,) 1 for particles within the radius of a fluid one, else 0.

        Args:
            position: (2, n) [m]. fluid: (n,) 1 where a particle flows or did so one step ago.

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
        fluid_count = backend.count_by_key(self._fluid_cell, marks.shape[0] + 1)
        backend.pointwise(near_fluid, cells, marks, fluid_count=fluid_count, **self._shape)
        if self.repeats:
            lines: Constants = {"lines": self._shape["lines"], "last": self._last}
            ends, columns = {"k": backend.head(cells["k"], lines["lines"])}, self._shape["columns"]
            backend.pointwise(
                at_ends, ends, self._line_marks, marks=marks, columns=columns, **lines
            )
            fields = cells | {"mark": marks}
            backend.pointwise(periodic_mark, fields, marks, line_marks=self._line_marks, **lines)
        found = backend.zeros(self.count)
        backend.pointwise(element, {"place": self._cell}, found, table=marks)
        return found
