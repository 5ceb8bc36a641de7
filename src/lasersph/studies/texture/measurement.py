"""A measured profile or map as points: their noise, their period, and what cannot be right."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lasersph.output.height_map import HeightMap

Array = NDArray[np.float64]
PERIOD_LIMIT, SCALE_LIMIT, OVERTONES = 0.2, 0.05, (2, 3)
"""How far a measured period may be off: of coarse measurements, and by a microscope's lateral scale
alone, which tells overtones of our period from other ones."""
LENGTH_ROUNDING = 1e-3
"""Of places that are written with four digits or more."""
OUTSTANDS = 10.0
"""Power of a wave over the median of all above which it is no noise: powers of noise are
distributed exponentially, and one of a thousand exceeds ten times their median."""
LEAKAGE = 1e-3
"""Power beside that of the strongest wave which a Hann window leaves six periods or more away; a
fundamental wave has more."""
FEWEST_ROWS = 16
"""Of a map that is thinned: a spot has a shape across the lines as well."""
FEWEST_PERIODS = 3
"""Waves in a measurement below which a Hann window does not tell their length."""
PADDING = 8
"""Places of a spectrum for each wave more in the measurement: periods are read between whole
numbers of them."""
FEWEST_POINTS = 8
"""Of a measurement in a period: fewer do not show its shape."""


class NoComparison(ValueError):
    """The two cannot be compared; the text says why, in one line."""


def correlated_points(residual: Array, surface: HeightMap, most: int) -> float:
    """tau of residuals at `points_of`, the points that have the information of one: 1 + 2 sum rho_k
    over the lags k up to the first at which rho_k is no more than chance, along x; times that along
    y. 1 where residuals are independent, as those of a wrong model are not."""
    grid = np.isfinite(_thinned(surface, most)[2]).astype(float)
    grid[grid > 0.0] = residual
    variance = float(np.mean(residual**2)) or 1.0
    tau = 1.0
    for rows in (grid, grid.T):
        here = 1.0
        for lag in range(1, rows.shape[1] // 4):
            rho = float(np.mean(rows[:, lag:] * rows[:, :-lag])) / variance
            # of independent residuals rho scatters by 1/sqrt(n): smaller ones tell nothing
            if rho < 2.0 / np.sqrt(residual.size):
                break
            here += 2.0 * rho
        tau *= here
    return tau


def point_noise(z: Array) -> float:
    """Noise from point to point along x [m], from second differences: rms / sqrt 6."""
    bend = np.diff(z, 2, axis=1)
    return float(np.sqrt(np.nanmean(bend**2) / 6.0))


def points_of(surface: HeightMap, most: int) -> tuple[Array, Array, Array]:
    """Known points (n,), no more than `most` of a map: places from its middle, heights from their
    mean [m]."""
    x, y, z = _thinned(surface, most)
    known = np.isfinite(z)
    x, y = x - 0.5 * (surface.x[0] + surface.x[-1]), y - 0.5 * (surface.y[0] + surface.y[-1])
    return x[known], y[known], z[known] - z[known].mean()


def _thinned(surface: HeightMap, most: int) -> tuple[Array, Array, Array]:
    """Places and heights (rows, columns) of a map [m]: of more than `most` every n-th row and, as
    far as they still show a line, every n-th column. All of a profile."""
    across = along = 1
    if surface.y.size > 1:
        across = max(1, min(int(np.ceil(surface.z.size / most)), surface.y.size // FEWEST_ROWS))
        along = max(1, int(np.ceil(surface.z[::across].size / most)))
    x, y = np.meshgrid(surface.x[::along], surface.y[::across])
    return x, y, surface.z[::across, ::along]


def rotation_of(surface: HeightMap, period: float, largest: float) -> float:
    """Angle of a map's x to that across its lines [rad], of 0 for a profile.

    The complex amplitude of the lines' strongest wave turns by k tan phi per length along y.
    """
    if surface.y.size == 1:
        return 0.0
    x, z = surface.x - surface.x.mean(), np.nan_to_num(surface.z - np.nanmean(surface.z))
    z = (z - np.outer(z @ x / (x @ x), x)) * np.hanning(x.size)
    waves = 2.0 * np.pi / period * np.arange(1, 1 + max(OVERTONES))
    rows = z @ np.exp(-1j * np.outer(x, waves))
    strongest = int(np.argmax(np.sum(np.abs(rows) ** 2, axis=0)))
    turns = np.sum(rows[1:, strongest] * np.conj(rows[:-1, strongest]))
    slope = float(np.angle(turns)) / (surface.steps[1] * waves[strongest])
    return float(np.clip(np.arctan(slope), -largest, largest))


def refuse_coarse(surface: HeightMap, length: float, what: str) -> None:
    """Refuse a measurement in which something of a length [m] cannot be seen. Raises
    NoComparison."""
    # a sampling that repeats leaves out its last point, that of the next period
    width = float(np.ptp(surface.x)) + surface.steps[0]
    if width < length * (1.0 - LENGTH_ROUNDING):
        raise NoComparison(
            f"the measurement is {1e6 * width:.4g} um long, shorter than {what} of "
            f"{1e6 * length:.4g} um: is its unit right?"
        )
    if surface.steps[0] > length / FEWEST_POINTS:
        raise NoComparison(
            f"points {1e6 * surface.steps[0]:.4g} um apart do not show {what} of "
            f"{1e6 * length:.4g} um: measure {FEWEST_POINTS} or more over it"
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


def refuse_odd(surface: HeightMap, period: float) -> None:
    """Refuse a measurement of other lines than those of a period [m]. Raises NoComparison."""
    refuse_coarse(surface, period, "a period")
    width = float(np.ptp(surface.x)) + surface.steps[0]
    # of fewer than three periods the spectrum shows the shape of one, not how they repeat
    measured = dominant_period(surface) if width > FEWEST_PERIODS * period else None
    waves = 1.0 if measured is None else period / measured
    # two hills a line make its second or third wave the strongest one
    is_overtone = round(waves) in OVERTONES and abs(waves / round(waves) - 1.0) < SCALE_LIMIT
    if measured is not None and abs(1.0 / waves - 1.0) > PERIOD_LIMIT and not is_overtone:
        raise NoComparison(
            f"the measured period of {1e6 * fundamental_period(surface, measured):.4g} um does not "
            f"fit ours of {1e6 * period:.4g} um"
        )


def dominant_period(surface: HeightMap) -> float | None:
    """Period of the strongest wave along x, of the mean over y [m]; None where none stands out from
    the others by five times, or where fewer than three lie in the measurement."""
    lowest, power = _spectrum(surface)
    strongest = lowest + int(np.argmax(power[lowest:]))
    if strongest <= lowest or power[strongest] < 5.0 * np.mean(power[lowest:]) * 4.0:
        return None
    return float(PADDING * surface.x.size * surface.steps[0] / strongest)


def fundamental_period(surface: HeightMap, strongest: float) -> float:
    """Period [m] of which the strongest wave is an overtone: the third or second of a wave that
    stands out from the noise; where none does, that of the strongest itself."""
    lowest, power = _spectrum(surface)
    length = PADDING * surface.x.size * surface.steps[0]
    least = max(OUTSTANDS * np.median(power[lowest:]), LEAKAGE * power[round(length / strongest)])
    for overtone in reversed(OVERTONES):
        place, width = round(length / strongest / overtone), PADDING // 2
        near = power[max(place - width, lowest) : place + width + 1]
        if near.size > 2 and 0 < np.argmax(near) < near.size - 1 and near.max() > least:
            return length / (max(place - width, lowest) + int(np.argmax(near)))
    return strongest


def _spectrum(surface: HeightMap) -> tuple[int, Array]:
    """The first place of three waves in the measurement, and the power of all along x, of the mean
    over y, at `PADDING` places a wave more."""
    line = np.nanmean(surface.z, axis=0)
    x = surface.x - surface.x.mean()
    line = np.where(np.isfinite(line), line, 0.0)
    line = (line - np.polyval(np.polyfit(x, line, 1), x)) * np.hanning(x.size)
    return FEWEST_PERIODS * PADDING, np.abs(np.fft.rfft(line, PADDING * x.size)) ** 2
