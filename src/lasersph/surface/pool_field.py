"""`PoolField`: heights over a pool of any shape, on a grid of two axes.

The smoothed field F eta of a pool lives on its columns and on a ring of two more around them, which
have no height of their own: the functional itself continues the field there,

    sum over columns (f - eta)^2 + sum_j binom(n, j) s^(2n) sum (D_x^j D_y^(n-j) f)^2
        + 100 sum over rim sides (f_side - pin)^2,        s = lambda_c/(2 pi dx)

[Whittaker1923], so that all derivatives at the columns are central ones, and no rim needs a rule of
its own. Differences count where all of their columns lie in pool and ring. The rim is a staircase
of sides, each pinned at the height of the solid beside it; f_side is the cubic through the two
columns at either side. Across planes of symmetry the field goes on as its mirror image.
"""

from __future__ import annotations

from functools import cached_property
from math import comb, pi, prod, sqrt
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lasersph.linear_solvers.banded import BandedFactors, factorize
from lasersph.surface.column_axis import RING, ColumnAxis
from lasersph.surface.height_field import (
    FIRST,
    SECOND,
    HeightField,
    curvature_of,
    drawn_to,
    length_ratio,
)
from lasersph.surface.smoothing import (
    EVEN_PARITY,
    ORDER,
    PIN_WEIGHT,
    PINNED_ORDER,
    REFINEMENTS,
)

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix

Array = NDArray[np.float64]
Numbers = NDArray[np.int64]
Parity = tuple[float, float]
EVEN_PARITIES: Parity = (EVEN_PARITY, EVEN_PARITY)
"""Parity of heights and temperatures. Exact: mirror images of scalars."""
BEYOND_SIDE = np.array([-1.0, 9.0, 9.0, -1.0]) / 16.0
"""Value at a side from the two columns at either side of it, of the cubic through them."""
RING_WEIGHT = 1e-9
"""Weight of a value 0 in the ring. Rounding: in an arm of one column across differences and pins
leave the cubic y (y^2 - 1/4) free there."""


