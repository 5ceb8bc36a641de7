"""Figures of validations: panels of curves, exact ones in gray, runs in color."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.plots import style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MARKS = "os^vD"
Values = np.ndarray | Sequence[float]


@dataclass(frozen=True)
class Curve:
    """Points (x, y) with a name for the legend and matplotlib's options for how they look."""

    x: Values
    y: Values
    label: str = ""
    options: dict[str, Any] = field(default_factory=dict)


def exact(x: Values, y: Values, label: str = "exact", **options: Any) -> Curve:
    """A gray line: what a run should give."""
    return Curve(x, y, label, {"color": style.GRAY} | options)


def line(x: Values, y: Values, label: str = "", k: int = 0, **options: Any) -> Curve:
    """A line in the color of number k."""
    return Curve(x, y, label, {"color": style.COLORS[k % len(style.COLORS)]} | options)


def marks(x: Values, y: Values, label: str = "", k: int = 0, **options: Any) -> Curve:
    """Points with the mark and in the color of number k."""
    mark = {"marker": MARKS[k % len(MARKS)], "linestyle": "", "markersize": 3}
    return line(x, y, label, k, **(mark | options))


@dataclass(frozen=True)
class Panel:
    """One pair of axes.

    Attributes:
        x, y: their names, with units. curves: those drawn. title: above.
        scales: of x and y, "linear" or "log". low, high: ends of the y axis.
        level: a value of y that is marked by a line, and its name.
    """

    x: str
    y: str
    curves: Sequence[Curve]
    title: str = ""
    scales: tuple[str, str] = ("linear", "linear")
    low: float | None = None
    high: float | None = None
    level: tuple[float, str] | None = None


def draw(panels: Sequence[Panel], *, height: float = 3.4, rows: int = 1, legend: int = 0) -> Figure:
    """Panels side by side in so many rows.

    Args:
        height: of the figure, inches. legend: columns of one legend above all panels; 0 puts one
            into each panel whose curves have names.
    """
    # Panels row by row, each with its scales and curves.
    figure, all_axes = style.new_figure(rows, len(panels) // rows, height=height)
    for axes, panel in zip(all_axes, panels, strict=True):
        axes.set_xscale(panel.scales[0])
        axes.set_yscale(panel.scales[1])
        for curve in panel.curves:
            axes.plot(curve.x, curve.y, label=curve.label or "_", **curve.options)
        if panel.level is not None:
            style.level_line(axes, *panel.level)
        if panel.low is not None or panel.high is not None:
            axes.set_ylim(panel.low, panel.high)
        style.label(axes, panel.x, panel.y, title=panel.title)
        if not legend:
            style.legend(axes)
    # One legend for all panels, or one each.
    if legend:
        style.legend_above(figure, all_axes[0], columns=legend)
    return figure
