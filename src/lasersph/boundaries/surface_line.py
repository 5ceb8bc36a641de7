"""`SurfaceLine`: heights of a moving surface above columns of one width, with slope and curvature.

Heights are the means of the columns and change by what flows through the sides of the columns and
what leaves through their tops, so that the volume below is kept to rounding:

    d eta_k/dt = -(Q_k+1/2 - Q_k-1/2)/dx - m_k S_k/rho,      S = sqrt(1 + (d eta/dx)^2)

Slope and curvature are those of the smoothed line F eta, which minimizes

    sum (f - eta)^2 + (lambda_c/(2 pi dx))^(2n) sum (n-th differences of f)^2

[Whittaker1923]. A wave of length lambda >> dx keeps the part 1/(1 + (lambda_c/lambda)^(2n)) of its
height: all waves are pulled back by surface tension, short ones less. A parabola fitted around each
point does not do that: its second derivative has the wrong sign for some short waves, which then
grow. Across a plane of symmetry the line goes on as its mirror image. Where it is pinned, to a wall
or to metal that is solid, no slope is assumed, polynomials of degree n - 1 pass unchanged, and the
smoothed line goes through the height there.

Beside a pin -d kappa/d eta is not symmetric: the line cannot follow a column there, the pressure on
it can, and waves may take up energy. With n = 5 one that leaves the last column standing grows by
0.2/ns over a film of steel of 72 nm, against the friction of its bottom. With n = 4, and columns
drawn to the line through the pin, none grows; with n = 3 the curvature of an arc errs more.
"""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from math import comb, pi, sqrt
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:  # SciPy's matrices take a tenth of a second to load, and few runs have a line
    from scipy.sparse import csc_matrix, csr_matrix
    from scipy.sparse.linalg import SuperLU

Array = NDArray[np.float64]
End = Literal["mirror", "periodic", "pinned"]
EVEN, ODD = 1.0, -1.0
"""How a field goes on beyond a plane of symmetry. Exact: heights and temperatures are even,
velocities along x odd."""
ORDER, PINNED_ORDER = 5, 4
"""Order n of the differences, and that of lines with a pinned end. Stability: with 5 waves grow
beside a pin. The curvature of an arc of 2 um over a chord errs by 10 %, 2 %, 0.5 % at its ends with
3, 4 and 5."""
REFINEMENTS = 2
"""Corrections of a solution by its own residual. Rounding: 1e-6 is left of it without at columns of
8 nm, 1e-3 at 4 nm."""
PIN_WEIGHT = 100.0
"""How much more than the mean of a column the height of a pinned end counts. Accuracy: the line
passes it within 1 % of the difference."""
AT_END = np.array([35.0, -35.0, 21.0, -5.0]) / 16.0
"""Value at an end from the means of the four columns beside it, of the cubic through them."""
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


@dataclass(frozen=True)
class Smoothing:
    """F for one parity: solves (1 + D^T D + P^T P) f = eta + P^T pins."""

    differences: csc_matrix
    pins: csc_matrix
    inverse: SuperLU

    @cached_property
    def transposed(self) -> tuple[csr_matrix, csr_matrix]:
        """D^T and P^T, which take longer to make than to apply."""
        return self.differences.T, self.pins.T

    def solve(self, values: Array, pinned: Array) -> Array:
        """F of values (count,) with heights (pins,) of the pinned ends."""
        (D, P), (D_T, P_T) = (self.differences, self.pins), self.transposed
        f = np.zeros(values.size)
        # iterative refinement: each pass solves for the residual of the one before
        for _ in range(1 + REFINEMENTS):
            f = f + self.inverse.solve(values - f - D_T @ (D @ f) - P_T @ (P @ f - pinned))
        return f