class PoolField:
    """Heights over the columns of a pool.

    Args:
        whole: the grid. columns: (m,) numbers of those of the pool.

    Attributes:
        height: (m,) [m]. columns: (m,). count: m. rim: (sides,) number of the column of the solid
            beside each side of the rim, -1 for a wall.
    """

    is_axisymmetric = False

    def __init__(self, whole: HeightField, columns: Numbers) -> None:
        self.whole, self.columns, self.count = whole, columns, columns.size
        self.widths, self.cutoff = whole.widths, whole.cutoff
        self.axes = tuple(
            ColumnAxis(n, ends) for n, ends in zip(whole.shape, whole.ends, strict=True)
        )
        self._place = np.array(np.unravel_index(columns, whole.shape))
        self.height = whole.height.ravel()[columns]

        # numbers of columns and ring, in a grid that is wider by the ring
        padded = tuple(n + 2 * RING for n in whole.shape)
        steps = np.arange(-RING, RING + 1)
        around = self._seen(
            self._place[0][:, None, None] + steps[:, None],
            self._place[1][:, None, None] + steps[None, :],
        )
        self._number = np.full(padded, -1)
        own = tuple(self._place + RING)
        self._number[around[..., 0], around[..., 1]] = 0
        self._number[own] = -1
        ring = np.argwhere(self._number == 0)
        self._number[tuple(ring.T)] = self.count + np.arange(len(ring))
        self._number[own] = np.arange(self.count)
        self.size = self.count + len(ring)
        self._support = np.concatenate([self._place.T, ring - RING])
        # (m, 5, 5) of the columns around each
        self._around = self._number[around[..., 0], around[..., 1]]
        self._pins = self._rim_sides()
        self.rim = self._pins[0]
        self.at_pins = self.wall_heights = self._heights_at_walls()
        self._factors: dict[tuple[Parity, bool], Factors] = {}

    @property
    def places(self) -> tuple[Array, ...]:
        """(m,) each, middle of the columns along x and y [m]."""
        return tuple(place[: self.count] for place in self.support_places)

    @property
    def support_places(self) -> tuple[Array, ...]:
        """(size,) each, that of columns and ring [m]."""
        grid = zip(self.whole.start, self.widths, self._support.T, strict=True)
        return tuple(start + width * (place + 0.5) for start, width, place in grid)

    def at_columns(self, smoothed: Array) -> Array:
        """Smoothed values at the columns."""
        return smoothed[: self.count]

    def smooth(
        self, values: Array, parity: Parity = EVEN_PARITIES, at_pins: float | None = None
    ) -> Array:
        """(size,) F of values (m,) at the columns.

        Args:
            parity: of the field along each axis. at_pins: value that it has at the rim; None where
                it has none.
        """
        pins = None if at_pins is None else np.full(self.rim.size, at_pins)
        return self._solve(values, parity, pins)

    @property
    def smoothed(self) -> Array:
        """(size,) F eta [m]."""
        return self._solve(self.height, EVEN_PARITIES, self.at_pins)

    def derivative(self, smoothed: Array, parity: Parity = EVEN_PARITIES, axis: int = 0) -> Array:
        """(m,) derivative of smoothed values (size,) along an axis."""
        return self._stencil(FIRST, smoothed, parity, axis) / self.widths[axis]

    def gradient(self, smoothed: Array) -> Array:
        """(2, m) derivatives of an even field along both axes."""
        return np.array([self.derivative(smoothed, axis=axis) for axis in (0, 1)])

    @property
    def slopes(self) -> Array:
        """(2, m) slopes of the smoothed field."""
        return self.gradient(self.smoothed)

    @property
    def length_ratio(self) -> Array:
        """(m,) S = sqrt(1 + |grad eta|^2) of the smoothed field."""
        return length_ratio(self.slopes)

    @property
    def curvature(self) -> Array:
        """(m,) kappa of the smoothed field [1/m], > 0 on a crest."""
        f = self.smoothed
        second = [
            self._stencil(SECOND, f, EVEN_PARITIES, axis) / self.widths[axis] ** 2
            for axis in (0, 1)
        ]
        # eta_xy by the product of both first differences
        weights = FIRST[:, None] * FIRST[None, :]
        mixed = np.sum(weights * f[self._around], axis=(1, 2)) / prod(self.widths)
        return curvature_of(self.gradient(f), second, [mixed])

    def damp_short_waves(self, share: float) -> None:
        """Take `share` (at most 1) of the way to the smoothed field of the same volume, but not in
        the corners of walls (`_is_damped`)."""
        smoothed = np.where(self._is_damped, self.at_columns(self.smoothed), self.height)
        raised = np.where(self._is_damped, self._raised, 0.0)
        self.height = drawn_to(smoothed, self.height, raised, 1.0, share)

    @cached_property
    def _is_damped(self) -> NDArray[np.bool_]:
        """(m,) which columns lie further than lambda_c from a corner of two walls, along x or y.

        Where two pinned sides meet at a right angle, a surface of even curvature is as r^2 ln r,
        which no smoothed field is: heights there hold short waves for good. Drawn to the smoothed
        field, they would be filled again by a flow that never rests.
        """
        found = np.zeros(self.count, bool)
        near = []
        for start, width, n, ends, place in zip(
            *(self.whole.start, self.widths, self.whole.shape, self.whole.ends, self.places),
            strict=True,
        ):
            # distance to the nearest wall of the axis
            walls = [
                wall
                for wall, end in zip((start, start + n * width), ends, strict=True)
                if end == "pinned"
            ]
            apart = [np.abs(place - wall) for wall in walls]
            near.append(np.min(apart, axis=0) < self.cutoff if apart else found)
        is_damped = ~(near[0] & near[1])
        # a pool that is nothing but a corner is damped as any other
        return is_damped if is_damped.any() else ~found

    @cached_property
    def _raised(self) -> Array:
        """Smoothed field of heights 1 over a rim at 0, by which the volume is kept."""
        return self.at_columns(self.smooth(np.ones(self.count), at_pins=0.0))

    def _seen(self, x: Numbers, y: Numbers) -> Numbers:
        """Places (..., 2) of the columns seen at places, in the grid that is wider by the ring."""
        found = (self.axes[0].seen(x), self.axes[1].seen(y))
        return np.stack(np.broadcast_arrays(*found), axis=-1) + RING

    def _stencil(self, weights: Array, f: Array, parity: Parity, axis: int) -> Array:
        """(m,) sum of five values along an axis with weights."""
        middle = RING
        line = self._around[:, :, middle] if axis == 0 else self._around[:, middle, :]
        place = self._place[axis][:, None] + np.arange(-RING, RING + 1)
        return np.sum(weights * self.axes[axis].sign(place, parity[axis]) * f[line], axis=1)

    def _rim_sides(self) -> tuple[Numbers, Numbers, Numbers, Numbers]:
        """Number of the solid column beside each side of the rim, -1 for a wall; axis of the side,
        and the places (sides, 4) of the columns at either side of it along x and y."""
        beside, axes, places = [], [], []
        for axis in (0, 1):
            for outward in (-1, 1):
                place = self._place.copy()
                place[axis] += outward
                seen = self._seen(*place)
                is_rim = self._number[seen[:, 0], seen[:, 1]] >= self.count
                column = seen[is_rim] - RING
                is_wall = np.any((column < 0) | (column >= self.whole.shape), axis=1)
                number = np.where(is_wall, -1, column @ (self.whole.shape[1], 1))
                beside.append(number)
                axes.append(np.full(number.size, axis))
                steps = np.zeros((2, 1, 4), int)
                steps[axis, 0] = outward * np.arange(-1, 3)
                places.append(self._place[:, is_rim, None] + steps)
        both = np.concatenate(places, axis=1)
        return np.concatenate(beside), np.concatenate(axes), both[0], both[1]

    def _heights_at_walls(self) -> Array:
        """(sides,) heights at which walls hold the surface, 0 at other sides [m]."""
        _, axes, x, y = self._pins
        found = np.zeros(axes.size)
        for axis, places in enumerate((x, y)):
            # the second place of a side lies in the pool, the third beyond it
            other = (y, x)[axis][:, 1]
            for end, pin in enumerate(self.whole.pins[axis]):
                count = self.whole.shape[axis]
                beyond = places[:, 2] < 0 if end == 0 else places[:, 2] >= count
                is_wall = (self.rim < 0) & (axes == axis) & beyond
                heights = np.broadcast_to(pin, (self.whole.shape[1 - axis],))
                found[is_wall] = heights[other[is_wall]]
        return found

    def _rows(self, x: Numbers, y: Numbers, values: Array) -> SignedRows:
        """Rows of values (rows, k) at places (rows, k) along x and y, those all of whose places are
        known."""
        seen = self._seen(x, y)
        number = self._number[seen[..., 0], seen[..., 1]]
        is_known = np.all((number >= 0) & np.all(seen >= 0, axis=-1), axis=1)
        mirrored = [
            axis.mirrored(place[is_known]) for axis, place in zip(self.axes, (x, y), strict=True)
        ]
        return SignedRows(number[is_known], values[is_known], np.array(mirrored))

    def _differences(self, orders: tuple[int, ...]) -> SignedRows:
        """Differences of orders along x and y, scaled so that waves of lambda_c keep half."""
        scale = sqrt(comb(sum(orders), orders[0])) * prod(
            (self.cutoff / (2.0 * pi * width)) ** one
            for width, one in zip(self.widths, orders, strict=True)
        )
        (x, share_x), (y, share_y) = (
            axis.blocks(place, one)
            for axis, place, one in zip(self.axes, self._place, orders, strict=True)
        )
        weights = np.multiply.outer(*(binomial(one) for one in orders))
        shape = len(x), len(y), *weights.shape
        place_x = np.broadcast_to(x[:, None, :, None], shape).reshape(-1, weights.size)
        place_y = np.broadcast_to(y[None, :, None, :], shape).reshape(-1, weights.size)
        share = np.multiply.outer(share_x, share_y).reshape(-1, 1)
        return self._rows(place_x, place_y, scale * share * weights.ravel())

    @cached_property
    def _all_differences(self) -> list[SignedRows]:
        """Differences of the functional, of all shares of its order along x and y."""
        order = PINNED_ORDER if self.rim.size else ORDER
        return [self._differences((along_x, order - along_x)) for along_x in range(order + 1)]

    @cached_property
    def _at_rim(self) -> SignedRows:
        """Values at the sides of the rim."""
        _, _, x, y = self._pins
        return self._rows(x, y, np.broadcast_to(BEYOND_SIDE, x.shape))

    def _solve(self, values: Array, parity: Parity, pins: Array | None) -> Array:
        """F of values with heights (sides,) at the rim; its factors are made at the first call."""
        key = parity, pins is not None
        if key not in self._factors:
            self._factors[key] = self._matrices(parity, passes_pins=pins is not None)
        A, P, factors = self._factors[key]
        right = np.zeros(self.size)
        right[: self.count] = values
        if pins is not None:
            right += PIN_WEIGHT * (P.T @ pins)
        f = factors.solve(right)
        # iterative refinement: each pass solves for the residual of the one before
        for _ in range(REFINEMENTS):
            f = f + factors.solve(right - A @ f)
        return f

    def _matrices(self, parity: Parity, *, passes_pins: bool) -> Factors:
        """Matrix of the normal equations, that of the values at the rim, and factors."""
        from scipy.sparse import diags  # few runs have a grid of columns

        weight = np.full(self.size, RING_WEIGHT)
        weight[: self.count] = 1.0
        D = signed_matrix(self._all_differences, parity, self.size)
        P = signed_matrix([self._at_rim], parity, self.size)
        A = diags(weight).tocsr() + D.T @ D
        if passes_pins:
            A = A + PIN_WEIGHT * (P.T @ P)
        return Factors(A, P, factorize(A))


