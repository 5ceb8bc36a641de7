"""`HeightField`: heights of a surface above columns on a grid of d - 1 axes.

In 2-D it is a line of columns, the grid with one axis. Heights are the means of the columns and
change by what flows through the sides of the columns and what leaves through their tops, so that
the volume below is kept to rounding:

    d eta_k/dt = -sum over axes (Q_k+1/2 - Q_k-1/2)/dx - m_k S_k/rho,   S = sqrt(1 + |grad eta|^2)

with Q per width of a side. Slopes and curvature, of a grid the sum over both directions

    kappa = -div(grad eta / S) = -sum_a [(S^2 - eta_a^2) eta_aa - sum_b eta_a eta_b eta_ab]/S^3,

are those of the smoothed field F eta, of a line see `smoothing`; a grid is smoothed pool by pool,
see `pool_field`. All waves are pulled back by surface tension, short ones less. A parabola fitted
around each point does not do that: its second derivative has the wrong sign for some short waves,
which then grow.

In a section (r, z) columns are rings: with their areas 2 pi r dx and sides 2 pi r,

    d eta_k/dt = -(r_k+1/2 Q_k+1/2 - r_k-1/2 Q_k-1/2)/(r_k dx) - m_k S_k/rho
    kappa = -eta''/S^3 - eta'/(r S)

Beside a pin -d kappa/d eta is not symmetric: the field cannot follow a column there, the pressure
on it can, and waves may take up energy. With n = 5 one that leaves the last column standing grows
by 0.2/ns over a film of steel of 72 nm, against the friction of its bottom. With n = 4, and columns
drawn to the line through the pin, none grows; with n = 3 the curvature of an arc errs more.
"""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from functools import cached_property, partial
from itertools import combinations
from math import pi, prod, sqrt

import numpy as np
from numpy.typing import NDArray

from lasersph.surface.smoothing import (
    EVEN_PARITY,
    ODD_PARITY,
    PIN_WEIGHT,
    End,
    Ends,
    Smoothing,
    pinned_ends,
    smoothing_of,
)

Array = NDArray[np.float64]
Parity = float | tuple[float, ...]
Pin = float | Array
Pins = tuple[tuple[Pin, Pin], ...]
FIRST = np.array([1.0, -8.0, 0.0, 8.0, -1.0]) / 12.0
SECOND = np.array([-1.0, 16.0, -30.0, 16.0, -1.0]) / 12.0
"""Central differences of fourth order, times dx and dx^2."""
BINOMIAL = np.array([1.0, 4.0, 6.0, 4.0, 1.0])
SHORTEST = 0.3e-6
"""lambda_c of lines with fine columns [m]. Accuracy: of a wave of 1 um F takes 6e-6; noise of
heights of 1 % of 8 nm is 1.3 % of the curvature of 50 nm of relief on 5 um."""
FEWEST_COLUMNS = 6.0
"""Columns in lambda_c at least. Accuracy: waves shorter than some columns are noise of single
particles."""


def cutoff_of(width: float) -> float:
    """lambda_c of a line with columns of a width [m]."""
    return max(SHORTEST, FEWEST_COLUMNS * width)


