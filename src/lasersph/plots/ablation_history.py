"""Figures of an ablation over time: crater and ejecta, and the traces of single particles.

The traces are drawn with the regions of Fig. 20 (temperature) and Fig. 23 (speed) of [Alshaer2017].
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.output import Run, RunOrFolder, open_run
from lasersph.plots import style
from lasersph.plots.curves import (
    are_same,
    draw_columns,
    draw_corner_temperatures,
    draw_pulse,
    material_of,
    summary_of,
    time_axis,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ROMAN = ("I", "II", "III", "IV")
AROUND = 0.6
"""Time shown after a particle left, over the time until then."""


def crater_history(run: RunOrFolder) -> Figure | None:
    """Depth of the crater and share of the mass ejected over time; None without ablation."""
    run = open_run(run)
    history = run.history
    if "crater_depth_m" not in history:
        return None

    # Above: depths of the crater, with the pulse.
    figure, (above, below) = style.new_figure(2, height=4.8, share_x=True)
    lines = {"crater_depth_m": "at the axis", "crater_depth_mean_m": "mean"}
    # the largest has a line of its own where it would not hide that of the axis
    if are_same(history["crater_depth_max_m"], history["crater_depth_m"]):
        lines["crater_depth_m"] = "at the axis, largest"
    else:
        lines["crater_depth_max_m"] = "largest"
    draw_pulse(above, history)
    if "crater_vaporized_volume_m" in history:  # 1-D: the volume over the area is a depth
        lines = {"crater_depth_m": "whole layers"}
        unit = style.fitting_unit("m", float(np.max(history["crater_depth_m"])))
        smooth = history["crater_vaporized_volume_m"] * unit.factor
        name, color = "with the layer on its way", style.COLORS[1]
        above.plot(time_axis(history)[0], smooth, label=name, color=color, linestyle="--")
    draw_columns(above, run, lines, label="depth of the crater")
    style.legend(above)

    # Below: shares of the absorbed energy.
    energy = {"removed": "carried away by ejecta", "stored": "in the body"}
    time, time_label = time_axis(history)
    absorbed = max(float(history["energy_absorbed_J"][-1]), 1e-300)
    for k, (term, text) in enumerate(energy.items()):
        values = 100.0 * history[f"energy_{term}_J"] / absorbed
        below.plot(time, values, style.LINES[k], color=style.COLORS[k], label=text)
    style.label(below, time_label, "energy [% of the absorbed]")
    style.legend(below)
    below.set_xlim(time[0], time[-1])
    return figure


def trace_figure(run: RunOrFolder) -> Figure | None:
    """Temperature and speed of the traced particles over time, with the published regions.

    None where no particle was traced.
    """
    run = open_run(run)
    history = run.history
    stages = (key for key in history if key.startswith("trace_") and key.endswith("_stage"))
    names = [key.removeprefix("trace_").removesuffix("_stage") for key in stages]
    if not names:
        return None
    figure, (above, below) = style.new_figure(2, height=5.2, share_x=True)
    # One color a particle in both panels; dashes show those that lie over each other.
    time, label = time_axis(history)
    for k, name in enumerate(names):
        options: dict[str, Any] = {
            "color": style.COLORS[k % len(style.COLORS)],
            "linestyle": style.LINES[k % 4],
        }
        above.plot(time, history[f"trace_{name}_temperature_K"], label=name, **options)
        below.plot(time, history[f"trace_{name}_speed_m_s"], label=name, **options)
    draw_corner_temperatures(above, material_of(run))
    style.label(above, "", "temperature [K]")
    style.label(below, label, "speed [m/s]")
    below.set_ylim(bottom=0.0)
    style.legend(above)
    end = mark_regions(run, names[0], above, below)
    below.set_xlim(time[0], min(end, time[-1]))
    return figure


def mark_regions(run: Run, name: str, above: Axes, below: Axes) -> float:
    """Lines and Roman numbers of the regions of one trace; returns where the axis should end."""
    # The regions need all three times: boiling, first motion, leaving.
    found: dict[str, Any] = summary_of(run).get("traces", {}).get(name, {})
    time, _ = time_axis(run.history)
    factor = time[-1] / float(run.history["time_s"][-1])
    left, boiled, moved = (found.get(key) for key in ("left_at_s", "boiled_at_s", "moved_at_s"))
    if left is None or boiled is None or moved is None:
        return float(time[-1])
    # The axis ends some time after the last traced particle left.
    end = max(left * (1.0 + AROUND), left + 0.02 * float(run.history["time_s"][-1]))
    others = summary_of(run)["traces"].values()
    end = max([end, *(1.1 * one["left_at_s"] for one in others if one["left_at_s"] is not None)])
    # Temperature has the edges of boiling and leaving, speed those of the jump and of leaving.
    for axes, edges in ((above, (0.0, boiled, left, end)), (below, (0.0, moved, moved, left, end))):
        for edge in edges[1:-1]:
            axes.axvline(edge * factor, color=style.GRAY, linewidth=0.7, linestyle=":")
        for number, first, last in zip(ROMAN, edges, edges[1:], strict=False):
            if last > first or number == "II":
                place, over = (0.5 * (first + last) * factor, 1.01), ("data", "axes fraction")
                options = {"fontsize": 8.5, "color": style.GRAY, "ha": "center", "va": "bottom"}
                axes.annotate(number, place, xycoords=over, **options)
    return end * factor
