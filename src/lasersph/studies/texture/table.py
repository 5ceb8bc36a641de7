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
from lasersph.studies.texture.lines import LEVELS, LineHeights

Array = NDArray[np.float64]
BETWEEN_EDGES = ("height", "melt_depth")
"""Names of values that end steeply at the edges of a line's melt."""
FEWEST_CELLS = 3
"""Of which one can be left out and predicted from two others."""
ROUNDING = 1e-9
"""By which a fluence may exceed that of the highest cell."""


@dataclass(frozen=True, eq=False)
class CellTable:
    """Cells of one pattern.

    Attributes:
        fluence: (cells,) local fluence, mean over the period, rising [J/m^2].
        x: (columns,) places in the period, rising, from 0 [m]. period: [m].
        values: (cells, columns) of each name of `cells.UNITS`.
        initial_temperature: of a surface without light [K].
    """

    fluence: Array
    x: Array
    period: float
    values: dict[str, Array]
    initial_temperature: float

    def __post_init__(self) -> None:
        """Raises ValueError for fewer than three cells, or fluences that do not rise."""
        refuse_odd_fluences(self.fluence)

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

    def without(self, number: int) -> CellTable:
        """The table without one cell."""
        values = {name: np.delete(one, number, axis=0) for name, one in self.values.items()}
        fluence = np.delete(self.fluence, number)
        return CellTable(fluence, self.x, self.period, values, self.initial_temperature)

    def profiles(self, name: str, fluence: ArrayLike) -> Array:
        """Values (n, columns) over the period at fluences (n,) [J/m^2].

        Raises:
            ValueError: a fluence above that of the highest cell.
        """
        from scipy.interpolate import PchipInterpolator

        wanted = np.asarray(fluence, float)
        highest = float(self.fluence[-1])
        refuse_brighter(wanted, self.fluence)
        if name in BETWEEN_EDGES:
            return self.lines[name].at(wanted[:, None], self.x[None, :])
        # monotone cubic over fluence at each place; linear to the dark below the lowest cell
        low = float(self.fluence[0])
        found = PchipInterpolator(self.fluence, self.values[name], axis=0)(
            np.clip(wanted, low, highest)
        )
        dark = self.initial_temperature if name == "temperature" else 0.0
        share = np.minimum(wanted / low, 1.0)[:, None]
        return dark + share * (found - dark)

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

    def leave_one_out(self, name: str) -> Array:
        """Largest error over the period at each cell but the two at the ends (cells - 2,), where it
        is predicted from the others."""
        # each inner cell predicted from the others
        inner = range(1, self.fluence.size - 1)
        errors = [
            np.abs(
                self.without(k).profiles(name, self.fluence[k : k + 1])[0] - self.values[name][k]
            )
            for k in inner
        ]
        return np.array([one.max() for one in errors])


def refuse_odd_fluences(fluence: Array) -> None:
    """Refuse fewer than three cells, or fluences (cells,) that do not rise. Raises ValueError."""
    if fluence.size < FEWEST_CELLS or np.any(np.diff(fluence) <= 0.0) or fluence[0] <= 0.0:
        raise ValueError("a table needs three cells or more whose fluences rise from above 0")


def refuse_brighter(wanted: Array, fluence: Array) -> None:
    """Refuse fluences of any shape above that of the highest of some cells (cells,) [J/m^2].

    Raises ValueError.
    """
    highest = float(fluence[-1])
    if np.any(wanted > highest * (1.0 + ROUNDING)):
        raise ValueError(
            f"a fluence of {wanted.max():g} J/m^2 exceeds that of all cells, {highest:g} J/m^2"
        )
