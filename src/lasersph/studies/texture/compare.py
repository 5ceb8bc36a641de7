"""A measured profile or map beside ours: leveled, aligned, and the fluence that explains it.

    z = a + b x + c y + h((x' cos phi + y' sin phi)/s, (y' cos phi - x' sin phi)/s; f) + noise,
    x' = x - x_0,   y' = y - y_0

Offset and tilts a, b, c, place x_0, y_0, angle phi and lateral scale s are those of the
measurement. h is our relief, of a texture at f times its local fluence: its cells tell it at any f
that they cover. Of a run of one cell h repeats, and f is 1; of a section (r, z) it is round, and
has no phi. A profile is taken as the line through the center of a spot; angle and y_0 are those of
maps.

The sum of squares is least over all of them: a, b, c are solved for exactly at each trial of the
others [Golub1973]. The start is the best of all places on a grid, for which some rows of a map are
enough; phi starts from how the phase of the lines moves from row to row. Standard errors are those
of the linear problem at the minimum, with the variance of the residuals times the points that are
correlated, see `correlated_points`. The lateral scale is known to be 1 to 3 % beforehand.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import NDArray

from lasersph.output.height_map import HeightMap
from lasersph.studies.texture.measurement import (
    NoComparison,
    correlated_points,
    point_noise,
    points_of,
    rotation_of,
)
from lasersph.studies.texture.relief import Relief
from lasersph.studies.texture.round_relief import RoundRelief

if TYPE_CHECKING:
    from scipy.optimize import OptimizeResult

Array = NDArray[np.float64]
AnyRelief = Relief | RoundRelief
SCALE_ERROR = 0.03
"""Standard deviation of the lateral scale of microscopes before they are calibrated, beforehand."""
STARTS, STARTS_A_PERIOD = 3, 12
"""Minima that are followed, and places of a period among which they are looked for."""
LOWEST_FACTOR = 0.3
MOST_POINTS, START_POINTS = 40_000, 4_000
"""Of a map that are compared, and by which its place is looked for: of finer ones every n-th."""
LARGEST_TURN = 0.35
"""Angle of a map to the lines [rad]: 20 degrees, beyond what a stage is out of line."""
NORMAL_95, NORMAL_95_ONE_SIDED = 1.959964, 1.644854
"""Half width of the 95 % interval of a normal distribution in standard deviations, and its distance
to the end of that with one end alone."""


@dataclass(frozen=True, eq=False)
class Comparison:
    """A measurement aligned with ours.

    Attributes:
        x, y: (n,) places in our coordinates [m]. measured: (n,) leveled heights [m].
        ours: (n,) heights [m]. values, errors: of the unknowns by name, with standard errors.
        bounds: of the unknowns that have some. at_bound: names of those that ended at one.
        middle: x, y of the middle of the measurement in its own coordinates [m], from which the
            shifts count. noise: standard deviation from point to
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
    bounds: Mapping[str, tuple[float, float]]
    at_bound: tuple[str, ...]
    middle: tuple[float, float]
    noise: float
    tau: float
    height_factor: tuple[float, float]
    interpolation: float

    @property
    def residual(self) -> Array:
        """Measured less ours (n,) [m]."""
        return self.measured - self.ours

    def interval(self, name: str) -> tuple[float, float]:
        """95 % interval of an unknown, within its bounds; one-sided where it ended at one."""
        least, most = self.bounds.get(name, (-np.inf, np.inf))
        value, error = self.values[name], self.errors[name]
        half = (NORMAL_95_ONE_SIDED if name in self.at_bound else NORMAL_95) * error
        return max(value - half, least), min(value + half, most)


def compare(relief: AnyRelief, surface: HeightMap, scale_error: float = SCALE_ERROR) -> Comparison:
    """Align a measured profile or map with our relief.

    Args:
        scale_error: standard deviation of the lateral scale beforehand.

    Raises:
        NoComparison: it is shorter than a period, too coarse for one, too flat to align, or its
            unit can't be right.
    """
    relief.refuse(surface)
    # start with few points, then least squares with all
    few = _Alignment.of(relief, surface, scale_error, START_POINTS)
    unknowns = min((few.least(one) for one in few.starts()), key=lambda found: found.cost).x
    every = _Alignment.of(relief, surface, scale_error, MOST_POINTS)
    found = every.least(unknowns)
    return every.comparison(found.x, found.jac)


