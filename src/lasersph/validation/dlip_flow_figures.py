"""Figs. 3-11 of [Demuth2020] from runs with flow, as the paper arranges them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lasersph.output import Run
from lasersph.plots import (
    melt_pools,
    speed_extrema,
    style,
    surface_flow_profiles,
    surface_speeds,
    surface_temperatures,
)
from lasersph.validation.dlip_flow import PROFILE_TIMES, Runs, profile_below
from lasersph.validation.dlip_flow_reference import FLOWS, INSTANT

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NUMBERS = {
    "steel": ("fig3", "fig4", "fig5", "fig6"),
    "aluminium": ("fig8", "fig9", "fig10", "fig11"),
}
EXTREMA_AT = (0.5, 0.8)
"""[J/cm2] of Fig. 7, of those that there are."""


def draw(out_dir: Path, label: str, runs: Runs, still: Run) -> tuple[Path, ...]:
    """All figures of one metal; those that depend on it for each reading of the plateau."""
    temperature, pool, speed, profiles = NUMBERS[label]
    detail = runs[FLOWS[label].fluence, "hold"]
    hold = of_plateau(runs, "hold")
    times = [1e-9 * t for t in PROFILE_TIMES if 1e-9 * t <= detail.summary["time_s"]]
    drawings: dict[str, Figure | None] = {
        f"{temperature}-{label}-temperature": surface_temperatures(hold),
        f"{pool}-{label}-melt-pool": melt_pools(hold),
        f"{profiles}-{label}-profiles": surface_flow_profiles(detail, times),
        f"{label}-below-the-surface": below_the_surface(label, detail),
        f"{label}-with-and-without-flow": melt_pools([detail, still], ["flow", "no flow"]),
    }
    for plateau in dict.fromkeys(reading for _, reading in runs):
        chosen = of_plateau(runs, plateau)
        drawings[f"{speed}-{label}-speed-{plateau}"] = surface_speeds(
            chosen, title=plateau, column="flow_below_speed_m_s"
        )
        if label == "steel":
            pair = [runs[f, plateau] for f in EXTREMA_AT if (f, plateau) in runs]
            drawings[f"fig7-steel-extrema-{plateau}"] = speed_extrema(pair, title=plateau)
    return tuple(
        style.save(figure, out_dir / f"{name}.png") for name, figure in drawings.items() if figure
    )


def of_plateau(runs: Runs, plateau: str) -> list[Run]:
    """Runs of one reading, in order of their fluence."""
    return [one for (_, reading), one in runs.items() if reading == plateau]


def below_the_surface(label: str, one: Run) -> Figure:
    """u below the place of the largest speed at INSTANT, beside finite volumes."""
    figure, (axes,) = style.new_figure(height=3.6)
    history = one.history
    x = float(np.interp(INSTANT * 1e-9, history["time_s"], history["flow_surface_speed_max_x_m"]))
    deepest = max([depth for depth, _ in FLOWS[label].profile], default=250.0)
    depths = np.linspace(0.0, deepest, 200)
    axes.plot(profile_below(one, x, 1e-9 * depths), depths, color=style.COLORS[0], label="SPH")
    if FLOWS[label].profile:
        depth, u = np.array(FLOWS[label].profile).T
        axes.plot(u, depth, "o", color=style.GRAY, label="finite volumes")
    axes.invert_yaxis()
    style.label(axes, "u [m/s]", "depth [nm]", title=f"x = {1e6 * x:.2f} µm, {INSTANT:g} ns")
    style.legend(axes)
    return figure