class SurfaceLine:
    """A line of `count` columns.

    Args:
        start: x of its left end [m]. width: of a column [m]. ends: how it goes on at both ends.
        cutoff: lambda_c, the length of waves half of whose height counts for slope and
            curvature [m].

    Attributes:
        x: (count,) middle of the columns [m]. height: (count,) eta [m]. pins: heights of the left
            and the right end where they are pinned [m].
    """

    def __init__(
        self, start: float, width: float, count: int, ends: tuple[End, End], cutoff: float
    ) -> None:
        self.start, self.width, self.count = start, width, count
        self.ends, self.cutoff = ends, cutoff
        self.x = start + width * (np.arange(count) + 0.5)
        self.height = np.zeros(count)
        self.pins = (0.0, 0.0)
        self._smoothing: dict[tuple[float, bool], Smoothing] = {}
        for parity, passes_pins in product((EVEN, ODD), (True, False)):
            self._smoothing[parity, passes_pins] = self._prepare(parity, passes_pins)
        # the smoothed line of heights 1 over pins at 0, by which the volume is kept
        self._raised = self.smooth(np.ones(count), EVEN, 0.0)

    def _prepare(self, parity: float, passes_pins: bool) -> Smoothing:
        from scipy.sparse import csc_matrix, identity, vstack
        from scipy.sparse.linalg import splu

        # D: n-th differences, so scaled that waves of length lambda_c keep half of their height
        order = PINNED_ORDER if "pinned" in self.ends else ORDER
        strength = (self.cutoff / (2.0 * pi * self.width)) ** order
        D = strength * differences(self.count, order, self.ends, parity)

        # P: the cubic through four columns meets each pinned end
        rows = []
        for end, kind in enumerate(self.ends):
            if kind == "pinned" and passes_pins:
                row = np.zeros(self.count)
                row[:4] = sqrt(PIN_WEIGHT) * AT_END
                rows.append(row if end == 0 else row[::-1])
        P = csc_matrix(np.array(rows).reshape(len(rows), self.count))

        # the matrix of the normal equations 1 + D^T D + P^T P, factorized once
        both = vstack([D, P]).tocsc()
        return Smoothing(D, P, splu((identity(self.count) + both.T @ both).tocsc()))

    def copy(self) -> SurfaceLine:
        """Another line that shares what its smoothing takes."""
        other = copy(self)
        other.height = self.height.copy()
        return other

    def smooth(self, values: Array, parity: float = EVEN, at_pins: float | None = None) -> Array:
        """F of values at the columns, shape (count,).

        Args:
            at_pins: value that the field has at pinned ends; None where it has none.
        """
        given = [] if at_pins is None else [at_pins for kind in self.ends if kind == "pinned"]
        pinned = sqrt(PIN_WEIGHT) * np.array(given)
        return self._smoothing[parity, at_pins is not None].solve(values, pinned)

    @property
    def smoothed(self) -> Array:
        """F eta (count,) [m]."""
        pinned = [pin for kind, pin in zip(self.ends, self.pins, strict=True) if kind == "pinned"]
        return self._smoothing[EVEN, True].solve(self.height, sqrt(PIN_WEIGHT) * np.array(pinned))

    def derivative(self, values: Array, parity: float = EVEN) -> Array:
        """d/dx of values at the columns, shape (count,), one-sided at pinned ends."""
        return self._stencil(FIRST, values, parity) / self.width

    @property
    def slope(self) -> Array:
        """d eta/dx of the smoothed line (count,)."""
        return self.derivative(self.smoothed)

    @property
    def curvature(self) -> Array:
        """kappa = -eta''/(1 + eta'^2)^(3/2) of the smoothed line (count,) [1/m], > 0 on a crest."""
        smoothed = self.smoothed
        slope = self.derivative(smoothed)
        second = self._stencil(SECOND, smoothed, EVEN) / self.width**2
        return -second / (1.0 + slope**2) ** 1.5

    def heights_after(self, step: float, flux: Array) -> Array:
        """Heights after `step` [s], (count,) [m].

        Args:
            flux: (count + 1,) Q through the sides of the columns, toward larger x [m^2/s].
        """
        return self.height - step * np.diff(flux) / self.width

    def damp_short_waves(self, share: float) -> None:
        """Take `share` (at most 1) of the way to the smoothed line of the same volume.

        A wave of length lambda loses the part share (lambda_c/lambda)^(2n) of its height where that
        is small.
        """
        change = self.smoothed - self.height

        # no volume may come or go: the mean change is taken back, none of it at the pins
        change -= self._raised * (np.sum(change) / np.sum(self._raised))
        self.height = self.height + min(share, 1.0) * change

    def first_harmonic(self, period: float) -> float:
        """(2/period) times the integral of eta cos(2 pi x/period) over a period [m].

        The line spans whole periods, or half of one from x = 0 on, which is mirrored; the mean over
        a column of the cosine is taken exactly.
        """
        k = 2.0 * pi / period
        mean_cosine = np.cos(k * self.x) * np.sinc(self.width / period)
        return float(2.0 * np.mean(self.height * mean_cosine))

    def extend(self, values: Array, parity: float = EVEN) -> Array:
        """Values with two more at either end, (count + 4,)."""
        n = self.count
        left = {
            "mirror": parity * values[1::-1],
            "periodic": values[-2:],
            "pinned": _extrapolate(values[:5])[::-1],
        }[self.ends[0]]
        right = {
            "mirror": parity * values[: n - 3 : -1],
            "periodic": values[:2],
            "pinned": _extrapolate(values[: n - 6 : -1]),
        }[self.ends[1]]
        return np.concatenate([left, values, right])

    def mean_of_neighbors(self, values: Array, counts: NDArray[np.bool_]) -> Array:
        """Binomial mean (count,) of five columns, of those that count; fewer beside a pin."""
        modes: dict[End, Literal["symmetric", "wrap", "constant"]]
        # the columns beyond the ends count as far as the line goes on there
        modes = {"mirror": "symmetric", "periodic": "wrap", "pinned": "constant"}
        left, right = modes[self.ends[0]], modes[self.ends[1]]
        both = np.stack([values * counts, counts.astype(float)])
        both = np.pad(both, ((0, 0), (2, 0)), mode=left)[:, : self.count + 2]
        both = np.pad(both, ((0, 0), (0, 2)), mode=right)

        # weighted sums of the values and of the weights, and their quotient
        sums = [np.convolve(row, BINOMIAL, mode="valid") for row in both]
        return sums[0] / np.maximum(sums[1], 1.0)

    def _stencil(self, weights: Array, values: Array, parity: float) -> Array:
        """Sum of five neighboring values with weights; at pinned ends of the quartic."""
        return np.convolve(self.extend(values, parity), weights[::-1], mode="valid")


