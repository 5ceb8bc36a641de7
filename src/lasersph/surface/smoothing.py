"""Smoothing of the heights of a surface, and of what it carries, along a line of columns.

F eta minimizes

    sum (f - eta)^2 + (lambda_c/2 pi)^(2n) sum (D^n f)^2 + 100 sum over pinned ends (f_end - pin)^2

[Whittaker1923], D^n the n-th difference over dx^n. A wave of length lambda >> dx keeps the part
1/(1 + (lambda_c/lambda)^(2n)) of its height. On a grid of two axes `pool_field` minimizes the same
with the differences of all directions. Across a plane of symmetry the field goes on as its mirror
image. Where it is pinned no slope is assumed: differences lie inside, polynomials of degree n - 1
pass unchanged.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import comb, pi, sqrt
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:  # SciPy's matrices take a tenth of a second to load, and few runs have a surface
    from scipy.sparse import csc_matrix, csr_matrix
    from scipy.sparse.linalg import SuperLU

Array = NDArray[np.float64]
End = Literal["mirror", "periodic", "pinned"]
Ends = tuple[End, End]
EVEN_PARITY, ODD_PARITY = 1.0, -1.0
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


@dataclass(frozen=True)
class Smoothing:
    """F for one parity: solves (1 + D^T D + P^T P) f = eta + P^T pins, on flat arrays."""

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
        has_pins = pinned.size > 0
        f = self.inverse.solve(values + (P_T @ pinned if has_pins else 0.0))
        # iterative refinement: each pass solves for the residual of the one before
        for _ in range(REFINEMENTS):
            residual = values - f - D_T @ (D @ f)
            f = f + self.inverse.solve(residual - P_T @ (P @ f - pinned) if has_pins else residual)
        return f


def smoothing_of(
    count: int, width: float, ends: Ends, cutoff: float, parity: float, *, passes_pins: bool
) -> Smoothing:
    """F of a field with a parity.

    Args:
        count: of columns. width: theirs [m]. ends: how the field goes on at both ends. cutoff:
            lambda_c [m]. passes_pins: whether pinned ends have a value.
    """
    from scipy.sparse import csc_matrix, identity, vstack
    from scipy.sparse.linalg import splu

    # D: differences of order n, so scaled that waves of length lambda_c keep half
    order = PINNED_ORDER if "pinned" in ends else ORDER
    strength = (cutoff / (2.0 * pi * width)) ** order
    D = csc_matrix(strength * differences(count, order, ends, parity))

    # P: the cubic through four columns meets each pinned end
    pinned = pinned_ends(ends) if passes_pins else []
    rows = [sqrt(PIN_WEIGHT) * end_values(count, end) for end in pinned]
    P = csc_matrix(vstack([csc_matrix((0, count)), *rows]))

    # the matrix of the normal equations 1 + D^T D + P^T P, factorized once
    both = vstack([D, P]).tocsc()
    return Smoothing(D, P, splu((identity(count) + both.T @ both).tocsc()))


def pinned_ends(ends: Ends) -> list[int]:
    """Numbers (0 or 1) of the pinned ends, in the order of the rows of P."""
    return [end for end, kind in enumerate(ends) if kind == "pinned"]


def end_values(count: int, end: int) -> csc_matrix:
    """Matrix (1, count) of the value at an end of a line."""
    from scipy.sparse import csc_matrix

    row = np.zeros(count)
    row[:4] = AT_END
    return csc_matrix((row if end == 0 else row[::-1]).reshape(1, -1))


def differences(count: int, order: int, ends: Ends, parity: float) -> csc_matrix:
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
        places = [place_on_line(begin + j, count, ends, parity) for j in range(order + 1)]
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


def place_on_line(index: int, count: int, ends: Ends, parity: float) -> tuple[int, float] | None:
    """Column and sign of a place on the continued line; None beyond a pinned end."""
    if 0 <= index < count:
        return index, 1.0
    end = ends[0] if index < 0 else ends[1]
    if end == "periodic":
        return index % count, 1.0
    if end == "mirror":
        return (-1 - index if index < 0 else 2 * count - 1 - index), parity
    return None
