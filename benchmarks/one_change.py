"""What single changes do to the numbers that `dlip-figures` misses.

python benchmarks/one_change.py                the tables in its README
python benchmarks/one_change.py --only heat    extrema of steel near 0.5 J/cm2
python benchmarks/one_change.py --only rises   how long both last, by the least rise of one
python benchmarks/one_change.py --only cells   speed of steel by `clip` over the spacing
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

import numpy as np

from lasersph.observers.flow_extrema import local_maxima
from lasersph.output import Run
from lasersph.validation.dlip_figures.rows import PRINTED, details, speed_of
from lasersph.validation.study import Study

HEATED = (
    ("0.535 J/cm2", 0.535, 10, ""),
    ("0.55 J/cm2", 0.55, 10, ""),
    ("0.57 J/cm2", 0.57, 10, ""),
    ("0.6 J/cm2", 0.6, 10, ""),
    ("0.535 J/cm2, 7 nm", 0.535, 7, ""),
    ("0.535 J/cm2, clip", 0.535, 10, "solver.plateau=clip"),
    ("0.535 J/cm2, evaporate", 0.535, 10, "solver.plateau=evaporate"),
    ("0.535 J/cm2, published limits of the step", 0.535, 10, "solver.step_limits=published"),
    ("0.535 J/cm2, no shifting", 0.535, 10, "solver.shifting=0"),
)
"""Words, fluence [J/cm2], spacing [nm] and a setting."""
RISES = (0.05, 0.02, 0.01, 0.005)
"""Least rise of an extremum over its valley, in parts of the largest speed; ours is first."""
LOOKS = np.arange(54.5, 61.05, 0.1)
"""Times of profiles [ns]: the pool has spread, and two extrema have become one by the last."""
CELLS = ((0.8, (20, 10)), (1.0, (20, 10, 7)))


def steel(study: Study, fluence: float, spacing: int, end: int, *settings: str) -> Run:
    """A run of the pool in steel."""
    return study.run(
        f"{fluence}-{spacing}-{settings}".replace(" ", "")[:60],
        f"laser.fluence={fluence} J/cm^2",
        f"particles.spacing={spacing} nm",
        f"time.end={end} ns",
        *settings,
        case="dlip-steel",
    )


def heat(study: Study) -> None:
    """Extrema of the speed beside those that the paper prints for 0.5 J/cm2."""
    print("printed:", ", ".join(f"{one.what} {one.value} {one.unit}" for one in PRINTED.values()))
    for words, fluence, spacing, setting in HEATED:
        one = steel(study, fluence, spacing, 63, *filter(None, [setting]))
        found = details(study, one)
        print(words, ", ".join(f"{key} {value:.2f}" for key, value in found.items()), flush=True)


def rises(study: Study) -> None:
    """For how long two extrema count, and the inner one is the faster one."""
    times = ", ".join(f'"{t:.1f} ns"' for t in LOOKS)
    for fluence in (0.535, 0.55, 0.57, 0.8):
        one = steel(study, fluence, 10, 62, f"output.snapshots.times=[{times}]")
        for least in RISES:
            both, faster = coexistence(one, least)
            print(f"{fluence} J/cm2, {least:g}: both {both:.1f} ns, inner faster {faster:.1f} ns")


def coexistence(one: Run, least: float) -> tuple[float, float]:
    """Time [ns] with two maxima of |u| at x > 0 that rise by `least`, and of a faster inner one."""
    both = faster = 0
    for step in one.snapshots:
        x = step["position"][0]
        chosen = np.flatnonzero((step["surface"] > 0) & (step["flows"] > 0) & (x > 0.0))
        speed = np.abs(step["surface_velocity"][chosen[np.argsort(x[chosen])]])
        if 1e9 * step["time"] < LOOKS[0] - 0.01 or not speed.size:
            continue
        speed = np.concatenate([[0.0], speed, [0.0]])
        found, _ = local_maxima(speed, least * float(np.max(speed)))
        both += found.size > 1
        faster += found.size > 1 and speed[found[0]] > speed[found[-1]]
    return 0.1 * both, 0.1 * faster


def cells(study: Study) -> None:
    """Largest speed of the surface with enthalpy beyond the full L_v discarded."""
    for fluence, spacings in CELLS:
        for spacing in spacings:
            one = steel(study, fluence, spacing, 66, "solver.plateau=clip")
            print(f"{fluence} J/cm2, {spacing} nm: {speed_of(one):.2f} m/s", flush=True)


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--only", choices=("heat", "rises", "cells"))
    only = parser.parse_args().only
    with tempfile.TemporaryDirectory() as folder:
        study = Study("dlip-figures", Path(folder), threads=1)
        for table in (heat, rises, cells):
            if only in (None, table.__name__):
                table(study)


if __name__ == "__main__":
    main()
