"""Write the loops that runs call, by kind of run, from coarse runs of all shipped cases, and of
heat alone in those that flow under a laser.

    python benchmarks/known_loops.py [CASE ...]

Several processes compile these where a run finds one missing (`compute.ahead`). To be run again
after loops got other names or arguments: a list that is out of date costs the first run on a
machine some seconds, and changes no result. Lists of kinds that none of the CASEs has stay.
"""

from __future__ import annotations

import sys
from collections import defaultdict
from pathlib import Path
from tempfile import TemporaryDirectory

from lasersph import simulation
from lasersph.case import Case, available_cases, load_case
from lasersph.compute.ahead import read_lists, write_lists
from lasersph.compute.generate import Loop, LoopText
from lasersph.compute.launch import Launcher
from lasersph.simulation.known_loops import FILE, kind_of_run


def text_that_records(loops: list[Loop]) -> type[LoopText]:
    """Class of texts that add their loops to a list, in the order in which they are asked for.

    Each run has its own: what a process has written for one class it writes again for the next.
    """

    class RecordedText(LoopText):
        def __init__(self, loop: Loop) -> None:
            super().__init__(loop)
            loops.append(loop)

    return RecordedText


def runs_of(name: str) -> list[Case]:
    """The coarse copy of a shipped case, and heat alone where it has light and flow."""
    case = load_case(name, quick=True)
    if case.solver.kind != "melt-pool" or case.laser is None:
        return [case]
    heat = f"solver={{ kind = 'conduction', dimensions = {case.solver.dimensions} }}"
    return [case, load_case(name, [heat], quick=True)]


def loops_of(case: Case) -> tuple[str, list[Loop]]:
    """Kind of a case's run, and the loops that it calls."""
    loops: list[Loop] = []
    Launcher.text = text_that_records(loops)
    with TemporaryDirectory() as folder:
        simulation.run(case, Path(folder, "run"), threads=1)
    return kind_of_run(case), list(dict.fromkeys(loops))


def main() -> None:
    """Run the cases and write the lists."""
    lists: dict[str, list[Loop]] = defaultdict(list)
    for name in sys.argv[1:] or available_cases():
        for case in runs_of(name):
            kind, loops = loops_of(case)
            lists[kind] += loops
            print(f"{name}: {len(loops)} loops of {kind}", flush=True)
    found = {kind: list(dict.fromkeys(loops)) for kind, loops in lists.items()}
    write_lists(FILE, read_lists(FILE) | found)
    print(f"{FILE}: {FILE.stat().st_size // 1024} KiB")


if __name__ == "__main__":
    main()
