"""Heights and depths of the melt of the lines of a texture, over places of their melt.

The heights of a line end steeply at the edges of its melt, which lie farther out the more light
there is, and so does the depth of the melt, of which all of this holds as well. So cells are
interpolated over places between the line and the edge, each of which follows a monotone cubic over
fluence [Fritsch1980], and so does w^2, the squared distance of the edge:

    Z(F, x) = S(F, x/w(F)),   S = 0 outside of -1 to 1

About a bright line light falls as x^2, so that w^2 rises evenly where melting begins. Columns of
particles melt or do not: an edge is known to a column's width d, evenly distributed, with standard
deviation d/sqrt 12. A smoothing spline follows w^2 as closely as that, and no closer.

In a spot the fluence changes across a line. Its melt is one pool nevertheless: it levels between
its edges, and its two rims come out of one height. The heights of line k are those of one cell,
moved and stretched to the edges a < b, each of which is at the fluence there:

    z(x) = S(F_k, (2 x - a - b)/(b - a)),   x_k - a = w(F(a)),   b - x_k = w(F(b))

Of that cell the brightest place is as bright as that of the line, whose light, with F(x) = F_c
(1 + g (x - x_k)) about it, is brightest beside x_k, at x_k + 2 g (p/2 pi)^2:

    F_k = max F(x) (1 + cos(2 pi (x - x_k)/p))/2 = F_c (1 + (g p/2 pi)^2)

This is the light of two equal beams; of unequal ones of contrast C the brightest place gains
(1 + C)/2 C times as much, which is left out. So is that the inner rim of a line, where the melt is
hotter, is higher than the outer one: cells without a slope of the fluence do not know it.

Moving and stretching leave the volume of a cell zero, as its own motion does. Where the melt of a
line meets that of the next one there is no edge between them: Z(F(x), x - x_k).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
LEVELS = 1024
"""Fluences at which cubics are tabulated, between which values are linear: with 24 cells some 40 a
cell, where a cubic bends by 1e-3 of a cell's change."""
PLACES = 801
"""From edge to edge of a line's melt: finer than the columns of a cell."""
CHANGED = 1e-4
"""Height over the largest of all cells by which a column has changed: solid metal evaporates by
less."""
BISECTIONS = 24
"""Of half a period, for an edge, to 1e-7 of it."""
ROWS_A_PERIOD = 40
"""At which edges are found for places that all have another y: of w^2 they miss (p/40 D)^2, 6e-6 in
a spot of ten periods."""
MEETS = 1e-6
"""A line without an edge reaches by bisections to within this share of half a period."""
SLOPE_STEP = 0.1
"""Of a period, over which the slope of the fluence is taken: several pixels of a map of it."""
FEWEST = 4
"""Edges from which a cubic spline can be smooth: one more is known than it has coefficients."""


