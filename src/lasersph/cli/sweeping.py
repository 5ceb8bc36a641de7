"""`lasersph sweep`: many runs of one case by a plan."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from lasersph.cli.arguments import Out
from lasersph.cli.cluster import RunsInHand, Slurm, SlurmDask, write_scripts
from lasersph.cli.engine_options import EngineOptions, takes_engine
from lasersph.cli.failures import DONE, FAILED, StoppedBySignal, WrongCommand
from lasersph.cli.same_command import command_of
from lasersph.input.text_table import text_table

if TYPE_CHECKING:
    from lasersph.sweeps import Engine, Event, Point, Study, SweepPlan, Table
    from lasersph.sweeps.progress import SweepStatus

PlanName = Annotated[
    Path, typer.Argument(metavar="PLAN", help="A plan file; with --table the folder of a sweep.")
]
DryRun = Annotated[
    bool,
    typer.Option(
        "--dry-run", help="Say how many runs, how long, and what is refused; compute nothing."
    ),
]
OnlyTable = Annotated[
    bool, typer.Option("--table", help="Make table.csv of a folder anew; compute nothing.")
]
MOST_SHOWN = 20
"""Failures and refusals that are listed; the table has all of them."""


@takes_engine
def sweep(
    plan: PlanName,
    engine: EngineOptions,
    out: Out = None,
    slurm: Slurm = None,
    slurm_dask: SlurmDask = None,
    dry_run: DryRun = False,
    table: OnlyTable = False,
) -> int:
    """Run a case with many settings by a plan; the same command again goes on."""
    # The table alone, anew from the folder.
    if table:
        return _remake(plan)
    from lasersph.sweeps import read_plan

    if plan.is_dir():
        raise WrongCommand(
            f"{plan} is a folder: give the plan, {plan / 'plan.toml'} if it is of a sweep, or add "
            "--table"
        )
    # Read the plan with its notes; then forecast, scripts, or runs.
    loaded = read_plan(plan)
    for note in loaded.notes():
        _say(f"note: {note}")
    if dry_run:
        forecast(loaded, engine)
        return DONE
    folder = out or Path("runs") / plan.stem
    if slurm is not None or slurm_dask is not None:
        return write_scripts(loaded, plan, folder, slurm, slurm_dask)
    again = command_of("sweep", plan, *engine.words(), out=folder)
    chosen = engine.engine()
    say_forecast(loaded.points(), engine, folder, loaded.study)
    return tell(make(loaded, folder, chosen, again))


def make(plan: SweepPlan, folder: Path, engine: Engine, again: str) -> Table:
    """Make the runs with progress; a signal ends them with checkpoints and the way to go on."""
    from lasersph.cli.progress import ProgressDisplay
    from lasersph.cli.stop_signals import StopSignals
    from lasersph.sweeps import DaskEngine, make_runs
    from lasersph.sweeps.progress import SweepProgress

    # Progress of all runs, and of a cluster also which worker has which.
    progress = SweepProgress()
    with StopSignals() as signals, ProgressDisplay(describe) as display:
        in_hand = RunsInHand(display.say) if isinstance(engine, DaskEngine) else None

        def should_stop() -> bool:
            if in_hand is not None:
                in_hand.say_if_due()
            return signals.asked()

        def report(event: Event, table: Table) -> None:
            if in_hand is not None:
                in_hand.note(event)
            # Failures are said above the line of progress.
            status = progress.step(event, table)
            if event.kind in ("failed", "wrong", "retry"):
                word = {"retry": "tried again", "wrong": "refused"}.get(event.kind, event.kind)
                display.say(f"{event.run} {word}: {event.message}")
            display(status)

        table = make_runs(
            plan.points(),
            folder,
            plan.study,
            engine=engine,
            report=report,
            should_stop=should_stop,
        )

    # Complete runs need no continuation.
    if signals.code and not table.is_complete.all():
        raise StoppedBySignal(
            f"stopped with {table.count('complete')} of {len(table.rows)} runs complete; continue "
            f"with: {again}",
            signals.code,
        )
    return table


def describe(status: SweepStatus) -> str:
    """Part of the work, runs complete and in hand, failed, refused, and the time left if known."""
    from lasersph.input import format_duration

    left = status.remaining_s
    return ", ".join(
        [
            f"{100 * min(status.work_done, 1.0):3.0f} %  {status.complete} of {status.total} runs",
            *([f"{status.running} running"] if status.running else []),
            *([f"{status.failed} failed"] if status.failed else []),
            *([f"{status.refused} refused"] if status.refused else []),
            *([] if left is None else [f"{format_duration(left)} left"]),
        ]
    )


def tell(table: Table) -> int:
    """Say what is complete and what is not, and why; the exit code."""
    from lasersph.sweeps.folder import RUNS, TABLE

    # What is complete, and the first of what is not, with its reason.
    for line in table.unknown_columns():
        _say(f"warning: {line}")
    others = [row for row in table.rows if row.status != "complete"]
    print(f"{table.count('complete')} of {len(table.rows)} runs complete: {table.path / TABLE}")
    shown = [(row.run, row.status, row.reason) for row in others[:MOST_SHOWN]]
    if shown:
        print(text_table(shown, ("run", "status", "reason")))
    if len(others) > MOST_SHOWN:
        print(f"and {len(others) - MOST_SHOWN} more, see {table.path / TABLE}")
    tell_warnings(table)
    # A failed run has a log of its own.
    failed = next((row for row in others if row.status == "failed"), None)
    if failed is not None:
        print(f"look at one with: lasersph info {table.path / RUNS / failed.run}")
    return FAILED if others else DONE


def tell_warnings(table: Table) -> None:
    """Say how many runs warn, and of what: each kind of warning once, with numbers of one run."""
    from lasersph.sweeps.run_warnings import warnings_of_runs

    warned, counts = warnings_of_runs(table)
    if warned:
        _say(f"{warned} of {table.count('complete')} complete runs warn (numbers of one of them):")
    for text, count in counts.items():
        _say(f"warning of {count} run{'s' * (count > 1)}: {text}")


def _remake(folder: Path) -> int:
    from lasersph.output import OutputError
    from lasersph.sweeps import Table

    try:
        found = Table.read(folder)
    except OutputError as error:
        raise WrongCommand(str(error)) from None
    found.write()
    return tell(found)


def forecast(plan: SweepPlan, engine: EngineOptions) -> None:
    """Say how many runs there are, how long they take, and which the case refuses."""
    points = plan.points()
    rows = [
        ("case", Path(plan.template.file.document.file).stem),
        ("runs", count_words(points) + refused_words(points)),
        ("varied", ", ".join(plan.choices)),
    ]
    print(text_table([*rows, *forecast_rows(points, engine)]))
    tell_refused(points)


def say_forecast(
    points: Sequence[Point],
    engine: EngineOptions,
    folder: Path,
    study: Study,
    most: int = 0,
    more: str = "",
) -> None:
    """Say in a line how many runs begin, which are there already, and how long the others take.

    Args:
        folder, study: of the runs. most: runs at most, where a study adds some to these.
        more: follows the number of runs.

    Raises:
        FolderRefused: the folder holds something else.
    """
    from lasersph.sweeps.folder import complete_hashes

    # Complete runs of an earlier call count as done.
    there = complete_hashes(folder, study)
    left = [point for point in points if point.hash not in there]
    known = len(points) - len(left)
    words = [f"{count_words(points, most)} runs{more}{refused_words(points)}"]
    if known:
        words.append(f"{known} of them complete" if left else "all complete")
    words += [f"{how}: {time}" for how, time in forecast_rows(left, engine, most - known)]
    _say(", ".join(words))


def count_words(points: Sequence[Point], most: int = 0) -> str:
    """How many runs there are: 4, or 4 to 6 where a study adds some, `most` in all."""
    # Points that the case refuses make no run.
    right = sum(point.case is not None for point in points)
    return f"{right} to {most}" if most > len(points) else f"{right}"


def refused_words(points: Sequence[Point]) -> str:
    """How many points the case refuses; empty where none."""
    wrong = sum(point.case is None for point in points)
    return f", and {wrong} points that the case refuses" if wrong else ""


def forecast_rows(
    points: Sequence[Point], engine: EngineOptions, most: int = 0
) -> list[tuple[str, str]]:
    """How long runs take, as rows of a table; none without runs.

    Args:
        most: runs at most, where a study adds some to these.
    """
    from lasersph.compute.threads import available
    from lasersph.input import format_duration
    from lasersph.sweeps.forecast import forecast_seconds

    right = sum(point.case is not None for point in points)
    if not right:
        return []
    # Workers share the processors, unless the threads of each are given.
    count = min(engine.workers or available(), right)
    of_each = engine.threads or max(1, available() // count)
    # Some runs are forecast, and where a study may add runs, both ends are said.
    seconds, sampled = forecast_seconds(points, of_each)
    shares = (1.0, most / len(points)) if most > len(points) else (1.0,)

    def duration(workers: int) -> str:
        each = (format_duration(share * seconds / workers) for share in shares)
        return f"roughly {' to '.join(each)}"

    source = "" if sampled == right else f", estimated from {sampled} of them"
    rows = [("one after the other", f"{duration(1)}{source}")]
    if not engine.is_distant:
        who = f"{count} worker{'s' * (count > 1)} with {of_each} thread{'s' * (of_each > 1)} each"
        rows.append(("together", f"{duration(count)} by {who}"))
    return rows


def tell_refused(points: Sequence[Point]) -> None:
    """Say which points the case refuses, and why."""
    for point in points:
        if point.case is None:
            values = ", ".join(f"{key} = {value}" for key, value in point.settings.items())
            print(f"refused: {values}: {point.reason}")


def _say(line: str) -> None:
    print(line, file=sys.stderr, flush=True)
