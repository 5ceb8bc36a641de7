"""Measured values over bands of the calibrated model, and the posterior of the unknowns."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.input.key_units import suffix
from lasersph.input.shown_unit import ShownUnit
from lasersph.observers.observer_list import RESULTS
from lasersph.plots import style

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, SubFigure

BINS = 40
"""Of the histograms of the posterior."""
PANEL_WORDS = 36
"""Characters in a line beside a panel that is two inches high."""


def calibration_figure(
    content: dict[str, Any], points: np.ndarray, profiles: Sequence[np.ndarray] = ()
) -> Figure:
    """Above: a panel for each measured number, data with standard errors over the computed values
    and their errors, and for each measured profile. Below: the posterior of each unknown, and of
    each pair.

    Args:
        content: of calibration.json. points: unknowns and weights (n, p + 1) of posterior.csv.
        profiles: columns x, y, measured, computed (n, 4) [m] of each.
    """
    from lasersph.plots.notebook_figure import NotebookFigure

    # Numbers that belong to a profile are shown with it.
    components = {name for one in content["profiles"] for name in one["components"]}
    every = dict.fromkeys(one["number"] for one in content["data"])
    columns = [column for column in every if column not in components]
    unknowns = content["unknowns"]
    corner = 2.2 * len(unknowns) + 0.6
    figure = NotebookFigure(figsize=(style.WIDTH, 3.0 + corner), layout="constrained")
    # A row of panels above, the square of the posterior below.
    above, below = figure.subfigures(2, 1, height_ratios=(3.0, corner), squeeze=False)[:, 0]
    all_axes = above.subplots(1, len(columns) + len(profiles), squeeze=False)[0]
    for axes, profile in zip(all_axes[len(columns) :], profiles, strict=True):
        _draw_profile(axes, profile)
    for axes, column in zip(all_axes, columns, strict=False):
        data = [one for one in content["data"] if one["number"] == column]
        _draw_data(axes, data, content)
    style.legend(all_axes[0])
    _draw_corner(below, unknowns, points)
    return figure


def _draw_data(axes: Axes, data: list[dict[str, Any]], content: dict[str, Any]) -> None:
    """Measured and computed values of one number over the setting that changes, or in order."""
    # The setting that changes is the axis; where several do, the number of the measurement is.
    settings = [one["settings"] for one in data]
    varied = [key for key in settings[0] if len({one[key] for one in settings}) > 1]
    x = np.array(
        [one["settings"][varied[0]] if len(varied) == 1 else one["measurement"] for one in data]
    )
    order = np.argsort(x, kind="stable")
    x, setting = x[order], ShownUnit("")
    if len(varied) == 1:
        shown = content.get("shown_units", {}).get(varied[0])
        setting = ShownUnit(**shown) if shown else ShownUnit(content["units"].get(varied[0], ""))
        x = setting.numbers(x)

    # Measured and computed values, with the errors of emulator and numerics together.
    names = ("measured", "standard_error", "computed", "emulator_sd", "numerical_sd")
    value, error, mean, emulated, numerical = (
        np.array([one[name] for one in data])[order] for name in names
    )
    number = data[0]["number"]
    unit = style.fitting_unit(data[0]["unit"], float(np.max(np.abs(value))))
    f, band = unit.factor, np.hypot(emulated, numerical)
    legend = "model and its error"

    # A band over several settings, a mark beside a single one.
    if len(x) == 1:  # a mark beside the measured one
        axes.errorbar(x + 0.2, f * mean, f * band, fmt="s", color=style.COLORS[0], markersize=4,
                      capsize=3, label=legend)  # fmt: skip
        axes.set(xlim=(x[0] - 0.5, x[0] + 0.7), xticks=x)
    else:
        axes.fill_between(x, f * (mean - band), f * (mean + band), color=style.COLORS[0],
                          alpha=0.25, linewidth=0.0, label=legend)  # fmt: skip
        axes.plot(x, f * mean, color=style.COLORS[0], linewidth=1.2)
    axes.errorbar(x, f * value, f * error, fmt="o", color=style.COLORS[1], markersize=4,
                  capsize=3, label="measured")  # fmt: skip
    # Names in words where there are some, in lines that a panel holds.
    name = "measurement"
    if len(varied) == 1:
        words = varied[0].replace(".", " ").replace("_", " ")
        name = f"{words} [{setting.name or '1'}]"
    known = RESULTS.get(number)
    words = known.words if known else number.removesuffix(suffix(data[0]["unit"]))
    style.label(axes, name, style.wrapped(f"{words} [{unit.name}]", PANEL_WORDS))
    axes.yaxis.label.set_fontsize(8.5)


def _draw_profile(axes: Axes, profile: np.ndarray) -> None:
    """The measured and the most probable heights; of a map those nearest to y = 0, as near as its
    points lie side by side."""
    # Points of a map lie in a square of this side on average.
    side = np.sqrt(np.ptp(profile[:, 0]) * np.ptp(profile[:, 1]) / len(profile))
    away = np.abs(profile[:, 1])
    near = profile[away <= away.min() + 0.5 * side]
    x, _, measured, computed = near[np.argsort(near[:, 0], kind="stable")].T
    along = style.unit_for(float(np.max(np.abs(x))), style.LENGTHS)
    up = style.fitting_unit("m", float(np.max(np.abs(measured))))
    x = along.factor * x
    axes.plot(x, up.factor * measured, ".", ms=2.5, color=style.COLORS[1], label="measured")
    axes.plot(x, up.factor * computed, color=style.COLORS[0], linewidth=1.2, label="model")
    style.label(axes, f"x [{along.name}]", f"height [{up.name}]")


def _draw_corner(figure: SubFigure, unknowns: dict[str, Any], points: np.ndarray) -> None:
    """Histograms of the unknowns on the diagonal, of pairs below it."""
    names, weights = list(unknowns), points[:, -1]
    units = [unit_of_unknown(one) for one in unknowns.values()]
    grid = figure.subplots(len(names), len(names), squeeze=False)
    # Below the diagonal pairs, on it each unknown with its mean and 95 % interval.
    for row, below in enumerate(names):
        for column, across in enumerate(names):
            axes = grid[row, column]
            if column > row:
                axes.set_visible(False)
                continue
            x = units[column].numbers(points[:, column])
            if column == row:
                axes.hist(x, BINS, weights=weights, color=style.COLORS[0], alpha=0.6)
                for end, dash in (("low_95", ":"), ("high_95", ":"), ("mean", "-")):
                    place = units[column].number(unknowns[across][end])
                    axes.axvline(place, color=style.GRAY, linestyle=dash)
                axes.set_yticks([])
            else:
                y = units[row].numbers(points[:, row])
                axes.hist2d(x, y, BINS, weights=weights, cmap=style.FRACTION_COLORS)
            is_lowest = row == len(names) - 1
            style.label(axes, _named(across, unknowns) if is_lowest else "",
                        _named(below, unknowns) if column == 0 and row > 0 else "")  # fmt: skip


def _named(name: str, unknowns: dict[str, Any]) -> str:
    return f"{name} [{unit_of_unknown(unknowns[name]).name or '1'}]"


def unit_of_unknown(one: dict[str, Any]) -> ShownUnit:
    """The unit in which an unknown of calibration.json is shown; SI in older files."""
    return ShownUnit(**one["shown_unit"]) if "shown_unit" in one else ShownUnit(one.get("unit", ""))
