"""`RidingSurface`: a surface that moves in a section (r, z), and the particles that ride with it.

Particles of a section keep their distance from the axis. So each stays in its column, and where the
column grows, what flows in it is stretched:

    z' = b + (H'/H) (z - b),    V' = (H'/H) V

with H the height of the melt in the column, b = top - H the place below it, and H' what reaches
from there to the line. Melt passes between them by what this motion leaves (`transport`). Particles
follow the line at the middle of each step; by what a column moves after that, before it freezes,
line and particles differ: some 1e-12 m. All that evaporates leaves the line in the first half of
the step. Melt does not run over the solid beside it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.array_types import Array, Constants
from lasersph.compute.vectors import vector
from lasersph.surface import loops
from lasersph.surface.moving_surface import MovingSurface
from lasersph.surface.surface import SurfaceStep

LEAST_HEIGHT, LARGEST_HEIGHT = 0.4, 2.0
"""Height of a row over the spacing within which a pool is computed. Geometry: the kernel reaches
3.75 spacings, and a row twice as high leaves four in it."""


class Ride(NamedTuple):
    """How particles have moved with their columns in a step.

    velocity: (d, n) [m/s]. growth: (n,) of their volumes, with what has left through the surface
    above them [m^d/s].
    """

    velocity: Array
    growth: Array


def ride(i, x, V, m, flows, lost, start, inverse_width, columns, base, ratio, step, spacing):
    """Place [m], volume [m^2] and mass [kg] of a particle after its column has moved; its velocity
    [m/s], the growth of its volume with what it has lost [m^2/s], and its height in spacings.

    Args:
        i: its number; the particles at the surface come first. lost: table of the thickness that
            has left each column [m]. base, ratio: tables of b [m] and H'/H.
    """
    column = loops.column_of(x, flows, start, inverse_width, columns)
    if column >= columns[0]:
        return 1.0 * x, 1.0 * V, 1.0 * m, 0.0 * x, 0.0 * V, 1.0, 1.0
    growth_ratio = ratio[column]
    place = vector(x[0], base[column] + growth_ratio * (x[1] - base[column]))
    # what evaporates leaves from the particle at the surface
    left = lost[column] / inverse_width[0] if i < columns[0] else 0.0
    growth = ((growth_ratio - 1.0) * V + left) / step
    height = growth_ratio * V * inverse_width[0] / spacing
    return place, growth_ratio * V, growth_ratio * m, (place - x) / step, growth, height, height


def is_uppermost(i, x, at_surface, start, inverse_width, columns):
    """1 for the first particle of a column; of coarse columns beside them the mark that it has."""
    if (x[0] - start[0]) * inverse_width[0] >= columns[0]:
        return 1.0 * at_surface
    return 1.0 if i < columns[0] else 0.0


class RidingSurface(MovingSurface):
    """A moving surface whose particles keep their columns; arguments of `MovingSurface`."""

    loss_shares = (1.0, 0.0)
    row_heights = (1.0, 1.0)
    """Least and largest height of a row that flows, in spacings."""
    _ridden: Ride | None = None

    def find(self, position: Array) -> None:
        """Set marks, depths and ghosts; one particle of a column lies at the surface, however low
        its rows are."""
        super().find(position)
        number = self.backend.asarray(np.arange(position.shape[1]), "index")
        fields = {"i": number, "x": position, "at_surface": self.at_surface}
        self.backend.pointwise(is_uppermost, fields, self.at_surface, **self._grid)

    def ride(self, now: SurfaceStep) -> Ride:
        """Let what flows follow the line with its columns; `now` is changed in place."""
        backend, line, n = self.backend, self.line, now.volume.shape[0]
        # b and H'/H of each column, from its melt and from the place of its uppermost particle
        melt = self._melt_height(now.position, now.volume, now.flows)
        top = self.column_tops(now.position, now.volume)
        moves = self.segments.is_molten & (melt > 0.0)
        base = np.where(moves, top - melt, 0.0)
        ratio = np.where(moves, (line.height - base) / np.where(moves, melt, 1.0), 1.0)

        # particles and what they stand for
        if self._ridden is None or self._ridden.growth.shape != now.volume.shape:
            self._ridden = Ride(backend.zeros(now.position.shape), backend.zeros(n))
        found = self._ridden
        fields = {"i": backend.asarray(np.arange(n), "index"), "x": now.position, "V": now.volume}
        fields |= {"m": now.mass, "flows": now.flows}
        tables: Constants = {"base": backend.asarray(base), "ratio": backend.asarray(ratio)}
        tables |= {"lost": backend.asarray(self.loss.lost)}
        tables |= {"step": now.interval[1] - now.interval[0], "spacing": self.spacing}
        out = (now.position, now.volume, now.mass, *found, None, None)
        reduce = (*(None,) * 5, "min", "max")
        low, high = backend.pointwise(ride, fields, out, reduce=reduce, **self._grid, **tables)
        self.row_heights = low, high
        return found

    def validity_error(self) -> str:
        """Refusal of `MovingSurface`, or rows too flat or too tall to be computed."""
        low, high = self.row_heights
        if low >= LEAST_HEIGHT and high <= LARGEST_HEIGHT:
            return super().validity_error()
        return (
            f"rows of the melt are {low:.2g} to {high:.2g} spacings high, as its columns have been "
            f"stretched; {LEAST_HEIGHT:g} to {LARGEST_HEIGHT:g} are computed, take a weaker drive, "
            "less light or an earlier end"
        )

    def heat_lost(self, enthalpy: Array) -> float:
        """Heat [J] of what leaves in this step, at the enthalpies (n,) of the particles [J/kg]."""
        h = self.backend.to_host(self.backend.head(enthalpy, self.line.count))
        return self.loss.density * self.line.volume_of(self.loss.lost * h)

    def column_tops(self, position: Array, volume: Array) -> NDArray[np.float64]:
        """(columns,) upper faces of the uppermost particles [m], which come first."""
        columns, to_host = self.line.count, self.backend.to_host
        height = to_host(self.backend.head(volume, columns)) / self.line.widths[0]
        return to_host(self.backend.head(position, columns))[-1] + 0.5 * height

    def _is_thick(self, height: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Columns without melt of their own have nothing that could ride."""
        return super()._is_thick(height) & (height > 0.0)

    def _overrun(self, thick: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Melt stays within its columns."""
        return np.zeros(thick.size, bool)

    def _take_mass(self, now: SurfaceStep) -> float:
        """Mass leaves with the ride of the next step."""
        return 0.0
