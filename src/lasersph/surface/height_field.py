"""`HeightField`: heights of a surface above columns on a grid of d - 1 axes.

In 2-D it is a line of columns, the grid with one axis. Heights are the means of the columns and
change by what flows through the sides of the columns and what leaves through their tops, so that
the volume below is kept to rounding:

    d eta_k/dt = -sum over axes (Q_k+1/2 - Q_k-1/2)/dx - m_k S_k/rho,   S = sqrt(1 + |grad eta|^2)

with Q per width of a side. Slopes and curvature, the sum over both directions

    kappa = -div(grad eta / S) = -sum_a [(S^2 - eta_a^2) eta_aa - sum_b eta_a eta_b eta_ab]/S^3,

are those of the smoothed field F eta, see `smoothing`: all waves are pulled back by surface
tension, short ones less. A parabola fitted around each point does not do that: its second
derivative has the wrong sign for some short waves, which then grow.

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
from functools import partial
from itertools import combinations
from math import pi, prod, sqrt
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from lasersph.surface.smoothing import (
    EVEN_PARITY,
    PIN_WEIGHT,
    End,
    Ends,
    Smoothing,
    pinned_ends,
    smoothing_of,
)

Array = NDArray[np.float64]
Parity = float | tuple[float, ...]
Pins = tuple[tuple[float | Array, float | Array], ...]
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
        self._smoothing: dict[tuple[tuple[float, ...], bool], Smoothing] = {}
        # the smoothed field of heights 1 over pins at 0, by which the volume is kept
        self._raised = self.smooth(np.ones(shape), EVEN_PARITY, 0.0)

    def centers(self, axis: int = 0) -> Array:
        """Middle of the columns along an axis [m]."""
        number = np.arange(self.shape[axis], dtype=np.float64)
        return self.start[axis] + self.widths[axis] * (number + 0.5)

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
        """F of values at the columns, `shape`.

        Args:
            parity: of the field, or along each axis. at_pins: value that the field has at pinned
                ends; None where it has none.
        """
        given = [] if at_pins is None else self._at_ends(((at_pins, at_pins),) * len(self.shape))
        return self._solve(values, self._parities(parity), given, passes_pins=at_pins is not None)

    @property
    def smoothed(self) -> Array:
        """F eta [m]."""
        parities = self._parities(EVEN_PARITY)
        return self._solve(self.height, parities, self._at_ends(self.pins), passes_pins=True)

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
        square = slopes**2
        terms = []
        for axis, width in enumerate(self.widths):
            # (S^2 - eta_a^2) eta_aa; on a line the factor is 1
            second = self._stencil(SECOND, smoothed, EVEN_PARITY, axis) / width**2
            others = (square[other] for other in range(len(self.shape)) if other != axis)
            terms.append(sum(others, 1.0) * second)
        if self.is_axisymmetric:
            # the curvature around the axis, eta'/r times S^2
            terms.append((1.0 + square[0]) * slopes[0] / self.centers())
        for a, b in combinations(range(len(self.shape)), 2):
            # eta_ab: the slope along b is even along a
            terms.append(-2.0 * slopes[a] * slopes[b] * self.derivative(slopes[b], EVEN_PARITY, a))
        return -np.sum(terms, axis=0) / (1.0 + np.sum(square, axis=0)) ** 1.5

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
        change = self.smoothed - self.height

        # no volume may come or go: the mean change is taken back, none of it at the pins
        measure = self.measure
        change -= self._raised * (np.sum(measure * change) / np.sum(measure * self._raised))
        self.height = self.height + min(share, 1.0) * change

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

    def _solve(
        self, values: Array, parities: tuple[float, ...], given: list[Array], *, passes_pins: bool
    ) -> Array:
        """F of values; its factors are made at the first call."""
        key = parities, passes_pins
        if key not in self._smoothing:
            grid = self.shape, self.widths, self.ends, self.cutoff
            self._smoothing[key] = smoothing_of(*grid, parities, passes_pins=passes_pins)
        pinned = sqrt(PIN_WEIGHT) * np.concatenate([np.zeros(0), *given])
        return self._smoothing[key].solve(values.ravel(), pinned).reshape(self.shape)

    def _at_ends(self, pins: Pins) -> list[Array]:
        """Values at pinned ends, one for each line of columns that ends there."""
        found = []
        for axis, end in pinned_ends(self.ends):
            others = self.shape[:axis] + self.shape[axis + 1 :]
            found.append(np.broadcast_to(pins[axis][end], others).ravel())
        return found

    def _parities(self, parity: Parity) -> tuple[float, ...]:
        """Parity along each axis: what is odd along x is even along others."""
        if isinstance(parity, tuple):
            return parity
        return (parity,) + (EVEN_PARITY,) * (len(self.shape) - 1)

    def _stencil(self, weights: Array, values: Array, parity: float, axis: int) -> Array:
        """Sum of five neighboring values with weights; at pinned ends of the quartic."""
        extended_values = self.extend(values, parity, axis)
        return along_axis(
            lambda line: np.convolve(line, weights[::-1], mode="valid"), axis, extended_values
        )


def length_ratio(slopes: Array) -> Array:
    """S = sqrt(1 + |grad eta|^2) from slopes (d - 1, ...)."""
    return np.sqrt(1.0 + np.sum(slopes**2, axis=0))


def along_axis(function: Callable[[Array], Array], axis: int, values: Array) -> Array:
    """A function of lines applied to each line along an axis."""
    if values.ndim == 1:
        return function(values)
    return np.apply_along_axis(function, axis, values)


def extended(values: Array, low: End, high: End, parity: float) -> Array:
    """Values of a line with two more at either end."""
    n = values.size
    left = {
        "mirror": parity * values[1::-1],
        "periodic": values[-2:],
        "pinned": _extrapolate(values[:5])[::-1],
    }[low]
    right = {
        "mirror": parity * values[: n - 3 : -1],
        "periodic": values[:2],
        "pinned": _extrapolate(values[: n - 6 : -1]),
    }[high]
    return np.concatenate([left, values, right])


def binomial_sum(values: Array, low: End, high: End) -> Array:
    """Binomial sums of five values of a line; beyond the ends as far as it goes on there."""
    modes: dict[End, Literal["symmetric", "wrap", "constant"]]
    modes = {"mirror": "symmetric", "periodic": "wrap", "pinned": "constant"}
    padded = np.pad(values, (2, 0), mode=modes[low])[: values.size + 2]
    return np.convolve(np.pad(padded, (0, 2), mode=modes[high]), BINOMIAL, mode="valid")


def _extrapolate(values: Array) -> Array:
    """The next two values beyond the first of five, on the quartic through them."""
    a, b, c, d, e = values
    # the fifth difference vanishes on a quartic
    first = 5.0 * a - 10.0 * b + 10.0 * c - 5.0 * d + e
    return np.array([first, 5.0 * first - 10.0 * a + 10.0 * b - 5.0 * c + d])
