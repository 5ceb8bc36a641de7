"""Heat that particles carry across a heated box, beside that of its walls.

    python benchmarks/heat_moved.py --rayleigh 1e5 --cells 40

Nusselt numbers of `natural-convection`, means over the last part of a run. The fields say
1 + <u T>, T less that of the middle. Particles are also shifted to keep them even, and what is
shifted takes its heat along: by their whole displacements dx of a step, with the mean of T before
and after it,

    1 + sum V dx T / (a dT A t)

is what has been carried from the warm wall to the cold one in a time t.
"""

from __future__ import annotations

import argparse

import numpy as np

from lasersph import compute
from lasersph.case import load_case
from lasersph.simulation.recipes import recipe_of
from lasersph.solvers.melt_pool.solver import MeltPool
from lasersph.validation.natural_convection.rows import diffusivity

PRANDTL = 0.71
MIDDLE, DIFFERENCE = 300.0, 10.0
"""Mean of the walls and their difference [K]."""
LAST = 0.6
"""Share of the time after which means are taken."""


def box_of(rayleigh: float, cells: int, end: float) -> MeltPool:
    """A box with so many particles a side until an end [s]; g beta dT width^3 is 1 in SI units."""
    settings = (
        "solver.frame=lagrangian",
        f"particles.spacing={1.0 / cells!r} m",
        f"material.kinematic_viscosity={np.sqrt(PRANDTL / rayleigh):.8g} m^2/s",
        f"material.conductivity={diffusivity(rayleigh, PRANDTL):.8g} W/(m K)",
        f"time.end={2.0 * end!r} s",
    )
    return recipe_of(load_case("natural-convection", settings)).build(compute.cpu(threads=1))


def advance(box: MeltPool) -> float:
    """Take the longest step that is allowed; its length [s]."""
    return box.step(min(box.time_step_limits().values()))


def nusselt_numbers(box: MeltPool, a: float, end: float) -> dict[str, float]:
    """Of the walls, by u T and by displacements, means from `LAST` of the end [s] on."""
    while box.state.time < LAST * end:
        advance(box)

    # sums over the last part: V u T dt, V dx T, and the heat that has crossed the walls
    particles = box.particles
    V, begin, at_walls = np.asarray(particles["volume"]), box.state.time, dict(box.exchange.heat)
    by_fields = by_motion = 0.0
    while box.state.time < end:
        x, T = np.array(particles["position"]), np.asarray(particles["temperature"]) - MIDDLE
        step = advance(box)
        now = np.asarray(particles["temperature"]) - MIDDLE
        by_fields += step * float(np.sum(V * np.asarray(box.flow.velocity)[0] * now))
        moved = np.asarray(particles["position"])[0] - x[0]
        by_motion += float(np.sum(V * moved * 0.5 * (T + now)))

    # over what conducts at rest, a dT A t
    rest = a * DIFFERENCE * (box.state.time - begin)
    walls = {side: abs(box.exchange.heat[side] - at_walls[side]) / rest for side in at_walls}
    return walls | {"u T": 1.0 + by_fields / rest, "displacements": 1.0 + by_motion / rest}


def main() -> None:
    """Print the Nusselt numbers, and how far those of the box are from the mean of its walls."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--rayleigh", type=float, default=1e5)
    parser.add_argument("--cells", type=int, default=40, help="particles a side")
    parser.add_argument("--end", type=float, default=90.0, help="[s]")
    given = parser.parse_args()
    box = box_of(given.rayleigh, given.cells, given.end)
    found = nusselt_numbers(box, diffusivity(given.rayleigh, PRANDTL), given.end)
    walls = 0.5 * (found["left"] + found["right"])
    for name in ("left", "right", "u T", "displacements"):
        print(f"{name:14} {found[name]:.4f}, {found[name] / walls - 1.0:+.2%} of the walls")


if __name__ == "__main__":
    main()
