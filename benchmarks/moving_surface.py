"""What a surface that moves costs: a case beside the same particles under a flat one.

    python benchmarks/moving_surface.py --spacing 8nm --end 45ns
    python benchmarks/moving_surface.py --case texture-dots-steel --spacing 48nm --end 60ns

Both pools advance in turns, a nanosecond of simulated time each, on one thread, from the light to
`--end`; processor time counts, so that other work on the machine does not. Particles, light, vapor
and the limits of the step that both have are the same; the one that moves has those of its waves
too, so that time per step and per nanosecond are told apart.
"""

from __future__ import annotations

import argparse
import os
from time import process_time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # as the command line has it

from lasersph import compute, load_case
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.step_control import choose_step

TURN = 1e-9
"""Simulated time of a turn [s]."""
BEFORE = 20e-9
"""Until here nothing melts and no time is taken [s]; loops are compiled."""
ASKED = {2: 1.5, 3: 1.3}
"""Ratio of a nanosecond, by dimensions."""


class Pool:
    """One of the pools: its solver, and what it has taken.

    Attributes:
        seconds: processor time. steps: while they were measured. flowing: of them with melt.
    """

    def __init__(self, case: str, surface: str, spacing: str) -> None:
        settings = (f"solver.flow.surface={surface}", f"particles.spacing={spacing}")
        self.case = load_case(case, settings)
        self.solver = recipe_of(self.case).build(compute.cpu(threads=1))
        self.seconds, self.steps, self.flowing = 0.0, 0, 0

    def advance(self, end: float) -> None:
        """Step to a time [s]."""
        solver, begin = self.solver, process_time()
        while solver.state.time < end * (1.0 - 1e-12):
            limits = solver.time_step_limits() | {"snapshot": end - solver.state.time}
            _, step, unclipped_step = choose_step(limits)
            solver.step(step, unclipped_step)
            self.steps += 1
            self.flowing += solver.fluid_count > 0.0
        self.seconds += process_time() - begin


def main() -> None:
    """Measure and print the two pools and their ratios."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--case", default="texture-steel")
    parser.add_argument("--spacing", default="8nm")
    parser.add_argument("--end", default="45ns", help="in ns, such as 45ns")
    given = parser.parse_args()
    end = 1e-9 * float(given.end.removesuffix("ns"))
    pools = {surface: Pool(given.case, surface, given.spacing) for surface in ("moving", "flat")}
    time = BEFORE
    for pool in pools.values():
        pool.advance(time)
        pool.seconds, pool.steps, pool.flowing = 0.0, 0, 0
    while time < end * (1.0 - 1e-9):
        time = min(time + TURN, end)
        for pool in pools.values():
            pool.advance(time)
    for surface, pool in pools.items():
        print(
            f"{surface:7} {pool.solver.particle_count} particles, {pool.steps} steps, "
            f"{pool.flowing} with melt: {pool.seconds:.1f} s, "
            f"{1e3 * pool.seconds / pool.steps:.1f} ms a step"
        )
    moving, flat = pools.values()
    per_step = moving.seconds / moving.steps / (flat.seconds / flat.steps)
    ratio, asked = moving.seconds / flat.seconds, ASKED[moving.case.solver.dimensions]
    print(f"ratio {ratio:.2f} (asked: {asked}), of a step {per_step:.2f}")


if __name__ == "__main__":
    main()