def _extrapolate(values: Array) -> Array:
    """The next two values beyond the first of five, on the quartic through them."""
    a, b, c, d, e = values
    # the fifth difference vanishes on a quartic
    first = 5.0 * a - 10.0 * b + 10.0 * c - 5.0 * d + e
    return np.array([first, 5.0 * first - 10.0 * a + 10.0 * b - 5.0 * c + d])


def differences(count: int, order: int, ends: tuple[End, End], parity: float) -> csc_matrix:
    """Matrix of the differences of an order along a line, (rows, count).

    The sum of their squares is that over the whole line, of which a plane of symmetry leaves half:
    a difference across it counts half.
    """
    from scipy.sparse import csc_matrix

    binomial = [(-1) ** j * comb(order, j) for j in range(order + 1)]
    entries: list[tuple[int, int, float]] = []
    row = 0
    # differences that reach into the line, and lie within it beside a pinned end
    for begin in range(-order, count):
        places = [_place(begin + j, count, ends, parity) for j in range(order + 1)]
        inside = [0 <= begin + j < count for j in range(order + 1)]
        if None in places or not any(inside) or (begin < 0 and ends[0] == "periodic"):
            continue

        # those of a period count once; those across a plane of symmetry are seen from both sides
        share = 1.0 if all(inside) or "periodic" in ends else 0.5**0.5
        for weight, place in zip(binomial, places, strict=True):
            assert place is not None
            entries.append((row, place[0], share * weight * place[1]))
        row += 1
    rows, columns, values = (np.array(part) for part in zip(*entries, strict=True))
    return csc_matrix((values, (rows, columns)), shape=(row, count))


def _place(
    index: int, count: int, ends: tuple[End, End], parity: float
) -> tuple[int, float] | None:
    """Column and sign of a place on the continued line; None beyond a pinned end."""
    if 0 <= index < count:
        return index, 1.0
    end = ends[0] if index < 0 else ends[1]
    if end == "periodic":
        return index % count, 1.0
    if end == "mirror":
        return (-1 - index if index < 0 else 2 * count - 1 - index), parity
    return None
