"""`lasersph converge` and `threshold`: many runs for one answer."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from lasersph.cli.arguments import CaseName, Out, Quick, Settings, Threads
from lasersph.cli.failures import WrongCommand
from lasersph.cli.tables import aligned

Spacings = Annotated[
    str, typer.Option("--spacing", metavar="A,B,C", help="Three or more, e.g. 32nm,16nm,8nm.")
]
Of = Annotated[
    Literal["melt", "vaporize"],
    typer.Option("--of", help="Completely molten somewhere, or the boiling point reached."),
]
Tolerance = Annotated[
    float,
    typer.Option(
        "--tolerance", min=1e-6, max=0.5, help="Half-width of the bracket over its middle."
    ),
]
Json = Annotated[
    Path | None, typer.Option("--json", metavar="FILE", help="Write the answer as JSON as well.")
]


def converge(
    case: CaseName,
    spacing: Spacings,
    out: Out = None,
    settings: Settings = None,
    threads: Threads = None,
    json_file: Json = None,
) -> None:
    """Run a case at several spacings: order and uncertainty of every number of its summary."""
    from lasersph import studies
    from lasersph.case import load_case

    wanted = [_length(text) for text in spacing.split(",") if text.strip()]
    if len(set(wanted)) < 3:
        raise WrongCommand("--spacing: an order needs three different spacings, e.g. 32nm,16nm,8nm")
    loaded = load_case(case, settings or ())
    _refuse_missing_folder(json_file)
    folder = _new_folder(out or Path("runs") / f"{loaded.name}-converge")
    found = studies.converge(loaded, wanted, folder, run=_runner(threads), report=_report)
    print(aligned(found.table(), header=True))
    _write(json_file, found.as_dict())


def threshold(
    case: CaseName,
    of: Of,
    out: Out = None,
    settings: Settings = None,
    quick: Quick = False,
    threads: Threads = None,
    tolerance: Tolerance = 0.01,
    json_file: Json = None,
) -> None:
    """Find the fluence at which melting or boiling begins, by bisection."""
    from dataclasses import asdict

    from lasersph import studies
    from lasersph.case import load_case

    loaded = load_case(case, settings or (), quick=quick)
    if loaded.laser is None:
        raise WrongCommand(f"{loaded.name} has no laser, so no threshold")
    section = loaded.material.melting if of == "melt" else loaded.material.vaporization
    if section is None or not loaded.solver.phase_change:
        raise WrongCommand(f"{loaded.name} computes no phase change to {of}, so no threshold")
    _refuse_missing_folder(json_file)
    folder = _new_folder(out or Path("runs") / f"{loaded.name}-threshold")
    found = studies.threshold(
        loaded, of, folder, tolerance=tolerance, run=_runner(threads), report=_report
    )
    print(_answer(found))
    _write(json_file, asdict(found))


def _answer(found: Any) -> str:
    from lasersph.studies import show_energy

    below, above = (show_energy(found.key, value) for value in (found.below, found.above))
    return (
        f"{found.key} = {show_energy(found.key, found.value, 4)} +- {100 * found.tolerance:.2g} % "
        f"to {found.of} (between {below} and {above})"
    )


def _length(text: str) -> float:
    from lasersph.reading import QuantityError, parse_quantity

    try:
        value = parse_quantity(text.strip(), "length")
    except QuantityError as error:
        raise WrongCommand(f"--spacing: {error}") from None
    if value <= 0.0:
        raise WrongCommand(f'--spacing: "{text.strip()}" must be greater than 0')
    return value


def _new_folder(folder: Path) -> Path:
    """Refuse a folder that holds files, as a run does."""
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise WrongCommand(f"{folder} is not empty: choose another folder with --out")
    return folder


def _refuse_missing_folder(file: Path | None) -> None:
    """Refuse an answer that could not be written after hours of runs."""
    if file is not None and not file.absolute().parent.is_dir():
        raise WrongCommand(f"--json: there is no folder {file.parent}")


def _runner(threads: int | None) -> Any:
    from lasersph.simulation import run

    return lambda case, folder: run(case, folder, threads=threads)


def _report(line: str) -> None:
    print(line, file=sys.stderr, flush=True)


def _write(file: Path | None, content: dict[str, Any]) -> None:
    from lasersph.output.atomic import replace_json

    if file is not None:
        replace_json(file, content)
