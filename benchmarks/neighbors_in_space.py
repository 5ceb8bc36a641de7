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
from lasersph.analytic.liquid_film import Drive
from lasersph.output import Run
from lasersph.validation.dots_film.rows import PULSE, WAVE, film_of, harmonic
from lasersph.validation.study import Study

CHOICES = (
    "quintic-spline:3.75", "quintic-spline:3.4", "quintic-spline:3.1", "quintic-spline:2.8",
    "quintic-spline:2.5", "wendland-c2:3.4", "wendland-c2:3.0", "wendland-c2:2.7",
    "cubic-spline:3.0", "cubic-spline:2.6",
)  # fmt: skip
"""Kernel and support over the spacing."""
PERIOD = 5.05
"""Of the film along x and y [um], as in `dots-film`."""


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
    study, length = Study("dots-film", out), f"{PERIOD} um"
    sides = (f"domain.{side}={length}" for side in ("width", "breadth"))
    periods = (f"{WAVE}.{name}={length}" for name in ("period", "period_y"))
    choices = (f"particles.spacing={spacing}", f"time.end={PULSE} s", *settings_of(choice))
    case = load_case(study.plan.case, [*study.plan.settings, *sides, *periods, *choices])
    begin = process_time()
    run(case, out, threads=1, warn=False, anyway=True)
    seconds = process_time() - begin

    # the same film, exactly
    times = PULSE * np.array([0.25, 0.5, 0.75, 1.0])
    film = film_of(study, [PERIOD, PERIOD])
    exact = film.amplitude(times, Drive(temperature=100.0, end=PULSE))
    found = harmonic(Run(out), times)
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
