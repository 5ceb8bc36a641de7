"""The process map of steel by one plan, and its melting line beside thresholds found by bisection.

    python benchmarks/process_map.py [--out runs/process-map] [--duration 18.803ns,50ns]

It makes the sweep of examples/process-map-steel on two workers with one thread each, tells the time
of the clock and of the processors, draws the map, and compares its melting line at some durations
with `lasersph threshold --of melt`. Finished runs are found again by another call.
"""

from __future__ import annotations

import argparse
import json
import os
import time
from pathlib import Path

import numpy as np

import lasersph
from lasersph.cli import main
from lasersph.input import parse_quantity
from lasersph.sweeps import read_plan

PLAN = Path(__file__).resolve().parent.parent / "examples" / "process-map-steel" / "plan.toml"


def melting_fluence(found, duration: float) -> float:
    """Fluence [J/m^2] at which the melting line of a map passes a duration [s]; nan beside it."""
    line = np.concatenate(found.lines["melts"])
    line = line[np.argsort(line[:, 1])]
    places = np.log(line[:, 1])
    return float(np.interp(np.log(duration), places, line[:, 0], left=np.nan, right=np.nan))


def compare(out: Path, durations: list[str]) -> None:
    """Make sweep, map and thresholds, and print both numbers."""
    began, before = time.monotonic(), os.times()
    main(["sweep", str(PLAN), "--out", str(out / "map"), "--workers", "2", "--threads", "1"])
    after = os.times()
    cores = sum(after[2:4]) - sum(before[2:4])
    print(f"sweep: {time.monotonic() - began:.0f} s, {cores:.0f} s of the processors")
    main(["map", str(out / "map"), "--target", "250 nm"])
    found = lasersph.map(out / "map")
    for text in durations:
        duration = parse_quantity(text, "time")
        expected = melting_fluence(found, duration)
        settings = read_plan(PLAN).template.settings
        options = [f"--set={key}={value}" for key, value in settings.items()]
        options += [f"--set=laser.pulse.fwhm={text}", f"--set=laser.fluence={expected} J/m^2"]
        options += ["--tolerance", "0.005", "--json", str(out / f"threshold-{text}.json")]
        options += [
            "--resume",
            "--workers",
            "2",
            "--threads",
            "1",
            "--out",
            str(out / f"threshold-{text}"),
        ]
        main(["threshold", "dlip-steel", "--of", "melt", *options])
        answer = json.loads((out / f"threshold-{text}.json").read_text(encoding="utf-8"))
        bisected = 0.5 * (answer["below"] + answer["above"])
        away = f"{100.0 * (expected / bisected - 1.0):+.1f} %"
        shown = f"map {1e-4 * expected:.4f} J/cm2, threshold {1e-4 * bisected:.4f} J/cm2"
        print(f"{text}: {shown}: {away}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("runs/process-map"))
    parser.add_argument("--duration", default="18.803ns,50ns", help="separated by commas")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    compare(arguments.out, arguments.duration.split(","))
