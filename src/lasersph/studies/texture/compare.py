"""A measured profile or map beside ours: leveled, aligned, and the fluence that explains it.

    z = a + b x + c y + h((x - x_0)/s, (y - y_0)/s; f) + noise

Offset and tilts a, b, c, place x_0, y_0 and lateral scale s are those of the measurement. h is our
relief, of a texture at f times its local fluence: its cells tell it at any f that they cover. Of a
run of one cell h repeats, and f is 1. A profile is taken as the line through the center of a spot.

The sum of squares is least over all of them: a, b, c are solved for exactly at each trial of the
others [Golub1973]. The start is the best of all places on a grid. Standard errors are those of the
linear problem at the minimum, with the variance of the residuals times their correlation length,
tau = 1 + 2 sum rho_k (to the first k at which rho_k is not above 0): residuals of a wrong model are
not independent. Of the lateral scale it is known beforehand that it is 1 to 3 %.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lasersph.output.height_map import HeightMap
from lasersph.studies.texture.measurement import (
    NoComparison,
    correlation_length,
    point_noise,
    points_of,
    refuse_odd,
)
from lasersph.studies.texture.relief import Relief

Array = NDArray[np.float64]
SCALE_ERROR = 0.03
"""Standard deviation of the lateral scale of microscopes before they are calibrated, beforehand."""
STARTS, STARTS_A_PERIOD = 3, 12
"""Minima that are followed, and places of a period among which they are looked for."""
LOWEST_FACTOR = 0.3
NORMAL_95 = 1.959964
"""Half width of the 95 % interval of a normal distribution in standard deviations."""


@dataclass(frozen=True, eq=False)
class Comparison:
    """A measurement aligned with ours.

    Attributes:
        x, y: (n,) places in our coordinates [m]. measured: (n,) leveled heights [m].
        ours: (n,) heights [m]. values, errors: of the unknowns by name, with standard errors.
        at_bound: names of unknowns that ended at a bound. noise: standard deviation from point to
            point [m]. tau: correlation length of the residuals, in points.
        height_factor: measured heights over ours, with its standard error.
        interpolation: rms error of ours [m].
    """

    x: Array
    y: Array
    measured: Array
    ours: Array
    values: Mapping[str, float]
    errors: Mapping[str, float]
    at_bound: tuple[str, ...]
    noise: float
    tau: float
    height_factor: tuple[float, float]
    interpolation: float

    @property
    def residual(self) -> Array:
        """Measured less ours (n,) [m]."""
        return self.measured - self.ours

    def interval(self, name: str) -> tuple[float, float]:
        """95 % interval of an unknown."""
        value, half = self.values[name], NORMAL_95 * self.errors[name]
        return value - half, value + half


def compare(relief: Relief, surface: HeightMap, scale_error: float = SCALE_ERROR) -> Comparison:
    """Align a measured profile or map with our relief.

    Args:
        scale_error: standard deviation of the lateral scale beforehand.

    Raises:
        NoComparison: it is shorter than a period, too coarse for one, too flat to align, or its
            unit can't be right.
    """
    from scipy.optimize import least_squares

    x, y, z = points_of(surface)
    period = relief.table.period
    refuse_odd(surface, period)
    columns = [np.ones_like(x), x - x.mean()] + ([y - y.mean()] if np.ptp(y) > 0.0 else [])
    basis = np.linalg.qr(np.stack(columns, axis=1))[0]
    low, high = LOWEST_FACTOR, relief.largest_factor
    names = ["shift_x_m", *(["shift_y_m"] if np.ptp(y) > 0.0 else []), "lateral_scale"]
    names += ["fluence_factor"] if relief.is_spot else []
    size = float(np.std(z - basis @ (basis.T @ z)))

    def heights(unknowns: Array) -> Array:
        found = dict(zip(names, unknowns, strict=True))
        scale = found["lateral_scale"]
        along = (x - period * found["shift_x_m"]) / scale
        across = (y - period * found.get("shift_y_m", 0.0)) / scale
        return relief.at(along, across, found.get("fluence_factor", 1.0))

    noise = max(point_noise(surface.z), 1e-6 * size)

    def misfit(unknowns: Array) -> Array:
        """Residuals over the noise, and how far the lateral scale is from 1 over its error."""
        left = z - heights(unknowns)
        left = (left - basis @ (basis.T @ left)) / noise
        scale = unknowns[names.index("lateral_scale")]
        return np.append(left, (scale - 1.0) / scale_error)

    start = _start(relief, x, y, z, basis, names)
    bounds = {"lateral_scale": (0.8, 1.25), "fluence_factor": (low, high * (1.0 + 1e-12))}
    ends = np.array([bounds.get(name, (-np.inf, np.inf)) for name in names]).T
    best = None
    for one in start:  # shifts are counted in periods, so that all unknowns are of order 1
        found = least_squares(
            misfit,
            np.clip(one, ends[0] + 1e-9, ends[1] - 1e-9),
            bounds=tuple(ends),
            x_scale=0.01,
            diff_step=1e-5,
        )
        best = found if best is None or found.cost < best.cost else best
    assert best is not None
    residual = noise * misfit(best.x)[:-1]
    freedom = max(z.size - len(names) - basis.shape[1], 1)
    variance, tau = float(residual @ residual) / freedom, correlation_length(residual, surface)
    jacobian = noise * best.jac[:-1]
    precision = jacobian.T @ jacobian / (variance * tau)
    place = names.index("lateral_scale")
    precision[place, place] += 1.0 / scale_error**2
    covariance = np.linalg.pinv(precision, hermitian=True)
    units = [period if name.startswith("shift") else 1.0 for name in names]
    errors = np.sqrt(np.maximum(np.diag(covariance), 0.0)) * units
    ours = heights(best.x)
    if np.std(ours) == 0.0:
        raise NoComparison("our relief is flat where the measurement lies: nothing to align with")
    level = z - ours - residual
    measured, flat = z - level, ours - basis @ (basis.T @ ours)
    factor = float(flat @ z) / float(flat @ flat)
    found = dict(zip(names, best.x, strict=True))
    scale = found["lateral_scale"]
    at_bound = [
        name
        for name in ("fluence_factor",)
        if name in found and min(found[name] - low, high - found[name]) < 1e-6
    ]
    return Comparison(
        (x - period * found["shift_x_m"]) / scale,
        (y - period * found.get("shift_y_m", 0.0)) / scale,
        measured,
        ours,
        dict(zip(names, best.x * units, strict=True)),
        dict(zip(names, errors, strict=True)),
        tuple(at_bound),
        noise,
        tau,
        (factor, float(np.sqrt(variance * tau / (flat @ flat)))),
        relief.error,
    )


def _start(
    relief: Relief, x: Array, y: Array, z: Array, basis: Array, names: list[str]
) -> list[Array]:
    """The best three places on a grid, in periods, with lateral scale 1."""
    period = relief.table.period
    reach = 0.5 * (np.ptp(x) + np.ptp(relief.x)) if relief.is_spot else 0.5 * period
    shifts = np.arange(-reach, reach, period / STARTS_A_PERIOD)
    if "shift_y_m" in names and relief.is_spot:
        # the center across the lines: that of the squares of the leveled heights
        left = z - basis @ (basis.T @ z)
        across = float(np.sum(y * left**2) / np.sum(left**2))
    else:
        across = 0.0
    factors = (1.0,) if not relief.is_spot else (relief.largest_factor * k for k in (0.97, 0.8))
    found = []
    for factor in factors:
        for shift in shifts:
            left = z - relief.at(x - shift, y - across, factor)
            left = left - basis @ (basis.T @ left)
            values = {
                "shift_x_m": shift / period,
                "shift_y_m": across / period,
                "lateral_scale": 1.0,
                "fluence_factor": factor,
            }
            found.append((float(left @ left), np.array([values[name] for name in names])))
    found.sort(key=lambda one: one[0])
    return [one for _, one in found[:STARTS]]


def answer(found: Comparison) -> dict[str, Any]:
    """Content of comparison.json, SI."""
    unknowns = {
        name: {
            "value": found.values[name],
            "standard_error": found.errors[name],
            "interval_95": list(found.interval(name)),
            "is_at_bound": name in found.at_bound,
        }
        for name in found.values
    }
    return {
        "schema_version": 1,
        "unknowns": unknowns,
        "points": int(found.x.size),
        "difference": {
            "rms_m": float(np.sqrt(np.mean(found.residual**2))),
            "largest_m": float(np.max(np.abs(found.residual))),
            "noise_m": found.noise,
            "interpolation_m": found.interpolation,
            "expected_rms_m": float(np.hypot(found.noise, found.interpolation)),
            "correlation_points": found.tau,
        },
        "height_factor": dict(zip(("value", "standard_error"), found.height_factor, strict=True)),
        "largest_ours_m": float(np.max(np.abs(found.ours))),
        "sentence": sentence(found),
    }


def sentence(found: Comparison) -> str:
    """What the measurement can tell, in one sentence."""
    rms = float(np.sqrt(np.mean(found.residual**2)))
    expected = float(np.hypot(found.noise, found.interpolation))
    fits = rms < 1.5 * expected
    text = (
        f"measured and computed heights differ by {1e9 * rms:.3g} nm rms, "
        + ("no more than" if fits else "more than")
        + f" noise and interpolation explain ({1e9 * expected:.3g} nm)"
    )
    if "fluence_factor" in found.at_bound:
        return text + (
            "; the fluence factor lies at the end of what the cells cover: compute a texture of "
            "more pulse energy"
        )
    if "fluence_factor" in found.values:
        low, high = found.interval("fluence_factor")
        text += (
            f"; the local fluence is {found.values['fluence_factor']:.4g} times that of the case "
            f"(95 %: {low:.4g} to {high:.4g}), or the absorptivity is by that factor another: a "
            "profile knows only their product"
        )
    return text
