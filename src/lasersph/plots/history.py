"""Figures over time, from history.csv: temperature, melt pool, energy, time step."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from lasersph.observers.energy_budget import IMBALANCE_ALLOWED, IMBALANCE_ALLOWED_WITH_FLOW
from lasersph.output import RunOrFolder, open_run
from lasersph.plots import style
from lasersph.plots.curves import (
    any_above_zero,
    are_same,
    draw_columns,
    draw_corner_temperatures,
    draw_pulse,
    limit_time,
    material_of,
    summary_of,
    time_axis,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LEVELS = {"": "$f_m = 1$", "_half": "$f_m = 0.5$", "_any": "$f_m > 0$"}


def temperature_history(run: RunOrFolder) -> Figure:
    """Temperature of the surface in the middle, the largest, and at probes; pulse shaded."""
    run = open_run(run)
    history = run.history
    figure, (axes,) = style.new_figure()

    # Probes that would hide the line of the surface share it.
    at_maximum, largest = history["temperature_at_maximum_K"], history["temperature_max_K"]
    # a probe that would hide the line of the surface shares it
    probes = {name: name.removeprefix("probe_").removesuffix("_K") for name in history}
    probes = {name: text for name, text in probes.items() if name.startswith("probe_")}
    shared = [name for name in probes if are_same(history[name], at_maximum)]
    surface = "surface" + f" at {run.across} = 0" * ("melt_width_m" in history)
    words = ", ".join([surface, *(f"probe {probes.pop(name)}" for name in shared)])
    lines = {"temperature_at_maximum_K": words}
    if not are_same(largest, at_maximum):
        lines["temperature_max_K"] = "largest anywhere"
    # The pulse, the surface, the probes, the temperatures of the metal.
    draw_pulse(axes, history)
    draw_columns(axes, run, lines, label="temperature")
    for k, (column, name) in enumerate(probes.items()):
        color, line = style.COLORS[(k + 2) % 8], style.LINES[k // 6 % 4]
        axes.plot(time_axis(history)[0], history[column], line, color=color, label=f"probe {name}")
    draw_corner_temperatures(axes, material_of(run))
    style.legend_above(figure, axes, columns=3)
    return figure


def melt_pool_history(run: RunOrFolder) -> Figure | None:
    """Width and depth of the melt pool at f_m = 1, 0.5 and above 0, and the molten volume.

    None where nothing melts.
    """
    run = open_run(run)
    if not any_above_zero(run, "melt_depth_any_m"):
        return None

    # A panel a size, and one for the volume where it is followed.
    sizes = [size for size in ("width", "depth") if f"melt_{size}_m" in run.history]
    has_volume = "melt_volume_m3" in run.history
    panels = len(sizes) + has_volume
    figure, all_axes = style.new_figure(panels, height=2.6 * panels, share_x=True)
    for axes, size in zip(all_axes, sizes, strict=False):
        lines = {f"melt_{size}{level}_m": text for level, text in LEVELS.items()}
        draw_columns(axes, run, lines, label=f"melt pool {size}", stairs=True)
        axes.set_ylim(bottom=0.0)
    if has_volume:
        draw_columns(all_axes[-1], run, "melt_volume_m3", label="molten volume")
        all_axes[-1].set_ylim(bottom=0.0)
    limit_time(all_axes[-1], run, run.history["melt_depth_any_m"] > 0.0, 0.1)
    style.legend_above(figure, all_axes[0], columns=3)
    return figure


def energy_history(run: RunOrFolder) -> Figure:
    """Where the absorbed energy is, and how well the balance closes."""
    run = open_run(run)
    history = run.history

    # Above: where the energy is. Small terms are left out.
    figure, (above, below) = style.new_figure(2, height=4.6, share_x=True)
    time, time_label = time_axis(history)
    largest = max(float(np.max(history[f"energy_{term}_J"])) for term in ("absorbed", "stored"))
    unit = style.fitting_unit(summary_of(run).get("energy", {}).get("unit", "J"), largest)
    for k, term in enumerate(("absorbed", "stored", "lost", "removed", "discarded")):
        values = history[f"energy_{term}_J"]
        if k < 2 or np.max(np.abs(values)) > 1e-6 * largest:
            values = values * unit.factor
            above.plot(time, values, style.LINES[k % 4], color=style.COLORS[k], label=term)
    style.label(above, "", f"energy [{unit.name}]")
    style.legend(above)

    # Below: the imbalance on a logarithmic scale, with what is allowed.
    shown = np.maximum(history["energy_imbalance_relative"], 1e-17)
    below.semilogy(time, shown, color=style.COLORS[6], linewidth=1.0)
    with_flow = "flow_speed_max_m_s" in history
    allowed = IMBALANCE_ALLOWED_WITH_FLOW if with_flow else IMBALANCE_ALLOWED
    text = f"allowed: {allowed:.0e}".replace("e-0", "e-")
    below.axhline(allowed, color=style.COLORS[1], linewidth=0.8, linestyle="--", label=text)
    top = max(10.0 * allowed, 3.0 * float(np.max(shown)))
    below.set_ylim(max(1e-17, 0.3 * float(np.min(shown))), top)
    style.label(below, time_label, "relative imbalance [1]")
    style.legend(below)
    below.set_xlim(time[0], time[-1])
    return figure


def time_step_history(run: RunOrFolder) -> Figure:
    """The time step, colored by what limited it, and the iterations of each step."""
    run = open_run(run)
    history = run.history
    counts = [column for column in history if column.startswith("iterations_")]
    figure, all_axes = style.new_figure(1 + bool(counts), height=4.6, share_x=True)

    # Above: the step, a color for each reason. The first row has no step.
    time, time_label = time_axis(history)
    step, limit = history["time_step_s"], history["limit"]
    taken = step > 0.0
    unit = style.fitting_unit("s", float(np.max(step)))
    for k, reason in enumerate(sorted(set(limit[taken].astype(str)))):
        of_reason, color = taken & (limit == reason), style.COLORS[k % 8]
        x, y = time[of_reason], step[of_reason] * unit.factor
        options = {"ls": "", "marker": style.MARKERS[k % 8], "ms": 3.0, "color": color}
        all_axes[0].plot(x, y, **options, label=reason or "unnamed")

    # A logarithmic scale where steps differ by more than a factor of 20.
    if np.max(step[taken]) > 20.0 * np.min(step[taken]):
        all_axes[0].set_yscale("log")
    else:
        all_axes[0].set_ylim(0.0, 1.1 * float(np.max(step)) * unit.factor)
    style.label(all_axes[0], "", f"time step [{unit.name}]")
    style.legend_above(figure, all_axes[0], columns=4)

    # Below: iterations of what the solver counts.
    for k, column in enumerate(counts):
        text = column.removeprefix("iterations_").replace("_", " ")
        x, y = time[taken], history[column][taken]
        all_axes[1].plot(x, y, color=style.COLORS[k], lw=0.9, label=text)
    if counts:
        style.label(all_axes[1], "", "iterations per step [1]")
        all_axes[1].set_ylim(bottom=0.0)
        style.legend(all_axes[1])
    all_axes[-1].set_xlabel(time_label, fontsize=10)
    all_axes[-1].set_xlim(time[0], time[-1])
    return figure
