"""Curves over time from history.csv in units that fit, pulse and corner temperatures."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.input.key_units import amount_dimension, unit_in
from lasersph.observers import COLUMNS
from lasersph.output import Run
from lasersph.plots import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CORNERS = {"solidus_K": "$T_s$", "liquidus_K": "$T_l$", "vaporization_K": "$T_v$"}


def draw_columns(
    axes: Axes,
    run: Run,
    names: str | Mapping[str, str],
    *,
    label: str = "",
    gaps: bool = False,
    stairs: bool = False,
) -> None:
    """Columns of the history over time; the axis says what they are, in a unit that fits them all.

    Args:
        axes: gets one curve a column. run: whose history is drawn.
        names: a column, or the legend of each of several.
        label: name of the axis; if not given, the words of the first column.
        gaps: curves break where a value is 0, since there is nothing then.
        stairs: values change by whole cells and are drawn through the middles of their steps.
    """
    texts = {names: None} if isinstance(names, str) else names

    # One unit for all columns, by the largest of their values.
    first = COLUMNS[next(iter(texts))]
    time, time_label = time_axis(run.history)
    largest = max(float(np.max(np.abs(run.history[column]))) for column in texts)
    dimension = amount_dimension(summary_of(run))
    unit = style.fitting_unit(unit_in(first.unit, dimension), largest)
    # Gaps where nothing is, and middles in place of stairs.
    for k, (column, text) in enumerate(texts.items()):
        x, y = time, run.history[column] * unit.factor
        if gaps:
            y = np.where(y == 0.0, np.nan, y)
            if np.all(np.isnan(y)):
                continue
        if stairs:
            x, y = style.without_stairs(x, y)
        axes.plot(x, y, style.LINES[k % 4], color=style.COLORS[k % 8], label=text)
    # The time is named below the lowest panel only.
    place = axes.get_subplotspec()
    is_lowest = place is None or place.is_last_row()
    words = label or first.words
    style.label(axes, time_label if is_lowest else "", f"{words} [{unit.name}]")
    axes.set_xlim(time[0], time[-1])


def time_axis(history: dict[str, np.ndarray], end: float | None = None) -> tuple[np.ndarray, str]:
    """Times in a unit that suits them, and the name of the axis.

    Args:
        end: of the axis [s], which it shares with other runs; the last time if not given.
    """
    unit = style.fitting_unit("s", float(history["time_s"][-1]) if end is None else end)
    return history["time_s"] * unit.factor, f"time [{unit.name}]"


def limit_time(axes: Axes, run: Run, holds: np.ndarray, margin: float) -> None:
    """Limit the time axis to when something held (rows,), and a margin of that time around it."""
    time, _ = time_axis(run.history)
    # Rows at which it held, from the first to the last.
    rows = np.flatnonzero(holds)
    around = margin * (time[rows[-1]] - time[rows[0]]) + 1e-9 * time[-1]
    axes.set_xlim(max(time[rows[0]] - around, time[0]), min(time[rows[-1]] + around, time[-1]))


def any_above_zero(run: Run, column: str) -> bool:
    """Whether a run has a column with anything in it."""
    return column in run.history and bool(np.any(run.history[column] > 0.0))


def are_same(first: np.ndarray, second: np.ndarray) -> bool:
    """Whether two curves would hide each other: apart by less than a hundredth of their height on
    average, which is as wide as a line."""
    return bool(np.mean(np.abs(first - second)) <= 0.01 * np.max(first))


def where_above_zero(values: np.ndarray) -> np.ndarray:
    """Values, NaN where there is nothing (0): lines break there."""
    return np.where(values > 0.0, values, np.nan)


def incident_power(history: dict[str, np.ndarray]) -> np.ndarray:
    """Power of the incident light relative to its largest value, (rows,); zeros without light."""
    energy, time = history["energy_incident_J"], history["time_s"]
    if energy.size < 3 or energy[-1] <= 0.0:
        return np.zeros(energy.size)
    # Power: the difference of the energy over that of the time, moved to the middle of each step.
    rate = np.concatenate([[0.0], np.diff(energy) / np.maximum(np.diff(time), 1e-300)])
    centered = np.interp(time, 0.5 * (time + np.concatenate([time[:1], time[:-1]])), rate)
    return np.maximum(centered, 0.0) / max(float(np.max(centered)), 1e-300)


def draw_pulse(axes: Axes, history: dict[str, np.ndarray], end: float | None = None) -> None:
    """The shape of the pulse as a shade at the foot of the axes; `end` as of `time_axis`."""
    power = incident_power(history)
    if np.any(power > 0.0):
        options: dict[str, Any] = {"color": "#E69F00", "alpha": 0.35, "linewidth": 0.0, "zorder": 0}
        foot, time = axes.get_xaxis_transform(), time_axis(history, end)[0]
        name = "power of the light (no scale)"
        axes.fill_between(time, 0.0, 0.25 * power, transform=foot, label=name, **options)


def draw_corner_temperatures(axes: Axes, corners: Mapping[str, Any]) -> None:
    """Lines at the melting range and the vaporization temperature, where these are in view."""
    top = axes.get_ylim()[1]
    solidus, liquidus = corners.get("solidus_K"), corners.get("liquidus_K")
    # Solidus and liquidus share a line where they are one temperature, and a name where they are
    # near.
    for key, text in CORNERS.items():
        value = corners.get(key)
        if value is None or value > top:
            continue
        if key == "solidus_K" and liquidus is not None:
            text = "$T_m$" if liquidus == value else "$T_s$, $T_l$"
        elif key == "liquidus_K" and solidus is not None:
            if liquidus != solidus:
                axes.axhline(value, color=style.GRAY, lw=0.8, ls=(0, (4, 3)), zorder=1)
            continue
        style.level_line(axes, float(value), text)


def summary_of(run: Run) -> dict[str, Any]:
    """The summary of a run; empty while it is not complete."""
    return run.summary if run.is_complete else {}


def material_of(run: Run) -> dict[str, Any]:
    """Corner temperatures of the material, where the summary gives them."""
    return summary_of(run).get("material", {})
