"""A measured profile or map as points: their noise, their period, and what cannot be right."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lasersph.output.height_map import HeightMap

Array = NDArray[np.float64]
MOST_POINTS = 40_000
"""Of a measured map that are compared; of finer ones every n-th in both directions."""
PERIOD_LIMIT, SCALE_LIMIT, OVERTONES = 0.2, 0.05, (2, 3)
"""How far a measured period may be off: of coarse measurements, and by a microscope's lateral scale
alone, which tells overtones of our period from other ones."""
FEWEST_POINTS = 8
"""Of a measurement in a period: fewer do not show its shape."""


class NoComparison(ValueError):
    """The two cannot be compared; the text says why, in one line."""


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


def points_of(surface: HeightMap) -> tuple[Array, Array, Array]:
    thin = max(1, int(np.ceil(np.sqrt(surface.z.size / MOST_POINTS))))
    thin_y = thin if surface.y.size > 1 else 1
    x, y = np.meshgrid(surface.x[::thin], surface.y[::thin_y])
    z = surface.z[::thin_y, ::thin]
    known = np.isfinite(z)
    x, y, z = x[known], y[known], z[known]
    return x - x.mean(), y - y.mean(), z - z.mean()


def refuse_odd(surface: HeightMap, period: float) -> None:
    width = float(np.ptp(surface.x))
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
    waves = 1.0 if measured is None else period / measured
    # two hills a line make its second or third wave the strongest one
    is_overtone = round(waves) in OVERTONES and abs(waves / round(waves) - 1.0) < SCALE_LIMIT
    if abs(1.0 / waves - 1.0) > PERIOD_LIMIT and not is_overtone:
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