class HeightField:
    """Columns of a grid of d - 1 axes, `shape` along each.

    Args:
        start: lower end of each axis [m]. widths: of a column [m]. ends: how the field goes on at
            both ends of each axis. cutoff: lambda_c, the length of waves half of whose height
            counts for slope and curvature [m]. is_axisymmetric: whether columns are rings, at
            distances from their axis.

    Attributes:
        height: `shape`, eta [m]. pins: heights of the lower and the upper end of each axis, where
            they are pinned: a number, or one for each line of columns [m].
    """

    def __init__(
        self,
        start: tuple[float, ...],
        widths: tuple[float, ...],
        shape: tuple[int, ...],
        ends: tuple[Ends, ...],
        cutoff: float,
        *,
        is_axisymmetric: bool = False,
    ) -> None:
        self.start = start
        self.is_axisymmetric = is_axisymmetric
        self.widths = widths
        self.shape = shape
        self.ends = ends
        self.cutoff = cutoff
        self.count = prod(shape)
        self.height = np.zeros(shape)
        self.pins: Pins = ((0.0, 0.0),) * len(shape)
        self._smoothing: dict[tuple[float, bool], Smoothing] = {}

    def centers(self, axis: int = 0) -> Array:
        """Middle of the columns along an axis [m]."""
        number = np.arange(self.shape[axis], dtype=np.float64)
        return self.start[axis] + self.widths[axis] * (number + 0.5)

    @property
    def places(self) -> tuple[Array, ...]:
        """`shape` each, middle of the columns along each axis [m]."""
        axes = (self.centers(axis) for axis in range(len(self.shape)))
        return tuple(np.meshgrid(*axes, indexing="ij"))

    @property
    def support_places(self) -> tuple[Array, ...]:
        """Places [m] at which smoothed values are known: the columns."""
        return self.places

    def at_columns(self, smoothed: Array) -> Array:
        """Smoothed values at the columns."""
        return smoothed

    @property
    def inverse_widths(self) -> tuple[float, ...]:
        """1 / width along each axis [1/m]."""
        return tuple(1.0 / width for width in self.widths)

    @property
    def inverse_area(self) -> float:
        """1 / area of a column seen from above [1/m^(d-1)]."""
        return prod(self.inverse_widths)

    @property
    def measure(self) -> Array:
        """`shape`, 2 pi r of rings [m], 1 of columns of a plane."""
        return 2.0 * pi * self.centers() if self.is_axisymmetric else np.ones(self.shape)

    def volume_of(self, thickness: Array) -> float:
        """Volume of a thickness `shape` of all columns [m^d], of rings [m^3]."""
        return float(np.sum(thickness * self.measure)) * prod(self.widths)

    def copy(self) -> HeightField:
        """Another field that shares what its smoothing takes."""
        other = copy(self)
        other.height = self.height.copy()
        return other

    def smooth(
        self, values: Array, parity: Parity = EVEN_PARITY, at_pins: float | None = None
    ) -> Array:
        """F of values at the columns of a line.

        Args:
            parity: of the field. at_pins: value that the field has at pinned ends; None where it
                has none.
        """
        pins = None if at_pins is None else (at_pins, at_pins)
        return self._solve(values, self._parities(parity)[0], pins)

    @property
    def smoothed(self) -> Array:
        """F eta of a line [m]."""
        (pins,) = self.pins
        return self._solve(self.height, EVEN_PARITY, pins)

    def derivative(self, values: Array, parity: Parity = EVEN_PARITY, axis: int = 0) -> Array:
        """Derivative of values at the columns along an axis, one-sided at pinned ends."""
        return self._stencil(FIRST, values, self._parities(parity)[axis], axis) / self.widths[axis]

    def gradient(self, values: Array, parity: Parity = EVEN_PARITY) -> Array:
        """(d - 1, *shape) derivatives along all axes."""
        axes = range(len(self.shape))
        return np.array([self.derivative(values, parity, axis) for axis in axes])

    @property
    def slopes(self) -> Array:
        """(d - 1, *shape) slopes of the smoothed field."""
        return self.gradient(self.smoothed)

    @property
    def length_ratio(self) -> Array:
        """S = sqrt(1 + |grad eta|^2) of the smoothed field: true area over that from above."""
        return length_ratio(self.slopes)

    @property
    def curvature(self) -> Array:
        """kappa of the smoothed field [1/m], > 0 on a crest."""
        smoothed = self.smoothed
        slopes = self.gradient(smoothed)
        second = self._stencil(SECOND, smoothed, EVEN_PARITY, 0) / self.widths[0] ** 2
        # around an axis of revolution, eta'/r
        around = slopes[0] / self.centers() if self.is_axisymmetric else None
        return curvature_of(slopes, [second], [], around)

    def heights_after(self, step: float, *flux: Array) -> Array:
        """Heights after `step` [s].

        Args:
            flux: along each axis, one more than columns there: Q through the sides, toward larger
                places, per width of a side [m^2/s].
        """
        height = self.height
        for axis, (Q, width) in enumerate(zip(flux, self.widths, strict=True)):
            if self.is_axisymmetric:
                # through sides 2 pi r into rings of area 2 pi r dx
                r = self.centers()
                sides = np.append(r - 0.5 * width, r[-1] + 0.5 * width)
                Q, width = sides * Q, r * width
            height = height - step * np.diff(Q, axis=axis) / width
        return height

    def damp_short_waves(self, share: float) -> None:
        """Take `share` (at most 1) of the way to the smoothed field of the same volume.

        A wave of length lambda loses the part share (lambda_c/lambda)^(2n) of its height where that
        is small.
        """
        self.height = drawn_to(self.smoothed, self.height, self._raised, self.measure, share)

    @cached_property
    def _raised(self) -> Array:
        """Smoothed field of heights 1 over pins at 0, by which the volume is kept."""
        return self.smooth(np.ones(self.shape), EVEN_PARITY, 0.0)

    def first_harmonic(self, *periods: float) -> float:
        """First harmonic of a pattern of periods [m], one for each axis of the first ones.

        (2/Lx) times the integral over x of eta cos(2 pi x/Lx) over a period, of both axes 4/(Lx Ly)
        times that over x and y of eta cos(2 pi x/Lx) cos(2 pi y/Ly). The field spans whole periods
        along each of them, or half of one from 0 on, which is mirrored; the mean over a column of
        the cosine is taken exactly, that over other axes as well.
        """
        found = self.height
        for axis, period in enumerate(periods):
            cosine = np.cos(2.0 * pi / period * self.centers(axis))
            mean_cosine = cosine * np.sinc(self.widths[axis] / period)
            # twice the mean over this axis, which is then gone
            found = 2.0 * np.tensordot(mean_cosine, found, axes=1) / mean_cosine.size
        return float(np.mean(found))

    def at_nodes(self, values: Array, *odd_axes: int) -> Array:
        """Values `shape` with two more at either end of each axis, flattened; they are odd along
        some axes."""
        for axis in range(len(self.shape)):
            parity = ODD_PARITY if axis in odd_axes else EVEN_PARITY
            values = self.extend(values, parity, axis)
        return values.ravel()

    def fill_gaps(self, values: Array, known: NDArray[np.bool_]) -> Array:
        """Values (count,) of all columns from the known ones: along a line linear between them, on
        a grid those of the nearest."""
        if len(self.shape) == 1:
            places = self.centers()
            return np.interp(places, places[known], values[known])
        from scipy.ndimage import distance_transform_edt  # few runs have a grid of columns

        unknown = ~known.reshape(self.shape)
        nearest = distance_transform_edt(unknown, return_distances=False, return_indices=True)
        return values.reshape(self.shape)[tuple(np.asarray(nearest))].ravel()

    def extend(self, values: Array, parity: float = EVEN_PARITY, axis: int = 0) -> Array:
        """Values with two more at either end of an axis."""
        low, high = self.ends[axis]
        return along_axis(lambda line: extended(line, low, high, parity), axis, values)

    def mean_of_neighbors(self, values: Array, counts: NDArray[np.bool_]) -> Array:
        """Binomial mean of five columns along each axis, of those that count; fewer beside pins."""
        total, weight = values * counts, counts.astype(float)
        for axis, (low, high) in enumerate(self.ends):
            sums = partial(binomial_sum, low=low, high=high)
            total, weight = (along_axis(sums, axis, part) for part in (total, weight))
        return total / np.maximum(weight, 1.0)

    def _solve(self, values: Array, parity: float, pins: tuple[Pin, Pin] | None) -> Array:
        """F of values; its factors are made at the first call."""
        key = parity, pins is not None
        if key not in self._smoothing:
            line = self.shape[0], self.widths[0], self.ends[0], self.cutoff
            self._smoothing[key] = smoothing_of(*line, parity, passes_pins=key[1])
        given = [] if pins is None else [float(pins[end]) for end in pinned_ends(self.ends[0])]
        return self._smoothing[key].solve(values, sqrt(PIN_WEIGHT) * np.array(given, float))

    def _parities(self, parity: Parity) -> tuple[float, ...]:
        """Parity along each axis: what is odd along x is even along others."""
        if isinstance(parity, tuple):
            return parity
        return (parity,) + (EVEN_PARITY,) * (len(self.shape) - 1)

    def _stencil(self, weights: Array, values: Array, parity: float, axis: int) -> Array:
        """Sum of five neighboring values with weights; at pinned ends of the quartic."""
        return along_axis(
            partial(window_sum, weights=weights), axis, self.extend(values, parity, axis)
        )


