"""The last pulse of a run whose pauses between pulses were jumped over, read like a run of its own.

A pause is a million times as long as the melt lasts, so that curves over the whole time of a train
are strokes, and a line through a pause would look like slow cooling.
"""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.output.pulse_starts import START_SHARE
from lasersph.output.reader import Run, Snapshots


def starts_after_pauses(run: Run) -> list[float]:
    """Times at which pulses begin after a pause that was jumped over [s]."""
    return [float(event["time_s"]) for event in run.events if event["event"] == "pause"]


def last_pulse(run: Run) -> Run:
    """The run since its last pause; the run itself where no pause was jumped over."""
    starts = starts_after_pauses(run)
    return PulseOfRun(run, starts[-1]) if starts else run


def is_in_pulse(times: np.ndarray, start: float, end: float) -> np.ndarray:
    """Whether times (n,) lie between the start of a pulse and that of the next [s], shape (n,)."""
    # a time at the very start belongs to the pulse, but for rounding
    return (times >= start * START_SHARE) & (times < end * START_SHARE)


class PulseOfRun(Run):
    """A run from the start of a pulse to that of the next, or to its end.

    Times of its history and snapshots count from the start of the pulse [s], and so do the amounts
    of energy since the start of the run.
    """

    def __init__(self, run: Run, start: float, end: float = np.inf) -> None:
        super().__init__(run.path)
        self.start, self.end = start, end

    @cached_property
    def history(self) -> dict[str, np.ndarray]:
        """Columns of history.csv, as of `Run`."""
        whole = super().history
        time = whole["time_s"]
        chosen = is_in_pulse(time, self.start, self.end)
        found = {name: column[chosen] for name, column in whole.items()}
        # Time and booked energies count from the start of the pulse; other columns are states.
        for name, column in found.items():
            if name == "time_s":
                found[name] = np.maximum(column - self.start, 0.0)
            elif name.startswith("energy_") and name.endswith("_J") and column.size:
                found[name] = column - column[0]
        return found

    @cached_property
    def snapshots(self) -> Snapshots:
        """Snapshots of the particles, as of `Run`."""
        return SnapshotsOfPulse(super().snapshots.path, self.start, self.end)

    @cached_property
    def surface(self) -> Snapshots:
        """The line of a surface that moves, as of `Run`."""
        return SnapshotsOfPulse(super().surface.path, self.start, self.end)


class SnapshotsOfPulse(Snapshots):
    """Those between two times [s]; their times count from the first."""

    def __init__(self, path: Path, start: float, end: float) -> None:
        super().__init__(path)
        self.start, self.end = start, end

    @cached_property
    def _chosen(self) -> np.ndarray:
        """Numbers of the steps in the file, shape (steps,)."""
        times = Snapshots(self.path).times
        return np.flatnonzero(is_in_pulse(times, self.start, self.end))

    def _numbers(self) -> list[int]:
        """Numbers of the steps in the file, as of `Snapshots`."""
        return self._chosen.tolist()

    @cached_property
    def times(self) -> np.ndarray:
        """Times of the steps since the start of the pulse [s]."""
        return np.maximum(Snapshots(self.path).times[self._chosen] - self.start, 0.0)

    def __getitem__(self, number: int) -> dict[str, Any]:
        step = super().__getitem__(int(self._chosen[number]))
        return {**step, "time": max(step["time"] - self.start, 0.0)}
