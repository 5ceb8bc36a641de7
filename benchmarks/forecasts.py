"""The time that `check` foresees beside the time that the solver takes, without files and figures.

    python benchmarks/forecasts.py texture-steel
    python benchmarks/forecasts.py texture-dots-steel particles.spacing=48nm --threads 2

Steps in which something flows and the others are counted and timed apart, beside the stages of the
forecast and the time of one product of the matrix of all pairs with a vector, in which their costs
are given (`StepCost`). Run it twice: the first time loops are compiled.
"""

from __future__ import annotations

import argparse
from collections import Counter, defaultdict
from time import perf_counter
from typing import Any

from lasersph import compute, load_case
from lasersph.simulation.forecast import PAIRS_PER_SECOND, active_pairs, forecast
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import choose_step


def main() -> None:
    """Run a case's solver to its end and print what was expected and what came out."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("case")
    parser.add_argument("settings", nargs="*")
    parser.add_argument("--threads", type=int, default=2)
    given = parser.parse_args()
    case = load_case(given.case, given.settings)
    recipe = recipe_of(case)
    expected = forecast(case, threads=given.threads, recipe=recipe)
    product = active_pairs(recipe) / PAIRS_PER_SECOND / given.threads
    stages = Counter[str]()
    for stage in recipe.step_forecast().stages:
        stages[stage.name] += stage.steps

    # the solver alone, from step to step as a run goes
    solver: Any = recipe.build(compute.cpu(threads=given.threads))
    steps, seconds = Counter[str](), defaultdict[str, float](float)
    end = case.time.end
    while solver.state.time < end * (1.0 - 1e-12):
        begin = perf_counter()
        limits = solver.time_step_limits() | {"end": end - solver.state.time}
        _, step, unclipped_step = choose_step(limits)
        solver.step(step, unclipped_step)
        kind = "flow" if getattr(solver, "fluid_count", 0.0) > 0.0 else "other"
        steps[kind] += 1
        seconds[kind] += perf_counter() - begin

    taken = sum(seconds.values())
    print(f"{expected.particles} particles; a product {1e3 * product:.2f} ms")
    print(f"expected {expected.wall_time:.1f} s, taken {taken:.1f} s: "
          f"{expected.wall_time / taken:.2f} times")  # fmt: skip
    print("expected steps: " + ", ".join(f"{n} {name}" for name, n in stages.items()))
    for kind, number in steps.items():
        print(f"taken: {number} {kind}, {1e3 * seconds[kind] / number:.1f} ms each")


if __name__ == "__main__":
    main()
