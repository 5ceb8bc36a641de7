"""Forecast of what the runs of a sweep will cost."""

from __future__ import annotations

from collections.abc import Sequence

from lasersph.simulation import forecast
from lasersph.sweeps.points import Point

SAMPLED = 9
"""Points that are forecast: each follows the depth of the melt, which takes a third of a second."""


def forecast_seconds(points: Sequence[Point], threads: int) -> tuple[float, int]:
    """Expected wall time of all points [s], one after the other on `threads` threads each.

    Returns:
        The sum, and from how many points it is estimated: evenly taken from all.
    """
    cases = [point.case for point in points if point.case is not None]
    # evenly taken points stand for all
    stride = max(1, (len(cases) - 1) // (SAMPLED - 1))
    chosen = cases[::stride]
    seconds = sum(forecast(case, threads=threads).wall_time for case in chosen)
    return seconds * len(cases) / max(1, len(chosen)), len(chosen)
