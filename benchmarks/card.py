"""The graphics card beside all processors of the same machine: loops, iterations, steps, a run.

    python benchmarks/card.py
    python benchmarks/card.py --only steps --json card.json
    python benchmarks/card.py --page                     # the record's table into docs/gpu.md

Right-hand sides and lists are those of a jittered cube with 90 neighbors a particle, iterations
those of a square; steps are of a lid-driven cube, with pressure, viscosity and search, and the run
is the published sample of ablation with ten million particles (`test_ablation_sample.py`). Each
line is the fastest of some passes after one that compiles. `docs/card.json` is the last record.
With `--backend cpu` the processor is measured alone.
"""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Callable, Iterator
from datetime import date
from importlib.metadata import version
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple

from hot_loops import loops
from hot_loops.hot_loop import seconds
from hot_loops.particles import jittered
from hot_loops.solves import hot_solves
from test_ablation_sample import SAMPLE

from lasersph import compute, load_case
from lasersph.compute.backend import Backend
from lasersph.input.text_table import text_table
from lasersph.output.atomic import replace_json
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import choose_step
from lasersph.sph.kernels import kernel

DOCS = Path(__file__).parents[1] / "docs"
RECORD, PAGE = DOCS / "card.json", DOCS / "gpu.md"
BEGIN, END = "<!-- card: begin -->", "<!-- card: end -->"
EDGES = (46, 100, 215)
"""Of cubes of 1e5, 1e6 and 1e7 particles."""
SQUARES = (450, 1400)
"""Of squares of 2e5 and 2e6 particles."""
SIDES = (48, 100)
"""Particles along the edge of a box of liquid."""
ROUNDS, STEPS, WARM = 5, 4, 3
RUN_STEPS, RUN_STEP = 300, 5e-11
HEAD = ["", "precision", "particles", "card [ms]", "processor [ms]", "times as fast"]
MOST_ON_PROCESSOR = 2_000_000
"""Particles beyond which only the card is measured."""


class Timed(NamedTuple):
    """A measured line: seconds of a pass or step of so many particles."""

    name: str
    precision: str
    particles: int
    device: str
    seconds: float


def loops_of(backend: Backend, most: float) -> Iterator[Timed]:
    """Right-hand side and neighbor list in space."""
    for edge in EDGES:
        if edge**3 > most:
            continue
        neighbors = jittered(backend, edge, kernel("wendland-c2", 3))
        for loop in (loops.pair_sum(backend, neighbors), loops.list_build(backend, neighbors)):
            yield timed(backend, loop.name, loop.count, seconds(waited(backend, loop.run), ROUNDS))
        del loop, neighbors


def iterations_of(backend: Backend, most: float) -> Iterator[Timed]:
    """Iterations of linear solvers and cycles of their preconditioners, on a square."""
    for edge in SQUARES:
        neighbors = jittered(backend, edge, kernel("wendland-c2", 2))
        for loop in hot_solves(backend, neighbors):
            yield timed(backend, loop.name, loop.count, seconds(waited(backend, loop.run), ROUNDS))


def steps_of(backend: Backend, most: float) -> Iterator[Timed]:
    """Steps of a lid-driven cube."""
    for side in SIDES:
        frame = ["solver.frame=lagrangian", "particles.support_ratio=3.1"]
        settings = [*frame, f"particles.spacing={1.0 / side} m"]
        case = load_case("lid-driven-cube", settings)
        solver: Any = recipe_of(case).build(backend)
        times = []
        for _ in range(WARM + STEPS):
            begin = perf_counter()
            _, step, unclipped_step = choose_step(solver.time_step_limits())
            solver.step(step, unclipped_step)
            backend.wait()
            times.append(perf_counter() - begin)
        yield timed(backend, "step of a lid-driven cube", solver.body.count, min(times[WARM:]))
        del solver


