"""A measured profile as the target of a calibration: a few numbers that no alignment changes.

    z = a + b x + c y + h((x - x_0)/s; keys) + noise of standard error sigma

h repeats, that of a run of one period. The measurement is aligned with the run that it fits best
(`texture.compare`). About that place everything is linear: a, b, c, x_0 are taken out of measured
and computed heights by projection, and so is s as far as it is not known beforehand. Of what is
left of the computed heights, at the measured points, principal components u_k over the runs
[Jolliffe2016] give the numbers of a profile,

    d_k = u_k z / sqrt n,   m_k = u_k h / sqrt n,   of standard error sigma sqrt(tau / n)

with independent errors, as the u_k are orthonormal: each is emulated and compared as a width or a
depth is. Components that differ among the runs by less than a tenth of that error tell nothing and
are left out. tau is the correlation length of what no sum of the runs explains, see `compare`; the
sum of its squares adds to chi^2, so that a relief that no run has is noticed.

Alignment and components follow from the finished runs in their order, anew with each that is added.

[Jolliffe2016] Jolliffe, Cadima, Phil. Trans. R. Soc. A 374, 20150202 (2016).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import gammaincc

from lasersph.output import Run
from lasersph.studies.calibration_plan import CalibrationPlan, NoCalibration, ProfileTarget
from lasersph.studies.measured_value import Measured
from lasersph.studies.texture.cells import read_cell
from lasersph.studies.texture.compare import Comparison, compare
from lasersph.studies.texture.measurement import correlation_length
from lasersph.studies.texture.relief import repeating_relief

Array = NDArray[np.float64]
Numbers = Mapping[str, float]
COMPONENT = "profile_"
"""First letters of the names of components."""
PLACES = 256
"""Of a period at which runs tell their height: as many as 5 um have particles of 20 nm."""
TELLING = 0.1
"""Standard deviation of a component among the runs over its standard error, below which it could
move no unknown by a tenth of its band."""


def height_numbers(run: Run, period: float) -> dict[str, float]:
    """Heights of a complete run over its period as numbers beside those of its summary [m].

    Raises:
        OutputError: the run is none of one period, or its surface does not move.
    """
    cell = read_cell(run, period)
    heights = np.interp(_places(period), cell.x, cell.values["height"], period=period)
    return {_name(number): float(value) for number, value in enumerate(heights)}


def heights_of(numbers: Numbers | None) -> Array:
    """Heights of a run at even places of its period (PLACES,) [m]; NaN of a run without."""
    every = {} if numbers is None else numbers
    return np.array([every.get(_name(number), np.nan) for number in range(PLACES)])


def _name(number: int) -> str:
    return f"relief.{number}"


def _places(period: float) -> Array:
    return (np.arange(PLACES) + 0.5) * period / PLACES


@dataclass(frozen=True, eq=False)
class ProfileFit:
    """A measured profile reduced to components; n is the number of its points, k of components.

    Attributes:
        number: of the measurement, from 1. period: [m]. comparison: with the run that fits best.
        middle: (n,) mean of the runs at the measured points [m].
        shapes: (k, n) heights [m] that a component of 1 m adds to it.
        values: (k,) components of the measured profile [m]. standard_error: of each [m].
        nuisances: (n, 4 or 5) what alignment changes: level, tilts, place, lateral scale.
        tau: correlation length of what is left over, in points. left_over: its rms [m].
        probability: of so large a rest of noise of the stated standard error.
    """

    number: int
    period: float
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
        """Of the components, as numbers of a run."""
        return [f"{COMPONENT}{self.number}.component_{k + 1}_m" for k in range(self.values.size)]

    @property
    def measured(self) -> dict[str, Measured]:
        """The components by name [m]."""
        pairs = zip(self.names, self.values, strict=True)
        return {name: Measured(float(value), self.standard_error) for name, value in pairs}

    def heights(self, components: ArrayLike) -> Array:
        """Computed heights (n,) [m] of components (k,) [m]."""
        return self.middle + np.asarray(components, float) @ self.shapes

    def at(self, relief: Array) -> Array:
        """Heights (n,) of a relief over its period (PLACES,) at the measured points [m]."""
        x = self.comparison.x
        return np.interp(x, _places(self.period), relief, period=self.period)

    def measured_beside(self, computed: Array) -> Array:
        """Measured heights (n,), aligned with computed ones (n,) [m]."""
        left = self.comparison.measured - computed
        moved = np.linalg.lstsq(self.nuisances, left, rcond=None)[0]
        return self.comparison.measured - self.nuisances @ moved

    def difference(self, computed: Array) -> float:
        """rms of what measured and computed heights (n,) differ by once aligned [m]."""
        return float(np.sqrt(np.mean((self.measured_beside(computed) - computed) ** 2)))


def reduce_profiles(
    plan: CalibrationPlan, numbers: Sequence[Numbers | None]
) -> tuple[CalibrationPlan, list[Numbers | None], list[ProfileFit]]:
    """A plan whose profiles are measured components, and runs with these numbers.

    Raises:
        NoCalibration: no two runs have a relief, none can be aligned, or all are the same.
    """
    fits: list[ProfileFit] = []
    conditions, found = list(plan.conditions), list(numbers)
    for place, condition in enumerate(plan.conditions):
        if condition.profile is None:
            continue
        reliefs = np.array([heights_of(one) for one in numbers])
        fit, components = _fit(place + 1, condition.profile, reliefs)
        fits.append(fit)
        conditions[place] = replace(condition, values={**condition.values, **fit.measured})
        for row, one in enumerate(found):
            if one is not None and np.isfinite(components[row]).all():
                named = zip(fit.names, components[row].tolist(), strict=True)
                found[row] = {**one, **dict(named)}
    return replace(plan, conditions=tuple(conditions)), found, fits


def _fit(number: int, target: ProfileTarget, reliefs: Array) -> tuple[ProfileFit, Array]:
    """The fit of one profile, and components (runs, k) of runs with heights (runs, PLACES) [m]."""
    has = np.isfinite(reliefs[:, 0])
    best, nearest = _nearest(number, target, reliefs[has])
    places, step, x = _places(target.period), target.period / PLACES, best.x

    def at(heights: Array, moved: float = 0.0) -> Array:
        return np.interp(x + moved, places, heights, period=target.period)

    computed = np.array([at(one) for one in reliefs[has]])
    middle, root = computed.mean(axis=0), np.sqrt(x.size)
    slope = (at(nearest, step) - at(nearest, -step)) / (2.0 * step)
    tilts = [np.ones_like(x), x] + ([best.y] if np.ptp(best.y) > 0.0 else [])
    scale = best.values["lateral_scale"]
    stretch = -slope * x / scale  # dh/ds
    # s is 1 +- its error beforehand: the one moves the heights, the other widens their errors
    measured = best.measured - stretch * (1.0 - scale) - middle
    free, widened = np.stack([*tilts, slope], axis=1), target.scale_error * stretch
    tau, sd, rest = 1.0, target.error, measured
    for _ in range(2):  # the second time with the tau of what the first leaves over
        sd = target.error * np.sqrt(tau)
        left, sizes, right = np.linalg.svd(_project(computed - middle, free, widened / sd), False)
        tells = sizes / np.sqrt(len(sizes)) > TELLING * sd
        if not tells.any():
            raise NoCalibration(
                f"profile {number} tells nothing: the {len(sizes)} runs differ by less than its "
                f"standard error of {1e9 * target.error:.3g} nm"
            )
        rest = _project(measured[None], free, widened / sd)[0]
        values = right[tells] @ rest
        rest = rest - values @ right[tells]
        tau = correlation_length(rest, target.surface)
    freedom = (x.size - free.shape[1] - 1 - values.size) / tau
    components = np.full((has.size, values.size), np.nan)
    components[has] = left[:, tells] * sizes[tells] / root
    fit = ProfileFit(
        number=number,
        period=target.period,
        comparison=best,
        middle=middle,
        shapes=root * (left[:, tells] / sizes[tells]).T @ (computed - middle),
        values=values / root,
        standard_error=target.error * float(np.sqrt(tau)) / root,
        nuisances=np.column_stack([free, stretch]),
        tau=tau,
        left_over=float(np.sqrt(np.mean(rest**2))),
        probability=float(gammaincc(0.5 * freedom, 0.5 * (rest @ rest) / sd**2)),
    )
    return fit, components


def _nearest(number: int, target: ProfileTarget, reliefs: Array) -> tuple[Comparison, Array]:
    """The comparison with the run that fits best, and its heights. Raises NoCalibration."""
    places, found = _places(target.period), []
    for heights in reliefs:
        if np.ptp(heights) > 0.0:
            ours = repeating_relief("", places, heights, target.period)
            found.append((compare(ours, target.surface, target.scale_error), heights))
    if len(found) < 2:
        raise NoCalibration(f"profile {number}: fewer than two runs leave a relief")
    return min(found, key=lambda one: float(np.sum(one[0].residual ** 2)))


def _project(rows: Array, free: Array, widened: Array) -> Array:
    """Rows (m, n) without the directions `free` (n, q), and with the direction `widened` (n,), in
    standard errors of a point, as much smaller as its error is larger."""
    basis = np.linalg.qr(free)[0]
    rows = rows - (rows @ basis) @ basis.T
    widened = widened - basis @ (basis.T @ widened)
    square = float(widened @ widened) or 1.0
    part = (1.0 - 1.0 / np.sqrt(1.0 + square)) / square
    return rows - part * np.outer(rows @ widened, widened)
