"""Calibration of a hidden factor: real runs, and honest bands.

    python benchmarks/calibration.py FOLDER [--seed 1] [--workers 2] [--with duration|absorptivity]

Four conduction runs of dlip-steel at 16 nm with the fluence times a hidden factor give widths and
depths of the melt; noise of 60 and 12 nm makes them measured values. A calibration with particles
of 32 nm, eight runs at most, has to find the factor within its 95 % interval. With a second unknown
it may take twelve: a pulse duration, hidden as well, must be found beside the factor; an
absorptivity cannot be, since only its product with the factor heats, and the answer has to say so.
The same command again goes on where it was stopped.
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
SECOND = {
    "duration": 'duration = { key = "laser.pulse.fwhm", between = ["6 ns", "16 ns"] }',
    "absorptivity": 'absorptivity = { complements = "laser.reflectivity", between = [0.25, 0.6] }',
}
CASE = {"solver.kind": "conduction", "output.snapshots.interval": "200 ns"}


def hidden_factor(seed: int) -> float:
    """Between 0.85 and 1.35."""
    return float(0.85 + 0.5 * np.random.default_rng(seed).random())


def hidden_duration(seed: int) -> float:
    """Between 8 and 13 ns."""
    return float(8e-9 + 5e-9 * np.random.default_rng(500 + seed).random())


def plan_text(folder: Path, seed: int, workers: int, second: str | None) -> str:
    """The plan with measured values from fine runs."""
    is_long = second == "duration"
    pulse = {"laser.pulse.fwhm": f"{hidden_duration(seed):.9g} s"} if is_long else {}
    factor, rng = hidden_factor(seed), np.random.default_rng(1000 + seed)
    table = lasersph.sweep(
        "dlip-steel",
        folder / ("data-of-another-duration" if is_long else "data"),
        set={**CASE, **pulse, "particles.spacing": "16 nm"},
        vary={"laser.fluence": [f"{factor * one:.9g} J/cm^2" for one in FLUENCES]},
        workers=workers,
        threads=1,
    )
    lines = ['case = "dlip-steel"', "[set]"]
    lines += [f'"{key}" = "{value}"' for key, value in CASE.items()]
    lines += ['"particles.spacing" = "32 nm"', "[unknown]"]
    lines += ['factor = { scales = "laser.fluence", between = [0.7, 1.6] }']
    lines += [SECOND[second]] if second else []
    for number, fluence in enumerate(FLUENCES):
        values = []
        for column, (sd, unit, scale) in NOISE.items():
            value = table.values(column)[number] + sd * rng.standard_normal()
            values.append(f'"{column}" = "{scale * value:.6g} +- {scale * sd:g} {unit}"')
        lines += ["[[measured]]", f'set = {{ "laser.fluence" = "{fluence} J/cm^2" }}']
        lines += [f"values = {{ {', '.join(values)} }}"]
    budget = ["first = 8", "most = 12"] if second else ["first = 5", "most = 8"]
    return "\n".join([*lines, "[runs]", *budget, ""])


def main() -> None:
    """Print the hidden and the found unknowns, or which combination of them is known."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--with", dest="second", choices=SECOND)
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    name = f"-{given.second}" if given.second else ""
    plan = given.folder / f"plan{name}.toml"
    plan.write_text(plan_text(given.folder, given.seed, given.workers, given.second))
    out = given.folder / f"calibration{name}"
    found = lasersph.calibrate(plan, out, workers=given.workers, threads=1, report=print)
    print(f"{found['runs']} runs")
    for text in found["warnings"]:
        print(f"warning: {text}")
    hidden = {"factor": hidden_factor(given.seed), "duration": hidden_duration(given.seed)}
    for key, one in found["unknowns"].items():
        if not one["is_fixed_by_data"]:
            print(f"{key}: not told by itself")
            continue
        is_inside = one["low_95"] < hidden[key] < one["high_95"]
        print(f"{key}: hidden {hidden[key]:.4g}, found {one['mean']:.4g} +- {one['sd']:.2g}")
        ends = f"{one['low_95']:.4g} to {one['high_95']:.4g}"
        print(f"95 %: {ends}: {'inside' if is_inside else 'MISSED'}")


if __name__ == "__main__":
    main()