def run_of(backend: Backend, most: float) -> Iterator[Timed]:
    """The published sample of ablation, in single precision: making it, and its steps."""
    if most < float("inf"):
        return
    single = compute.cuda("float32")
    begin = perf_counter()
    solver: Any = recipe_of(load_case("ablation-depth", [*SAMPLE])).build(single)
    single.wait()
    count = solver.particles.capacity
    yield timed(single, "ablation of a sample: made", count, perf_counter() - begin)
    begin = perf_counter()
    for _ in range(RUN_STEPS):
        solver.step(RUN_STEP)
    single.wait()
    name = f"ablation of a sample: {RUN_STEPS} steps"
    yield timed(single, name, count, perf_counter() - begin)


PARTS: dict[str, Callable[[Backend, float], Iterator[Timed]]] = {
    "loops": loops_of,
    "iterations": iterations_of,
    "steps": steps_of,
    "run": run_of,
}


def waited(backend: Backend, run: Callable[[], int]) -> Callable[[], int]:
    """The function, which ends when the card has done its work."""

    def whole() -> int:
        passes = run()
        backend.wait()
        return passes

    return whole


def timed(backend: Backend, name: str, particles: int, time: float) -> Timed:
    """A line of a backend."""
    device = backend.device or f"{backend.threads} threads"
    found = Timed(name, backend.precision, particles, device, time)
    print(f"{name}, {particles} particles, {found.precision}, {device}: {1e3 * time:.2f} ms",
          flush=True)  # fmt: skip
    return found


def rows(found: list[Timed]) -> list[list[str]]:
    """Lines of the table: the card's time, the processor's, and how often the card is faster."""
    by_line: dict[tuple, dict[bool, Timed]] = {}
    for one in found:
        by_line.setdefault(one[:3], {})[one.device.endswith("threads")] = one
    table = []
    for (name, precision, particles), both in by_line.items():
        card, processor = both.get(False), both.get(True)
        numbers = [f"{1e3 * one.seconds:.2f}" if one else "" for one in (card, processor)]
        ratio = f"{processor.seconds / card.seconds:.1f}" if card and processor else ""
        table.append([name, precision, str(particles), *numbers, ratio])
    return table


def head_of(found: list[Timed]) -> dict[str, Any]:
    """Day, card, processors and packages of a record."""
    card = next((one.device for one in found if not one.device.endswith("threads")), None)
    packages = ("numba", "numba-cuda", "cuda-core", "numpy")
    return {
        "taken": date.today().isoformat(),
        "card": card,
        "processors": os.cpu_count(),
        "packages": {name: version(name) for name in packages},
    }


def page_of(text: str, found: list[Timed]) -> str:
    """The page with the table of a record between its marks."""
    before, _, behind = text.partition(BEGIN)
    _, end, after = behind.partition(END)
    lines = [HEAD, ["---"] * len(HEAD), *rows(found)]
    table = "".join(f"| {' | '.join(line)} |\n" for line in lines)
    return f"{before}{BEGIN}\n{table}{end}{after}"


def recorded() -> list[Timed]:
    """Lines of the last record."""
    return [Timed(**one) for one in json.loads(RECORD.read_text(encoding="utf-8"))["lines"]]


def main() -> None:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--only", choices=PARTS, action="append")
    parser.add_argument("--backend", choices=("both", "cuda", "cpu"), default="both")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--page", action="store_true")
    given = parser.parse_args()
    if given.page:
        text = PAGE.read_text(encoding="utf-8")
        PAGE.write_text(page_of(text, recorded()), encoding="utf-8")
        return
    found: list[Timed] = []
    for name in given.only or PARTS:
        for precision in ("float64", "float32") if name == "loops" else ("float64",):
            if given.backend != "cpu":
                found += PARTS[name](compute.cuda(precision), float("inf"))
            if given.backend != "cuda":
                found += PARTS[name](compute.cpu(precision=precision), MOST_ON_PROCESSOR)
    print()
    print(text_table(rows(found), HEAD))
    if given.json:
        record = head_of(found) | {"lines": [one._asdict() for one in found]}
        replace_json(given.json, record)


if __name__ == "__main__":
    main()
