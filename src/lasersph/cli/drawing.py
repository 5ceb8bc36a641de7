"""Processes that draw figures beside a command, on the processors that it may use."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lasersph.plots.drawing_processes import DrawingProcesses
    from lasersph.simulation import RunProgress

LOADING = 2.0
"""Time in which a process loads what figures need [s]: a run that ends sooner is drawn as fast
without it."""
SOON = 10.0
"""How long before the end of a run they start [s]: time enough to load also from files that are new
to the machine, and none waits for hours."""


def drawing_processes(threads: int | None = None) -> DrawingProcesses:
    """Processes for figures, none of them started yet.

    Args:
        threads: that the command may use; None for all processors.
    """
    from lasersph.compute.threads import available
    from lasersph.plots.drawing_processes import DrawingProcesses

    return DrawingProcesses(min(threads or available(), available()), say)


def begin_before_end(others: DrawingProcesses, status: RunProgress) -> None:
    """Start them shortly before the end of a run, while it leaves processors free."""
    if status.remaining_s is not None and LOADING <= status.remaining_s <= SOON:
        others.begin()


def say(line: str) -> None:
    """Show a line on standard error."""
    print(line, file=sys.stderr, flush=True)
