"""A measured profile or map as the target of a calibration: numbers that no alignment changes.

    z = a + b x + c y + h((x - x_0)/s, (y - y_0)/s; keys) + noise of standard error sigma

h repeats, that of a run of one period, or it is that of a spot, assembled from cells
(`calibration_spot`), or that of a round one, a section (r, z). The measurement is aligned with the
relief that it fits best, of a spot of cells at any factor on the fluence (`texture.compare`). About
that place everything is linear: a, b, c, x_0, of
a map its angle, and y_0 of a spot are taken out of measured and computed heights by projection, and
so is s as far as it is not known beforehand. Of what is left of the computed heights, at the
measured points, principal components u_k over the runs [Jolliffe2016] give the numbers,

    d_k = u_k z / sqrt n,   m_k = u_k h / sqrt n,   of standard error sigma sqrt(tau / n)

with independent errors, as the u_k are orthonormal: each is emulated and compared as a width or a
depth is. Components that differ among the runs by less than a tenth of that error tell nothing and
are left out. tau counts the points that are correlated in what no sum of the runs explains, see
`texture.measurement`; the sum of its squares adds to chi^2, so that a relief that no run has is
noticed.

Alignment and components follow from the finished runs in their order, anew with each that is added.

[Jolliffe2016] Jolliffe, Cadima, Phil. Trans. R. Soc. A 374, 20150202 (2016).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import gammaincc

from lasersph.studies.calibration_plan import CalibrationPlan, NoCalibration
from lasersph.studies.calibration_target import ProfileTarget
from lasersph.studies.measured_value import Measured
from lasersph.studies.texture.compare import MOST_POINTS, AnyRelief, Comparison, compare
from lasersph.studies.texture.measurement import NoComparison, correlated_points

Array = NDArray[np.float64]
Numbers = Mapping[str, float]
Reliefs = Sequence[AnyRelief | None]
COMPONENT = "profile_"
"""First letters of the names of components."""
STEPS = 256
"""Of a period, by which a relief is moved for its slope: 5 um have as many particles of 20 nm."""
TELLING = 0.1
"""Standard deviation of a component among the runs over its standard error, below which it could
move no unknown by a tenth of its band."""


@dataclass(frozen=True, eq=False)
class ProfileFit:
    """A measured profile reduced to components; n is the number of its points, k of components.

    Attributes:
        number: of the measurement, from 1. comparison: with the relief that fits best.
        middle: (n,) mean of the runs at the measured points [m].
        shapes: (k, n) heights [m] that a component of 1 m adds to it.
        values: (k,) components of the measured profile [m]. standard_error: of each [m].
        nuisances: (n, 4 to 7) what alignment changes: level, tilts, place, angle, lateral scale.
        tau: correlated points of what is left over. left_over: its rms [m].
        probability: of so large a residual by noise of the stated standard error.
    """

    number: int
    comparison: Comparison
    middle: Array
    shapes: Array
    values: Array
    standard_error: float
    nuisances: Array
    tau: float
    left_over: float
    probability: float

    @property
    def names(self) -> list[str]:
        """Of the components, as numbers of a run [m]."""
        # "..._1_m" would end in the unit 1/m
        numbers = range(1, self.values.size + 1)
        return [f"{COMPONENT}{self.number}.component_{k}_height_m" for k in numbers]

    @property
    def measured(self) -> dict[str, Measured]:
        """The components by name [m]."""
        pairs = zip(self.names, self.values, strict=True)
        return {name: Measured(float(value), self.standard_error) for name, value in pairs}

    def heights(self, components: ArrayLike) -> Array:
        """Computed heights (n,) [m] of components (k,) [m]."""
        return self.middle + np.asarray(components, float) @ self.shapes

    def at(self, relief: AnyRelief) -> Array:
        """Heights (n,) of a relief at the measured points [m]."""
        return relief.at(self.comparison.x, self.comparison.y, 1.0)

    def measured_beside(self, computed: Array) -> Array:
        """Measured heights (n,), aligned with computed ones (n,) [m]."""
        # alignment anew: least squares of what it changes
        left = self.comparison.measured - computed
        moved = np.linalg.lstsq(self.nuisances, left, rcond=None)[0]
        return self.comparison.measured - self.nuisances @ moved

    def difference(self, computed: Array) -> float:
        """rms of what measured and computed heights (n,) differ by once aligned [m]."""
        return float(np.sqrt(np.mean((self.measured_beside(computed) - computed) ** 2)))


def reduce_profiles(
    plan: CalibrationPlan, numbers: Sequence[Numbers | None], reliefs: Reliefs
) -> tuple[CalibrationPlan, list[Numbers | None], list[ProfileFit]]:
    """A plan whose profiles are measured components, and runs with these numbers.

    Args:
        numbers, reliefs: of the runs in their order, None of those that fail.

    Raises:
        NoCalibration: no two runs have a relief, none can be aligned, or all are the same.
    """
    fits: list[ProfileFit] = []
    conditions, found = list(plan.conditions), list(numbers)
    for place, condition in enumerate(plan.conditions):
        if condition.profile is None:
            continue
        fit, components = _fit(place + 1, condition.profile, reliefs)
        fits.append(fit)
        conditions[place] = replace(condition, values={**condition.values, **fit.measured})
        for row, one in enumerate(found):
            if one is not None and np.isfinite(components[row]).all():
                named = zip(fit.names, components[row].tolist(), strict=True)
                found[row] = {**one, **dict(named)}
    return replace(plan, conditions=tuple(conditions)), found, fits


def _fit(number: int, target: ProfileTarget, reliefs: Reliefs) -> tuple[ProfileFit, Array]:
    """The fit of one profile, and components (runs, k) of the runs."""
    known = [one for one in reliefs if one is not None]
    best, nearest = _nearest(number, target, known)
    x, y, is_map = best.x, best.y, np.ptp(best.y) > 0.0

    # slope of the relief about the place of alignment, by central differences
    factor, step = best.values.get("fluence_factor", 1.0), nearest.period / STEPS

    def slope(along: float, across: float) -> Array:
        before, after = (
            nearest.at(x + sign * along * step, y + sign * across * step, factor)
            for sign in (-1.0, 1.0)
        )
        return (after - before) / (2.0 * step)

    # directions in which alignment moves the heights: level, tilts, shifts, angle
    computed = np.array([one.at(x, y, 1.0) for one in known])
    middle, root = computed.mean(axis=0), np.sqrt(x.size)
    slope_x, slope_y = slope(1.0, 0.0), np.zeros_like(x)
    moves = [np.ones_like(x), x, slope_x]
    if is_map and nearest.is_spot:
        slope_y = slope(0.0, 1.0)
        moves.append(slope_y)
    if is_map:
        moves += [y] if nearest.is_round else [y, y * slope_x - x * slope_y]
    free, scale = np.stack(moves, axis=1), best.values["lateral_scale"]
    scale_slope = -(x * slope_x + y * slope_y) / scale  # dh/ds
    # s is 1 +- its error beforehand: the one moves the heights, the other widens their errors
    measured = best.measured - scale_slope * (1.0 - scale) - middle
    widened = target.scale_error * scale_slope

    # principal components of the runs, without what alignment explains
    tau, sd, residual = 1.0, target.error, measured
    for _ in range(2):  # the second time with the tau of what the first leaves over
        sd = target.error * np.sqrt(tau)
        left, sizes, right = np.linalg.svd(_project(computed - middle, free, widened / sd), False)
        tells = sizes / np.sqrt(len(sizes)) > TELLING * sd
        if not tells.any():
            raise NoCalibration(
                f"profile {number} tells nothing: the {len(sizes)} runs differ by less than its "
                f"standard error of {1e9 * target.error:.3g} nm"
            )
        residual = _project(measured[None], free, widened / sd)[0]
        # d_k, and what no sum of the components explains
        values = right[tells] @ residual
        residual = residual - values @ right[tells]
        tau = correlated_points(residual, target.surface, MOST_POINTS)

    # components m_k of the runs, and degrees of freedom of the remainder
    freedom = (x.size - free.shape[1] - 1 - values.size) / tau
    components = np.full((len(reliefs), values.size), np.nan)
    components[[one is not None for one in reliefs]] = left[:, tells] * sizes[tells] / root
    fit = ProfileFit(
        number=number,
        comparison=best,
        middle=middle,
        shapes=root * (left[:, tells] / sizes[tells]).T @ (computed - middle),
        values=values / root,
        standard_error=target.error * float(np.sqrt(tau)) / root,
        nuisances=np.column_stack([free, scale_slope]),
        tau=tau,
        left_over=float(np.sqrt(np.mean(residual**2))),
        probability=float(gammaincc(0.5 * freedom, 0.5 * (residual @ residual) / sd**2)),
    )
    return fit, components


def _nearest(
    number: int, target: ProfileTarget, reliefs: Sequence[AnyRelief]
) -> tuple[Comparison, AnyRelief]:
    """The comparison with the relief that fits best. Raises NoCalibration."""
    uneven = [one for one in reliefs if not one.is_flat]
    tables: dict[int, AnyRelief] = {}  # spots of one table differ by their light alone
    for one in uneven:
        tables.setdefault(one.family, one)
    found = [(_aligned(one, target), one) for one in tables.values()]
    good = [(aligned, one) for aligned, one in found if aligned is not None]
    if len(uneven) < 2 or not good:
        raise NoCalibration(f"profile {number}: fewer than two runs leave a relief")
    return min(good, key=lambda one: float(np.sum(one[0].residual ** 2)))


@lru_cache(maxsize=64)
def _aligned(relief: AnyRelief, target: ProfileTarget) -> Comparison | None:
    """The comparison with a relief, made once; None where that is flat beside the measurement."""
    try:
        return compare(relief, target.surface, target.scale_error)
    except NoComparison:
        return None


def _project(rows: Array, free: Array, widened: Array) -> Array:
    """Rows (m, n) without the directions `free` (n, q), and with the direction `widened` (n,), in
    standard errors of a point, as much smaller as its error is larger."""
    # remove the free directions, then shrink along the one that is known beforehand
    basis = np.linalg.qr(free)[0]
    rows = rows - (rows @ basis) @ basis.T
    widened = widened - basis @ (basis.T @ widened)
    square = float(widened @ widened) or 1.0
    # the root of the inverse of 1 + w w^T takes this part off along w
    part = (1.0 - 1.0 / np.sqrt(1.0 + square)) / square
    return rows - part * np.outer(rows @ widened, widened)