@dataclass(frozen=True, eq=False)
class _Alignment:
    """Least squares of the unknowns of an alignment, of order 1: shifts are counted in periods.

    Attributes:
        x, y, z: (n,) measured, from the middle of the measurement [m]. surface: all of it.
        noise: of a point [m]. names: of the unknowns. basis: (n, 2 or 3) level and tilts.
    """

    relief: AnyRelief
    surface: HeightMap
    scale_error: float
    most: int
    x: Array
    y: Array
    z: Array
    noise: float
    names: list[str]
    basis: Array

    @classmethod
    def of(cls, relief: AnyRelief, surface: HeightMap, scale_error: float, most: int) -> Self:
        x, y, z = points_of(surface, most)
        is_map = np.ptp(y) > 0.0
        # level and tilts as an orthonormal basis: solved for exactly [Golub1973]
        columns = [np.ones_like(x), x - x.mean()] + ([y - y.mean()] if is_map else [])
        basis = np.linalg.qr(np.stack(columns, axis=1))[0]
        # unknowns that a profile or a map, of lines or of a spot, can tell
        names = ["shift_x_m", "lateral_scale"]
        knowable = {
            "rotation_rad": is_map and not relief.is_round,
            "fluence_factor": relief.tells_fluence,
            "shift_y_m": (is_map and relief.is_spot) or has_dots(relief),
        }
        names += [name for name, is_known in knowable.items() if is_known]
        noise = max(point_noise(surface.z), 1e-6 * float(np.std(z - basis @ (basis.T @ z))))
        return cls(relief, surface, scale_error, most, x, y, z, noise, names, basis)

    @property
    def bounds(self) -> Mapping[str, tuple[float, float]]:
        high = self.relief.largest_factor * (1.0 + 1e-12)
        return {
            "lateral_scale": (0.8, 1.25),
            "fluence_factor": (LOWEST_FACTOR, high),
            "rotation_rad": (-LARGEST_TURN, LARGEST_TURN),
        }

    def places(self, unknowns: Array) -> tuple[Array, Array]:
        """Our coordinates of the points [m]."""
        found, period = dict(zip(self.names, unknowns, strict=True)), self.relief.period
        angle, scale = found.get("rotation_rad", 0.0), found["lateral_scale"]
        x, y = self.x - period * found["shift_x_m"], self.y - period * found.get("shift_y_m", 0.0)
        # into the coordinates of the relief: shift, turn, scale
        cosine, sine = np.cos(angle), np.sin(angle)
        return (cosine * x + sine * y) / scale, (cosine * y - sine * x) / scale

    def heights(self, unknowns: Array) -> Array:
        """Ours (n,) at the points [m]."""
        factor = dict(zip(self.names, unknowns, strict=True)).get("fluence_factor", 1.0)
        return self.relief.at(*self.places(unknowns), factor)

    def leveled(self, heights: Array) -> Array:
        """Heights (n,) without level and tilts [m]."""
        return heights - self.basis @ (self.basis.T @ heights)

    def misfit(self, unknowns: Array) -> Array:
        """Residuals over the noise, and how far the lateral scale is from 1 over its error."""
        left = self.leveled(self.z - self.heights(unknowns)) / self.noise
        scale = unknowns[self.names.index("lateral_scale")]
        return np.append(left, (scale - 1.0) / self.scale_error)

    def least(self, start: Array) -> OptimizeResult:
        """The minimum next to a start."""
        from scipy.optimize import least_squares

        ends = np.array([self.bounds.get(name, (-np.inf, np.inf)) for name in self.names]).T
        return least_squares(
            self.misfit,
            np.clip(start, ends[0] + 1e-9, ends[1] - 1e-9),
            bounds=tuple(ends),
            x_scale=0.01,
            diff_step=1e-5,
        )

    def starts(self) -> list[Array]:
        """The best places on a grid, with lateral scale 1."""
        # places within reach: one period of lines, or a spot that overlaps the measurement
        relief, period = self.relief, self.relief.period
        reach = 0.5 * (np.ptp(self.x) + np.ptp(relief.x)) if relief.is_spot else 0.5 * period
        shifts = np.arange(-reach, reach, period / STARTS_A_PERIOD) / period
        left = self.leveled(self.z)
        # the center across the lines: that of the squares of the leveled heights
        across = float(np.sum(self.y * left**2) / np.sum(left**2)) / period
        values = {"lateral_scale": 1.0, "shift_y_m": across}
        if "rotation_rad" in self.names:
            values["rotation_rad"] = rotation_of(self.surface, period, LARGEST_TURN)

        # each place and factor, leveled; the best few are followed; dots repeat along y as well
        offsets = np.zeros(1)
        if isinstance(relief, Relief) and relief.period_y is not None and not relief.is_spot:
            reach_y = 0.5 * relief.period_y
            offsets = np.arange(-reach_y, reach_y, period / STARTS_A_PERIOD) / period
            values["shift_y_m"] = 0.0
        factors = [relief.largest_factor * k for k in (0.97, 0.8)]
        factors = factors if relief.tells_fluence else [1.0]
        found = []
        for factor in factors:
            heights = relief.sampled(factor, period / STARTS_A_PERIOD)
            for shift, offset in product(shifts, offsets):
                every = {**values, "shift_x_m": shift, "fluence_factor": factor}
                every["shift_y_m"] += offset
                one = np.array([every[name] for name in self.names])
                left = self.leveled(self.z - heights(*self.places(one)))
                found.append((float(left @ left), one))
        found.sort(key=lambda one: one[0])
        return [one for _, one in found[:STARTS]]

    def comparison(self, unknowns: Array, jacobian: Array) -> Comparison:
        """Comparison at the minimum. Raises NoComparison."""
        relief, names = self.relief, self.names
        # variance of the residuals, their correlation, and the scale known beforehand
        residual, jacobian = self.noise * self.misfit(unknowns)[:-1], self.noise * jacobian[:-1]
        freedom = max(self.z.size - len(names) - self.basis.shape[1], 1)
        variance = float(residual @ residual) / freedom
        tau = correlated_points(residual, self.surface, self.most)
        precision = jacobian.T @ jacobian / (variance * tau)
        place = names.index("lateral_scale")
        precision[place, place] += 1.0 / self.scale_error**2
        covariance = np.linalg.pinv(precision, hermitian=True)
        units = [relief.period if name.startswith("shift") else 1.0 for name in names]
        errors = np.sqrt(np.maximum(np.diag(covariance), 0.0)) * units
        # factor on heights: regression of measured on ours, both leveled
        ours = self.heights(unknowns)
        if np.std(ours) == 0.0:
            raise NoComparison("our relief is flat where the measurement lies: nothing to align to")
        flat = self.leveled(ours)
        factor = float(flat @ self.z) / float(flat @ flat)
        at_bound = tuple(
            name
            for name, value in zip(names, unknowns, strict=True)
            if np.min(np.abs(value - np.asarray(self.bounds.get(name, np.inf)))) < 1e-6
        )
        return Comparison(
            *self.places(unknowns),
            ours + residual,
            ours,
            dict(zip(names, unknowns * units, strict=True)),
            dict(zip(names, errors, strict=True)),
            self.bounds,
            at_bound,
            (float(np.mean(self.surface.x[[0, -1]])), float(np.mean(self.surface.y[[0, -1]]))),
            self.noise,
            tau,
            (factor, float(np.sqrt(variance * tau / (flat @ flat)))),
            relief.error,
        )


