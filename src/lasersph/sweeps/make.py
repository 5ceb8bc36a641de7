"""`make_runs`: make the run folders of many points exist, and their table."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

from lasersph.case import Case
from lasersph.sweeps.engine import Engine, Event, Task
from lasersph.sweeps.folder import RUNS, Study, SweepFolder
from lasersph.sweeps.local import LocalEngine
from lasersph.sweeps.plan import SweepPlan, build_plan, read_plan
from lasersph.sweeps.points import Point
from lasersph.sweeps.table import Table

TABLE_EVERY = 5.0
"""Least time between two writings of the table while runs are made [s]."""
Report = Callable[[Event, Table], None]
"""Called with each event and the table as it was when last made."""


def make_runs(
    points: Sequence[Point],
    folder: str | PathLike[str],
    study: Study,
    *,
    engine: Engine | None = None,
    report: Report | None = None,
    should_stop: Callable[[], bool] | None = None,
) -> Table:
    """Make the run folders of all points exist and write their table.

    Runs that are complete are left as they are, others go on from their checkpoints. A run that
    fails, or whose case is refused, keeps its reason and stops no other.

    Args:
        folder: receives points.json, runs/, table.csv and sweep.jsonl.
        study: whose runs these are; another study in the folder is refused.
        engine: what computes; None for this machine. report: called with what happens.
        should_stop: asked several times a second; True ends all runs with their checkpoints.

    Returns:
        The table, in the order of the points.

    Raises:
        FolderRefused: the folder holds something else; nothing was written.
        OutputError: the folder cannot be written, or the engine has nothing to compute with; the
            table then says what is complete.
    """
    path = Path(folder)
    with SweepFolder(path, study) as home:
        # what is wanted, as names of folders; the table says what is complete
        names = home.list_points(points)
        table = Table.read(path)
        table.write()
        cases = {name: p.case for name, p in zip(names, points, strict=True) if p.case is not None}
        for row in table.rows:
            if row.status == "complete":
                cases.pop(row.run, None)
        # events to the log, and a new table now and then
        tasks = [Task(name, case, path / RUNS / name) for name, case in cases.items()]
        written_at = time.monotonic()

        def note(event: Event) -> None:
            nonlocal table, written_at
            if event.kind != "progress":
                home.log(event)
            if event.kind == "complete" and time.monotonic() - written_at >= TABLE_EVERY:
                table = Table.read(path, table)
                table.write()
                written_at = time.monotonic()
            if report is not None:
                report(event, table)

        try:
            if tasks:
                (engine or LocalEngine()).make(tasks, note, should_stop or never)
        finally:  # whatever has happened, the table says what is there
            table = Table.read(path, table)
            table.write()
    return table


def never() -> bool:
    """Let all runs go on to their ends."""
    return False


def make_folders(
    cases: Mapping[Path, Case],
    engine: Engine,
    report: Callable[[Event], None],
    should_stop: Callable[[], bool],
) -> None:
    """Make run folders anywhere exist, without a table: those of studies, by the names they give.

    A run that fails stops no other. Arguments as those of `make_runs`.
    """
    # folders with a summary are complete
    waiting = {path: case for path, case in cases.items() if not (path / "summary.json").exists()}
    tasks = [Task(path.name, case, path) for path, case in waiting.items()]
    engine.make(tasks, report, should_stop)


def sweep(
    plan: str | PathLike[str] | SweepPlan,
    out: str | PathLike[str],
    *,
    vary: Mapping[str, Any] | None = None,
    set: Mapping[str, Any] | None = None,
    sampling: Mapping[str, Any] | None = None,
    columns: Sequence[str] = (),
    workers: int | None = None,
    threads: int | None = None,
    retries: int = 2,
    engine: Engine | None = None,
) -> Table:
    """Run a case with many settings; the same call again goes on where it was stopped.

        table = lasersph.sweep("dlip-steel", "runs/map",
                               set={"solver.kind": "conduction"},
                               vary={"laser.fluence": ["0.4 J/cm^2", "0.6 J/cm^2"]})
        table.values("melt.depth_max_m")

    Args:
        plan: a plan, a plan file, or with `vary` a case file or the name of a shipped case.
        out: folder of the runs.
        vary, set, sampling, columns: the tables of a plan file; vary has lists or
            {"from": ..., "to": ..., "count": ...}.
        workers, threads, retries: see `LocalEngine`. engine: another one in its place.

    Returns:
        The table of the runs, a row each; `values` gives a number of all of them as an array.

    Raises:
        CaseError: every mistake of the plan or its case. FolderRefused: see `make_runs`.
    """
    if not isinstance(plan, SweepPlan):
        given = {"set": set, "sampling": sampling, "columns": columns}
        plan = read_plan(plan) if vary is None else build_plan(plan, vary, **given)
    return make_runs(
        plan.points(), out, plan.study, engine=engine or LocalEngine(workers, threads, retries)
    )
