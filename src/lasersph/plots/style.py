"""One style for all figures: sizes, colors that color-blind readers tell apart, units on the axes.

Figures are `matplotlib.figure.Figure` objects without pyplot: no global state, no window, safe
in threads. Colors: Okabe and Ito (2008), https://jfly.uni-koeln.de/color/.
"""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from lasersph.input import format_quantity

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.image import AxesImage

COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#333333", "#B8A800")
LINES = ("-", "--", "-.", ":")
MARKERS = ("o", "x", "^", "+", "s", "1", "v", "D")
"""Of dots, as colors of eight kinds of them are not told apart."""
TEMPERATURE_COLORS = "inferno"
FRACTION_COLORS = "cividis"
SPEED_COLORS = "viridis"
GRAY = "0.45"
NO_BREAK = "\u00a0=\u00a0"
WIDTH = 7.4
DPI = 150


class Unit(NamedTuple):
    """A unit for an axis: value in SI times `factor` is the number shown."""

    factor: float
    name: str


TIMES = (Unit(1e12, "ps"), Unit(1e9, "ns"), Unit(1e6, "µs"), Unit(1e3, "ms"), Unit(1.0, "s"))
LENGTHS = (Unit(1e9, "nm"), Unit(1e6, "µm"), Unit(1e3, "mm"), Unit(1.0, "m"))
UNITS = {
    "s": TIMES,
    "m": LENGTHS,
    "m^2": (Unit(1e12, "µm$^2$"), Unit(1e6, "mm$^2$"), Unit(1.0, "m$^2$")),
    "m^3": (Unit(1e18, "µm$^3$"), Unit(1e9, "mm$^3$"), Unit(1.0, "m$^3$")),
    "m^3/s": (Unit(1e12, "µm$^3$/µs"), Unit(1e9, "mm$^3$/s"), Unit(1.0, "m$^3$/s")),
    "Pa": (Unit(1.0, "Pa"), Unit(1e-3, "kPa"), Unit(1e-6, "MPa"), Unit(1e-9, "GPa")),
    "J": tuple(Unit(10.0**n, f"{name}J") for n, name in ((12, "p"), (9, "n"), (6, "µ"), (3, "m"))),
    "J/m": tuple(
        Unit(10.0**n, f"{name}J/m") for n, name in ((9, "n"), (6, "µ"), (3, "m"), (0, ""))
    ),
    "K/m": (Unit(1e-6, "K/µm"),),
    "J/m^2": (Unit(1e-4, "J/cm$^2$"),),
    "W/m^2": (Unit(1e-4, "W/cm$^2$"),),
    "": (Unit(1.0, "1"),),
}
"""Units in which axes show quantities, the smallest first; others are shown as they are."""
SPEEDS = (Unit(1e6, "µm/s"), Unit(1e3, "mm/s"), Unit(1.0, "m/s"))


def unit_for(largest: float, units: Sequence[Unit]) -> Unit:
    """The unit in which a size shows as a number above 1 and, if possible, below 1000."""
    # The first unit in which the number is not yet in the thousands.
    for unit in units:
        if abs(largest) * unit.factor < 2000.0:
            return unit
    return units[-1]


def speed_unit(largest: float) -> Unit:
    """The largest unit in which a speed shows as at least 0.05."""
    fitting = [unit for unit in SPEEDS if abs(largest) * unit.factor >= 0.05]
    return fitting[-1] if fitting else SPEEDS[-1]


def fitting_unit(unit: str, largest: float) -> Unit:
    """The unit in which an axis shows a quantity given in SI up to its largest value."""
    if unit == "m/s":
        return speed_unit(largest)
    return unit_for(largest, UNITS.get(unit, (Unit(1.0, unit),)))


def time_text(time: float) -> str:
    """t = 57 ns."""
    return f"t = {format_quantity(time, 's', typographic=True)}"


def new_figure(
    rows: int = 1, columns: int = 1, *, height: float = 3.4, share_x: bool = False
) -> tuple[Figure, list[Axes]]:
    """An empty figure and its axes, row by row; `height` in inches."""
    from lasersph.plots.notebook_figure import NotebookFigure

    figure = NotebookFigure(figsize=(WIDTH, height), layout="constrained")
    grid = figure.subplots(rows, columns, sharex=share_x, squeeze=False)
    axes = list(grid.ravel())
    # Axes without a box, a faint grid behind the curves.
    for one in axes:
        one.tick_params(labelsize=9)
        for side in ("top", "right"):
            one.spines[side].set_visible(False)
        one.grid(True, color="0.9", linewidth=0.6)
        one.set_axisbelow(True)
    return figure, axes


