"""Calibration of a hidden factor: real runs, and honest bands.

    python benchmarks/calibration.py FOLDER [--seed 1] [--workers 2]

Four conduction runs of dlip-steel at 16 nm with the fluence times a hidden factor give widths and
depths of the melt; noise of 60 and 12 nm makes them measured values. A calibration with particles
of 32 nm, eight runs at most, has to find the factor within its 95 % interval. The same command
again goes on where it was stopped.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

import lasersph

FLUENCES = (0.45, 0.55, 0.65, 0.75)
NOISE = {
    "melt.width_half_max_m": (60e-9, "um", 1e6),
    "melt.depth_half_max_m": (12e-9, "nm", 1e9),
}
CASE = {"solver.kind": "conduction", "output.snapshots.interval": "200 ns"}


def hidden_factor(seed: int) -> float:
    """Between 0.85 and 1.35."""
    return float(0.85 + 0.5 * np.random.default_rng(seed).random())


def plan_text(folder: Path, seed: int, workers: int) -> str:
    """The plan with measured values from fine runs."""
    factor, rng = hidden_factor(seed), np.random.default_rng(1000 + seed)
    table = lasersph.sweep(
        "dlip-steel",
        folder / "data",
        set={**CASE, "particles.spacing": "16 nm"},
        vary={"laser.fluence": [f"{factor * one:.9g} J/cm^2" for one in FLUENCES]},
        workers=workers,
        threads=1,
    )
    lines = ['case = "dlip-steel"', "[set]"]
    lines += [f'"{key}" = "{value}"' for key, value in CASE.items()]
    lines += ['"particles.spacing" = "32 nm"', "[unknown]"]
    lines += ['factor = { scales = "laser.fluence", between = [0.7, 1.6] }']
    for number, fluence in enumerate(FLUENCES):
        values = []
        for column, (sd, unit, scale) in NOISE.items():
            value = table.values(column)[number] + sd * rng.standard_normal()
            values.append(f'"{column}" = "{scale * value:.6g} +- {scale * sd:g} {unit}"')
        lines += ["[[measured]]", f'set = {{ "laser.fluence" = "{fluence} J/cm^2" }}']
        lines += [f"values = {{ {', '.join(values)} }}"]
    return "\n".join([*lines, "[runs]", "first = 5", "most = 8", ""])


def main() -> None:
    """Print the hidden and the found factor."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=2)
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    plan = given.folder / "plan.toml"
    plan.write_text(plan_text(given.folder, given.seed, given.workers))
    out = given.folder / "calibration"
    found = lasersph.calibrate(plan, out, workers=given.workers, threads=1, report=print)
    one, hidden = found["unknowns"]["factor"], hidden_factor(given.seed)
    is_inside = one["low_95"] < hidden < one["high_95"]
    print(
        f"hidden {hidden:.4f}, found {one['mean']:.4f} +- {one['sd']:.4f} with {found['runs']} runs"
    )
    print(
        f"95 %: {one['low_95']:.4f} to {one['high_95']:.4f}: {'inside' if is_inside else 'MISSED'}"
    )


if __name__ == "__main__":
    main()
