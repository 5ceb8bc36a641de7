"""Order of convergence, Richardson extrapolation and the grid convergence index.

With f1 (finest), f2, f3 (coarsest) computed at spacings in a constant ratio r,

    p = log((f3 - f2)/(f2 - f1)) / log r                          [Alshaer2017, eq. 35; Roache]
    f = f1 + (f1 - f2)/(r^p - 1)                                  Richardson's estimate
    GCI = F_s |eps| / (r^p - 1),  F_s = 1.25                      [Alshaer2017, eq. 37]

where eps is the relative change (f2 - f1)/f1, or in the paper's eq. 36 the relative error
(f1 - f_exact)/f_exact. (The paper numbers f1 the coarsest in eq. 35 and the finest in eq. 36; here
f1 is always the finest.) For any ratios r21 = d2/d1 and r32 = d3/d2 the procedure of [Celik2008],
eq. (3), asks for

    |f3 - f2|/|f2 - f1| = r21^p (r32^p - s)/(r21^p - s),  s the sign of (f3 - f2)/(f2 - f1)

s = -1 is its oscillating convergence, which gets the same index. Two deviations, for numbers that
the procedure leaves open: p is taken as 2 where it comes out larger, since no operator here is of a
higher order; and where the changes grow (the procedure takes the absolute value of the logarithm,
so that a diverging number passes for a converging one) the index is that of p = 1/2 with the factor
F_s = 3 that [Roache1994] asks for where the order is not to be trusted. No number gets a larger
one. Where one change vanishes the procedure does not work: the uncertainty is then the largest
difference between the three.

[Roache1994] Roache, J. Fluids Eng. 116 (1994) 405; Roache, Annu. Rev. Fluid Mech. 29 (1997) 123;
[Celik2008] Celik et al., J. Fluids Eng. 130 (2008) 078001;
[Alshaer2017] Alshaer et al., Comput. Mater. Sci. 127 (2017) 161.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

SAFETY_FACTOR = 1.25
SAFETY_FACTOR_WITHOUT_ORDER = 3.0
LEAST_ORDER, LARGEST_ORDER = 0.5, 2.0
ROUNDING = 1e-12
"""Relative changes below this are rounding."""


@dataclass(frozen=True)
class Convergence:
    """Convergence of one number over three or more spacings.

    kind: "converging" (the changes shrink, same sign), "oscillating" (their sign alternates),
    "diverging" (they grow), "stepped" (two neighbors agree to rounding and the third differs, as
    sizes in whole cells do), "exact" (all agree to rounding). `order` and `extrapolated` are nan
    unless the number converges (exact: order nan). `uncertainty` of the finest result has its unit,
    `gci` is the same relative to it (nan where that is 0).
    """

    kind: str
    order: float
    extrapolated: float
    uncertainty: float
    gci: float


def observed_order(values: Sequence[float], spacings: Sequence[float]) -> float:
    """Order p from three results, finest first; nan where they do not converge monotonically.

    Raises:
        ValueError: not three of each, or the spacings do not grow.
    """
    if len(values) != 3 or len(spacings) != 3:
        raise ValueError("the order needs three values and three spacings")
    if not 0.0 < spacings[0] < spacings[1] < spacings[2]:
        raise ValueError(f"spacings must grow from the finest to the coarsest, not {spacings}")
    fine, coarse = values[1] - values[0], values[2] - values[1]
    return math.nan if fine * coarse <= 0.0 else _apparent_order(fine, coarse, spacings)


def _apparent_order(fine: float, coarse: float, spacings: Sequence[float]) -> float:
    """Order p of two changes, neither of them 0, of one sign or of two [Celik2008, eq. 3].

    For unequal ratios nan where there is none in (0.05, 20): the left-hand side grows with p, so
    that bisection finds the only root.
    """
    log_change = math.log(abs(coarse / fine))
    log_fine, log_coarse = (math.log(spacings[k + 1] / spacings[k]) for k in (0, 1))
    # equal ratios: the order in closed form
    if math.isclose(log_fine, log_coarse, rel_tol=1e-9):
        return log_change / log_fine
    sign = math.copysign(1.0, coarse / fine)

    def excess(p: float) -> float:
        ratio = (math.exp(p * log_coarse) - sign) / (math.exp(p * log_fine) - sign)
        return p * log_fine + math.log(ratio) - log_change

    # bisection for the root of eq. (3)
    low, high = 0.05, 20.0
    if excess(low) > 0.0 or excess(high) < 0.0:
        return math.nan
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) < 0.0 else (low, middle)
    return 0.5 * (low + high)


def richardson(fine: float, medium: float, ratio: float, order: float) -> float:
    """Value at vanishing spacing from the two finest results."""
    return fine + (fine - medium) / (ratio**order - 1.0)


def relative_error(value: float, exact: float) -> float:
    """(f - f_exact) / f_exact [Alshaer2017, eq. 36]."""
    return (value - exact) / exact


def grid_convergence_index(
    relative_change: float, ratio: float, order: float, safety_factor: float = SAFETY_FACTOR
) -> float:
    """Relative uncertainty F_s |eps| / (r^p - 1) of the finest result [Alshaer2017, eq. 37]."""
    return safety_factor * abs(relative_change) / (ratio**order - 1.0)


def assess(values: Sequence[float], spacings: Sequence[float]) -> Convergence:
    """Order, extrapolated value and uncertainty of the three finest results, in any order.

    Raises:
        ValueError: fewer than three results, or two equal spacings.
    """
    # the three finest, f1 first
    pairs = sorted(zip(spacings, values, strict=True))[:3]
    spacing, value = [d for d, _ in pairs], [v for _, v in pairs]
    order = observed_order(value, spacing)
    fine, coarse = value[1] - value[0], value[2] - value[1]

    # changes of the size of rounding have no order
    smallest = ROUNDING * max(abs(v) for v in value)
    is_level = [abs(change) <= smallest for change in (fine, coarse)]
    if all(is_level):
        return Convergence("exact", math.nan, value[0], 0.0, 0.0)
    limit, ratio = math.nan, spacing[1] / spacing[0]
    if any(is_level):
        kind, order, uncertainty = "stepped", math.nan, max(value) - min(value)
    else:
        # kind by sign and size of the two changes
        uncertainty = _uncertainty(fine, ratio, _apparent_order(fine, coarse, spacing))
        if fine * coarse < 0.0:
            kind = "oscillating"
        elif math.isnan(order) or order <= 0.0:
            kind, order = "diverging", math.nan
        else:
            kind, limit = "converging", richardson(value[0], value[1], ratio, order)
            limit = limit if abs(limit) > smallest else 0.0
    gci = uncertainty / abs(value[0]) if value[0] else math.nan
    return Convergence(kind, order, limit, uncertainty, gci)


def _uncertainty(change: float, ratio: float, order: float) -> float:
    """Grid convergence index of a change, in its unit, with the order kept to what is credible."""
    # p between 1/2 with F_s = 3, where it is not to be trusted, and 2
    largest = grid_convergence_index(change, ratio, LEAST_ORDER, SAFETY_FACTOR_WITHOUT_ORDER)
    if math.isnan(order) or order <= 0.0:
        return largest
    return min(grid_convergence_index(change, ratio, min(order, LARGEST_ORDER)), largest)
