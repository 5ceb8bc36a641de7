"""What a step of a small flow takes on one thread, and its parts, beside an older tree.

Sweeps, calibration and tutorials are hundreds of runs with a few thousand particles. Each tree
runs in processes of its own, in turn, so that both meet the same machine. The figure is processor
time, since others may run: the least over rounds of the mean over steps, without any instrument.
The parts come from further steps with clocks around what a step calls; these take some time
themselves, and contain each other where one is called by another.

    python benchmarks/small_steps.py                     this tree
    python benchmarks/small_steps.py --beside OLD_TREE   and another one, with the ratio of both
"""

from __future__ import annotations

import argparse
import importlib
import json
import os
import subprocess
import sys
from collections.abc import Callable
from operator import itemgetter
from pathlib import Path
from statistics import median
from time import process_time
from typing import Any

CASES = {
    "natural-convection 40 x 40": ("natural-convection", ["solver.frame=lagrangian"], None),
    "dlip-steel 16 nm": (
        "dlip-steel",
        ["solver.kind=melt-pool", "laser.fluence=0.5 J/cm^2", "particles.spacing=16 nm"],
        54e-9,
    ),
}
"""Shipped case, settings, and time from which on it is measured [s]; it flows there."""
WARM_UP, STEPS, ROUNDS = 20, 10, 6
"""Steps before, steps of a round, and rounds; the parts take one round more."""
LAUNCHES = "launches"
PARTS = {
    LAUNCHES: ("compute.launch:Launcher.run", "compute.launch:Launch.__call__"),
    "bound calls": ("compute.loops:Loops.run",),
    "viscosity solver": ("solvers.melt_pool.viscous_step:ViscousStep.advance",),
    "pressure operator": ("solvers.melt_pool.pressure_equation:PressureEquation.set_operator",),
    "pressure solver": ("solvers.melt_pool.pressure_equation:PressureEquation.solve",),
    "heat solver": ("linear_solvers.conjugate_gradient:ConjugateGradient.solve",),
    "neighbor search": ("compute.search:neighbor_list",),
}
"""What is clocked: names, of which a tree has one. A launch runs compiled code; a bound call finds
its loop and the arguments before that."""
BUILDERS = ("simulation.build:build", "simulation.recipes:recipe_of")
"""What builds a solver, before and since there are recipes."""
STEP_CHOICES = ("solvers.step_control:choose_step", "solvers.time_step:choose")


class Clocks:
    """Processor time and calls of functions that are wrapped."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self.calls: dict[str, int] = {}
        self._depth: dict[str, int] = {}

    def around(self, name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        """The function with a clock; a call inside a call of the same name is not timed again."""
        for table in (self.seconds, self.calls, self._depth):
            table.setdefault(name, 0)

        def call(*arguments: Any, **options: Any) -> Any:
            self.calls[name] += 1
            if self._depth[name]:
                return function(*arguments, **options)
            self._depth[name] += 1
            begin = process_time()
            try:
                return function(*arguments, **options)
            finally:
                self.seconds[name] += process_time() - begin
                self._depth[name] -= 1

        return call


def measure(case: str) -> dict[str, Any]:
    """Milliseconds a step of one case in this process, and its parts."""

    from lasersph import compute
    from lasersph.case import load_case

    name, settings, start = CASES[case]
    loaded, backend = load_case(name, settings), compute.cpu(threads=1)
    build, recipe_of = (_found((name,))[1] for name in BUILDERS)
    solver: Any = recipe_of(loaded).build(backend) if recipe_of else build(loaded, backend)[1]

    choose_step = _found(STEP_CHOICES)[1]

    def advance(steps: int) -> None:
        for _ in range(steps):
            _, step, unclipped_step = choose_step(solver.time_step_limits())
            solver.step(step, unclipped_step)

    while start is not None and solver.state.time < start:
        advance(1)
    advance(WARM_UP)
    rounds, iterations = [], []
    for _ in range(ROUNDS):
        begin = process_time()
        advance(STEPS)
        rounds.append(1e3 * (process_time() - begin) / STEPS)
        iterations.append(dict(solver.iterations))
    clocks = Clocks()
    for part, names in PARTS.items():
        owner, function = _found(names)
        if owner is not None:
            setattr(owner, function.__name__, clocks.around(part, function))
    begin = process_time()
    advance(STEPS)
    return {
        "milliseconds": min(rounds),
        "rounds": rounds,
        "iterations": {key: sum(r[key] for r in iterations) / ROUNDS for key in iterations[0]},
        "clocked": 1e3 * (process_time() - begin) / STEPS,
        "parts": {key: 1e3 * value / STEPS for key, value in clocks.seconds.items()},
        "calls": {key: value / STEPS for key, value in clocks.calls.items()},
    }


def _found(names: tuple[str, ...]) -> tuple[Any, Any]:
    """Owner and function of the first name that this tree has; None for both where it has none."""
    for name in names:
        module, _, path = name.partition(":")
        try:
            owner: Any = importlib.import_module(f"lasersph.{module}")
        except ImportError:
            continue
        *owners, last = path.split(".")
        for one in owners:
            owner = getattr(owner, one, None)
        if hasattr(owner, last):
            return owner, getattr(owner, last)
    return None, None


def _in_tree(tree: Path, case: str) -> dict[str, Any]:
    """What `measure` finds in a process that imports the package of a tree."""
    environment = os.environ | {"PYTHONPATH": str(tree / "src"), "NUMBA_NUM_THREADS": "1"}
    command = [sys.executable, __file__, "--measure", case]
    done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, check=True, text=True)
    return json.loads(done.stdout.splitlines()[-1])


def _print(title: str, found: dict[str, Any]) -> None:
    iterations = ", ".join(f"{key} {mean:.1f}" for key, mean in found["iterations"].items())
    print(f"  {title}: {found['milliseconds']:.2f} ms a step; iterations: {iterations}")
    print(f"    parts, of {found['clocked']:.2f} ms with clocks:")
    for part, value in sorted(found["parts"].items(), key=lambda pair: -pair[1]):
        print(f"      {part:20s} {value:7.2f} ms {found['calls'][part]:7.1f} calls")
    outside = found["clocked"] - found["parts"].get(LAUNCHES, 0.0)
    print(f"      {'outside launches':20s} {outside:7.2f} ms")


def main() -> None:
    """Measure this tree, beside another where one is given."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--beside", type=Path, help="root of another tree of this package")
    parser.add_argument("--turns", type=int, default=6, help="processes for each tree and case")
    parser.add_argument("--case", choices=CASES, action="append", help="only this case")
    parser.add_argument("--measure", choices=CASES, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.measure:
        print(json.dumps(measure(given.measure)))
        return
    here = Path(__file__).resolve().parents[1]
    trees = {"this tree": here} | ({"beside": given.beside.resolve()} if given.beside else {})
    for case in given.case or CASES:
        print(case)
        turns: dict[str, list[dict[str, Any]]] = {title: [] for title in trees}
        for _ in range(given.turns):
            for title, tree in trees.items():
                turns[title].append(_in_tree(tree, case))
        for title, found in turns.items():
            _print(title, min(found, key=itemgetter("milliseconds")))
        if given.beside:
            # of turns next to each other: a machine's speed changes from one to the next
            here_ms, there_ms = ([one["milliseconds"] for one in turns[title]] for title in trees)
            ratios = sorted(b / a for a, b in zip(here_ms, there_ms, strict=True))
            words = f"{median(ratios):.2f} times as fast, {ratios[0]:.2f} to {ratios[-1]:.2f}"
            print(f"  {words} in {len(ratios)} turns")


if __name__ == "__main__":
    main()
