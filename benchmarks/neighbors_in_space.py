"""Error against time of kernels and supports in 3-D, for the neighbors that a pool takes.

    python benchmarks/neighbors_in_space.py
    python benchmarks/neighbors_in_space.py --only quintic-spline:3.1 quintic-spline:3.75

A film of steel under dots of temperature is held against its exact harmonic. Of a dot of four
beams, `texture-dots-steel`, the relief and the volume of melt are printed, to be held against those
of fine particles in docs/methods/dots.md. Both are coarse, so that errors show. Processor time of
one thread counts, so that other work on the machine does not.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

import numpy as np

from lasersph import load_case, run
from lasersph.analytic.liquid_film import Drive, LiquidFilm
from lasersph.output import Run

CHOICES = (
    "quintic-spline:3.75", "quintic-spline:3.4", "quintic-spline:3.1", "quintic-spline:2.8",
    "quintic-spline:2.5", "wendland-c2:3.4", "wendland-c2:3.0", "wendland-c2:2.7",
    "cubic-spline:3.0", "cubic-spline:2.6",
)  # fmt: skip
"""Kernel and support over the spacing."""
FILM = (
    "solver.dimensions=3", "domain.extent=quarter", "solver.flow.front=symmetry",
    "solver.flow.back=symmetry", "boundaries.surface_temperature=2000 K", "domain.width=5.05 um",
    "domain.breadth=5.05 um", "boundaries.surface_temperature_wave.period=5.05 um",
    "boundaries.surface_temperature_wave.period_y=5.05 um", "time.end=20 ns",
)  # fmt: skip
"""The film of `dots-film`, by the case `moving-film`."""


def neighbors_of(ratio: float) -> int:
    """Neighbors within the support on a cubic lattice."""
    places = np.arange(-6, 7)
    x, y, z = np.meshgrid(places, places, places)
    return int(np.count_nonzero(x**2 + y**2 + z**2 < ratio**2)) - 1


def settings_of(choice: str) -> list[str]:
    """Settings of a kernel and its support."""
    kernel, ratio = choice.split(":")
    return [f"particles.kernel={kernel}", f"particles.support_ratio={ratio}"]


def film_error(choice: str, spacing: str, out: Path) -> tuple[float, float]:
    """Largest deviation of the harmonic over the largest height, and processor time [s]."""
    case = load_case("moving-film", [*FILM, f"particles.spacing={spacing}", *settings_of(choice)])
    begin = process_time()
    run(case, out, threads=1, warn=False, anyway=True)
    seconds, history = process_time() - begin, Run(out).history

    # the same film, exactly
    metal, cold = case.material, 2000.0
    film = LiquidFilm(
        case.domain.depth,
        5.05e-6 / np.sqrt(2.0),
        metal.density_reference,
        float(metal.viscosity_at(cold)),
        float(metal.at("surface_tension", cold)),
        float(metal.at("surface_tension_slope", cold)),
    )
    times = 1e-9 * np.array([5.0, 10.0, 15.0, 20.0])
    exact = film.amplitude(times, Drive(temperature=100.0, end=20e-9))
    found = np.interp(times, history["time_s"], history["topography.first_harmonic_m"])
    return float(np.max(np.abs(found - exact)) / np.max(np.abs(exact))), seconds


def dot_numbers(choice: str, spacing: str, out: Path) -> tuple[list[str], float]:
    """Depth, height from peak to valley and largest volume of the melt of a dot, and processor time
    [s]."""
    settings = [f"particles.spacing={spacing}", *settings_of(choice)]
    begin = process_time()
    case = load_case("texture-dots-steel", settings)
    summary = run(case, out, threads=1, warn=False, anyway=True).summary
    relief, melt = summary["topography"], summary["melt"]["volume_max_m3"]
    heights = [f"{1e9 * relief[f'{name}_m']:5.1f} nm" for name in ("depth", "peak_to_valley")]
    return [*heights, f"{1e18 * melt:.3f} um3"], process_time() - begin


def main() -> None:
    """Print a row for each choice."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--film", default="70nm", help="spacing of the film")
    parser.add_argument("--dot", default="64nm", help="spacing of the dot")
    parser.add_argument("--only", nargs="*", default=CHOICES, metavar="KERNEL:SUPPORT")
    given = parser.parse_args()
    print(f"kernel:support, neighbors | film {given.film}: error, time | dot {given.dot}: depth, "
          "peak to valley, melt, time")  # fmt: skip
    for choice in given.only:
        with TemporaryDirectory() as folder:
            error, seconds = film_error(choice, given.film, Path(folder) / "film")
            found, dot_seconds = dot_numbers(choice, given.dot, Path(folder) / "dot")
        print(
            f"{choice}, {neighbors_of(float(choice.split(':')[1]))} | "
            f"{100.0 * error:.1f} %, {seconds:.0f} s | {', '.join(found)}, {dot_seconds:.0f} s",
            flush=True,
        )


if __name__ == "__main__":
    main()
