"""How far a run is and how long it still takes. For display only: nothing depends on it."""

from __future__ import annotations

import time
from collections import deque
from dataclasses import dataclass

from lasersph.observers.view import View

WINDOW = 200


@dataclass(frozen=True)
class Standing:
    """How a run stands.

    Attributes:
        fraction: part of the simulated time done, 0 to 1.
        steps_per_second: over the last steps.
        remaining_s: expected wall time to the end, None before it can be told.
        temperature_K: largest temperature.
    """

    fraction: float
    steps_per_second: float
    remaining_s: float | None
    temperature_K: float

    def __str__(self) -> str:
        """One line, as for a terminal or a log."""
        left = "" if self.remaining_s is None else f", {duration(self.remaining_s)} left"
        return (
            f"{100.0 * self.fraction:5.1f} %, {self.steps_per_second:.3g} steps/s{left},"
            f" {self.temperature_K:.0f} K at most"
        )


class Progress:
    """Measures the speed of a run on the clock."""

    def __init__(self, end: float) -> None:
        """`end`: time at which the run ends [s]."""
        self.end = end
        self._ticks: deque[tuple[float, int, float]] = deque(maxlen=WINDOW)

    def standing(self, view: View, temperature: float) -> Standing:
        """How the run stands after a step; `temperature` is the largest one [K]."""
        self._ticks.append((time.perf_counter(), view.step, view.time))
        clock, step, simulated = self._ticks[0]
        elapsed = self._ticks[-1][0] - clock
        speed = (view.step - step) / elapsed if elapsed > 0.0 else 0.0
        advance = (view.time - simulated) / elapsed if elapsed > 0.0 else 0.0
        remaining = (self.end - view.time) / advance if advance > 0.0 else None
        fraction = min(view.time / self.end, 1.0) if self.end > 0.0 else 1.0
        return Standing(fraction, speed, remaining, temperature)


def duration(seconds: float) -> str:
    """A duration in words a person reads at a glance: "42 s", "3 min 05 s", "2 h 10 min"."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"
