"""Cells of one pattern over fluence: what tables of lines and of dots have in common.

Between fluences each place of the period follows a monotone cubic [Fritsch1980], which does not
overshoot where melting begins. Below the lowest cell the values fall linearly to those of a surface
without light. The error of that is found by leaving out each cell but the two at the ends.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
FEWEST_CELLS = 3
"""Of which one can be left out and predicted from two others."""
ROUNDING = 1e-9
"""By which a fluence may exceed that of the highest cell."""


@dataclass(frozen=True, eq=False)
class FluenceTable:
    """Cells of one pattern.

    Attributes:
        fluence: (cells,) local fluence, mean over the period, rising [J/m^2].
        x: (nx,) places in the period, rising, from 0 [m]. period: along x [m].
        values: (cells, nx, ...) of each name of `cells.UNITS`.
        initial_temperature: of a surface without light [K].
    """

    fluence: Array
    x: Array
    period: float
    values: dict[str, Array]
    initial_temperature: float

    def __post_init__(self) -> None:
        """Raises ValueError for fewer than three cells, or fluences that do not rise."""
        F = self.fluence
        if F.size < FEWEST_CELLS or np.any(np.diff(F) <= 0.0) or F[0] <= 0.0:
            raise ValueError("a table needs three cells or more whose fluences rise from above 0")

    def without(self, number: int) -> Self:
        """The table without one cell."""
        values = {name: np.delete(one, number, axis=0) for name, one in self.values.items()}
        return replace(self, fluence=np.delete(self.fluence, number), values=values)

    def refuse_brighter(self, wanted: Array) -> None:
        """Raise ValueError for fluences [J/m^2] of any shape above that of the highest cell."""
        highest = float(self.fluence[-1])
        if np.any(wanted > highest * (1.0 + ROUNDING)):
            raise ValueError(
                f"a fluence of {wanted.max():g} J/m^2 exceeds that of all cells, {highest:g} J/m^2"
            )

    def profiles(self, name: str, fluence: ArrayLike) -> Array:
        """Values (n, nx, ...) over the period at fluences (n,) [J/m^2].

        Raises:
            ValueError: a fluence above that of the highest cell.
        """
        from scipy.interpolate import PchipInterpolator

        wanted = np.asarray(fluence, float)
        self.refuse_brighter(wanted)
        # monotone cubic over fluence at each place; linear to the dark below the lowest cell
        low, highest = float(self.fluence[0]), float(self.fluence[-1])
        cubic = PchipInterpolator(self.fluence, self.values[name], axis=0)
        found = cubic(np.clip(wanted, low, highest))
        dark = self.initial_temperature if name == "temperature" else 0.0
        share = np.expand_dims(np.minimum(wanted / low, 1.0), tuple(range(1, found.ndim)))
        return dark + share * (found - dark)

    def leave_one_out(self, name: str) -> Array:
        """Largest error over the period at each cell but the two at the ends (cells - 2,), where it
        is predicted from the others."""
        errors = [
            np.abs(
                self.without(k).profiles(name, self.fluence[k : k + 1])[0] - self.values[name][k]
            )
            for k in range(1, self.fluence.size - 1)
        ]
        return np.array([one.max() for one in errors])