def label(axes: Axes, x: str, y: str, *, title: str = "") -> None:
    """Name the axes, with units."""
    axes.set_xlabel(x, fontsize=10)
    axes.set_ylabel(y, fontsize=10)
    if title:
        axes.set_title(title, fontsize=10, loc="left")


def wrapped(text: str, characters: int) -> str:
    """A text in lines of so many characters; f_m = 0.5 stays together."""
    return textwrap.fill(text.replace(" = ", NO_BREAK), characters).replace(NO_BREAK, " = ")


def legend(axes: Axes) -> None:
    """A legend inside the axes, where there is something to name."""
    if axes.get_legend_handles_labels()[1]:
        axes.legend(fontsize=8.5, framealpha=0.85, edgecolor="none")


def legend_above(figure: Figure, axes: Axes, *, columns: int) -> None:
    """The legend of some axes above the whole figure, where it hides no curve."""
    handles, labels = axes.get_legend_handles_labels()
    if labels:
        figure.legend(
            handles, labels, loc="outside upper left", ncols=columns, fontsize=8.5, frameon=False
        )


def note(figure: Figure, text: str) -> None:
    """A line in gray below the whole figure, at its right."""
    figure.supxlabel(text, x=0.99, ha="right", fontsize=8.5, color=GRAY)


def level_line(axes: Axes, value: float, name: str) -> None:
    """A thin horizontal line at a known temperature, named at its right end."""
    axes.axhline(value, color=GRAY, linewidth=0.8, linestyle=(0, (4, 3)), zorder=1)
    axes.annotate(
        f"{name} ",  # the space keeps slanted letters off the edge of the figure
        (1.0, value),
        xycoords=("axes fraction", "data"),
        xytext=(4, 0),
        textcoords="offset points",
        va="center",
        fontsize=8.5,
        color=GRAY,
        annotation_clip=False,
    )


def paint(
    axes: Axes,
    values: np.ndarray,
    edges: Sequence[float],
    unit: Unit,
    *,
    across: str = "x",
    **options: Any,
) -> AxesImage:
    """Draw values (rows, columns) as a picture between its edges left, right, bottom, top [m].

    `across` is the letter of the level axis; `options` goes to matplotlib's `imshow`; axes are in
    `unit`.
    """
    left, right, bottom, top = (edge * unit.factor for edge in edges)
    axes.grid(False)
    label(axes, f"{across} [{unit.name}]", f"z [{unit.name}]")
    return axes.imshow(
        values,
        extent=(left, right, bottom, top),
        origin="lower",
        interpolation="nearest",
        **options,
    )


def color_bar(axes: Axes | Sequence[Axes], image: Any, name: str, aspect: float = 14.0) -> Any:
    """The color bar of a picture or of arrows beside its axes."""
    first = axes[0] if isinstance(axes, Sequence) else axes
    bar = first.figure.colorbar(image, ax=axes, pad=0.015, aspect=aspect)
    bar.set_label(name, fontsize=10)
    return bar


def color_scale(name: str, count: int) -> list[Any]:
    """Colors from a scale, dark to light without the palest end."""
    from matplotlib import colormaps

    return list(colormaps[name](np.linspace(0.0, 0.9, count)))


def save(figure: Figure, path: Path) -> Path:
    """Write a figure; the ending of the name says in which format."""
    figure.savefig(path, dpi=DPI)
    return path


def without_stairs(times: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A curve through the steps of a quantity that changes by whole cells.

    Each value that stands for a while is drawn once, in the middle of that while, as in Figs. 4
    and 9 of [Demuth2020]. The zeros before and after stay, and the last value reaches to the end.

    Args:
        times, values: (n,).

    Returns:
        Shorter arrays of the same kind; the largest value is kept.
    """
    if values.size == 0:
        return times, values

    # Runs of equal values: where each begins and ends.
    tolerance = 1e-9 * float(np.max(np.abs(values)))
    starts = np.flatnonzero(np.concatenate([[True], np.abs(np.diff(values)) > tolerance]))
    ends = np.concatenate([starts[1:] - 1, [values.size - 1]])
    # Each is drawn once, in its middle; zeros keep their first and last time, the last one its end.
    middle = 0.5 * (times[starts] + times[ends])
    height = values[starts]
    middle[height == 0.0] = times[starts][height == 0.0]
    keep_end = (height == 0.0) & (ends > starts)
    keep_end[-1] = ends[-1] > starts[-1]
    all_times = np.concatenate([middle, times[ends[keep_end]]])
    all_values = np.concatenate([height, height[keep_end]])
    order = np.argsort(all_times, kind="stable")
    return all_times[order], all_values[order]
