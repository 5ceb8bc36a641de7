"""Memory beside what `lasersph check` says.

    python benchmarks/memory.py         # of a particle, while a run is built and takes two steps
    python benchmarks/memory.py runs    # of whole runs on one thread, with figures and report

Of a particle: two sizes of each case, each in a process of its own; the largest memory of the
larger one less that of the smaller one, over the difference of their particles, so that the program
itself counts for nothing; a first process compiles the loops. Other programs on the machine do not
matter.
"""

from __future__ import annotations

import json
import subprocess
import sys
from resource import RUSAGE_SELF, getrusage
from tempfile import TemporaryDirectory

from lasersph import compute
from lasersph.case import Case, load_case
from lasersph.cli import main as lasersph
from lasersph.simulation import forecast
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import choose_step

SQUARE = ["solver.dimensions=2", "domain.width=100 um", "domain.depth=100 um", "time.step=10 ns"]
CUBE = ["solver.dimensions=3", "domain.width=20 um", "domain.depth=20 um", "time.step=1 ns"]
WAVE = ["solver.dimensions=3", "particles.kernel=cubic-spline", "particles.support_ratio=3.0"]
CASES = (
    ("pulsed-heating", ["solver.scheme=explicit", *SQUARE], ("0.4 um", "0.2 um")),
    ("pulsed-heating", ["solver.scheme=implicit", *SQUARE], ("0.4 um", "0.2 um")),
    ("pulsed-heating", ["solver.scheme=explicit", *CUBE], ("0.5 um", "0.35 um")),
    ("pulsed-heating", ["solver.scheme=implicit", *CUBE], ("0.5 um", "0.35 um")),
    ("natural-convection", [], ("5 mm", "2.5 mm")),
    ("sound-wave", [*WAVE, "domain.width=40 um"], ("1 um", "0.8 um")),
)
"""Name, settings and two spacings."""
RUNS = (("dlip-aluminium", "16nm"), ("dlip-steel", "8nm"), ("dlip-aluminium", "8nm"))
"""Name and spacing of whole runs."""


def main() -> None:
    """Print a line a case; with what to do and a case as arguments its particles and memory."""
    if len(sys.argv) > 2:
        print(json.dumps({"steps": take_two_steps, "run": run_whole}[sys.argv[1]](*sys.argv[2:])))
        return
    if len(sys.argv) > 1:
        for name, spacing in RUNS:
            found = in_a_process("run", name, f"particles.spacing={spacing}")
            expected, taken = (found[key] / 2**20 for key in ("expected", "memory"))
            print(f"{name} {spacing}: {found['particles']} particles, ", end="")
            print(f"{expected:.0f} MiB expected, {taken:.0f} taken", flush=True)
        return
    for name, settings, spacings in CASES:
        given = [[*settings, f"particles.spacing={spacing}"] for spacing in spacings]
        in_a_process("steps", name, *given[0])  # compiling takes memory, too
        small, large = (in_a_process("steps", name, *each) for each in given)
        more = large["particles"] - small["particles"]
        taken = (large["memory"] - small["memory"]) / more
        expected = (large["expected"] - small["expected"]) / more
        said = " ".join([name, *settings])
        print(f"{said}: {more} more particles, {expected:.0f} B each expected, {taken:.0f} taken")


def in_a_process(*arguments: str) -> dict[str, float]:
    """What `take_two_steps` or `run_whole` finds, in a process of its own."""
    command = [sys.executable, __file__, *arguments]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return json.loads(done.stdout.splitlines()[-1])


def run_whole(name: str, *settings: str) -> dict[str, float]:
    """As `take_two_steps`, of `lasersph run`."""
    given = [word for setting in settings for word in ("--set", setting)]
    with TemporaryDirectory() as folder:
        lasersph(["run", name, *given, "--threads", "1", "--out", f"{folder}/run"])
    return memory_beside(load_case(name, settings))


def take_two_steps(name: str, *settings: str) -> dict[str, float]:
    """Particles of a case, its memory [bytes] as expected, and the largest of this process."""
    case = load_case(name, settings)
    solver = recipe_of(case).build(compute.cpu(threads=1))
    for _ in range(2):
        _, step, unclipped_step = choose_step(solver.time_step_limits())
        solver.step(step, unclipped_step)
    return memory_beside(case)


def memory_beside(case: Case) -> dict[str, float]:
    """What is expected of a case, and the largest memory of this process so far."""
    found = forecast(case)
    memory = 1024 * getrusage(RUSAGE_SELF).ru_maxrss
    return {"particles": found.particles, "expected": found.memory, "memory": memory}


if __name__ == "__main__":
    main()
