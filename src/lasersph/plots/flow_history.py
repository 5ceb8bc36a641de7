"""Figures of a flow over time, from history.csv: speeds, extrema, surface pressure, soundness."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from lasersph.output import Run
from lasersph.plots import style
from lasersph.plots.flow_fields import is_box
from lasersph.plots.history import draw_pulse, incident_power, summary_of, time_axis

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MARGIN = 0.06
"""Time shown before and after the flow, over the time for which it lasted."""


def speed_history(run: Run) -> Figure | None:
    """Largest speeds over time (as Figs. 5 and 10 of [Demuth2020]); None where nothing flowed."""
    history = run.history
    if not flowed(run):
        return None
    lines = {
        "flow_surface_speed_max_m_s": "at the surface",
        "flow_below_speed_m_s": below_text(run),
        "flow_speed_max_m_s": "of any particle",
        "flow_return_speed_m_s": "return flow",
    }
    if not np.any(history["flow_surface_speed_max_m_s"] > 0.0):
        lines = {"flow_speed_max_m_s": "of any particle"}
    largest = max(float(np.max(history[name])) for name in lines)
    unit = style.speed_unit(largest)
    figure, (axes,) = style.new_figure(height=3.7)
    time, name = time_axis(history)
    draw_pulse(axes, history, time)
    for k, (column, text) in enumerate(lines.items()):
        values = where_above_zero(history[column]) * unit.factor
        axes.plot(time, values, style.LINES[k], color=style.COLORS[k], label=text)
    axes.set_ylim(bottom=0.0)
    show_flowing(axes, run)
    style.label(axes, name, f"largest speed [{unit.name}]")
    if len(lines) > 1:
        style.legend_above(figure, axes, columns=3)
    return figure


def extrema_history(run: Run) -> Figure | None:
    """Inner and outer extremum of the surface speed over time (as Fig. 7): speed and place."""
    history = run.history
    if "flow_outer_speed_m_s" not in history or not flowed(run):
        return None
    if not np.any(history["flow_outer_speed_m_s"] + history["flow_inner_speed_m_s"] > 0.0):
        return None
    figure, (above, below) = style.new_figure(2, height=4.9, share_x=True)
    time, name = time_axis(history)
    for k, which in enumerate(("outer", "inner")):
        speed = where_above_zero(history[f"flow_{which}_speed_m_s"])
        place = np.where(np.isnan(speed), np.nan, history[f"flow_{which}_x_m"])
        color, line = style.COLORS[k], style.LINES[k]
        if np.all(np.isnan(speed)):
            above.plot([], [], color=color, linestyle=line, label=f"{which} extremum: none")
            continue
        above.plot(time, speed, color=color, linestyle=line, label=f"{which} extremum")
        below.plot(time, place * 1e6, color=color, linestyle=line)
    style.label(above, "", "surface speed [m/s]")
    style.label(below, name, "distance from x = 0 [µm]")
    above.set_ylim(bottom=0.0)
    below.set_ylim(bottom=0.0)
    show_flowing(below, run)
    style.legend_above(figure, above, columns=2)
    return figure


def layer_history(run: Run) -> Figure | None:
    """Thickness of the layer that flows outward, and the mean gradient that drives it."""
    history = run.history
    if not np.any(history.get("flow_layer_thickness_m", np.zeros(1)) > 0.0):
        return None
    figure, (above, below) = style.new_figure(2, height=4.6, share_x=True)
    time, name = time_axis(history)
    thickness = where_above_zero(history["flow_layer_thickness_m"])
    unit = style.unit_for(float(np.nanmax(thickness)), style.LENGTHS)
    above.plot(time, thickness * unit.factor, color=style.COLORS[0])
    style.label(above, "", f"outward layer $\\delta_m$ [{unit.name}]")
    above.set_ylim(bottom=0.0)
    gradient = where_above_zero(history["flow_gradient_mean_K_m"]) * 1e-6
    below.plot(time, gradient, color=style.COLORS[1])
    style.label(below, name, "mean |dT/dx| [K/µm]")
    below.set_ylim(bottom=0.0)
    show_flowing(below, run)
    return figure


def surface_pressure_history(run: Run) -> Figure | None:
    """Largest and smallest pressure of the flat surface beside the recoil pressure."""
    history = run.history
    if not np.any(history.get("lid_pressure_max_Pa", np.zeros(1)) != 0.0):
        return None
    figure, (axes,) = style.new_figure(height=3.4)
    time, name = time_axis(history)
    lines = {
        "lid_pressure_max_Pa": "flat surface, largest",
        "lid_pressure_min_Pa": "flat surface, smallest",
        "lid_recoil_max_Pa": "0.54 $p_{sat}(T)$, largest",
    }
    largest = max(float(np.max(np.abs(history[column]))) for column in lines)
    unit = style.unit_for(largest, style.PRESSURES)
    for k, (column, text) in enumerate(lines.items()):
        values = np.where(history[column] == 0.0, np.nan, history[column])
        if not np.all(np.isnan(values)):
            axes.plot(time, values * unit.factor, style.LINES[k], color=style.COLORS[k], label=text)
    axes.axhline(0.0, color=style.GRAY, linewidth=0.8)
    style.label(axes, name, f"pressure [{unit.name}]")
    show_flowing(axes, run)
    style.legend_above(figure, axes, columns=3)
    return figure


def soundness_history(run: Run) -> Figure | None:
    """Kinetic energy, divergence and smallest distance over time."""
    history = run.history
    if not flowed(run):
        return None
    figure, all_axes = style.new_figure(3, height=5.6, share_x=True)
    time, name = time_axis(history)
    unit = summary_of(run).get("flow", {}).get("kinetic_energy_unit", "J/m")
    energy = where_above_zero(history["flow_kinetic_energy_J"])
    all_axes[0].plot(time, energy, color=style.COLORS[0])
    style.label(all_axes[0], "", f"kinetic energy [{unit}]")
    divergence = where_above_zero(history["flow_divergence_relative"])
    all_axes[1].semilogy(time, divergence, color=style.COLORS[1])
    style.label(all_axes[1], "", "relative divergence [1]")
    spacing = history["flow_spacing_min_m"]
    all_axes[2].plot(time, spacing / spacing[0], color=style.COLORS[2])
    style.label(all_axes[2], name, "distance / first [1]")
    all_axes[2].set_ylim(0.0, 1.1)
    show_flowing(all_axes[2], run)
    return figure


def flowed(run: Run) -> bool:
    """Whether anything moved."""
    return bool(np.any(run.history.get("flow_speed_max_m_s", np.zeros(1)) > 0.0))


def where_above_zero(values: np.ndarray) -> np.ndarray:
    """Values, NaN where there is nothing (0): lines break there."""
    return np.where(values > 0.0, values, np.nan)


def show_flowing(axes: Axes, run: Run) -> None:
    """Limit the time axis to the time at which something flowed, and with light to its start."""
    history = run.history
    time, _ = time_axis(history)
    moving = np.flatnonzero(history["flow_speed_max_m_s"] > 0.0)
    first, last = time[moving[0]], time[moving[-1]]
    if is_box(run) and not np.any(incident_power(history) > 0.0):
        first = time[0]
    margin = MARGIN * (last - first)
    axes.set_xlim(max(first - margin, time[0]), min(last + margin, time[-1]))


def below_text(run: Run) -> str:
    """How far below the surface the second speed is, as far as the summary tells."""
    depth = summary_of(run).get("flow", {}).get("below_depth_m")
    if depth is None:
        return "one spacing below it"
    unit = style.unit_for(depth, style.LENGTHS)
    return f"{depth * unit.factor:.3g} {unit.name} below it"
