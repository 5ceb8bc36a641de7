"""Support radius of a pair from the radii of its particles: plain functions (l_i, l_j) -> l_ij."""

from __future__ import annotations

from math import log


def arithmetic(l_i, l_j):
    """Mean of two support radii [m]."""
    return 0.5 * (l_i + l_j)


def common(l_i, l_j):
    """Support radius where all particles have the same [m]: that of a neighbor is not even read."""
    return l_i


def graded(l_i, l_j):
    """Support radius between particles of layers graded by q = 7/9 [m] [Demuth2020, eq. (63)].

    With l_j = l_i q^k the paper's l_i (1 + q) (1 - q^k) / (2 k (1 - q)) is

        l_ij = c (l_i - l_j) / ln(l_i / l_j),    c = (1 + q) (-ln q) / (2 (1 - q)) = 1.00526

    which needs no layer numbers and holds for layers that are cut or joined, too.
    """
    ratio = l_i / l_j
    # the logarithm of a ratio near 1 loses its digits; both formulas agree there to 1e-7
    if abs(ratio - 1.0) < 1.0e-3:
        return 0.5 * (l_i + l_j)
    return 1.005257713 * (l_i - l_j) / log(ratio)
