"""How far many runs are and how long the rest takes. For display only."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

from lasersph.sweeps.engine import Event
from lasersph.sweeps.table import Table

ENDS = ("complete", "failed", "wrong", "stopped")


@dataclass(frozen=True)
class SweepStatus:
    """How far many runs are.

    Attributes:
        total, complete, failed, refused: numbers of runs; refused are those of a wrong case.
        running: in hand. work_done: part of all runs, 0 to 1.
        remaining_s: expected wall time to the end [s], None before it can be told.
    """

    total: int
    complete: int
    failed: int
    refused: int
    running: int
    work_done: float
    remaining_s: float | None


@dataclass
class SweepProgress:
    """Counts runs from events; the clock tells how long one takes."""

    complete: set[str] = field(default_factory=set)
    failed: set[str] = field(default_factory=set)
    refused: set[str] = field(default_factory=set)
    _running: dict[str, tuple[float, float, float]] = field(default_factory=dict)
    """By run: share of it done before this call and now, and when it was begun [s]."""
    _seconds: list[float] = field(default_factory=list)
    """Wall times of whole runs [s]."""

    def step(self, event: Event, table: Table) -> SweepStatus:
        """Note an event; how far all runs are after it.

        Args:
            table: made before the event; it tells what earlier calls have done.
        """
        # complete and refused runs of earlier calls
        now, run = time.monotonic(), event.run
        for row in table.rows:
            if row.status == "complete":
                self.complete.add(row.run)
            elif row.status == "wrong":
                self.refused.add(row.run)
        # share of this run and when it began; a run that ends gives the time of a whole one
        if event.kind == "progress":
            before, _, begun = self._running.get(run, (event.work_done, 0.0, now))
            self._running[run] = (before, event.work_done, begun)
        elif event.kind in ENDS or event.kind == "retry":
            before, _, begun = self._running.pop(run, (1.0, 1.0, now))
            if event.kind == "complete" and before < 1.0:
                self._seconds.append((now - begun) / (1.0 - before))
        ended = {"complete": self.complete, "failed": self.failed, "wrong": self.refused}
        if event.kind in ended:
            ended[event.kind].add(run)
        return self._status(table, now)

    def _status(self, table: Table, now: float) -> SweepStatus:
        total = len(set(table.runs))
        ended = len(self.complete | self.failed | self.refused)
        done = sum(share for _, share, _ in self._running.values())
        # time of a whole run: of those that ended, and of those in hand by their share
        whole = [*self._seconds]
        whole += [
            (now - begun) / (share - before)
            for before, share, begun in self._running.values()
            if share > before
        ]
        remaining = None
        if whole and self._running:
            # as many at a time as now
            left = total - ended - done  # in runs
            remaining = left * sum(whole) / len(whole) / len(self._running)
        return SweepStatus(
            total=total,
            complete=len(self.complete),
            failed=len(self.failed),
            refused=len(self.refused),
            running=len(self._running),
            work_done=(ended + done) / max(1, total),
            remaining_s=remaining,
        )
