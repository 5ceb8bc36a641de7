"""Figs. 3-11 of [Demuth2020] from runs with flow, as the paper arranges them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from lasersph.output import Run
from lasersph.plots import (
    melt_pools,
    speed_extrema,
    surface_flow_profiles,
    surface_speeds,
    surface_temperatures,
)
from lasersph.validation.drawing import Panel, line, marks
from lasersph.validation.study import Study

Runs = dict[tuple[float, str], Run]


def draw(study: Study, runs: Runs, still: Run, profile: Callable[[np.ndarray], np.ndarray]) -> None:
    """All figures of one metal; those that depend on it for each reading of the plateau.

    profile: u [m/s] at depths [m] of the detailed run.
    """
    # Temperature, pool and profiles by one reading.
    plan, metal = study.plan, study.name.removeprefix("dlip-")
    detail, hold = runs[plan.detail, "hold"], of_plateau(runs, "hold")
    times = [1e-9 * t for t in plan.profile_times if 1e-9 * t <= detail.summary["time_s"]]
    names = {key: f"{number}-{metal}" for key, number in plan.figures.items()}
    study.save(f"{names['temperature']}-temperature", surface_temperatures(hold))
    study.save(f"{names['pool']}-melt-pool", melt_pools(hold))
    study.save(f"{names['profiles']}-profiles", surface_flow_profiles(detail, times))
    draw_profile(study, f"{metal}-below-the-surface", profile)
    both = melt_pools([detail, still], ["flow", "no flow"])
    study.save(f"{metal}-with-and-without-flow", both)
    # Speeds and extrema by every reading of the plateau.
    for plateau in plan.plateaus:
        below = "flow_below_speed_m_s"
        speeds = surface_speeds(of_plateau(runs, plateau), title=plateau, column=below)
        study.save(f"{names['speed']}-speed-{plateau}", speeds)
        pair = [runs[f, plateau] for f in plan.extrema_at if (f, plateau) in runs]
        if pair:
            extrema = speed_extrema(pair, title=plateau)
            study.save(f"{names['extrema']}-extrema-{plateau}", extrema)


def of_plateau(runs: Runs, plateau: str) -> list[Run]:
    """Runs of one reading, in order of their fluence."""
    return [one for (_, reading), one in runs.items() if reading == plateau]


def draw_profile(study: Study, name: str, profile: Callable[[np.ndarray], np.ndarray]) -> None:
    """u below the place of the largest speed at the instant, beside finite volumes."""
    # Our profile on even depths, finite volumes at theirs.
    known = study.table("profile.csv")
    depths = np.linspace(0.0, np.max(known["depth"], initial=250.0), 200)
    curves = [line(profile(1e-9 * depths), depths, "SPH")]
    if known["u"].size:
        curves.append(marks(known["u"], known["depth"], "finite volumes", color="0.45"))
    title, deepest = f"{study.plan.instant:g} ns", float(depths[-1])
    panel = Panel("u [m/s]", "depth [nm]", curves, title, low=deepest, high=0.0)
    study.draw(name, panel, height=3.6)