def drawn_to(
    smoothed: Array, height: Array, raised: Array, measure: Array | float, share: float
) -> Array:
    """Heights [m] after `share` (at most 1) of the way to the smoothed ones.

    No volume may come or go: the change summed is taken back, by `raised`, which is 1 far from the
    pins and 0 at them, so that none of it is taken there.

    Args:
        measure: area of each column over that of the others.
    """
    change = smoothed - height
    change -= raised * (np.sum(measure * change) / np.sum(measure * raised))
    return height + min(share, 1.0) * change


def curvature_of(
    slopes: Array, second: list[Array], mixed: list[Array], around: Array | None = None
) -> Array:
    """kappa [1/m] from slopes (d - 1, ...), the second derivatives along each axis, eta_xy of a
    grid [1/m], and eta'/r of rings [1/m]."""
    square, terms = slopes**2, []
    for axis, own in enumerate(second):
        # (S^2 - eta_a^2) eta_aa; on a line the factor is 1
        others = (square[other] for other in range(len(second)) if other != axis)
        terms.append(sum(others, 1.0) * own)
    if around is not None:
        terms.append((1.0 + square[0]) * around)
    for (a, b), own in zip(combinations(range(len(second)), 2), mixed, strict=True):
        terms.append(-2.0 * slopes[a] * slopes[b] * own)
    return -np.sum(terms, axis=0) / (1.0 + np.sum(square, axis=0)) ** 1.5


