"""`lasersph cache`: the folder of compiled loops."""

from __future__ import annotations

import sys
from typing import Annotated, Literal

import typer

from lasersph.cli.failures import WrongCommand

Action = Annotated[
    Literal["show", "fill", "clear"],
    typer.Argument(
        help="show: where the loops are and how large; fill: compile those of cases, so that their"
        " runs need not; clear: remove them."
    ),
]
Cases = Annotated[
    list[str] | None,
    typer.Argument(metavar="CASE", help="For fill: case files, or names of shipped cases."),
]


def cache(action: Action = "show", cases: Cases = None) -> None:
    """Show, fill or clear the cache of compiled loops."""
    # Cases and fill belong together.
    if (action == "fill") != bool(cases):
        raise WrongCommand(
            "cases are for fill: lasersph cache fill CASE"
            if cases
            else "fill wants the cases whose loops to compile: lasersph cache fill dlip-steel"
        )
    from lasersph.case.size import in_words
    from lasersph.compute import cache as loops

    if cases:
        for name in cases:
            _fill(name)
    elif action == "clear":
        print(f"removed {in_words(loops.clear())} from {loops.location()}")
    else:
        print(f"{loops.location()}: {len(loops.files())} loops, {in_words(loops.size())}")


def _fill(name: str) -> None:
    """Compile the loops of a case for processors, in float64: those that its coarse copy calls.

    A few that only more particles need, of multigrid, are left to the run.
    """
    from pathlib import Path
    from tempfile import TemporaryDirectory

    from lasersph import simulation
    from lasersph.case import load_case
    from lasersph.compute.compiling import Compiling

    # A coarse copy calls the same loops in seconds.
    case = load_case(name, quick=True)

    def begun() -> None:
        print(f"compiling the loops of {case.name}, about a minute", file=sys.stderr, flush=True)

    with TemporaryDirectory() as folder, Compiling(begun) as compiling:
        simulation.run(case, Path(folder, "run"), warn=False)
    print(f"{case.name}: compiled {compiling.loops} loops in {compiling.seconds:.0f} s")
