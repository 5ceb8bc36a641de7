"""Settings of the results: what is stored, and which points and particles are watched.

Reading a case loads this file of the room and no other.
"""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field, field_validator

from lasersph.input import Count, Length, Model, Time, format_quantity

DEFAULT_COUNT = 40
LARGEST_COUNT = 100_000
ROUNDING = 1e-15
"""Of the sum of the start of a pulse and a time from there on."""


class SnapshotPlan(Model):
    """When to write snapshots: at every multiple of `interval` and at the listed `times`.

    The initial and the final state are always written. Without an interval there are
    40 evenly spaced ones.
    """

    interval: Annotated[Time, Field(gt=0.0)] | None = Field(
        default=None, description="from one snapshot to the next; default: a fortieth of the run"
    )
    times: tuple[Annotated[Time, Field(ge=0.0)], ...] = Field(
        default=(), description="further snapshots"
    )


class OutputSettings(Model):
    """Contents of the run folder, and how often they are written."""

    snapshots: SnapshotPlan = Field(
        default=SnapshotPlan.model_validate({}), description="when all particles are stored"
    )
    history_every: Count = Field(
        default=1, description="steps from one row of history.csv to the next"
    )
    checkpoint_every: Count = Field(
        default=200, description="steps from one checkpoint to the next"
    )


class NamedPoint(Model):
    """A point of the metal with a name."""

    name: Annotated[
        str,
        Field(
            min_length=1,
            max_length=40,
            pattern=r"^[A-Za-z0-9_-]+$",
            description="letters, digits, - and _; stands in the names of the history columns",
        ),
    ]
    depth: Length = Field(default=0.0, description="below the original surface")
    x: Length = Field(default=0.0, description="not used in 1-D")
    y: Length = Field(default=0.0, description="used in 3-D")

    @field_validator("depth")
    @classmethod
    def _below_the_surface(cls, depth: float) -> float:
        """The point lies in the metal."""
        if depth < 0.0:
            raise ValueError("a depth is counted downward from the surface and not negative")
        return depth

    def place(self, dimension: int) -> np.ndarray:
        """Coordinates of the point, (dim,) [m]."""
        return np.array({1: (), 2: (self.x,), 3: (self.x, self.y)}[dimension] + (-self.depth,))


class Probe(NamedPoint):
    """A named point whose temperature is recorded in every step."""

    method: Literal["nearest", "linear", "even"] = Field(
        default="nearest",
        description="nearest: the closest particle; linear: exact for linear fields; even: exact "
        "for fields of no slope at the surface, for adiabatic surfaces",
    )


class Trace(NamedPoint):
    """A named particle that is followed: the one closest to a point at the start."""


class SnapshotSchedule:
    """The times of a run's snapshots, which time steps must hit, and which is next.

    Where pauses between pulses are jumped over, they count from the start of each pulse anew.

    Attributes:
        times: sorted, the first 0, the last the end of the run or of a pulse [s].
        start: from which they count now [s].
    """

    def __init__(self, plan: SnapshotPlan, end: float) -> None:
        """Raises ValueError where the plan asks for more than 100 000 snapshots."""
        interval = plan.interval or end / DEFAULT_COUNT
        # A unit slip in the interval would fill the disk.
        if end / interval > LARGEST_COUNT:
            raise ValueError(
                f"{end / interval:.0f} snapshots are too many:"
                f" give an interval of at least {format_quantity(end / LARGEST_COUNT, 's')}"
            )
        # Multiples of the interval, the listed times and the end, each once.
        multiples = interval * np.arange(int(end / interval) + 1)
        wanted = np.concatenate([multiples, np.array(plan.times), [end]])
        wanted = np.unique(wanted[wanted <= end])
        # Times closer than rounding to the next one would ask for steps of no length.
        apart = np.concatenate([np.diff(wanted) > 1e-9 * end, [True]])
        self.times = wanted[apart]
        self.written, self.start = 0, 0.0

    @property
    def next_time(self) -> float:
        """Time of the next snapshot [s], infinite after the last."""
        if self.written == len(self.times):
            return float("inf")
        return self.start + float(self.times[self.written])

    def begin_again(self, time: float) -> None:
        """Count the times from `time` [s] on."""
        self.start, self.written = time, 0

    def due(self, time: float) -> bool:
        """Whether a snapshot is to be written at `time` [s]; the caller then writes it."""
        if time * (1.0 + ROUNDING) < self.next_time:
            return False
        self.written = self._count(time)
        return True

    def state(self) -> dict[str, float]:
        """State for `restore`."""
        return {"start": self.start}

    def restore(self, state: dict[str, float], time: float) -> None:
        """Continue from a state at `time` [s]; it may be that of another plan."""
        self.start = state["start"]
        self.written = self._count(time)

    def _count(self, time: float) -> int:
        """Number of times until `time` [s], which is one of them where a step has hit it."""
        return int(np.searchsorted(self.start + self.times, time * (1.0 + ROUNDING), side="right"))
