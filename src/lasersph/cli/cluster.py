"""Files and messages of verbs that make many runs on a cluster."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from lasersph.cli.failures import DONE

if TYPE_CHECKING:
    from lasersph.sweeps import Event, SweepPlan

Slurm = Annotated[
    Path | None,
    typer.Option(
        "--slurm", metavar="FILE", help="Write a script for sbatch, a task a run; compute nothing."
    ),
]
SlurmDask = Annotated[
    Path | None,
    typer.Option(
        "--slurm-dask",
        metavar="FILE",
        help="Write a script for sbatch that starts Dask and makes the runs; compute nothing.",
    ),
]
LINE_EVERY = 10.0
"""From one line of what runs where to the next [s]."""
MOST_NAMED = 8
"""Runs in such a line."""


def write_scripts(
    plan: SweepPlan, plan_file: Path, out: Path, slurm: Path | None, slurm_dask: Path | None
) -> int:
    """Write the scripts for Slurm that are asked for, and say what to do with them."""
    from lasersph.sweeps.slurm import write_array_script, write_dask_script

    # An array of runs, or a scheduler with workers that take them.
    if slurm is not None:
        count = write_array_script(plan, out, slurm)
        if count:
            runs = f"{count} run{'s' * (count > 1)}"
            print(f"{slurm}: {runs}. Set its #SBATCH lines, then: sbatch {slurm}")
        else:
            print(f"all runs are complete: {out / 'table.csv'}")
    if slurm_dask is not None:
        write_dask_script(plan_file, out, slurm_dask)
        print(f"{slurm_dask}: set its #SBATCH lines, then: sbatch {slurm_dask}")
    return DONE


@dataclass
class RunsInHand:
    """Says every 10 s which worker makes which run, and since when.

    Attributes:
        say: shows a line.
    """

    say: Callable[[str], None]
    _runs: dict[str, tuple[str, str, float]] = field(default_factory=dict)
    """Worker, time of day at the start and part done, by run."""
    _said: float = field(default_factory=time.monotonic)

    def note(self, event: Event) -> None:
        """Take in an event."""
        from lasersph.sweeps.progress import ENDS

        # A run that has ended is in nobody's hands.
        if event.kind in (*ENDS, "retry"):
            self._runs.pop(event.run, None)
            return
        # A run keeps its start as long as its worker is the same.
        since = f"{datetime.now():%H:%M:%S}"
        worker, before, _ = self._runs.get(event.run, (event.worker, since, 0.0))
        since = before if worker == event.worker else since
        self._runs[event.run] = (event.worker, since, event.work_done)

    def say_if_due(self) -> None:
        """Show a line if the last was shown long ago."""
        if time.monotonic() - self._said < LINE_EVERY:
            return
        self._said = time.monotonic()
        # The run by its number, its worker, its start, and the part that is done.
        runs = [
            f"{run.partition('-')[0]} on {worker} since {since} ({100 * done:.0f} %)"
            for run, (worker, since, done) in sorted(self._runs.items())
        ]
        more = [f"and {len(runs) - MOST_NAMED} more"] if len(runs) > MOST_NAMED else []
        self.say(", ".join(runs[:MOST_NAMED] + more) or "no run in hand: no worker is there yet")
