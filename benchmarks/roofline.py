"""How near the hot loops come to what this machine, or its graphics card, can do.

    python benchmarks/roofline.py
    python benchmarks/roofline.py --backend cuda --sizes 400000,10000000 --json card.json

Other programs on the machine make the numbers wrong.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer
from hot_loops.card import measure_card
from hot_loops.ceilings import Ceilings
from hot_loops.measure import Measured, measure, memory
from hot_loops.table import as_dict, ceilings_line, growth, table

import lasersph
from lasersph.case.size import in_words, memories
from lasersph.cli.arguments import Backend, Threads, refuse_backend
from lasersph.cli.failures import WrongCommand, exit_code_of
from lasersph.input.text_table import text_table
from lasersph.output.atomic import replace_json

SCHEMA_VERSION = 1
FEWEST = 100
"""Particles below which a cube has no inside."""
Sizes = Annotated[str, typer.Option("--sizes", metavar="N,N,...", help="Numbers of particles.")]
Json = Annotated[
    Path | None, typer.Option("--json", metavar="FILE", help="Write all numbers as JSON as well.")
]


def roofline(
    sizes: Sizes = "50000,400000",
    threads: Threads = None,
    json_file: Json = None,
    backend: Backend = "cpu",
) -> None:
    """Time each hot loop beside the least time that memory and arithmetic allow here."""
    wanted = _numbers(sizes)
    refuse_backend(backend, threads)
    _refuse_more_than_there_is(wanted, backend)
    limits: list[Ceilings] = []
    loops: list[Measured] = []

    def report(one: Ceilings | Measured) -> None:
        if isinstance(one, Ceilings):
            limits.append(one)
            print(ceilings_line(one), flush=True)
        else:
            loops.append(one)

    if backend == "cuda":
        measure_card(wanted, report=report)
    else:
        measure(wanted, threads, report=report)
    print(f"\n{max(wanted)} particles; numbers are per particle and pass")
    head, *rows = table(loops)
    print(text_table(rows, head))
    if len(wanted) > 1:
        where = "on the card" if backend == "cuda" else f"with {limits[-1].threads} threads"
        print(f"\ntime per particle {where}")
        head, *rows = growth(loops)
        print(text_table(rows, head))
    if json_file is not None:
        head = {"schema_version": SCHEMA_VERSION, "lasersph": lasersph.__version__}
        replace_json(json_file, head | as_dict(limits, loops))


def _numbers(text: str) -> tuple[int, ...]:
    """Different sizes from a list with commas, in order."""
    try:
        numbers = sorted({int(word) for word in text.split(",")})
    except ValueError:
        numbers = []
    if not numbers or numbers[0] < FEWEST:
        raise WrongCommand(
            f"--sizes {text}: give whole numbers from {FEWEST} on, e.g. 50000,400000"
        )
    return tuple(numbers)


def _refuse_more_than_there_is(sizes: tuple[int, ...], backend: str) -> None:
    """Say what the largest size needs, or that it is more than the machine or its card has."""
    needed = memory(max(sizes))
    for words, there in memories(backend):
        if needed > there:
            raise WrongCommand(
                f"{max(sizes)} particles need up to {in_words(needed)} of memory,"
                f" {words.format(in_words(there))}"
            )
    print(f"needs up to {in_words(needed)} of memory", flush=True)


def main(arguments: list[str]) -> int:
    """Run the command; a failure is one line on standard error, as with `lasersph`."""
    command = typer.Typer(add_completion=False)
    command.command()(roofline)
    return exit_code_of(
        lambda: command(arguments, standalone_mode=False) or 0, wants_traceback=False
    )


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
