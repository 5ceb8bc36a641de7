"""How many runs a command makes and how long they take, said before the first of them begins."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from lasersph.cli.engine_options import EngineOptions

if TYPE_CHECKING:
    from lasersph.case import Case

SAMPLED = 9
"""Runs that are forecast, spread over all: each takes up to a third of a second."""


def say_cost(
    cases: Sequence[Case],
    engine: EngineOptions,
    backend: str,
    folder: Path,
    *,
    more: str = "",
    instead: str = "",
) -> None:
    """Say on standard error how many runs there are, how long they take and where they go.

    Args:
        cases: of all runs. more: follows their number. instead: a quicker way.
    """
    time = "" if backend != "cpu" else f", roughly {_duration(cases, engine)}"
    _say(f"{len(cases)} runs{more}{time}, in {folder}")
    if instead:
        _say(instead)


def expected_seconds(cases: Sequence[Case], threads: int) -> float:
    """Expected wall time of runs one after the other [s], from some of them where they are many."""
    from lasersph.simulation import forecast

    # Forecast some, spread over all, and scale: each takes up to a third of a second.
    chosen = cases[:: -(-len(cases) // SAMPLED)] if cases else ()
    seconds = sum(forecast(case, threads=threads).wall_time for case in chosen)
    return seconds * len(cases) / max(1, len(chosen))


def _duration(cases: Sequence[Case], engine: EngineOptions) -> str:
    """Expected time of all runs, in words, and by whom."""
    from lasersph.compute.threads import available, chosen
    from lasersph.input import format_duration

    # Workers share the processors.
    count = min(engine.at_once, len(cases))
    threads = chosen(engine.threads) if count == 1 else max(1, available() // count)
    seconds = expected_seconds(cases, threads) / count
    how = "one after the other" if count == 1 else f"{count} at a time"
    return f"{format_duration(seconds)} {how}"


def _say(line: str) -> None:
    print(line, file=sys.stderr, flush=True)