@dataclass(frozen=True, eq=False)
class LineHeights:
    """Heights of a line, or depths of its melt, by its fluence.

    Attributes:
        period: [m]. highest: fluence of the highest cell [J/m^2].
        half_width: (LEVELS,) w [m] at fluences evenly from 0 to the highest.
        height: (LEVELS, PLACES) S [m], evenly from edge to edge.
    """

    period: float
    highest: float
    half_width: Array
    height: Array

    @classmethod
    def of(cls, fluence: Array, x: Array, period: float, height: Array) -> LineHeights:
        """Those of cells with rising fluences (cells,) [J/m^2].

        Args:
            x: (columns,) places, with a line at 0 and one a period farther [m].
            height: (cells, columns) [m].
        """
        from scipy.interpolate import PchipInterpolator, UnivariateSpline

        # cells over the distance from their line, with the edges of their melt
        phase = x - period * np.round(x / period)
        order = np.argsort(phase, kind="stable")
        phase, height = phase[order], height[:, order]
        least = CHANGED * float(np.abs(height).max())
        half_width = np.array([distance_of_edge(phase, row, least, period) for row in height])

        # S: heights from edge to edge, of a line without edges over its period
        stretched = np.zeros((fluence.size, PLACES))
        for k, (row, w) in enumerate(zip(height, half_width, strict=True)):
            places = np.linspace(-w, w, PLACES)
            if w == 0.5 * period:
                stretched[k] = np.interp(places, phase, row, period=period)
            elif w > 0.0:
                inside = np.abs(phase) < w
                ends = np.concatenate([[-w], phase[inside], [w]])
                stretched[k] = np.interp(places, ends, np.pad(row[inside], 1))
        for k in range(fluence.size - 2, -1, -1):
            if half_width[k] == 0.0 and half_width[k + 1] == 0.5 * period:
                half_width[k] = 0.5 * period  # nothing is known of an edge between these two

        # smoothing spline of w^2 over fluence, to the rounding of columns
        has_edge = (half_width > 0.0) & (half_width < 0.5 * period)
        if np.count_nonzero(has_edge) > FEWEST:
            lit, w = fluence[has_edge], half_width[has_edge]
            rounding = period / (np.sqrt(12.0) * x.size)
            smooth = UnivariateSpline(lit, w**2, w=1.0 / (2.0 * w * rounding))
            half_width[has_edge] = np.sqrt(np.maximum(smooth(lit), 0.0))

        # monotone cubics over fluence, tabulated
        levels = np.linspace(0.0, fluence[-1], LEVELS)
        lit = np.maximum(levels, fluence[0])
        share = np.minimum(levels / fluence[0], 1.0)[:, None]  # linear below the lowest cell
        return cls(
            period,
            float(fluence[-1]),
            np.sqrt(PchipInterpolator(fluence, half_width**2)(lit)),
            share * PchipInterpolator(fluence, stretched, axis=0)(lit),
        )

    def at(self, fluence: ArrayLike, x: ArrayLike) -> Array:
        """Z(F, x) at local fluences, none above the highest, and places [m], any shape."""
        local, places = np.broadcast_arrays(np.asarray(fluence, float), np.asarray(x, float))
        return self._stretched(local, self._phase(places), self._half_width(local))

    def across(self, fluence: Callable[[Array, Array], Array], x: ArrayLike, y: ArrayLike) -> Array:
        """Heights in a spot at places [m], any shape.

        Args:
            fluence: local, of places x and y, none above the highest.
        """
        x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        # a line at one y, on which many places lie, is one complex number
        lines, line = np.unique(np.round(x / self.period) + 1j * y, return_inverse=True)
        center, row = self.period * lines.real, lines.imag
        # S(F_k, (2 x - a - b) / (b - a)), or Z(F, x) where lines meet
        left, right = self._edges(fluence, center, row)
        own = self._brightest(fluence, center, row)
        half, off = 0.5 * (left + right), 0.5 * (right - left)
        meets = np.maximum(left, right) > 0.5 * self.period * (1.0 - MEETS)
        line = line.reshape(x.shape)
        alone = self._stretched(own[line], self._phase(x) - off[line], half[line])
        if not meets.any():
            return alone
        return np.where(meets[line], self.at(fluence(x, y), x), alone)

    def _brightest(
        self, fluence: Callable[[Array, Array], Array], center: Array, row: Array
    ) -> Array:
        """F_k (n,) of lines at (center, row); that at the line where an edge of the light, such as
        of a top hat, gives no slope."""
        # slope g of the light, and the brightest place that it moves beside the line
        own, step = fluence(center, row), SLOPE_STEP * self.period
        change = fluence(center + step, row) - fluence(center - step, row)
        slope = change / (2.0 * step * np.maximum(own, 1e-12 * self.highest))
        wave = 2.0 * np.pi / self.period
        off = np.clip(2.0 * slope / wave**2, -0.25 * self.period, 0.25 * self.period)
        moved = 0.5 * fluence(center + off, row) * (1.0 + np.cos(wave * off))
        return np.maximum(own, moved)

    def _edges(
        self, fluence: Callable[[Array, Array], Array], center: Array, row: Array
    ) -> tuple[Array, Array]:
        """Distances of the left and the right edge from lines at `center` (n,), at y = `row` (n,).

        Where a map lies at an angle each point has a y of its own: edges are then found at even
        rows, and their squares, which change evenly where a line ends, are linear between them.
        """
        from scipy.ndimage import map_coordinates

        # few places: each edge by itself; many: a table over lines and rows
        number = np.round(center / self.period).astype(int)
        first, low, high = number.min(), float(row.min()), float(row.max())
        rows = np.linspace(low, high, 2 + int(ROWS_A_PERIOD * (high - low) / self.period))
        shape = (int(number.max() - first) + 1, rows.size)
        if number.size < 2 * shape[0] * shape[1]:
            left, right = (self._distance(fluence, center, row, side) for side in (-1.0, 1.0))
            return left, right
        k, y = (
            one.ravel() for one in np.meshgrid(first + np.arange(shape[0]), rows, indexing="ij")
        )
        places = [number - first, (row - low) / (rows[1] - rows[0])]
        squares = (
            self._distance(fluence, self.period * k, y, side).reshape(shape) ** 2
            for side in (-1.0, 1.0)
        )
        left, right = (np.sqrt(map_coordinates(one, places, order=1)) for one in squares)
        return left, right

    def _distance(
        self, fluence: Callable[[Array, Array], Array], center: Array, row: Array, side: float
    ) -> Array:
        """Distance (n,) of the edge on a side from lines at (center, row)."""
        # bisection for x_k -+ w(F): melt reaches as far as w of the fluence there
        near, far = np.zeros(center.size), np.full(center.size, 0.5 * self.period)
        for _ in range(BISECTIONS):
            middle = 0.5 * (near + far)
            melts = self._half_width(fluence(center + side * middle, row)) > middle
            near, far = np.where(melts, middle, near), np.where(melts, far, middle)
        return near

    def _phase(self, x: Array) -> Array:
        """Distance from the next line, from minus half a period to half a one [m]."""
        return x - self.period * np.round(x / self.period)

    def _half_width(self, fluence: Array) -> Array:
        return np.interp(fluence, np.linspace(0.0, self.highest, LEVELS), self.half_width)

    def _stretched(self, fluence: Array, distance: Array, half_width: Array) -> Array:
        """S at distances from the middle between edges that are twice the half width apart."""
        from scipy.ndimage import map_coordinates

        # bilinear in the table: fluence and place from edge to edge
        place = distance / np.maximum(half_width, 1e-12 * self.period)
        row = np.minimum(fluence / self.highest, 1.0) * (LEVELS - 1)
        column = 0.5 * (place + 1.0) * (PLACES - 1)
        found = map_coordinates(self.height, [row, column], order=1, mode="nearest")
        return np.where(np.abs(place) <= 1.0, found, 0.0)


def distance_of_edge(phase: Array, height: Array, least: float, period: float) -> float:
    """Distance from the line at which heights of a cell end [m]; half a period where they do not.

    The edge lies where the last two columns that have changed lead to 0, a column farther at most.

    Args:
        phase: (columns,) from the line, rising [m]. height: (columns,) [m].
        least: height of a column that has changed [m].
    """
    found = 0.0
    step = period / phase.size
    for side in (phase <= 0.0, phase >= 0.0):
        order = np.argsort(np.abs(phase[side]), kind="stable")
        # from the line outward: the last column that has changed
        away, z = np.abs(phase[side][order]), np.abs(height[side][order])
        changed = np.flatnonzero(z > least)
        if changed.size == 0:
            continue
        last = int(changed[-1])
        if last == z.size - 1:
            return 0.5 * period
        # the fall of the last two columns leads to 0
        falls = z[last - 1] - z[last] if last > 0 else 0.0
        farther = min(z[last] / falls, 1.0) if falls > 0.0 else 0.5
        found = max(found, float(away[last]) + step * farther)
    return min(found, 0.5 * period)
