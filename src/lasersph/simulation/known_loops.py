"""The loops that runs are known to call, by kind of run, so that several processors compile them.

`benchmarks/known_loops.py` writes the lists from coarse runs of all shipped cases.
"""

from __future__ import annotations

from pathlib import Path

from lasersph.case import Case
from lasersph.compute.ahead import CompilingAhead, places_of

FILE = Path(__file__).with_name("known_loops.jsonl")
PRECISION = "float64"
"""Of the lists; runs in another compile their loops when they call them."""


def kind_of_run(case: Case) -> str:
    """Name of the list of loops that a run of a case calls."""
    what = "block" if case.flow is None else "box"
    surface = "moving" if case.surface_moves else "flat"
    return f"{case.solver.kind}, {case.solver.dimensions}-D {what}, {surface} surface"


def known_loops(case: Case) -> int:
    """Number of loops that a run of a case is known to call; 0 where its kind is not known."""
    return len(places_of(FILE).get(kind_of_run(case), ()))


def compiling_ahead(case: Case) -> CompilingAhead:
    """Lets other processes compile what a run of a case calls, see `compute.ahead`."""
    return CompilingAhead(FILE, kind_of_run(case))
