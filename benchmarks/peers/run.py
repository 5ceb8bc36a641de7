"""lasersph beside the programs that do part of its work, on the same particles, in one run.

    python benchmarks/peers/run.py              two rounds, minutes
    python benchmarks/peers/run.py --quick      small cases, to see that all of it works

Each round times every installed program once, in turn; programs that are not installed are left
out with a line that says how to install them. `benchmarks/README.md` says what is compared.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from pathlib import Path

import dualsphysics_side
import fipy_side
import lammps_side
import lasersph_side
import laserttm_side
import ntmpy_side
import openfoam_side
import pysph_side
import splishsplash_side
from comparison_table import TITLES, Rounds, busy_note, lines_of, table
from measurement import Measurement
from workplace import PeerFailed, Program, Workplace

from lasersph import __version__

ROOT = Path(__file__).parents[2]
PROGRAMS = [
    side.PROGRAM
    for side in (
        lasersph_side, lammps_side, dualsphysics_side, pysph_side, splishsplash_side,
        openfoam_side, fipy_side, ntmpy_side, laserttm_side,
    )
]  # fmt: skip
FULL = {"edge": 58, "sheet": 450, "segments": 5, "steps": 10}
QUICK = {"edge": 24, "sheet": 100, "segments": 2, "steps": 3}


def arguments(words: list[str] | None = None) -> argparse.Namespace:
    """What the command line says."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--threads", type=int, default=2, help="processors of each program")
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("--quick", action="store_true", help="small cases")
    parser.add_argument("--cases", nargs="+", choices=list(TITLES), default=list(TITLES))
    parser.add_argument(
        "--clock", choices=("wall", "processor"), default="wall",
        help="processor: times as a program had the processors, where others use them too",
    )  # fmt: skip
    parser.add_argument(
        "--peers", type=Path, default=ROOT / "build" / "peers", help="where install.sh put them"
    )
    parser.add_argument("--json", type=Path, help="write every measurement to this file")
    return parser.parse_args(words)


def available(workplace: Workplace) -> list[Program]:
    """The programs that are installed; prints a line for each that is not."""
    found = []
    for program in PROGRAMS:
        if program.is_installed(workplace):
            found.append(program)
        else:
            print(
                f"{program.name} is not installed: sh benchmarks/peers/install.sh {program.package}"
            )
    return found


def measured(programs: list[Program], cases: list[str], workplace: Workplace) -> list[Measurement]:
    """One round: each case by each program; prints a line for each that fails."""
    found = []
    for case in cases:
        for program in programs:
            if case not in program.measures:
                continue
            print(f"{case}: {program.name} ...", file=sys.stderr, flush=True)
            try:
                found.append(program.measures[case](workplace))
            except PeerFailed as error:
                print(f"{case}: {program.name} failed: {error}", flush=True)
    return found


def as_json(rounds: Rounds, workplace: Workplace) -> str:
    """All measurements, and the sizes they were made with."""
    sizes = {name: value for name, value in vars(workplace).items() if name != "folder"}
    return json.dumps(
        {
            "lasersph": __version__, "processors": os.cpu_count(), "sizes": sizes,
            "rounds": [[m.as_json() for m in some] for some in rounds],
        },
        indent=1,
    )  # fmt: skip


def main() -> None:
    """Measure and print."""
    wanted = arguments()
    sizes = QUICK if wanted.quick else FULL
    workplace = Workplace(wanted.peers.resolve(), wanted.threads, **sizes, clock=wanted.clock)
    programs = available(workplace)
    rounds = [measured(programs, wanted.cases, workplace) for _ in range(wanted.rounds)]
    for case in wanted.cases:
        print("\n" + table(case, lines_of(case, rounds, wanted.clock)))
    print("\nRatios are of pairs per second and right-hand side; of steps where none are counted.")
    for program in programs:
        print(f"{program.name}: {program.differs}.")
    note = busy_note(rounds, wanted.clock)
    if note:
        print(note)
    if wanted.json is not None:
        wanted.json.write_text(as_json(rounds, workplace), encoding="utf-8")


if __name__ == "__main__":
    main()