class Factors(NamedTuple):
    """Matrix A (size, size) of the normal equations, P (sides, size) of the values at the rim, and
    factors of A."""

    A: csr_matrix
    P: csr_matrix
    factors: BandedFactors


class SignedRows(NamedTuple):
    """Rows of a matrix, the same for fields of every parity but for signs.

    Attributes:
        number, values: (rows, k) of the entries. mirrored: (2, rows, k) whether the place lies
            across a plane of symmetry, along each axis.
    """

    number: Numbers
    values: Array
    mirrored: NDArray[np.bool_]


def signed_matrix(given: list[SignedRows], parity: Parity, size: int) -> csr_matrix:
    """Matrix (all rows, size) for fields of a parity; places that meet in one entry are added."""
    from scipy.sparse import csr_matrix

    values = [
        np.where(one.mirrored[0], parity[0], 1.0)
        * np.where(one.mirrored[1], parity[1], 1.0)
        * one.values
        for one in given
    ]
    lengths = np.concatenate([np.full(len(one.number), one.number.shape[1]) for one in given])
    start = np.concatenate([[0], np.cumsum(lengths)])
    number = np.concatenate([one.number.ravel() for one in given])
    entries = np.concatenate([one.ravel() for one in values])
    return csr_matrix((entries, number, start), shape=(len(lengths), size))


def binomial(order: int) -> Array:
    """Weights of the difference of an order."""
    return np.array([(-1.0) ** j * comb(order, j) for j in range(order + 1)])
