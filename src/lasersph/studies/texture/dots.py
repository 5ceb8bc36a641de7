"""Cells of dots over fluence: what any place of a spot looks like, by its local fluence and phase.

    z(x, y) = Z(F(x, y), x mod Lx, y mod Ly)

Between fluences each place of the period follows a monotone cubic [Fritsch1980]; between places all
values are linear, as columns are narrow. Below the lowest cell they fall linearly to those of a
surface without light. Values that end steeply at the rim of a melt are not followed along it, as
they are for lines: the error by leaving out each cell tells what that costs, and the volume of a
dot on a slope of the fluence is not kept exactly.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lasersph.studies.texture.cells import UNITS, Cell
from lasersph.studies.texture.fluence_table import FluenceTable
from lasersph.studies.texture.table import CellTable

Array = NDArray[np.float64]
LEVELS = 256
"""Fluences at which cubics are tabulated, between which values are linear: ten for each of 24
cells, where a cubic bends by 1e-2 of a cell's change."""


@dataclass(frozen=True, eq=False)
class DotTable(FluenceTable):
    """Cells of one pattern that repeats along x and y.

    Attributes:
        x, y: (nx,), (ny,) places in the period, rising, from 0 [m].
        values: (cells, nx, ny) of each name of `cells.UNITS`.
    """

    y: Array

    @classmethod
    def of(
        cls, cells: list[tuple[float, Cell]], period: float, initial_temperature: float
    ) -> DotTable:
        """The table of cells of the same columns with their fluences [J/m^2], in any order.

        Raises:
            ValueError: cells of other columns.
        """
        ordered = sorted(cells, key=lambda one: one[0])
        fluence, (_, first) = np.array([one[0] for one in ordered]), ordered[0]
        assert first.y is not None
        shape = (first.x.size, first.y.size)
        if any(cell.values[name].shape != shape for _, cell in ordered for name in UNITS):
            raise ValueError("cells of dots must have the same columns: take one spacing for all")
        values = {name: np.array([cell.values[name] for _, cell in ordered]) for name in UNITS}
        return cls(fluence, first.x, period, values, initial_temperature, first.y)

    @property
    def period_y(self) -> float:
        """Along y [m]."""
        return float(self.y[1] - self.y[0]) * self.y.size

    @cached_property
    def _levels(self) -> dict[str, Array]:
        """Values (LEVELS, nx + 1, ny + 1) evenly in fluence from 0; the last column and row are the
        first."""
        levels = np.linspace(0.0, self.fluence[-1], LEVELS)
        return {
            name: np.pad(self.profiles(name, levels), ((0, 0), (0, 1), (0, 1)), mode="wrap")
            for name in self.values
        }

    def at(self, name: str, fluence: ArrayLike, x: ArrayLike, y: ArrayLike) -> Array:
        """Values at local fluences [J/m^2] and places [m] from a brightest dot, any shape.

        Raises:
            ValueError: a fluence above that of the highest cell.
        """
        from scipy.ndimage import map_coordinates

        wanted, *places = np.broadcast_arrays(*(np.asarray(one, float) for one in (fluence, x, y)))
        self.refuse_brighter(wanted)
        # trilinear in the tabulated levels, periodic along x and y
        level = np.minimum(wanted / self.fluence[-1], 1.0) * (LEVELS - 1)
        axes = [
            ((place - axis[0]) % period) / (axis[1] - axis[0])
            for place, axis, period in zip(
                places, (self.x, self.y), (self.period, self.period_y), strict=True
            )
        ]
        coordinates = np.reshape([level, *axes], (3, -1))
        found = map_coordinates(self._levels[name], coordinates, order=1, mode="nearest")
        return found.reshape(wanted.shape)

    def in_spot(
        self, name: str, fluence: Callable[[Array, Array], Array], x: ArrayLike, y: ArrayLike
    ) -> Array:
        """Values in a spot of a local fluence [J/m^2] at places x, y [m], any shape."""
        x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        return self.at(name, fluence(x, y), x, y)

    def repeating(self, name: str, x: Array, y: Array) -> Array:
        """Values of the darkest cell at places [m], any shape; it repeats along x and y."""
        return self.at(name, self.fluence[0], x, y)


AnyTable = CellTable | DotTable


def table_of(
    cells: list[tuple[float, Cell]], period: float, initial_temperature: float
) -> AnyTable:
    """The table of cells of lines or of dots with their fluences [J/m^2], in any order.

    Args:
        period: along x [m]. initial_temperature: of a surface without light [K].
    """
    kind = CellTable if cells[0][1].y is None else DotTable
    return kind.of(cells, period, initial_temperature)
