"""Figures of several runs together, as the papers draw them.

`surface_temperatures` and `melt_pools` are Figs. 3 and 4 (steel) and 8 and 9 (aluminium) of
[Demuth2020], `surface_speeds` Figs. 5 and 10, `speed_extrema` Fig. 7.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from lasersph.output import Run
from lasersph.plots import style
from lasersph.plots.flow_history import where_above_zero
from lasersph.plots.history import draw_corner_temperatures, draw_pulse, material_of, time_axis

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def surface_temperatures(
    runs: Sequence[Run], labels: Sequence[str] | None = None, *, title: str = ""
) -> Figure:
    """Temperature at the interference maximum over time, one curve a run, pulse shaded.

    Args:
        runs: runs of one material, in the order of their fluence.
        labels: one a run; if not given, their fluences.
        title: what the runs have in common.
    """
    figure, (axes,) = style.new_figure(height=4.2)
    names = fluence_labels(runs) if labels is None else list(labels)
    draw_pulse(axes, runs[0].history, time_axis(runs[0].history)[0])
    name = ""
    for color, run, text in zip(style.color_scale("plasma", len(runs)), runs, names, strict=True):
        time, name = time_axis(run.history)
        axes.plot(time, run.history["temperature_at_maximum_K"], color=color, label=text)
        axes.set_xlim(time[0], time[-1])
    draw_corner_temperatures(axes, material_of(runs[0]))
    style.label(axes, name, "surface temperature at the maximum [K]", title=title)
    style.legend_above(figure, axes, columns=5)
    return figure


def melt_pools(
    runs: Sequence[Run],
    labels: Sequence[str] | None = None,
    *,
    title: str = "",
    level: str = "",
) -> Figure:
    """(a) width and (b) depth of the melt pool over time, one curve a run.

    Args:
        runs, labels, title: as for `surface_temperatures`.
        level: "" for completely fluid material (f_m = 1), "half_" for 0.5, "any_" for above 0.
    """
    figure, all_axes = style.new_figure(1, 2, height=3.9)
    names = fluence_labels(runs) if labels is None else list(labels)
    first, last = np.inf, -np.inf
    for axes, letter, quantity in zip(all_axes, "ab", ("width", "depth"), strict=True):
        column = f"melt_{quantity}_{level}m"
        largest = max(float(np.max(run.history[column])) for run in runs)
        unit = style.unit_for(largest, style.LENGTHS)
        for color, run, text in zip(
            style.color_scale("plasma", len(runs)), runs, names, strict=True
        ):
            time, name = time_axis(run.history)
            values = run.history[column]
            if not np.any(values > 0.0):
                continue
            wet = time[values > 0.0]
            first, last = min(first, wet[0]), max(last, wet[-1])
            x, y = style.without_stairs(time, values * unit.factor)
            axes.plot(x, y, color=color, label=text)
            style.label(axes, name, f"melt pool {quantity} [{unit.name}]", title=f"({letter})")
        axes.set_ylim(bottom=0.0)
    if last > first:
        margin = 0.08 * (last - first)
        for axes in all_axes:
            axes.set_xlim(max(first - margin, 0.0), last + margin)
    if title:
        figure.suptitle(title, fontsize=10)
    style.legend_above(figure, all_axes[0], columns=5)
    return figure


def surface_speeds(
    runs: Sequence[Run],
    labels: Sequence[str] | None = None,
    *,
    title: str = "",
    column: str = "flow_surface_speed_max_m_s",
) -> Figure:
    """Largest speed along the surface over time, one curve a run, pulse shaded.

    Args:
        runs, labels, title: as for `surface_temperatures`.
        column: `flow_below_speed_m_s` for the speed one spacing below, as the paper draws it.
    """
    figure, (axes,) = style.new_figure(height=4.2)
    names = fluence_labels(runs) if labels is None else list(labels)
    draw_pulse(axes, runs[0].history, time_axis(runs[0].history)[0])
    for color, run, text in zip(style.color_scale("plasma", len(runs)), runs, names, strict=True):
        time, _ = time_axis(run.history)
        values = where_above_zero(run.history[column])
        axes.plot(time, values, color=color, label=text)
    show_all_flowing(axes, runs)
    axes.set_ylim(bottom=0.0)
    where = "one spacing below the surface" if "below" in column else "at the surface"
    name = time_axis(runs[0].history)[1]
    style.label(axes, name, f"largest speed\n{where} [m/s]", title=title)
    style.legend_above(figure, axes, columns=5)
    return figure


def speed_extrema(
    runs: Sequence[Run], labels: Sequence[str] | None = None, *, title: str = ""
) -> Figure:
    """Inner (full lines) and outer extrema (dashed) of the surface speed, one color a run.

    Args:
        runs, labels, title: as for `surface_temperatures`.
    """
    figure, (axes,) = style.new_figure(height=4.2)
    names = fluence_labels(runs) if labels is None else list(labels)
    for color, run, text in zip(style.color_scale("plasma", len(runs)), runs, names, strict=True):
        time, _ = time_axis(run.history)
        inner = where_above_zero(run.history["flow_inner_speed_m_s"])
        outer = where_above_zero(run.history["flow_outer_speed_m_s"])
        axes.plot(time, outer, "--", color=color, linewidth=1.1)
        axes.plot(time, inner, color=color, linewidth=1.8, label=text)
    show_all_flowing(axes, runs)
    axes.set_ylim(bottom=0.0)
    for line, text in (("-", "inner extremum"), ("--", "outer extremum")):
        axes.plot([], [], line, color=style.GRAY, label=text)
    style.label(axes, time_axis(runs[0].history)[1], "surface speed [m/s]", title=title)
    style.legend_above(figure, axes, columns=5)
    return figure


def show_all_flowing(axes: Axes, runs: Sequence[Run]) -> None:
    """Limit the time axis to when any of the runs flowed."""
    spans = []
    for run in runs:
        time, _ = time_axis(run.history)
        moving = np.flatnonzero(run.history["flow_speed_max_m_s"] > 0.0)
        if moving.size:
            spans.append((time[moving[0]], time[moving[-1]]))
    if spans:
        first, last = min(s[0] for s in spans), max(s[1] for s in spans)
        margin = 0.06 * (last - first)
        axes.set_xlim(max(first - margin, 0.0), last + margin)


def fluence_labels(runs: Sequence[Run]) -> list[str]:
    """Fluence of each run in J/cm2; the folder's name where its case gives none."""
    labels = []
    for run in runs:
        fluence = run.case.get("laser", {}).get("fluence")
        is_number = isinstance(fluence, int | float)
        labels.append(f"{fluence * 1e-4:.3g} J/cm$^2$" if is_number else run.path.name)
    return labels
