"""What a step of a section (r, z) costs beside one of a plane with as many particles.

    python benchmarks/ring_step.py --rows 40

Two boxes of molten steel four times as wide as deep, under a bump of temperature at their left end:
rings about an axis, or strips beside a plane of symmetry. Both take the same steps in turns, on one
thread; processor time counts, so that other work on the machine does not. Below a flat surface the
particles of a section rest, below one that moves they ride with it; those of a plane move.
"""

from __future__ import annotations

import argparse
from time import process_time

from lasersph import compute
from lasersph.case import Case
from lasersph.simulation.recipes import recipe_of

DEPTH = 1e-6
"""Of the boxes [m]."""
WARM_UP, TURN, TURNS = 20, 10, 8
"""Steps before, steps of a turn, and turns of each box; the least of its turns counts."""
ASKED = 1.15


def solver_of(geometry: str, surface: str, rows: int):
    """A box with so many rows of particles."""
    flow, frame = {"surface": surface, "right": "symmetry"}, {}
    if geometry == "planar":
        flow["left"], frame = "symmetry", {"frame": "lagrangian"}
    heat = {"amplitude": 100.0, "radius": DEPTH}
    data = {
        "material": {
            "name": "steel",
            "heat_capacity": 704.0,
            "conductivity": 26.8,
            "density": 6863.0,
            "viscosity": 7e-3,
            "surface_tension": 1.6,
            "surface_tension_slope": -4.3e-4,
        },
        "initial_temperature": 2000.0,
        "domain": {"width": 4.0 * DEPTH, "depth": DEPTH},
        "boundaries": {
            "surface": "fixed-temperature",
            "surface_temperature": 2000.0,
            "surface_temperature_bump": heat,
        },
        "particles": {"spacing": DEPTH / rows, "arrangement": "uniform"},
        "solver": {"kind": "melt-pool", "geometry": geometry, "flow": flow, **frame},
        "time": {"end": 1e-6},
    }
    return recipe_of(Case.model_validate(data)).build(compute.cpu(threads=1))


def seconds_of_turns(solvers: list, steps: float) -> list[float]:
    """Least processor time of a step of each [s]; all take steps of a length [s], in turns."""
    least = [float("inf")] * len(solvers)
    for turn in range(TURNS + 1):
        for number, solver in enumerate(solvers):
            count, begin = TURN if turn else WARM_UP, process_time()
            for _ in range(count):
                solver.step(steps)
            if turn:
                least[number] = min(least[number], (process_time() - begin) / count)
    return least


def main() -> None:
    """Print both times, and their ratio beside what is asked for."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--rows", type=int, default=40, help="rows of particles in the depth")
    rows = parser.parse_args().rows
    for surface in ("flat", "moving"):
        solvers = [solver_of(geometry, surface, rows) for geometry in ("axisymmetric", "planar")]
        # half of the shorter step that both allow at the start
        step = min(min(solver.time_step_limits().values()) for solver in solvers)
        ring, strip = seconds_of_turns(solvers, 0.5 * step)
        print(
            f"{surface} surface, {solvers[0].particle_count} particles: "
            f"{1e3 * ring:.1f} ms a step of rings, {1e3 * strip:.1f} ms of strips, "
            f"ratio {ring / strip:.2f} (asked for: {ASKED})",
            flush=True,
        )


if __name__ == "__main__":
    main()
