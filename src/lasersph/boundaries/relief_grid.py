"""Heights of a file over x and y, between which they are linear along both."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ReliefGrid:
    """Heights (nx, ny) over places x (nx,) and y (ny,) that rise [m]."""

    x: Array
    y: Array
    height: Array

    @classmethod
    def of(cls, rows: Array) -> ReliefGrid | None:
        """The grid of rows (n, 3) of x, y and height [m], x slowest; None where they are none."""
        x, y = np.unique(rows[:, 0]), np.unique(rows[:, 1])
        if min(x.size, y.size) < 2 or len(rows) != x.size * y.size:
            return None
        places = np.stack([grid.ravel() for grid in np.meshgrid(x, y, indexing="ij")], axis=1)
        if not np.array_equal(places, rows[:, :2]):
            return None
        return cls(x, y, rows[:, 2].reshape(x.size, y.size))

    def at(self, x: Array, y: Array) -> Array:
        """Height at x and y [m], any shape; beyond its ends that of the nearest place."""
        (i, s), (j, t) = (_cell(*one) for one in ((self.x, x), (self.y, y)))
        # bilinear: along y at both ends of the cell along x
        h = self.height
        low = (1.0 - t) * h[i, j] + t * h[i, j + 1]
        high = (1.0 - t) * h[i + 1, j] + t * h[i + 1, j + 1]
        return (1.0 - s) * low + s * high

    def steepest(self, width: float) -> float:
        """Largest slope, over a width [m] along x and y; single places have noise."""
        x, y = np.meshgrid(self.x, self.y, indexing="ij")
        half = 0.5 * width
        along_x = self.at(x + half, y) - self.at(x - half, y)
        along_y = self.at(x, y + half) - self.at(x, y - half)
        return float(np.hypot(along_x, along_y).max()) / width

    def covers(self, axis: int, low: float, high: float, beyond: float) -> bool:
        """Whether it has heights from `low` to `high` [m] along an axis, or ends so many widths of
        its columns before."""
        places = (self.x, self.y)[axis]
        margin = beyond * (places[-1] - places[0]) / (places.size - 1)
        return bool(places[0] - margin <= low and high <= places[-1] + margin)


def _cell(places: Array, at: Array) -> tuple[NDArray[np.int64], Array]:
    """Number of the place before each of others, and the share of the way to the next one."""
    inside = np.clip(at, places[0], places[-1])
    number = np.clip(np.searchsorted(places, inside, side="right") - 1, 0, places.size - 2)
    return number, (inside - places[number]) / (places[number + 1] - places[number])
