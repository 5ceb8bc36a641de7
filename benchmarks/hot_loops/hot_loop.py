"""A loop that is measured, and how it is timed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter

from hot_loops.least import Least


@dataclass(frozen=True)
class HotLoop:
    """A loop over `count` particles.

    Attributes:
        count: particles. run: runs it; returns the number of passes. least: of a pass, where `run`
            is more than calls of the backend's loops, from which it is found else.
    """

    name: str
    count: int
    run: Callable[[], int]
    least: Least | None = None


def seconds(run: Callable[[], int], rounds: int) -> float:
    """Shortest time of a pass [s], after one that compiles and warms up."""
    run()
    times = []
    for _ in range(rounds):
        start = perf_counter()
        passes = run()
        times.append((perf_counter() - start) / max(passes, 1))
    return min(times)
