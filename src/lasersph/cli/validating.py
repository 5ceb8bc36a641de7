"""`lasersph validate`: published and exact numbers beside computed ones, with a verdict."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from lasersph.cli.arguments import Backend, Out, Threads, refuse_backend
from lasersph.cli.failures import FAILED

SCHEMA_VERSION = 1
RUNS = Path("runs") / "validation"
Names = Annotated[
    list[str] | None, typer.Argument(metavar="NAME", help="Default: all of them, in order.")
]
Json = Annotated[
    Path | None, typer.Option("--json", metavar="FILE", help="Write all numbers as JSON as well.")
]
Short = Annotated[bool, typer.Option("--quick", help="Shortened runs; still judged.")]
OnlyList = Annotated[bool, typer.Option("--list", help="List the validations and run none.")]


def validate(
    names: Names = None,
    json_file: Json = None,
    out: Out = None,
    quick: Short = False,
    only_list: OnlyList = False,
    threads: Threads = None,
    backend: Backend = "cpu",
) -> None:
    """Compute published cases; print published, reference and computed numbers with verdicts.

    Runs are kept in the output folder: the same command goes on where it was interrupted.
    """
    from lasersph import validation
    from lasersph.cli.tables import aligned

    if only_list:
        print(aligned(validation.titles().items()))
        return
    wanted = dict.fromkeys(map(validation.known_name, names or validation.names()))
    refuse_backend(backend, threads)
    if json_file is not None:
        _write(json_file, backend, {})
    reports: dict[str, dict[str, Any]] = {}
    for name in wanted:
        folder = (out or RUNS) / name
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
