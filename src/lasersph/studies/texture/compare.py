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
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lasersph.output import OutputError, open_run
from lasersph.output.height_map import HeightMap
from lasersph.output.image_file import read_maps
from lasersph.output.reader import read_json
from lasersph.studies.texture.cells import read_cell
from lasersph.studies.texture.table import CellTable

Array = NDArray[np.float64]
SCALE_ERROR = 0.03
"""Standard deviation of the lateral scale of microscopes before they are calibrated, beforehand."""
MOST_POINTS = 40_000
"""Of a measured map that are compared; of finer ones every n-th in both directions."""
FEWEST_POINTS = 8
"""Of a measurement in a period: fewer do not show its shape."""
STARTS, STARTS_A_PERIOD = 3, 12
"""Minima that are followed, and places of a period among which they are looked for."""
LOWEST_FACTOR = 0.3
NORMAL_95 = 1.959964
"""Half width of the 95 % interval of a normal distribution in standard deviations."""


class NoComparison(ValueError):
    """The two cannot be compared; the text says why, in one line."""


@dataclass(frozen=True, eq=False)
class Relief:
    """Our relief, of a texture or of a cell that repeats.

    Attributes:
        name: of the folder. table: cells. x, y: of the fluence of a texture (nx,), (ny,) [m].
        fluence: (ny, nx) [J/m^2]; of a cell that repeats one value.
        error: of the interpolation, rms [m]; 0 of a cell.
    """

    name: str
    table: CellTable
    x: Array
    y: Array
    fluence: Array
    error: float = 0.0

    @property
    def is_spot(self) -> bool:
        """Whether it is that of a spot, whose fluence changes."""
        return self.fluence.size > 1

    @property
    def largest_factor(self) -> float:
        """Largest factor on the fluence that the cells cover."""
        return float(self.table.fluence[-1] / self.fluence.max()) if self.is_spot else 1.0

    def at(self, x: Array, y: Array, factor: float) -> Array:
        """Heights at places (n,) [m] with a factor on the fluence."""
        if not self.is_spot:
            return self.table.at("height", np.full(x.shape, self.fluence.item()), x)
        from scipy.ndimage import map_coordinates

        steps = [(side[-1] - side[0]) / (side.size - 1) for side in (self.y, self.x)]
        places = [(y - self.y[0]) / steps[0], (x - self.x[0]) / steps[1]]
        local = factor * map_coordinates(self.fluence, places, order=1, mode="constant")
        return self.table.at("height", np.minimum(local, self.table.fluence[-1]), x)


def read_relief(folder: Path) -> Relief:
    """Our relief in the folder of a texture, or of a run of one period.

    Raises:
        OutputError: it holds neither.
    """
    if (folder / "texture.json").exists():
        content, maps = read_json(folder / "texture.json"), read_maps(folder / "maps.vtkhdf")
        if content["pulses"] > 1:
            raise OutputError(f"{folder} has pulses that are moved: compare one spot")
        cells = content["cells"]
        fluence, x = np.array(cells["fluence_J_m2"]), np.array(cells["x_m"])
        values = {"height": np.array(cells["height_m"])}
        table = CellTable(fluence, x, content["period_m"], values, 0.0)
        error = content["interpolation_error"]["height"]["rms"]
        return Relief(folder.name, table, maps.x, maps.y, maps.fields["fluence"], error)
    run = open_run(folder)
    if not run.is_complete:
        raise OutputError(f"{folder} is not complete")
    period = (run.case.get("laser") or {}).get("beam", {}).get("period")
    if period is None:
        raise OutputError(f"{folder} has no pattern with a period, and is no texture")
    cell = read_cell(run, period)
    values = {"height": np.tile(cell.values["height"], (3, 1))}  # the same at any fluence
    table = CellTable(np.array([0.5, 1.0, 2.0]), cell.x, period, values, 0.0)
    return Relief(folder.name, table, np.zeros(1), np.zeros(1), np.ones((1, 1)))


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


