"""Arguments and options that several verbs share."""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from lasersph.cli.failures import WrongCommand

if TYPE_CHECKING:
    from lasersph.case import Case


def completion_of(room: str, lister: str) -> Callable[[str], list[str]]:
    """Completion of a name: those that a function of a room lists and that begin so. A shell adds
    files where there is none."""

    def complete(begun: str) -> list[str]:
        names = getattr(import_module(f"lasersph.{room}"), lister)()
        return [name for name in names if name.startswith(begun)]

    return complete


CaseName = Annotated[
    str,
    typer.Argument(
        metavar="CASE",
        help="A case file, the name of a shipped case, or a run folder: its case and settings.",
        autocompletion=completion_of("case", "available_cases"),
    ),
]
Settings = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        help="Change one key of the case, e.g. laser.fluence=0.8J/cm2. Later ones win.",
    ),
]
Out = Annotated[Path | None, typer.Option("--out", metavar="DIR", help="Folder to write into.")]
Resume = Annotated[
    bool, typer.Option("--resume", help="Continue what DIR holds, or start where it holds nothing.")
]
Overwrite = Annotated[
    bool, typer.Option("--overwrite", help="Replace the run that DIR holds, if the case is right.")
]
Quick = Annotated[
    bool, typer.Option("--quick", help="Up to four times coarser, to see that it works.")
]
Anyway = Annotated[
    bool,
    typer.Option(
        "--anyway",
        help="Start all the same what is too large for this machine, or too coarse for its flow.",
    ),
]
Threads = Annotated[
    int | None, typer.Option("--threads", min=1, metavar="N", help="Default: all processors.")
]
Backend = Annotated[
    Literal["cpu", "cuda"],
    typer.Option("--backend", help="Where to compute: the processor or a CUDA graphics card."),
]
RunFolder = Annotated[Path, typer.Argument(metavar="DIR", help="The folder of a run.")]


def refuse_backend(backend: str, threads: int | None) -> None:
    """Refuse a graphics card that is not there, or threads for one, before anything is written.

    Raises:
        WrongCommand: threads are asked for. NoDevice: see `compute.cuda_device`.
    """
    if backend != "cuda":
        return
    if threads is not None:
        raise WrongCommand("--threads is for --backend cpu")
    from lasersph.compute import cuda_device

    cuda_device.checked()


def read_quantity(option: str, text: str, kind: str) -> float:
    """The number in SI units that an option gives with its unit.

    Raises:
        WrongCommand: it is no quantity of that kind.
    """
    from lasersph.input import QuantityError, parse_quantity

    try:
        return parse_quantity(text.strip(), kind)
    except QuantityError as error:
        raise WrongCommand(f"{option}: {error}") from None


def read_quantities(option: str, text: str, kind: str) -> list[float]:
    """Positive numbers in SI units from an option that separates them by commas.

    Raises:
        WrongCommand: one is no quantity of that kind, or not above zero.
    """
    # Empty parts, as of a comma at the end, are no values.
    texts = [one.strip() for one in text.split(",") if one.strip()]
    values = [read_quantity(option, one, kind) for one in texts]
    for one, value in zip(texts, values, strict=True):
        if value <= 0.0:
            raise WrongCommand(f'{option}: "{one}" must be greater than 0')
    return values


def say_what_moved(case: Case) -> None:
    """Say which keys of an older case file were read at another place."""
    if case.conversion_note:
        print(f"note: {case.conversion_note}", file=sys.stderr)
