"""Values at even places of a surface: at 0 between them, and whether periods fit."""

from __future__ import annotations

import numpy as np

WHOLE = 1e-6
"""Rounding of lengths that must fit a whole number of times."""


def value_at_zero(x: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Values at x = 0 of those at even places (n,) [m], (n, ...) -> (...), by four around it.

    Places that begin above 0 go on as their mirror image: (9 v_1 - v_2) / 8.
    """
    if x[0] > 0.0:
        return (9.0 * values[0] - values[1]) / 8.0
    # Lagrange's polynomial through the four columns around 0, taken there
    first = int(np.clip(np.searchsorted(x, 0.0) - 2, 0, max(x.size - 4, 0)))
    x, values = x[first : first + 4], values[first : first + 4]
    found = np.zeros(values.shape[1:])
    for k in range(x.size):
        others = np.delete(x, k)
        found = found + values[k] * np.prod(others / (others - x[k]))
    return found


def refuse_parts(width: float, period: float) -> None:
    """Refuse a width that holds no whole half periods [m]. Raises ValueError."""
    halves = width / (0.5 * period)
    if halves < 0.5 or abs(halves - round(halves)) > WHOLE * halves:
        raise ValueError(f"a width of {width:g} m holds no whole half periods of {period:g} m")
