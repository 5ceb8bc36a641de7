"""What a user waits for before anything is computed, and its parts.

    python benchmarks/start_up.py [CASE ...] [--source src] [--tries 5]

It times small commands, and `lasersph run CASE` from its start to the end of the first time step,
with the loops compiled, on one thread. Bytecode is written, as by any installation. The fastest of
some tries counts; processor time stands beside the time of the clock, since others may run.
`--source` measures another tree, e.g. an older commit in a work tree of its own.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

COMMANDS = {
    "an empty program": ("pass", None),
    "import lasersph": ("import lasersph", 0.15),
    "lasersph --help": ("from lasersph.cli import main; main(['--help'])", 0.3),
    "lasersph run --help": ("from lasersph.cli import main; main(['run', '--help'])", 0.6),
    "reading a case": ("import lasersph; lasersph.load_case('dlip-steel')", 0.6),
}
"""Programs, and the time [s] that each should stay below on a quiet machine."""
AIMS = {"stefan": 1.0, "pulsed-heating": 1.0, "natural-convection": 1.5, "dlip-steel": 1.5}
"""Cases, and the time [s] from the command to the first step that each should stay below."""

PROGRAM = Path(__file__).with_name("first_step.py")


def environment(source: Path, bytecode: str) -> dict[str, str]:
    """Variables of the programs: a source tree, and bytecode as an installation has it."""
    variables = os.environ | {"PYTHONPATH": str(source), "PYTHONPYCACHEPREFIX": bytecode}
    variables.pop("PYTHONDONTWRITEBYTECODE", None)
    return variables


def time_command(program: str, variables: dict[str, str], tries: int) -> tuple[float, float]:
    """Least time of the clock and of the processor of a program [s], once there is bytecode."""
    times = []
    for _ in range(tries + 1):
        before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        subprocess.run([sys.executable, "-c", program], env=variables, stdout=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        used = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
        times.append((time.perf_counter() - begin, used))
    wall, processor = zip(*times[1:], strict=True)
    return min(wall), min(processor)


def time_first_step(case: str, variables: dict[str, str], tries: int) -> dict:
    """Time to the first step and its parts, of the fastest try; the one before compiles loops."""
    found = []
    for _ in range(tries + 1):
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, str(PROGRAM), repr(time.time())]
            command += ["run", case, "--threads", "1", "--no-figures", "--out", f"{folder}/run"]
            done = subprocess.run(command, env=variables, stdout=subprocess.PIPE, check=True)
        found.append(json.loads(done.stdout))
    return min(found[1:], key=lambda one: one["wall"])


def line(name: str, wall: float, processor: float, aim: float | None = None) -> str:
    """One line of the table, times in ms."""
    wanted = "" if aim is None else f"{1e3 * aim:8.0f}"
    return f"{name:44s}{1e3 * wall:8.0f}{1e3 * processor:11.0f}{wanted}"


def main() -> None:
    """Measure and print everything."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("case", nargs="*", default=list(AIMS))
    parser.add_argument("--source", type=Path, default=Path(__file__).parents[1] / "src")
    parser.add_argument("--tries", type=int, default=5)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as bytecode:
        variables = environment(given.source, bytecode)
        print(f"{'ms':44s}{'clock':>8s}{'processor':>11s}{'aim':>8s}")
        for name, (program, aim) in COMMANDS.items():
            print(line(name, *time_command(program, variables, given.tries), aim), flush=True)
        for case in given.case:
            found = time_first_step(case, variables, given.tries)
            name = f"lasersph run {case}, to its first step"
            print(f"\n{line(name, found['wall'], found['processor'], AIMS.get(case))}")
            for part, times in sorted(found["parts"].items(), key=lambda item: -item[1][0]):
                print(line(f"    {part}", *times), flush=True)


if __name__ == "__main__":
    main()
