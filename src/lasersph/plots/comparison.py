"""Figures of several runs side by side, as the papers draw them.

`surface_temperatures` and `melt_pools` are Figs. 3 and 4 (steel) and 8 and 9 (aluminum) of
[Demuth2020], `surface_speeds` Figs. 5 and 10, `speed_extrema` Fig. 7. Every figure has one curve a
run, dark to light in the order of the runs, which their fluences name unless `labels` do; `title`
says what they have in common.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.output import Run, RunOrFolder, open_run
from lasersph.output.last_pulse import last_pulse
from lasersph.plots import style
from lasersph.plots.curves import (
    any_above_zero,
    draw_corner_temperatures,
    draw_pulse,
    material_of,
    time_axis,
    where_above_zero,
)
from lasersph.plots.relief import has_lines, lines_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Labels = Sequence[str] | None


def surface_temperatures(
    runs: Sequence[RunOrFolder], labels: Labels = None, *, title: str = ""
) -> Figure:
    """Temperature at the interference maximum over time, pulse shaded."""
    runs = [open_run(one) for one in runs]
    figure, (axes,) = style.new_figure(height=4.2)
    draw_pulse(axes, runs[0].history, end_of(runs))
    # One curve a run, dark to light.
    for run, time, options in styled_runs(runs, labels):
        axes.plot(time, run.history["temperature_at_maximum_K"], **options)
    axes.set_xlim(0.0, max(float(np.max(line.get_xdata())) for line in axes.lines))
    draw_corner_temperatures(axes, material_of(runs[0]))
    return finish(figure, axes, runs, "surface temperature at the maximum [K]", title)


def melt_pools(
    runs: Sequence[RunOrFolder], labels: Labels = None, *, title: str = "", level: str = ""
) -> Figure:
    """(a) width and (b) depth of the melt pool over time.

    Args:
        runs, labels, title: see above.
        level: empty for completely fluid material (f_m = 1), "half" and "any" with an underscore
            behind for 0.5 and above 0.
    """
    runs = [open_run(one) for one in runs]
    figure, all_axes = style.new_figure(1, 2, height=3.9)
    # A panel each for width and depth, drawn without the stairs of whole cells.
    for axes, letter, size in zip(all_axes, "ab", ("width", "depth"), strict=True):
        column = f"melt_{size}_{level}m"
        largest = max(float(np.max(run.history[column])) for run in runs)
        unit = style.fitting_unit("m", largest)
        for run, time, options in styled_runs(runs, labels):
            if np.any(run.history[column] > 0.0):
                x, y = style.without_stairs(time, run.history[column] * unit.factor)
                axes.plot(x, y, **options)
        text = f"melt pool {size} [{unit.name}]"
        style.label(axes, time_axis(runs[0].history, end_of(runs))[1], text, title=f"({letter})")
        axes.set_ylim(bottom=0.0)
        show_while(axes, runs, f"melt_width_{level}m", 0.08)
    if title:
        figure.suptitle(title, fontsize=10)
    style.legend_above(figure, all_axes[0], columns=5)
    return figure


def surface_speeds(
    runs: Sequence[RunOrFolder],
    labels: Labels = None,
    *,
    title: str = "",
    column: str = "flow_surface_speed_max_m_s",
) -> Figure:
    """Largest speed along the surface over time, pulse shaded.

    Args:
        runs, labels, title: see above.
        column: `flow_below_speed_m_s` for the speed one spacing below, as the paper draws it.
    """
    runs = [open_run(one) for one in runs]
    figure, (axes,) = style.new_figure(height=4.2)
    draw_pulse(axes, runs[0].history, end_of(runs))
    for run, time, options in styled_runs(runs, labels):
        axes.plot(time, where_above_zero(run.history[column]), **options)
    show_while(axes, runs, "flow_speed_max_m_s", 0.06)
    axes.set_ylim(bottom=0.0)
    where = "one spacing below the surface" if "below" in column else "at the surface"
    return finish(figure, axes, runs, f"largest speed\n{where} [m/s]", title)


def reliefs(runs: Sequence[RunOrFolder], labels: Labels = None) -> Figure:
    """Above: the reliefs at the end of two runs. Below: the second less the first where both are,
    by linear interpolation at the places of the first."""
    runs = [open_run(one) for one in runs]
    figure, (above, below) = style.new_figure(2, height=5.2, share_x=True)

    # Above: both reliefs. Below: their difference, in a unit of its own.
    lines = [(x, height[-1]) for _, x, height in map(lines_of, runs)]
    along = style.fitting_unit("m", max(float(np.max(np.abs(x))) for x, _ in lines))
    up = style.fitting_unit("m", max(float(np.max(np.abs(z))) for _, z in lines))
    for (x, z), (_, _, options) in zip(lines, styled_runs(runs, labels), strict=True):
        above.plot(x * along.factor, z * up.factor, **options)
    (x, first), (other, second) = lines
    change = np.interp(x, other, second, left=np.nan, right=np.nan) - first
    fine = style.fitting_unit("m", float(np.nanmax(np.abs(change), initial=0.0)))
    below.plot(x * along.factor, change * fine.factor, color=style.GRAY)
    style.label(above, "", f"height [{up.name}]")
    style.label(below, f"{runs[0].across} [{along.name}]", f"difference [{fine.name}]")
    style.legend_above(figure, above, columns=2)
    return figure


def figures_of_two(runs: Sequence[Run], labels: Labels = None) -> dict[str, Figure]:
    """Figures of two runs by name: "relief" where both surfaces move, "temperature" and "melt"
    where both have them, of trains of pulses since the start of the last."""
    found = {}
    # Reliefs are those at the end; curves of trains count from the last pulse.
    if all(has_lines(run) for run in runs):
        found["relief"] = reliefs(runs, labels)
    runs = [last_pulse(run) for run in runs]
    if all("temperature_at_maximum_K" in run.history for run in runs):
        found["temperature"] = surface_temperatures(runs, labels)
    if all(any_above_zero(run, "melt_depth_half_m") for run in runs):
        found["melt"] = melt_pools(runs, labels, level="half_")
    return found


def speed_extrema(runs: Sequence[RunOrFolder], labels: Labels = None, *, title: str = "") -> Figure:
    """Inner (full lines) and outer extrema (dashed) of the surface speed."""
    runs = [open_run(one) for one in runs]
    figure, (axes,) = style.new_figure(height=4.2)
    # Full and dashed lines of one color belong to one run.
    for run, time, options in styled_runs(runs, labels):
        inner, outer = (
            where_above_zero(run.history[f"flow_{name}_speed_m_s"]) for name in ("inner", "outer")
        )
        axes.plot(time, outer, "--", color=options["color"], linewidth=1.1)
        axes.plot(time, inner, linewidth=1.8, **options)
    show_while(axes, runs, "flow_speed_max_m_s", 0.06)
    axes.set_ylim(bottom=0.0)
    for line, text in (("-", "inner extremum"), ("--", "outer extremum")):
        axes.plot([], [], line, color=style.GRAY, label=text)
    return finish(figure, axes, runs, "surface speed [m/s]", title)


def styled_runs(
    runs: Sequence[Run], labels: Labels
) -> Iterator[tuple[Run, np.ndarray, dict[str, Any]]]:
    """Each run with its times, and color and label of its curve."""
    names = fluence_labels(runs) if labels is None else labels
    end = end_of(runs)
    # Times in one unit, that of the longest run.
    for color, run, text in zip(style.color_scale("plasma", len(runs)), runs, names, strict=True):
        yield run, time_axis(run.history, end)[0], {"color": color, "label": text}


def end_of(runs: Sequence[Run]) -> float:
    """When the longest of some runs ended [s]: one unit of time suits all of their curves."""
    return max(float(run.history["time_s"][-1]) for run in runs)


def finish(figure: Figure, axes: Axes, runs: Sequence[Run], name: str, title: str) -> Figure:
    """Name the axes and put the legend above."""
    style.label(axes, time_axis(runs[0].history, end_of(runs))[1], name, title=title)
    style.legend_above(figure, axes, columns=5)
    return figure


def show_while(axes: Axes, runs: Sequence[Run], column: str, margin: float) -> None:
    """Limit the time axis to when a column of any of the runs was above zero."""
    end = end_of(runs)
    # Times at which the column is above zero in any run, and a margin around them.
    times = [time_axis(run.history, end)[0][run.history[column] > 0.0] for run in runs]
    seen = np.concatenate(times)
    if seen.size and np.ptp(seen) > 0.0:
        around = margin * float(np.ptp(seen))
        axes.set_xlim(max(float(np.min(seen)) - around, 0.0), float(np.max(seen)) + around)


def fluence_labels(runs: Sequence[Run]) -> list[str]:
    """Fluence of each run in J/cm2; the folder's name where its case gives none."""
    labels = []
    for run in runs:
        fluence = run.case.get("laser", {}).get("fluence")
        is_number = isinstance(fluence, int | float)
        labels.append(f"{fluence * 1e-4:.3g} J/cm$^2$" if is_number else run.path.name)
    return labels
