"""Where the time of a dot goes: heat of all of the metal, and the lines of a step while melt flows.

    python benchmarks/dot_time.py --spacing 64nm
    python benchmarks/dot_time.py --spacing 48nm --end 40ns --threads 2

`texture-dots-steel` without its files, by the lines of `MeltPool.step`; processor time of all
threads counts, so that other work on the machine does not. What melt costs is given per flowing
particle and step, what heat costs per particle and step. Lines that are indented are parts of the
one above. Of the time of heat the share is named that particles took which were still cold.
"""

from __future__ import annotations

import argparse
from typing import Any

from small_steps import Clocks

from lasersph import compute, load_case
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.melt_pool.solver import MeltPool
from lasersph.solvers.step_control import choose_step

LINES = (
    "heat.conduct", "illuminate", "advect", "flow.predict", "flow.project", "flow.correct",
    "update_positions", "rearrange", "_find_fluid", "_measure", "_keep",
)  # fmt: skip
"""What a step calls, in the order of `MeltPool._advance`; no line is a part of another."""
PARTS = {
    "advect": ("domain.surface.update_stress", "domain.surface.advance_first_half"),
    "update_positions": ("domain.surface.advance_second_half", "pairs.update"),
}
"""Parts of a line."""
OF_ALL = ("heat.conduct", "illuminate")
"""Lines that all particles are in."""
COLD = 1.0
"""Rise of the temperature up to which a particle counts as cold [K]."""
ASKED = 10.0
"""Time of a flowing particle and step at most, with all of its pressure and viscosity [us]."""


def clocked(solver: MeltPool) -> Clocks:
    """Clocks around the lines of a step and their parts."""
    clocks = Clocks()
    for name in (*LINES, *(part for parts in PARTS.values() for part in parts)):
        *owners, method = name.split(".")
        found: Any = solver
        for owner in owners:
            found = getattr(found, owner)
        setattr(found, method, clocks.around(name, getattr(found, method)))
    return clocks


def main() -> None:
    """Compute a dot and print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--spacing", default="64nm")
    parser.add_argument("--end", default="300ns", help="in ns, such as 40ns")
    parser.add_argument("--surface", default="moving", choices=("moving", "flat"))
    parser.add_argument("--threads", type=int, default=1)
    given = parser.parse_args()
    settings = (f"particles.spacing={given.spacing}", f"solver.flow.surface={given.surface}")
    case = load_case("texture-dots-steel", settings)
    solver = recipe_of(case).build(compute.cpu(threads=given.threads))
    assert isinstance(solver, MeltPool)
    end = 1e-9 * float(given.end.removesuffix("ns"))

    # a clock around the whole step as well: what no line has is the difference
    clocks = clocked(solver)
    step = clocks.around("step", solver.step)
    flowing, steps, with_melt, melt_before, cold = 0.0, 0, 0, 0.0, 0.0
    temperature = solver.backend.host_view(solver.particles["temperature"])
    coldest = float(temperature.min())
    while solver.state.time < end * (1.0 - 1e-12):
        limits = solver.time_step_limits() | {"end": end - solver.state.time}
        _, length, unclipped_step = choose_step(limits)
        before, heat_before = clocks.seconds["step"], clocks.seconds["heat.conduct"]
        step(length, unclipped_step)
        steps += 1
        share = float((temperature < coldest + COLD).mean())
        cold += share * (clocks.seconds["heat.conduct"] - heat_before)
        if solver.fluid_count > 0.0:
            flowing, with_melt = flowing + solver.fluid_count, with_melt + 1
            melt_before += clocks.seconds["step"] - before

    total, particles = clocks.seconds["step"], solver.particle_count
    print(f"{particles} particles, {steps} steps, {with_melt} with melt: {total:.1f} s")
    print(f"steps with melt: {melt_before:.1f} s, {100.0 * melt_before / total:.0f} %")
    print(f"heat of particles within {COLD:.0f} K of the start: {cold:.1f} s")
    for name in LINES:
        show(clocks, name, particles * steps if name in OF_ALL else flowing)
        for part in PARTS.get(name, ()):
            show(clocks, part, flowing, indent="    ")
    rest = total - sum(clocks.seconds[name] for name in LINES)
    print(f"{'rest':38}{rest:9.2f} s {100.0 * rest / total:5.1f} %")
    melt = total - sum(clocks.seconds[name] for name in OF_ALL)
    each = 1e6 * melt / max(flowing, 1.0)
    print(f"all but heat: {each:.1f} us a flowing particle and step (asked: {ASKED:.0f})")


def show(clocks: Clocks, name: str, count: float, indent: str = "") -> None:
    """Print a line: seconds, share, and microseconds each of so many particles and steps."""
    seconds, total = clocks.seconds[name], clocks.seconds["step"]
    each = 1e6 * seconds / max(count, 1.0)
    print(f"{indent + name:38}{seconds:9.2f} s {100.0 * seconds / total:5.1f} % {each:8.2f} us")


if __name__ == "__main__":
    main()
