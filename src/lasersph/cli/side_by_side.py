"""Runs of a study that do not wait for each other, made by several workers at a time."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from lasersph.cli.failures import StoppedBySignal, WrongCommand
from lasersph.cli.stop_signals import StopSignals

if TYPE_CHECKING:
    from lasersph.case import Case
    from lasersph.sweeps import Event

Workers = Annotated[
    int,
    typer.Option(
        "--workers",
        min=1,
        metavar="N",
        help="Runs that are made at a time, where they do not wait for each other.",
    ),
]


def refuse_workers(workers: int, backend: str, precision: str = "float64") -> None:
    """Refuse several workers for what only one computes. Raises WrongCommand."""
    if workers > 1 and (backend != "cpu" or precision != "float64"):
        raise WrongCommand("--workers is for --backend cpu in float64")


def preparation(
    workers: int, threads: int | None, again: str
) -> Callable[[Mapping[Path, Case]], None]:
    """A function that makes the run folders of cases exist, several at a time.

    Args:
        threads: of each worker; None for the processors over the workers.
        again: how to go on after a signal.
    """

    def report(event: Event) -> None:
        if event.kind not in ("started", "progress", "waiting"):
            text = f"{event.run}: {event.kind}" + (f": {event.message}" if event.message else "")
            print(text, file=sys.stderr, flush=True)

    def prepare(cases: Mapping[Path, Case]) -> None:
        from lasersph.sweeps import LocalEngine
        from lasersph.sweeps.make import make_folders

        if workers == 1 or not cases:
            return
        with StopSignals() as signals:
            make_folders(cases, LocalEngine(workers, threads), report, signals.asked)
        if signals.code:
            raise StoppedBySignal(f"stopped; continue with {again}", signals.code)

    return prepare
