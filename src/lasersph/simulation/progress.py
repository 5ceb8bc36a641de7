"""How much of a run's work is done and how long the rest takes. For display only.

The forecast says what each span of a run should cost: steps are few and cheap before the light and
many and costly while something flows. The clock corrects it as the run goes, each kind of span for
itself; kinds that have not been met yet are corrected as those that have.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lasersph.input import format_duration, format_quantity

WEIGHT_PER_STEP = 0.99
"""Weight that earlier steps keep at each step: a pool grows, and so does the cost of its steps.
Display: the time that is left is told from the last hundred."""
OUTLIER = 5.0
"""Times the usual that a step may count. Display: loops are compiled or loaded in steps that take
longer."""
LINES = 10
"""Lines of a whole run. Display: what a log can be read at a glance."""
LEAST_STEPS = 5
"""Steps before anything is said of the time that remains. Display: the first ones compile loops."""


@dataclass(frozen=True)
class RunProgress:
    """How far a run is after a step; nothing in a run depends on it.

    Attributes:
        time: simulated so far [s].
        end: time at which the run ends [s].
        steps: done.
        hottest: largest temperature [K].
        work_done: part of the work that is done, 0 to 1.
        remaining_s: expected wall time to the end [s], None before it can be told.
    """

    time: float
    end: float
    steps: int
    hottest: float
    work_done: float
    remaining_s: float | None = None

    def __str__(self) -> str:
        """Part of the work, simulated time, steps, highest temperature, time left if known."""
        left = self.remaining_s
        return ", ".join(
            [
                f"{100 * min(self.work_done, 1.0):3.0f} %  {format_quantity(self.time, 's')}",
                f"step {self.steps}",
                f"{self.hottest:.0f} K",
                *([] if left is None else [f"{format_duration(left)} left"]),
            ]
        )


class ProgressLines:
    """Prints how far a run is on standard error, in some lines over all of it."""

    def __init__(self) -> None:
        self._shown = 0

    def __call__(self, status: RunProgress) -> None:
        """Print a line where the next part of the run is done."""
        parts = int(LINES * min(status.work_done, 1.0))
        if parts > self._shown:
            self._shown = parts
            print(status, file=sys.stderr, flush=True)


@dataclass(frozen=True)
class Span:
    """A part of a run: its kind, simulated time at which it ends [s], expected wall time [s]."""

    kind: str
    end: float
    seconds: float


class RemainingTime:
    """Expected wall time to the end of a run, from spans in their order and the clock."""

    def __init__(self, spans: Sequence[Span]) -> None:
        self._spans = tuple(spans)
        self._ends = np.array([0.0, *(span.end for span in spans)])
        self._work = np.cumsum([0.0, *(span.seconds for span in spans)])
        self._taken = {span.kind: (0.0, 0.0) for span in spans}  # seconds taken and expected
        self._wall: float | None = None
        self._time, self._steps = 0.0, 0

    def work_done(self, time: float) -> float:
        """Part of the expected work that is done at a simulated time [s]."""
        return self._expected_until(time) / self._work[-1]

    def step_to(self, time: float, wall: float) -> float | None:
        """Note that a step has reached a time [s] at a reading of the clock [s].

        Returns:
            Wall time to the end [s]; None before it can be told.
        """
        # The first step only sets the clock.
        if self._wall is not None:
            self._count(time, wall - self._wall)
        self._time, self._wall = time, wall
        return self._remaining() if self._steps >= LEAST_STEPS else None

    def _count(self, time: float, seconds: float) -> None:
        self._steps += 1
        # The step belongs to the span in which it began.
        kind = self._spans[self._place(self._time)].kind
        taken, expected = self._taken[kind]
        work = self._expected_until(time) - self._expected_until(self._time)
        # Compiling takes long once: it counts as some steps at most.
        seconds = min(seconds, OUTLIER * self._usual_rate() * work)
        # Both sums forget earlier steps at the same rate, so their quotient stays a mean.
        self._taken[kind] = WEIGHT_PER_STEP * taken + seconds, WEIGHT_PER_STEP * expected + work

    def _usual_rate(self) -> float:
        """Seconds taken over seconds expected, of all steps so far."""
        taken, expected = np.sum(list(self._taken.values()), axis=0)
        return taken / expected if expected > 0.0 else 1.0

    def _remaining(self) -> float:
        usual = self._usual_rate()
        # Kinds of span that the run has not met run at the rate of all others.
        rate = {kind: one / of if of > 0.0 else usual for kind, (one, of) in self._taken.items()}
        place = self._place(self._time)
        # What is left of this span, and all that follow.
        seconds = rate[self._spans[place].kind] * (
            self._work[place + 1] - self._expected_until(self._time)
        )
        return seconds + sum(rate[span.kind] * span.seconds for span in self._spans[place + 1 :])

    def _place(self, time: float) -> int:
        """Number of the span that a time lies in."""
        found = int(np.searchsorted(self._ends, time, side="right")) - 1
        return min(found, len(self._spans) - 1)

    def _expected_until(self, time: float) -> float:
        return float(np.interp(time, self._ends, self._work))
