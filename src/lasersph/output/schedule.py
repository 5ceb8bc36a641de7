"""The times at which snapshots of all particles are written."""

from __future__ import annotations

import numpy as np

from lasersph.input import format_quantity
from lasersph.output.settings import SnapshotPlan

DEFAULT_COUNT = 40
LARGEST_COUNT = 100_000


class SnapshotSchedule:
    """The times of a run's snapshots, which time steps must hit, and which is next.

    Attributes:
        times: sorted, the first 0, the last the end of the run [s].
    """

    def __init__(self, plan: SnapshotPlan, end: float) -> None:
        """Raises ValueError where the plan asks for more than 100 000 snapshots."""
        interval = plan.interval or end / DEFAULT_COUNT
        if end / interval > LARGEST_COUNT:
            raise ValueError(
                f"{end / interval:.0f} snapshots are too many:"
                f" give an interval of at least {format_quantity(end / LARGEST_COUNT, 's')}"
            )
        multiples = interval * np.arange(int(end / interval) + 1)
        wanted = np.concatenate([multiples, np.array(plan.times), [end]])
        wanted = np.unique(wanted[wanted <= end])
        apart = np.concatenate([np.diff(wanted) > 1e-9 * end, [True]])
        self.times = wanted[apart]
        self.written = 0

    @property
    def next_time(self) -> float:
        """Time of the next snapshot [s], infinite after the last."""
        return float(self.times[self.written]) if self.written < len(self.times) else float("inf")

    def due(self, time: float) -> bool:
        """Whether a snapshot is to be written at `time` [s]; the caller then writes it."""
        if time < self.next_time:
            return False
        self.written = int(np.searchsorted(self.times, time, side="right"))
        return True

    def state(self) -> dict[str, int]:
        """What `restore` needs."""
        return {"written": self.written}

    def restore(self, state: dict[str, int]) -> None:
        """Continue from a state."""
        self.written = state["written"]
