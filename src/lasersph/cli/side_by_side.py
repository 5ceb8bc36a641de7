"""Runs of a study that do not wait for each other, made by several workers at a time."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from lasersph.cli.engine_options import EngineOptions
from lasersph.cli.failures import StoppedBySignal, WrongCommand
from lasersph.cli.stop_signals import StopSignals

if TYPE_CHECKING:
    from lasersph.case import Case
    from lasersph.sweeps import Event


def refuse_workers(engine: EngineOptions, backend: str, precision: str = "float64") -> None:
    """Refuse several workers for what only one computes. Raises WrongCommand."""
    if engine.at_once > 1 and (backend != "cpu" or precision != "float64"):
        raise WrongCommand("--workers is for --backend cpu in float64")


def preparation(engine: EngineOptions, again: str) -> Callable[[Mapping[Path, Case]], None]:
    """A function that makes the run folders of cases exist, several at a time.

    Args:
        again: how to go on after a signal.

    Raises:
        WrongCommand: see `EngineOptions.engine`.
    """
    chosen = engine.engine()

    def report(event: Event) -> None:
        # Starts and progress of each run would drown the rest.
        if event.kind not in ("started", "progress", "waiting"):
            text = f"{event.run}: {event.kind}" + (f": {event.message}" if event.message else "")
            print(text, file=sys.stderr, flush=True)

    def prepare(cases: Mapping[Path, Case]) -> None:
        from lasersph.sweeps.make import make_folders

        # One worker makes the runs as they are asked for.
        if engine.at_once == 1 or not cases:
            return
        with StopSignals() as signals:
            make_folders(cases, chosen, report, signals.asked)
        if signals.code:
            raise StoppedBySignal(f"stopped; continue with {again}", signals.code)

    return prepare