def compare(relief: Relief, surface: HeightMap) -> Comparison:
    """Align a measured profile or map with our relief.

    Raises:
        NoComparison: it is shorter than a period, too coarse for one, too flat to align, or its
            unit can't be right.
    """
    from scipy.optimize import least_squares

    x, y, z = _points(surface)
    period = relief.table.period
    _refuse_odd(surface, relief)
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
        return np.append(left, (scale - 1.0) / SCALE_ERROR)

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
    precision[place, place] += 1.0 / SCALE_ERROR**2
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


def correlation_length(residual: Array, surface: HeightMap) -> float:
    """tau of residuals along x, in points; 1 where they are independent."""
    length = surface.z.shape[1] if residual.size == surface.z.size else residual.size
    rows = residual[: residual.size // length * length].reshape(-1, length)
    variance = float(np.mean(rows**2)) or 1.0
    tau = 1.0
    for lag in range(1, length // 4):
        rho = float(np.mean(rows[:, lag:] * rows[:, :-lag])) / variance
        # of independent residuals rho scatters by 1/sqrt(n): smaller ones tell nothing
        if rho < 2.0 / np.sqrt(residual.size):
            break
        tau += 2.0 * rho
    return tau


def point_noise(z: Array) -> float:
    """Noise from point to point along x [m], from second differences: rms / sqrt 6."""
    bend = np.diff(z, 2, axis=1)
    return float(np.sqrt(np.nanmean(bend**2) / 6.0))


def _points(surface: HeightMap) -> tuple[Array, Array, Array]:
    thin = max(1, int(np.ceil(np.sqrt(surface.z.size / MOST_POINTS))))
    thin_y = thin if surface.y.size > 1 else 1
    x, y = np.meshgrid(surface.x[::thin], surface.y[::thin_y])
    z = surface.z[::thin_y, ::thin]
    known = np.isfinite(z)
    x, y, z = x[known], y[known], z[known]
    return x - x.mean(), y - y.mean(), z - z.mean()


def _refuse_odd(surface: HeightMap, relief: Relief) -> None:
    period, width = relief.table.period, float(np.ptp(surface.x))
    if width < period:
        raise NoComparison(
            f"the measurement is {1e6 * width:.4g} um long, shorter than a period of "
            f"{1e6 * period:.4g} um: is its unit right?"
        )
    if surface.steps[0] > period / FEWEST_POINTS:
        raise NoComparison(
            f"points {1e6 * surface.steps[0]:.4g} um apart do not show a period of "
            f"{1e6 * period:.4g} um: measure {FEWEST_POINTS} or more a period"
        )
    rough = float(np.nanmax(surface.z) - np.nanmin(surface.z))
    if rough > width:
        raise NoComparison(
            f"heights differ by {1e6 * rough:.4g} um over a width of {1e6 * width:.4g} um: is the "
            "unit of the heights right?"
        )
    z = surface.z - np.nanmean(surface.z)
    if not np.nanmax(np.abs(z)) > 0.0:
        raise NoComparison("all measured heights are the same")
    measured = dominant_period(surface)
    if measured is not None and abs(measured / period - 1.0) > 0.2:
        raise NoComparison(
            f"the measured period of {1e6 * measured:.4g} um does not fit ours of "
            f"{1e6 * period:.4g} um"
        )


def dominant_period(surface: HeightMap) -> float | None:
    """Period of the strongest wave along x, of the mean over y [m]; None where none stands out from
    the others by five times, or where fewer than three lie in the measurement."""
    line = np.nanmean(surface.z, axis=0)
    x = surface.x - surface.x.mean()
    line = np.where(np.isfinite(line), line, 0.0)
    line = (line - np.polyval(np.polyfit(x, line, 1), x)) * np.hanning(x.size)
    count = 8 * x.size
    power = np.abs(np.fft.rfft(line, count)) ** 2
    lowest = int(np.ceil(3.0 * count / x.size))
    strongest = lowest + int(np.argmax(power[lowest:]))
    if strongest <= lowest or power[strongest] < 5.0 * np.mean(power[lowest:]) * 4.0:
        return None
    return float(count * surface.steps[0] / strongest)


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
