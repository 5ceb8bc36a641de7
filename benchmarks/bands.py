"""Errors of small validations over spacing and step: the studies from which their bands follow.

python benchmarks/bands.py                     the tables in the README of each validation
python benchmarks/bands.py --only stefan       one of them
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

from lasersph.validation.ablation_depth import rows as ablation_depth
from lasersph.validation.dlip_steel import rows as dlip_steel
from lasersph.validation.gaussian_pulse import rows as gaussian_pulse
from lasersph.validation.hydrostatic_column import rows as hydrostatic_column
from lasersph.validation.marangoni_layer import rows as marangoni_layer
from lasersph.validation.sound_wave import rows as sound_wave
from lasersph.validation.stefan import rows as stefan
from lasersph.validation.study import Study

SPACINGS = {"dlip-steel": (32.0, 16.0, 8.0), "dlip-aluminium": (50.0, 25.0, 16.0)}
"""Of the pools [nm]; the validations take 3.97 nm."""


def errors_of_fronts(study: Study) -> None:
    """Front and temperature of the Stefan problem in full, and shortened."""
    for quick, spacings in ((False, (800, 400, 200, 100)), (True, (1600, 800, 400))):
        settings = Study(study.name, study.folder, quick=quick).plan.settings
        solution = stefan.exact_solution(study.case(*settings))
        for spacing in spacings:
            one = study.run(f"{quick}-{spacing}", f"particles.spacing={spacing} nm", *settings)
            error = np.abs(stefan.fronts(one) - solution.front(one.snapshots.times))[1:]
            front = float(solution.front(one.snapshots.times[-1]))
            print(
                f"{'shortened' if quick else 'full'}, {spacing} nm: front at the end off by"
                f" {100.0 * error[-1] / front:.3f} %, mean {1e9 * error.mean():.2f} nm,"
                f" largest {1e9 * error.max():.2f} nm;"
                f" temperature {100.0 * stefan.temperature_error(one, solution):.3f} %",
                flush=True,
            )


def errors_of_rises(study: Study) -> None:
    """Temperature under a Gaussian pulse, steel in 1-D: deviations in parts of the rise."""
    tried = [(spacing, 20, 0.9) for spacing in (15.88, 7.94, 3.97, 1.985)]
    tried += [(3.97, step, 0.9) for step in (40, 10)]
    tried += [(3.97, 20, ratio) for ratio in (7.0 / 9.0, 0.95, 0.975)]
    for spacing, step, ratio in tried:
        one = study.run(
            f"{spacing}-{step}-{ratio}",
            *study.plan.flat["settings"],
            f"particles.spacing={spacing} nm",
            f"particles.ratio={ratio!r}",
            f"time.step={step} ps",
            "solver.kind=conduction",
            "solver.phase_change=false",
            f"laser.reflectivity={study.plan.reflectivity['dlip-steel']}",
            case="dlip-steel",
        )
        place, depth = gaussian_pulse.first_particle(one)
        exact = gaussian_pulse.exact_temperature(study, "dlip-steel", one, place, depth)
        times, found = one.history["time_s"], one.history[gaussian_pulse.AT_MAXIMUM]
        at = 1e-9 * np.array([40.0, 50.0, 60.0, 100.0, 200.0])
        rise = np.interp(at, times, exact) - one.case["initial_temperature"]
        parts = 100.0 * (np.interp(at, times, found) - np.interp(at, times, exact)) / rise
        text = " ".join(f"{part:+.3f}" for part in parts)
        print(f"{spacing} nm, {step} ps, ratio {ratio:.4f}: {text} %", flush=True)


def errors_of_layers(study: Study) -> None:
    """Layer driven by its surface tension, over rows and steps."""
    solution = marangoni_layer.exact_solution(study.case())
    for rows, step in ((10, 2), (14, 2), (20, 2), (28, 2), (40, 2), (20, 4), (20, 1), (40, 1)):
        found = marangoni_layer.layer(study, rows, solution, f"time.step={step} ns")
        off, error = found.surface_speed / solution.surface_speed - 1.0, found.error
        print(
            f"{rows} rows, {step} ns: speed {100.0 * off:+.3f} %, profiles {100.0 * error:.3f} %",
            flush=True,
        )


def errors_of_waves(study: Study) -> None:
    """Speed of sound over the number of particles in a wave."""
    for name, plan in study.plan.runs.items():
        spacing = 2.0 if plan["dimension"] == 3 else 1.0
        for length in (50, 100, 200):
            long = [
                f"domain.depth={length * spacing} um",
                f"time.end={length * spacing / 5.0} ns",
                f"output.snapshots.interval={length * spacing / 100.0} ns",
            ]
            kept, plan["settings"] = plan["settings"], [*plan["settings"], *long]
            found = sound_wave.wave(study, name)
            plan["settings"] = kept
            sound_speed = found.run.case["solver"]["sound_speed"]
            off = 100.0 * (found.speed / (sound_speed * found.moment) - 1.0)
            start = found.run.case["solver"]["motion"]["amplitude"]
            change = 100.0 * np.max(np.abs(found.amplitude / start - 1.0))
            print(
                f"{name}, {length} in a wave: second moment {found.moment:.5f},"
                f" speed over that {off:+.3f} %, amplitude {change:.4f} %",
                flush=True,
            )


def errors_of_columns(study: Study) -> None:
    """Water at rest over spacings, in full and to 1 s as shortened."""
    tried = [(1, 10, spacing) for spacing in (0.1, 0.05, 0.025)]
    tried += [(2, end, spacing) for end in (10, 1) for spacing in (0.1, 0.05)]
    for dimension, end, spacing in tried:
        one = study.run(
            f"{dimension}-{end}-{spacing}",
            f"solver.dimensions={dimension}",
            f"particles.spacing={spacing} m",
            "domain.width=1 m",
            f"time.end={end} s",
            f"output.snapshots.interval={0.05 * end} s",
        )
        found = hydrostatic_column.fit_lines(one, *hydrostatic_column.weight(study))
        half = one.snapshots.times.size // 2
        drift = abs(np.mean(found.bottom[half:]) - np.mean(found.bottom[1:half]))
        print(
            f"{dimension}-D, {end} s, {spacing} m:"
            f" slope {100.0 * np.max(np.abs(found.slope - 1.0)):.3f},"
            f" bottom {100.0 * np.max(np.abs(found.bottom - 1.0)):.3f},"
            f" all {100.0 * np.max(found.deviation):.3f}, drift {100.0 * drift:.3f} %",
            flush=True,
        )


def errors_of_depths(study: Study) -> None:
    """Removed volume, with what was about to leave, in parts of a layer."""
    for spacing in (0.2, 0.1, 0.05):
        parts = []
        for pulse in ((10, 4), (10, 10), (10, 20), (6, 10), (6, 25)):
            found = ablation_depth.column(study, pulse, spacing).smooth
            exact = 1e6 * ablation_depth.stefan(study, *pulse).depth
            parts.append(
                f"{(found - exact) / spacing:+.3f} ({100.0 * (found / exact - 1.0):+.2f} %)"
            )
        print(f"{spacing} um: " + ", ".join(parts), flush=True)


def errors_of_pools(study: Study) -> None:
    """Flow of the detailed pool at the instant, and its size with and without stress."""
    plan = study.plan
    for spacing in SPACINGS[study.name]:
        plan.detail_spacing = spacing
        one = dlip_steel.run_pool(study, plan.detail, "hold")
        dlip_steel.add_detail(study, f"{spacing:g} nm", one)
        still = dlip_steel.run_pool(
            study, plan.detail, "hold", "solver.marangoni=false", label="-still"
        )
        dlip_steel.add_sizes(study, f"{spacing:g} nm", one, still)
        for row in study.rows:
            if row.tolerance is not None:
                print(f"{row.quantity}: {row.computed:.3f} beside {row.reference:.3f} {row.unit}")
        study.rows.clear()


STUDIES: dict[str, Callable[[Study], None]] = {
    "stefan": errors_of_fronts,
    "marangoni-layer": errors_of_layers,
    "sound-wave": errors_of_waves,
    "hydrostatic-column": errors_of_columns,
    "gaussian-pulse": errors_of_rises,
    "ablation-depth": errors_of_depths,
    "dlip-steel": errors_of_pools,
    "dlip-aluminium": errors_of_pools,
}


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--only", choices=tuple(STUDIES))
    only = parser.parse_args().only
    for name, study in STUDIES.items():
        if only in (None, name):
            with tempfile.TemporaryDirectory() as folder:
                print(f"# {name}")
                quick = name.startswith("dlip")  # to the instant of the velocities, not to 200 ns
                study(Study(name, Path(folder), quick=quick, threads=1))


if __name__ == "__main__":
    main()