def length_ratio(slopes: Array) -> Array:
    """S = sqrt(1 + |grad eta|^2) from slopes (d - 1, ...)."""
    return np.sqrt(1.0 + np.sum(slopes**2, axis=0))


def along_axis(function: Callable[[Array], Array], axis: int, values: Array) -> Array:
    """A function of lines, which run along the first axis, applied to those along another one."""
    if axis == 0:
        return function(values)
    return np.moveaxis(function(np.moveaxis(values, axis, 0)), 0, axis)


def window_sum(values: Array, weights: Array) -> Array:
    """Sums of as many neighboring values of a line as there are weights, with these."""
    count = values.shape[0] - weights.size + 1
    return sum((w * values[k : k + count] for k, w in enumerate(weights)), 0.0 * values[:count])


def extended(values: Array, low: End, high: End, parity: float) -> Array:
    """Values of a line with two more at either end."""
    before, after = _continued(values, low, parity), _continued(values[::-1], high, parity)
    return np.concatenate([before[::-1], values, after])


def _continued(values: Array, end: End, parity: float) -> Array:
    """The next two values beyond the first of a line."""
    if end == "mirror":
        return parity * values[:2]
    return values[:-3:-1] if end == "periodic" else _extrapolate(values[:5])


def binomial_sum(values: Array, low: End, high: End) -> Array:
    """Binomial sums of five values of a line; beyond the ends as far as it goes on there."""
    # each end goes on from the line itself, not from what was put before it
    before, after = _continued_or_zero(values, low), _continued_or_zero(values[::-1], high)
    return window_sum(np.concatenate([before[::-1], values, after]), BINOMIAL)


def _continued_or_zero(values: Array, end: End) -> Array:
    """The next two values of an even line beyond its first, 0 beyond a pin."""
    if end == "pinned":
        return np.zeros((2, *values.shape[1:]))
    return _continued(values, end, EVEN_PARITY)


def _extrapolate(values: Array) -> Array:
    """The next two values beyond the first of five, on the quartic through them."""
    a, b, c, d, e = values
    # the fifth difference vanishes on a quartic
    first = 5.0 * a - 10.0 * b + 10.0 * c - 5.0 * d + e
    return np.array([first, 5.0 * first - 10.0 * a + 10.0 * b - 5.0 * c + d])
