"""Error against time of kernels and supports in 3-D, for the neighbors that a pool takes.

    python benchmarks/neighbors_in_space.py
    python benchmarks/neighbors_in_space.py --only quintic-spline:3.1 quintic-spline:3.75

A film of steel under dots of temperature is held against its exact harmonic, and a dot of four
beams, `texture-dots-steel`, against what it converges to: the limits of depths and volume by second
order from 32 and 24 nm, under [validation](../docs/methods/dots.md). Both are coarse, so that
errors show. Processor time of one thread counts, so that other work on the machine does not.
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
LIMITS = {"depth": 34.3e-9, "peak to valley": 48.5e-9, "melt": 0.6208e-18}
"""What the dot converges to [m], [m], [m^3]."""


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


def dot_numbers(choice: str, spacing: str, out: Path) -> tuple[dict[str, float], float]:
    """Depth, height and volume of a dot, and processor time [s]."""
    settings = [f"particles.spacing={spacing}", *settings_of(choice)]
    begin = process_time()
    case = load_case("texture-dots-steel", settings)
    summary = run(case, out, threads=1, warn=False, anyway=True).summary
    relief = summary["topography"]
    found = {"depth": relief["depth_m"], "peak to valley": relief["peak_to_valley_m"]}
    return found | {"melt": summary["melt"]["volume_max_m3"]}, process_time() - begin


def main() -> None:
    """Print a row for each choice."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--film", default="70nm", help="spacing of the film")
    parser.add_argument("--dot", default="64nm", help="spacing of the dot")
    parser.add_argument("--only", nargs="*", default=CHOICES, metavar="KERNEL:SUPPORT")
    given = parser.parse_args()
    print(f"{'kernel, support':20s}  neighbors  film {given.film}       dot {given.dot}: "
          + ", ".join(LIMITS))  # fmt: skip
    for choice in given.only:
        with TemporaryDirectory() as folder:
            error, seconds = film_error(choice, given.film, Path(folder) / "film")
            found, dot_seconds = dot_numbers(choice, given.dot, Path(folder) / "dot")
        errors = "  ".join(
            f"{100.0 * (found[name] / LIMITS[name] - 1.0):+6.1f} %" for name in found
        )
        print(
            f"{choice:20s}  {neighbors_of(float(choice.split(':')[1])):9d}  "
            f"{100.0 * error:5.2f} % {seconds:5.0f} s   {errors}  {dot_seconds:5.0f} s",
            flush=True,
        )


if __name__ == "__main__":
    main()
