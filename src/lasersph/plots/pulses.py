"""The pulses of a train over each other, each over the time since its own start."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from lasersph.observers import COLUMNS
from lasersph.output import Run, RunOrFolder, open_run
from lasersph.output.last_pulse import PulseOfRun, starts_after_pauses
from lasersph.plots import style
from lasersph.plots.curves import draw_corner_temperatures, material_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COUNTS = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)
"""Of pulses that are shown beside the last one."""
COMPARED = {
    "temperature_max_K": "largest temperature",
    "melt_depth_half_m": "melt depth, $f_m = 0.5$",
    "flow_surface_speed_max_m_s": "speed along the surface",
}
"""Columns that pulses are compared by, and their words."""


def pulses_of(run: Run) -> dict[int, PulseOfRun]:
    """The 1st, 2nd, 5th, 10th ... and last pulse by number; one where no pause was jumped over."""
    # A pulse lasts from its start to the next one; the last to the end of the run.
    edges = [0.0, *starts_after_pauses(run), np.inf]
    count = len(edges) - 1
    shown = [*(number for number in COUNTS if number < count), count]
    return {number: PulseOfRun(run, edges[number - 1], edges[number]) for number in shown}


def eventful_time(run: Run) -> float:
    """Time until the melt is solid, and a third more; without melt the whole time [s]."""
    time = run.history["time_s"]
    # Until the last melt, and a third of that beyond.
    wet = np.flatnonzero(run.history.get("melt_depth_any_m", np.zeros(time.size)) > 0.0)
    return float(min(1.33 * time[wet[-1]], time[-1])) if wet.size else float(time[-1])


def pulses_compared(run: RunOrFolder) -> Figure | None:
    """Temperature, depth and speed after several pulses; None unless a pause was left out."""
    run = open_run(run)
    pulses = pulses_of(run)
    columns = [name for name in COMPARED if np.any(run.history.get(name, 0.0))]
    if len(pulses) < 2 or not columns:
        return None
    figure, all_axes = style.new_figure(len(columns), height=2.2 * len(columns), share_x=True)
    longest = max(eventful_time(one) for one in pulses.values())
    unit = style.fitting_unit("s", longest)
    colors = style.color_scale("viridis", len(pulses))
    # One panel a column, one color a pulse.
    for axes, name in zip(all_axes, columns, strict=True):
        size = style.fitting_unit(COLUMNS[name].unit, float(np.max(run.history[name])))
        for (number, one), color in zip(pulses.items(), colors, strict=True):
            x, y = one.history["time_s"] * unit.factor, one.history[name] * size.factor
            axes.plot(x, y, lw=1.2, color=color, label=f"pulse {number}")
        style.label(axes, "", f"{COMPARED[name]} [{size.name}]")
        if name == "temperature_max_K":
            draw_corner_temperatures(axes, material_of(run))
        axes.yaxis.label.set_fontsize(9)
    all_axes[-1].set_xlabel(f"time since the start of each pulse [{unit.name}]", fontsize=10)
    all_axes[-1].set_xlim(0.0, longest * unit.factor)
    style.legend_above(figure, all_axes[0], columns=7)
    return figure
