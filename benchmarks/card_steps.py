"""Where the time of a step on a graphics card goes: kernels, gaps between them, waiting, copies.

    python benchmarks/card_steps.py lid-driven-cube solver.frame=lagrangian particles.spacing=0.01m
    python benchmarks/card_steps.py texture-dots-steel --until 40ns --steps 5

Each kernel is measured by two events around it, which a kernel of no work shows to be some 5 us
apart; a kernel is named by the functions that its loop calls. What the kernels leave of a step
without events is the host's: Python between launches, and waiting for numbers.
"""

# pyright: reportAttributeAccessIssue=false
# NVIDIA's packages say little about what they hold.

from __future__ import annotations

import argparse
import re
from collections import Counter, defaultdict
from collections.abc import Callable
from functools import cache
from pathlib import Path
from time import perf_counter
from typing import Any

from lasersph import compute, load_case
from lasersph.input.text_table import text_table
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import choose_step

OF_THE_HEAD = {"floor", "ceil", "loop"}
"""Functions of each generated file."""


class Events:
    """Times of kernels by events, and of the host's calls that wait or copy.

    Attributes:
        kernels: name and time [ms] of each launch of the last measured step.
        waits: seconds of the host by what it waited in; how many: `counts`.
    """

    def __init__(self) -> None:
        from cuda.bindings import driver

        from lasersph.compute import cuda_card, cuda_memory

        self._driver, self._card = driver, cuda_card
        self._pairs: list[tuple[str, Any, Any]] = []
        self.waits: dict[str, float] = defaultdict(float)
        self.counts = Counter[str]()
        self.is_on = False
        self._patch_calls()
        for owner, name in ((cuda_card.Room, "read"), (cuda_memory, "to_host"),
                            (cuda_memory, "from_host"), (cuda_memory, "wait")):  # fmt: skip
            setattr(owner, name, self._clocked(name, getattr(owner, name)))

    @property
    def kernels(self) -> list[tuple[str, float]]:
        """Names and times [ms] of what was launched."""
        self._card.wait()
        elapsed = self._driver.cuEventElapsedTime
        return [(name, float(elapsed(first, last)[1])) for name, first, last in self._pairs]

    def start(self) -> None:
        """Begin a step whose kernels are measured."""
        self._pairs, self.is_on = [], True
        self.waits.clear()
        self.counts.clear()

    def _patch_calls(self) -> None:
        driver, kind = self._driver, self._card.Call
        begin, launch = kind.__init__, kind.start

        def named(call: Any, kernel: Any, arguments: list[Any]) -> None:
            begin(call, kernel, arguments)
            call.name = kernel_name(kernel.py_func)

        def timed(call: Any, groups: int) -> None:
            if not self.is_on:
                launch(call, groups)
                return
            first, last = driver.cuEventCreate(0)[1], driver.cuEventCreate(0)[1]
            driver.cuEventRecord(first, 0)
            launch(call, groups)
            driver.cuEventRecord(last, 0)
            self._pairs.append((call.name, first, last))

        kind.__init__, kind.start = named, timed

    def _clocked(self, name: str, function: Callable) -> Callable:
        def run(*arguments: Any) -> Any:
            begin = perf_counter()
            found = function(*arguments)
            self.waits[name] += perf_counter() - begin
            self.counts[name] += 1
            return found

        return run


@cache
def kernel_name(function: Any) -> str:
    """Functions that a loop calls, or the name of a kernel without physics."""
    if function.__name__ != "loop":
        return function.__name__
    text = Path(function.__code__.co_filename).read_text(encoding="utf-8")
    names = [name for name in re.findall(r"^def (\w+)\(", text, re.M) if name not in OF_THE_HEAD]
    return " ".join(names)[-60:]


def advance(solver: Any, end: float) -> None:
    """One step, as the run would take it."""
    limits = solver.time_step_limits() | {"end": end}
    _, step, unclipped_step = choose_step(limits)
    solver.step(step, unclipped_step)
    solver.body.backend.wait()


def main() -> None:
    """Measure some steps and print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("case")
    parser.add_argument("settings", nargs="*")
    parser.add_argument("--until", default="0ns", help="go there before measuring, such as 40ns")
    parser.add_argument("--steps", type=int, default=3)
    parser.add_argument("--precision", default="float64")
    given = parser.parse_args()
    events, backend = Events(), compute.cuda(given.precision)
    solver: Any = recipe_of(load_case(given.case, given.settings)).build(backend)
    begin, steps = perf_counter(), 0
    until = 1e-9 * float(given.until.removesuffix("ns"))
    while solver.state.time < until or steps < 3:
        advance(solver, 1.0)
        steps += 1
    print(f"{solver.body.count} particles; {steps} steps before in {perf_counter() - begin:.1f} s")

    # steps without events, then one with
    times = []
    for _ in range(given.steps):
        begin = perf_counter()
        advance(solver, 1.0)
        times.append(perf_counter() - begin)
    events.start()
    begin = perf_counter()
    advance(solver, 1.0)
    with_events = perf_counter() - begin
    kernels = events.kernels
    total: dict[str, float] = defaultdict(float)
    number = Counter[str]()
    for name, time in kernels:
        total[name] += time
        number[name] += 1
    every = sum(total.values())
    print(f"step {1e3 * min(times):.2f} ms ({1e3 * with_events:.2f} ms with events), "
          f"{len(kernels)} kernels of {every:.2f} ms together")  # fmt: skip
    for name, seconds in events.waits.items():
        print(f"  {name}: {events.counts[name]} times, {1e3 * seconds:.2f} ms of the host")
    rows = [
        [name, str(number[name]), f"{time:.2f}", f"{100 * time / every:.0f} %"]
        for name, time in sorted(total.items(), key=lambda one: -one[1])[:25]
    ]
    print(text_table(rows, ["kernel", "launches", "[ms]", "share"]))


if __name__ == "__main__":
    main()
