"""Cells over fluence: what any place of a spot looks like, by its local fluence and its phase.

Between fluences each place of the period follows a monotone cubic [Fritsch1980], which does not
overshoot where melting begins; between places of the period it is linear, as columns are narrow.
Heights and depths of the melt are interpolated over places of the melt instead, see `lines`. Below
the lowest cell the values fall linearly to those of a surface without light.

The error of the interpolation is found by leaving out each cell but the two at the ends, and
predicting it from the others, which lie twice as far apart there: it is an upper estimate.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lasersph.studies.texture.cells import UNITS, Cell
from lasersph.studies.texture.fluence_table import FluenceTable
from lasersph.studies.texture.lines import LEVELS, LineHeights

Array = NDArray[np.float64]
BETWEEN_EDGES = ("height", "melt_depth")
"""Names of values that end steeply at the edges of a line's melt."""


@dataclass(frozen=True, eq=False)
class CellTable(FluenceTable):
    """Cells of one pattern of lines; `values` are (cells, columns)."""

    @classmethod
    def of(
        cls, cells: list[tuple[float, Cell]], period: float, initial_temperature: float
    ) -> CellTable:
        """The table of cells with their fluences [J/m^2], in any order."""
        ordered = sorted(cells, key=lambda one: one[0])
        fluence, x = np.array([one[0] for one in ordered]), ordered[0][1].x
        # all cells at the places of the lowest one
        values = {
            name: np.array([np.interp(x, c.x, c.values[name], period=period) for _, c in ordered])
            for name in UNITS
        }
        return cls(fluence, x, period, values, initial_temperature)

    def profiles(self, name: str, fluence: ArrayLike) -> Array:
        """Values (n, columns) over the period at fluences (n,) [J/m^2].

        Raises:
            ValueError: a fluence above that of the highest cell.
        """
        if name not in BETWEEN_EDGES:
            return super().profiles(name, fluence)
        wanted = np.asarray(fluence, float)
        self.refuse_brighter(wanted)
        return self.lines[name].at(wanted[:, None], self.x[None, :])

    @cached_property
    def lines(self) -> dict[str, LineHeights]:
        """Values that are interpolated over places of the melt, by name."""
        return {
            name: LineHeights.of(self.fluence, self.x, self.period, self.values[name])
            for name in BETWEEN_EDGES
            if name in self.values
        }

    @cached_property
    def _levels(self) -> tuple[Array, dict[str, Array]]:
        """Fluences (LEVELS,) and values (LEVELS, columns + 1), whose last column is the first."""
        fluence = np.linspace(0.0, self.fluence[-1], LEVELS)
        names = [name for name in self.values if name not in BETWEEN_EDGES]
        values = {name: self.profiles(name, fluence) for name in names}
        return fluence, {n: np.column_stack([v, v[:, 0]]) for n, v in values.items()}

    def at(self, name: str, fluence: ArrayLike, x: ArrayLike) -> Array:
        """Values at local fluences [J/m^2] and places [m] from a brightest line, any shape.

        Raises:
            ValueError: see `profiles`.
        """
        from scipy.ndimage import map_coordinates

        wanted, places = np.broadcast_arrays(np.asarray(fluence, float), np.asarray(x, float))
        self.profiles(name, wanted.max(keepdims=True).ravel())  # refuses what no cell covers
        if name in BETWEEN_EDGES:
            return self.lines[name].at(wanted, places)
        # bilinear in the tabulated levels, periodic along x
        levels, values = self._levels
        row = np.minimum(wanted / levels[-1], 1.0) * (LEVELS - 1)
        step = self.period / self.x.size
        column = ((places - self.x[0]) % self.period) / step
        return map_coordinates(values[name], [row, column], order=1, mode="nearest")

    def in_spot(
        self, name: str, fluence: Callable[[Array, Array], Array], x: ArrayLike, y: ArrayLike
    ) -> Array:
        """Values in a spot of a local fluence [J/m^2] at places x, y [m], any shape."""
        if name in BETWEEN_EDGES:
            return self.lines[name].across(fluence, x, y)
        return self.at(name, fluence(np.asarray(x, float), np.asarray(y, float)), x)

    def repeating(self, name: str, x: Array, y: Array) -> Array:
        """Values of the darkest cell at places [m], any shape; lines are the same at any y."""
        return np.interp(x, self.x, self.values[name][0], period=self.period) + 0.0 * y
