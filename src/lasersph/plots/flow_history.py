"""Figures of a flow over time, from history.csv: speeds, extrema, surface pressure, quality; and
along the center lines of a box, from its last snapshot."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from lasersph.input import format_quantity
from lasersph.observers.box_sections import Box, CenterLines, center_lines
from lasersph.output import Run, RunOrFolder, open_run
from lasersph.plots import style
from lasersph.plots.curves import (
    any_above_zero,
    draw_columns,
    draw_pulse,
    incident_power,
    limit_time,
    summary_of,
    time_axis,
    where_above_zero,
)
from lasersph.plots.flow_fields import has_flow, is_box

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MARGIN = 0.06
"""Time shown before and after the flow, over the time for which it lasted."""
POINTS = 201


def speed_history(run: RunOrFolder) -> Figure | None:
    """Largest speeds over time (as Figs. 5 and 10 of [Demuth2020]); None where nothing flowed."""
    run = open_run(run)
    if not any_above_zero(run, "flow_speed_max_m_s"):
        return None
    # Particles always, the surface where it has speeds of its own.
    lines = {"flow_speed_max_m_s": "of any particle"}
    if any_above_zero(run, "flow_surface_speed_max_m_s"):
        depth = summary_of(run).get("flow", {}).get("below_depth_m")
        below = "one spacing" if depth is None else format_quantity(depth, "m", 3, typographic=True)
        lines = {
            "flow_surface_speed_max_m_s": "at the surface",
            "flow_below_speed_m_s": f"{below} below it",
            **lines,
            "flow_return_speed_m_s": "return flow",
        }
    figure, (axes,) = style.new_figure(height=3.7)
    draw_pulse(axes, run.history)
    draw_columns(axes, run, lines, label="largest speed", gaps=True)
    axes.set_ylim(bottom=0.0)
    show_flow(axes, run)
    if len(lines) > 1:
        style.legend_above(figure, axes, columns=3)
    return figure


def extrema_history(run: RunOrFolder) -> Figure | None:
    """Inner and outer extremum of the surface speed over time (as Fig. 7): speed and place."""
    run = open_run(run)
    names = ("outer", "inner")
    if not any(any_above_zero(run, f"flow_{name}_speed_m_s") for name in names):
        return None
    figure, (above, below) = style.new_figure(2, height=4.9, share_x=True)
    # Speed above, place below, over the same time.
    for axes, end, label in (
        (above, "speed_m_s", "surface speed"),
        (below, "x_m", f"distance from {run.across} = 0"),
    ):
        lines = {f"flow_{name}_{end}": f"{name} extremum" for name in names}
        draw_columns(axes, run, lines, label=label, gaps=True)
        axes.set_ylim(bottom=0.0)
    show_flow(below, run)
    style.legend_above(figure, above, columns=2)
    return figure


def layer_history(run: RunOrFolder) -> Figure | None:
    """Thickness of the layer that flows outward, and the mean gradient that drives it."""
    run = open_run(run)
    if not any_above_zero(run, "flow_layer_thickness_m"):
        return None
    figure, (above, below) = style.new_figure(2, height=4.6, share_x=True)
    layer, gradient = r"outward layer $\delta_m$", "mean |dT/dx|"
    draw_columns(above, run, "flow_layer_thickness_m", label=layer, gaps=True)
    draw_columns(below, run, "flow_gradient_mean_K_m", label=gradient, gaps=True)
    for axes in (above, below):
        axes.set_ylim(bottom=0.0)
    show_flow(below, run)
    return figure


def surface_pressure_history(run: RunOrFolder) -> Figure | None:
    """Largest and smallest pressure at the surface beside the recoil pressure."""
    run = open_run(run)
    lines = {
        "lid_pressure_max_Pa": "of the liquid, largest",
        "lid_pressure_min_Pa": "of the liquid, smallest",
        "lid_recoil_max_Pa": "recoil of the vapor, largest",
    }
    if not np.any(run.history.get("lid_pressure_max_Pa", 0.0)):
        return None
    figure, (axes,) = style.new_figure(height=3.4)
    draw_columns(axes, run, lines, label="pressure", gaps=True)
    axes.axhline(0.0, color=style.GRAY, linewidth=0.8)
    show_flow(axes, run)
    style.legend_above(figure, axes, columns=3)
    return figure


def quality_history(run: RunOrFolder) -> Figure | None:
    """Kinetic energy, divergence and smallest distance over time."""
    run = open_run(run)
    if not any_above_zero(run, "flow_speed_max_m_s"):
        return None
    history = run.history
    figure, all_axes = style.new_figure(3, height=5.6, share_x=True)

    # Energy and divergence are logarithms or gaps at zero, distances relative to the first.
    time, time_label = time_axis(history)
    energy = where_above_zero(history["flow_kinetic_energy_J"])
    divergence = where_above_zero(history["flow_divergence_relative"])
    spacing = history["flow_spacing_min_m"]
    unit = style.fitting_unit("J/m", float(np.nanmax(energy)))
    all_axes[0].plot(time, energy * unit.factor, color=style.COLORS[0])
    all_axes[1].semilogy(time, divergence, color=style.COLORS[1])
    all_axes[2].plot(time, spacing / spacing[0], color=style.COLORS[2])
    style.label(all_axes[0], "", f"kinetic energy [{unit.name}]")
    style.label(all_axes[1], "", "relative divergence [1]")
    style.label(all_axes[2], time_label, "distance / first [1]")
    all_axes[2].set_ylim(0.0, 1.1)
    show_flow(all_axes[2], run)
    return figure


def nusselt_history(run: RunOrFolder) -> Figure | None:
    """Nusselt numbers of the sides and of the whole box over time; None where there are none."""
    run = open_run(run)
    # A side without heat has no Nusselt number.
    names = [name for name in run.history if name.startswith("box_nusselt_")]
    words = {"surface": "surface", "bottom": "bottom", "mean": "domain-averaged"}
    keys = {name: name.removeprefix("box_nusselt_") for name in names}
    lines = {
        name: words.get(keys[name], f"{keys[name]} side")
        for name in names
        if np.any(run.history[name])
    }
    if not lines:
        return None
    figure, (axes,) = style.new_figure(height=3.2)
    draw_columns(axes, run, lines, label="Nusselt number")
    axes.set_ylim(bottom=0.0)
    style.legend(axes)
    return figure


def show_flow(axes: Axes, run: Run) -> None:
    """Limit the time axis to the time at which something flowed, and with light to its start."""
    # A flow without light begins with the run.
    moves = run.history["flow_speed_max_m_s"] > 0.0
    if is_box(run) and not np.any(incident_power(run.history) > 0.0):
        moves[0] = True
    limit_time(axes, run, moves, MARGIN)


def lines_of(run: Run, shares: np.ndarray, number: int = -1) -> CenterLines:
    """Velocity along both center lines of a box.

    Args:
        run: a run with flow in a box.
        shares: (m,) places between 0 and 1, of the height and of the width.
        number: of the snapshot; the last if not given.
    """
    start, step = run.snapshots[0], run.snapshots[number]
    box = Box.around(start["position"], start["width"], mirror_of(run))
    return center_lines(step["position"], step["velocity"], box, shares)


def mirror_of(run: Run) -> str:
    """Front or back of a block where that alone of the two is a plane of symmetry."""
    flow = run.case.get("solver", {}).get("flow") or {}
    sides = flow.get("sides") or {}
    kinds = {side: (flow.get(side) or sides).get("kind") for side in ("front", "back")}
    planes = [side for side, kind in kinds.items() if kind == "symmetry"]
    return planes[0] if len(planes) == 1 else ""


def center_line_figure(run: RunOrFolder) -> Figure | None:
    """(a) u over z at half the width and (b) w over x at half the height, at the end.

    None where the run is no box or nothing moved.
    """
    run = open_run(run)
    if not has_flow(run) or not is_box(run):
        return None
    # Both lines from one snapshot, each velocity in the same unit.
    lines = lines_of(run, np.linspace(0.0, 1.0, POINTS))
    largest = float(max(np.max(np.abs(lines.u)), np.max(np.abs(lines.w))))
    if largest == 0.0:
        return None
    speed = style.speed_unit(largest)
    length = style.unit_for(max(np.ptp(lines.x), np.ptp(lines.z)), style.LENGTHS)
    figure, (left, right) = style.new_figure(1, 2, height=3.4)
    left.plot(lines.u * speed.factor, lines.z * length.factor, color=style.COLORS[0])
    right.plot(lines.x * length.factor, lines.w * speed.factor, color=style.COLORS[1])
    style.label(left, f"u [{speed.name}]", f"z [{length.name}]", title="(a) at half the width")
    style.label(right, f"x [{length.name}]", f"w [{speed.name}]", title="(b) at half the height")
    left.axvline(0.0, color=style.GRAY, linewidth=0.8)
    right.axhline(0.0, color=style.GRAY, linewidth=0.8)
    return figure
