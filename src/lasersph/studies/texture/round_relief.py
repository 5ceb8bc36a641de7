"""Our relief of a round spot, from a run of a section (r, z), beside which a measured one is put.

It is h(r) about an axis: the place of the axis, level, tilts and lateral scale of a measurement are
found as for lines, an angle has no meaning. Once the axis of a height map is known, its mean over
the angle shows the spot with less noise, and what it scatters by on rings how round it is.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lasersph.output import OutputError, Run, open_run
from lasersph.output.height_map import HeightMap
from lasersph.studies.texture.measurement import refuse_coarse

Array = NDArray[np.float64]
EDGE = 0.05
"""Part of the largest |h| down to which a relief belongs to the spot [1]. Guard: the size by which
places are looked for and measurements are found too short."""


@dataclass(frozen=True, eq=False)
class RoundRelief:
    """Relief of a round spot; the members that a comparison reads are those of `Relief`.

    Attributes:
        name: of the folder. r: (n,) distances from the axis, rising [m]. height: (n,) [m].
    """

    name: str
    r: Array
    height: Array
    error: float = 0.0
    is_spot: bool = True
    is_round: bool = True
    tells_fluence: bool = False
    largest_factor: float = 1.0

    @property
    def x(self) -> Array:
        """Ends of the body along x [m]."""
        return np.array([-self.r[-1], self.r[-1]])

    @property
    def period(self) -> float:
        """Diameter of the relief [m], see `EDGE`; that of the body where it is flat."""
        size = np.abs(self.height - self.height[-1])
        high = np.flatnonzero(size > EDGE * float(np.max(size)))
        return 2.0 * float(self.r[high[-1] if high.size else -1])

    @property
    def is_flat(self) -> bool:
        """Whether there is nothing to align to."""
        return float(np.ptp(self.height)) == 0.0

    @property
    def family(self) -> int:
        """Number that reliefs which differ in their light alone have in common."""
        return id(self)

    def refuse(self, surface: HeightMap) -> None:
        """Refuse a measurement that cannot show the spot. Raises NoComparison."""
        refuse_coarse(surface, self.period, "the spot")

    def at(self, x: Array, y: Array, factor: float) -> Array:
        """Heights at places [m], any shape; beyond the body that of its edge. No factor is told."""
        return np.interp(np.hypot(x, y), self.r, self.height)

    def sampled(self, factor: float, step: float) -> Callable[[Array, Array], Array]:
        """Heights for many looks."""
        return lambda x, y: self.at(x, y, factor)


def round_relief(run: Run) -> RoundRelief:
    """The relief of a complete section (r, z) at its end.

    Raises:
        OutputError: it is not complete, or its surface stayed flat.
    """
    if not run.is_complete:
        raise OutputError(f"{run.path} is not complete")
    if not len(run.surface):
        raise OutputError(f"{run.path} holds no surface that moved")
    r, height = run.surface[-1]["position"]
    return RoundRelief(run.path.name, np.asarray(r, float), np.asarray(height, float))


@lru_cache(maxsize=256)
def read_round_relief(folder: Path) -> RoundRelief:
    """The relief of the run in a folder, the same one each time. Raises OutputError."""
    return round_relief(open_run(folder))


def mean_over_angle(x: Array, y: Array, heights: Array, step: float) -> Array:
    """Means on rings about the axis.

    Args:
        x, y: (n,) places [m]. heights: (m, n) [m]. step: width of the rings [m].

    Returns:
        (2 m + 1, rings): mean distance from the axis [m], then of each of `heights` the mean and
        the standard deviation [m]; rings without points are left out.
    """
    ring = np.floor(np.hypot(x, y) / step).astype(int)
    count = np.bincount(ring)
    seen = count > 0
    count = count[seen]

    def mean(values: Array) -> Array:
        return np.bincount(ring, weights=values)[seen] / count

    rows = [mean(np.hypot(x, y))]
    for values in heights:
        middle = mean(values)
        rows += [middle, np.sqrt(np.maximum(mean(values**2) - middle**2, 0.0))]
    return np.array(rows)
