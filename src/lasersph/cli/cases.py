"""`lasersph new`, `check`, `cases`, `schema`: cases before they run."""

from __future__ import annotations

from typing import Annotated

import typer

from lasersph.cli.arguments import (
    Backend,
    CaseName,
    Quick,
    Settings,
    Threads,
    refuse_backend,
    say_what_moved,
)
from lasersph.cli.failures import WrongCommand
from lasersph.input.text_table import text_table

NewFile = Annotated[
    str | None, typer.Argument(metavar="FILE", help="The file to write; must be new.")
]
PlanKind = Annotated[
    str | None,
    typer.Option(
        "--plan",
        metavar="KIND",
        help="Write a plan for many runs of the case instead: sweep, calibrate, find.",
    ),
]


def new(case: CaseName, file: NewFile = None, plan: PlanKind = None) -> None:
    """Write a commented case file, or a plan for many runs, to start from."""
    if plan is not None:
        # A plan may go without a case: then it is one for the case of the manual.
        from lasersph.sweeps.new_plan import write_new_plan

        case, target = ("dlip-steel", case) if file is None else (case, file)
        path = write_new_plan(plan, case, target)
        trial = "" if plan == "find" else " --dry-run"
        print(f"wrote {path}: edit it, then lasersph {plan} {path}{trial}")
        return
    if file is None:
        raise WrongCommand("new wants a case and a file: lasersph new dlip-steel my-case.toml")
    from lasersph.case import write_new_case

    path = write_new_case(case, file)
    print(f"wrote {path}: edit it, then lasersph check {path} or lasersph run {path}")


def list_cases() -> None:
    """List the shipped cases."""
    from lasersph.case import available_cases
    from lasersph.input import read_toml

    rows = [(name, read_toml(path).data["title"]) for name, path in available_cases().items()]
    print(text_table(rows))


def schema() -> None:
    """Print the JSON Schema of case files."""
    import json

    from lasersph.case import Case

    print(json.dumps(Case.model_json_schema(), indent=2))


def check(
    case: CaseName,
    settings: Settings = None,
    quick: Quick = False,
    threads: Threads = None,
    backend: Backend = "cpu",
) -> None:
    """Say what a run would need, before anything runs: particles, memory, steps, warnings."""
    from lasersph.case import load_case
    from lasersph.simulation import check as check_case

    refuse_backend(backend, threads)
    # Read, convert, forecast; nothing is wrong with the keys once nothing has refused them.
    loaded = load_case(case, settings or (), quick=quick)
    say_what_moved(loaded)
    expected = check_case(loaded, threads=threads, backend=backend)
    print(expected)
    print("no mistake in the case" + ("; think about the warnings" if expected.warnings else ""))
    if expected.flow is not None and expected.flow.unresolved and not quick:
        print("too coarse for its flow: lasersph run asks for --anyway or --quick")
