"""Figs. 3-11 of [Demuth2020] from runs with flow, as the paper arranges them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.output import Run
from lasersph.plots import melt_pools, style, surface_temperatures
from lasersph.plots.comparison import fluence_labels
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
    """All figures of one metal, of the runs with plateau `hold` but for the speeds."""
    temperature, pool, speed, profiles = NUMBERS[label]
    hold = [one for (_, plateau), one in runs.items() if plateau == "hold"]
    detail = runs[FLOWS[label].fluence, "hold"]
    drawings: dict[str, Figure] = {
        f"{temperature}-{label}-temperature": surface_temperatures(hold),
        f"{pool}-{label}-melt-pool": melt_pools(hold),
        f"{speed}-{label}-speed": speeds(runs),
        f"{profiles}-{label}-profiles": surface_profiles(detail),
        f"{label}-below-the-surface": below_the_surface(label, detail),
        f"{label}-with-and-without-flow": melt_pools([detail, still], ["flow", "no flow"]),
    }
    if label == "steel":
        drawings["fig7-steel-extrema"] = extrema(runs)
    return tuple(style.save(figure, out_dir / f"{name}.png") for name, figure in drawings.items())


def speeds(runs: Runs) -> Figure:
    """Largest |u| of the uppermost particles over time, a panel for each plateau reading."""
    plateaus = list(dict.fromkeys(plateau for _, plateau in runs))
    figure, panels = style.new_figure(1, len(plateaus), height=3.8)
    for axes, plateau in zip(panels, plateaus, strict=True):
        chosen = [one for (_, reading), one in runs.items() if reading == plateau]
        colors = style.color_scale("plasma", len(chosen))
        for color, one, text in zip(colors, chosen, fluence_labels(chosen), strict=True):
            time, u = 1e9 * one.history["time_s"], one.history["flow_row_speed_max_m_s"]
            wet = np.flatnonzero(u > 0.0)
            if wet.size:
                part = slice(max(wet[0] - 1, 0), wet[-1] + 2)
                axes.plot(time[part], u[part], color=color, label=text)
        style.label(axes, "time [ns]", "largest |u| below the surface [m/s]", title=plateau)
    style.legend_above(figure, panels[0], columns=5)
    return figure


def surface_profiles(one: Run) -> Figure:
    """(a) temperature, (b) its gradient, (c) velocity along the surface at several times."""
    figure, panels = style.new_figure(3, 1, height=7.4, share_x=True)
    times = [t for t in PROFILE_TIMES if t * 1e-9 <= one.snapshots.times[-1] * (1.0 + 1e-9)]
    names = (("surface_temperature", 1.0, "T [K]"), ("surface_gradient", 1e-6, "dT/dx [K/µm]"),
             ("surface_velocity", 1.0, "u at the surface [m/s]"))  # fmt: skip
    for color, at in zip(style.color_scale("viridis", len(times)), times, strict=True):
        step = one.snapshots.nearest(1e-9 * at)
        for axes, (name, factor, _) in zip(panels, names, strict=True):
            x, values = along_surface(step, name)
            axes.plot(1e6 * x, factor * values, color=color, label=f"{at:g} ns")
    for axes, letter, (_, _, text) in zip(panels, "abc", names, strict=True):
        style.label(axes, "x [µm]" if letter == "c" else "", text, title=f"({letter})")
    style.legend_above(figure, panels[0], columns=6)
    return figure


def along_surface(step: dict[str, Any], name: str) -> tuple[np.ndarray, np.ndarray]:
    """x [m] and a field of the surface particles of a snapshot in order of x."""
    cells = np.flatnonzero(step["surface"])
    cells = cells[np.argsort(step["position"][0, cells], kind="stable")]
    return step["position"][0, cells], step[name][cells]


def extrema(runs: Runs) -> Figure:
    """Speeds of the outer and inner extremum over time at two fluences, both plateau readings."""
    fluences = [f for f in EXTREMA_AT if (f, "hold") in runs]
    figure, panels = style.new_figure(1, len(fluences), height=3.6)
    for axes, letter, fluence in zip(panels, "ab", fluences, strict=False):
        plateaus = [plateau for f, plateau in runs if f == fluence]
        for line, plateau in zip(style.LINES, plateaus, strict=False):
            history = runs[fluence, plateau].history
            for color, name in zip(style.COLORS, ("outer", "inner"), strict=False):
                u = history[f"flow_{name}_speed_m_s"]
                u = np.where(u > 0.0, u, np.nan)
                axes.plot(1e9 * history["time_s"], u, line, color=color,
                          label=f"{name}, {plateau}")  # fmt: skip
        style.label(axes, "time [ns]", "speed of the extremum [m/s]",
                    title=f"({letter}) {fluence} J/cm$^2$")  # fmt: skip
        style.legend(axes)
    return figure


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