def has_dots(relief: AnyRelief) -> bool:
    """Whether a relief varies along y as its cells do."""
    return isinstance(relief, Relief) and relief.period_y is not None


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
        "origin_in_measurement": {
            f"{axis}_m": middle + found.values[f"shift_{axis}_m"]
            for axis, middle in zip("xy", found.middle, strict=True)
            if f"shift_{axis}_m" in found.values
        },
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
        "peak_to_valley": {
            "measured_m": float(np.ptp(found.measured)),
            "computed_m": float(np.ptp(found.ours)),
        },
        "largest_ours_m": float(np.max(np.abs(found.ours))),
        "sentence": sentence(found),
    }


def sentence(found: Comparison) -> str:
    """Sentence that says what the measurement can tell."""
    rms = float(np.sqrt(np.mean(found.residual**2)))
    expected = float(np.hypot(found.noise, found.interpolation))
    fits = rms < 1.5 * expected
    text = (
        f"measured and computed heights differ by {1e9 * rms:.3g} nm rms, "
        + ("no more than" if fits else "more than")
        + f" noise and interpolation explain ({1e9 * expected:.3g} nm)"
    )
    # a factor at its bound is a limit, not a value
    if "fluence_factor" in found.at_bound:
        low, high = found.interval("fluence_factor")
        is_high = found.values["fluence_factor"] > LOWEST_FACTOR + 0.5 * (high - low)
        end = f"{low:.4g} or more" if is_high else f"{high:.4g} or less"
        return text + (
            f"; the factor on the local fluence is {end} and lies at the end of what the cells "
            f"cover: compute a texture of {'more' if is_high else 'less'} pulse energy"
        )
    if "fluence_factor" in found.values:
        low, high = found.interval("fluence_factor")
        text += (
            f"; the local fluence is {found.values['fluence_factor']:.4g} times that of the case "
            f"(95 %: {low:.4g} to {high:.4g}), or the absorptivity is by that factor another: a "
            "profile knows only their product"
        )
    return text
