"""What single changes do to the numbers that `dlip-figures` misses.

python benchmarks/one_change.py                the tables in its README
python benchmarks/one_change.py --only heat    extrema of steel near 0.5 J/cm2
python benchmarks/one_change.py --only cells   speed of steel by `clip` over the spacing
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

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
CELLS = ((0.8, (20, 10)), (1.0, (20, 10, 7)))


def steel(study: Study, fluence: float, spacing: int, end: int, *settings: str) -> Run:
    """A run of the pool in steel."""
    return study.run(
        f"{fluence}-{spacing}-{settings}".replace(" ", ""),
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


def cells(study: Study) -> None:
    """Largest speed of the surface with enthalpy beyond the full L_v discarded."""
    for fluence, spacings in CELLS:
        for spacing in spacings:
            one = steel(study, fluence, spacing, 66, "solver.plateau=clip")
            print(f"{fluence} J/cm2, {spacing} nm: {speed_of(one):.2f} m/s", flush=True)


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--only", choices=("heat", "cells"))
    only = parser.parse_args().only
    with tempfile.TemporaryDirectory() as folder:
        study = Study("dlip-figures", Path(folder), threads=1)
        for table in (heat, cells):
            if only in (None, table.__name__):
                table(study)


if __name__ == "__main__":
    main()
