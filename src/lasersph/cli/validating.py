"""`lasersph validate`: published and exact numbers beside computed ones, with a verdict."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Any

import typer

from lasersph.cli.arguments import Backend, Out, Threads, refuse_backend
from lasersph.cli.failures import FAILED, WrongCommand

SCHEMA_VERSION = 1
RUNS = Path("runs") / "validation"
RECORDS = Path("docs") / "validation"
Names = Annotated[
    list[str] | None, typer.Argument(metavar="NAME", help="One or several; see --list.")
]
All = Annotated[bool, typer.Option("--all", help="All of them, in order: hours.")]
Json = Annotated[
    Path | None, typer.Option("--json", metavar="FILE", help="Write all numbers as JSON as well.")
]
Short = Annotated[bool, typer.Option("--quick", help="Shortened runs; still judged.")]
OnlyList = Annotated[bool, typer.Option("--list", help="List the validations and run none.")]
Record = Annotated[
    Path | None,
    typer.Option(
        "--record", metavar="DIR", help="Compute what is out of date in a folder of records."
    ),
]
Status = Annotated[
    bool,
    typer.Option("--status", help=f"Say which records are current (of --record, {RECORDS})."),
]
Confirm = Annotated[
    bool,
    typer.Option("--confirm", help="Confirm stale records by their shortened form (as --status)."),
]


def validate(
    names: Names = None,
    every: All = False,
    json_file: Json = None,
    out: Out = None,
    quick: Short = False,
    only_list: OnlyList = False,
    record: Record = None,
    status: Status = False,
    confirm: Confirm = False,
    threads: Threads = None,
    backend: Backend = "cpu",
) -> None:
    """Compute published cases; print published, reference and computed numbers with verdicts.

    Runs are kept in the output folder: the same command goes on where it was interrupted.
    """
    from lasersph import validation
    from lasersph.input.text_table import text_table

    if only_list:
        print(text_table(validation.titles().items()))
        return

    # Options that exclude each other.
    if every and names:
        raise WrongCommand("--all is for no NAME")
    of_records = record is not None or status or confirm
    if of_records and (quick or json_file is not None or (status and confirm)):
        raise WrongCommand("--record, --status and --confirm go without --quick and --json")

    # Each name once, in its order.
    wanted = list(dict.fromkeys(map(validation.known_name, names or validation.names())))
    refuse_backend(backend, threads)
    folder, out = record or RECORDS, out or RUNS

    # Say, confirm or compute records; else compute and judge.
    if status:
        _say_states(wanted, folder)
    elif confirm:
        _confirm(wanted, folder, out, threads)
    elif record is not None:
        _record(wanted, folder, out, threads, backend)
    else:
        cost = _cost(wanted, quick=quick)
        if not (names or every):
            raise WrongCommand(
                f"{cost}; give names (lasersph validate --list) or --all"
                + ("" if quick else ", or --quick for the shortened forms")
            )
        print(cost, file=sys.stderr, flush=True)
        _compute(wanted, out, quick, json_file, threads, backend)


def _cost(names: list[str], *, quick: bool) -> str:
    """How many validations there are and how long they took when they were recorded."""
    from lasersph.input import format_duration
    from lasersph.validation.records import recorded_seconds

    # Times as they were recorded, where they were.
    known = [recorded_seconds(name, RECORDS, quick=quick) for name in names]
    seconds = [one for one in known if one is not None]
    form = "shortened " if quick else ""
    count = f"{len(names)} {form}validation{'s' * (len(names) > 1)}, one after the other"
    if not seconds:
        return count if quick else f"{count}, from seconds to hours each"
    source = "" if len(seconds) == len(names) else f", {len(seconds)} of them,"
    took = format_duration(sum(seconds))
    return f"{count}, which{source} took {took} when they were recorded"


def _compute(
    names: list[str],
    out: Path,
    quick: bool,
    json_file: Path | None,
    threads: int | None,
    backend: str,
) -> None:
    """Print a table of each, and a verdict of all; exit code 1 where one did not pass."""
    from lasersph import validation

    # An answer that could not be written is noticed before hours of runs.
    if json_file is not None:
        _write(json_file, backend, {})
    reports: dict[str, dict[str, Any]] = {}
    # One after the other, each stored when it is finished.
    for name in names:
        folder = out / "short" / name if quick else out / name
        report = validation.validate(name, folder, quick=quick, threads=threads, backend=backend)
        print(report.table(), end="\n\n", flush=True)
        reports[name] = report.as_dict()
        if json_file is not None:
            _write(json_file, backend, reports)
    failed = [name for name, report in reports.items() if not report["passed"]]
    print(f"{len(reports) - len(failed)} of {len(reports)} passed")
    if failed:
        print(f"not passed: {', '.join(failed)}")
        raise typer.Exit(FAILED)


def _say_states(names: Iterable[str], folder: Path) -> None:
    """Print a line of each record; exit code 1 where one is failed, stale or missing."""
    from lasersph.input.text_table import text_table
    from lasersph.validation.records import state_of

    # A line a record; anything but current and confirmed fails.
    states = [state_of(name, folder) for name in names]
    rows = [(state.name, state.word, state.text) for state in states]
    print(text_table(rows, ("validation", "record", "of")))
    if any(state.word not in ("current", "confirmed") for state in states):
        raise typer.Exit(FAILED)


def _record(
    names: Iterable[str], folder: Path, out: Path, threads: int | None, backend: str
) -> None:
    """Compute what is out of date, one after the other, each stored when it is finished."""
    from lasersph.validation.records import make_record, state_of

    # What is current is not computed again.
    left = [name for name in names if state_of(name, folder).is_out_of_date]
    if left:
        print(_cost(left, quick=False), file=sys.stderr, flush=True)
    for name in left:
        print(f"{name}: computing", flush=True)
        make_record(name, folder, out, threads=threads, backend=backend)
    _say_states(names, folder)


def _confirm(names: Iterable[str], folder: Path, out: Path, threads: int | None) -> None:
    """Compute the shortened form of what is stale; say what stands against confirming it."""
    from lasersph.validation.records import confirm, state_of

    for name in names:
        state = state_of(name, folder)
        # Stale records can be confirmed by their shortened form, missing ones cannot.
        if state.record is not None and state.changes:
            print(f"{name}: computing its shortened form", flush=True)
            for text in confirm(state, folder, out, threads=threads)[:4]:
                print(f"{name}: not confirmed: {text}")
    _say_states(names, folder)


def _write(file: Path, backend: str, reports: dict[str, dict[str, Any]]) -> None:
    """All reports so far; long validations leave what they have when they are stopped."""
    import lasersph
    from lasersph.output.atomic import replace_json

    content = {
        "schema_version": SCHEMA_VERSION,
        "lasersph": lasersph.__version__,
        "backend": backend,
        "passed": bool(reports) and all(report["passed"] for report in reports.values()),
        "validations": reports,
    }
    replace_json(file, content)
