"""Process map: a number of many runs over one or two keys of their case, and where metal melts,
boils or is ablated."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from lasersph.input import format_quantity, in_field_units
from lasersph.input.shown_unit import ShownUnit
from lasersph.observers.observer_list import RESULTS
from lasersph.plots import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
LINE_STYLES = {
    "melts": (style.COLORS[5], "-"),
    "boils": (style.COLORS[1], "--"),
    "ablates": (style.COLORS[3], "-."),
}
"""Colors and dashes of the outlines that are clear on dark blue and on yellow."""
EVENTS = {"melts": "melting", "boils": "boiling", "ablates": "ablation"}
BAND = 0.35
"""Opacity of the area in which a line lies, over one key."""
BAND_HATCHES = {"melts": "////", "boils": "\\\\\\\\", "ablates": "||||"}
"""Of such an area over the colors of two keys: crossed where two of them lie over each other."""
TARGET_COLOR = "white"
LEVELS = 9
"""About as many steps of color as a reader can tell apart."""


@dataclass(frozen=True)
class MapAxis:
    """One key: its name, SI unit, places of the field (m,), whether it counts logarithmically, the
    unit in which the plan of the sweep gives its values."""

    key: str
    unit: str
    grid: Array
    is_logarithmic: bool
    shown: ShownUnit

    @property
    def words(self) -> str:
        """The key as an axis shows it: laser pulse fwhm."""
        return self.key.replace(".", " ").replace("_", " ")


@dataclass(frozen=True)
class Onset:
    """Where an event begins along the first key of a map.

    Attributes:
        event: "melts", "boils", "ablates". at: value of the second key, None where there is one.
        between: values of the first key between which it begins, SI; where all runs have the
            event, or none, those of the first and the last of them.
        known: "measured": interpolated, as surely as `between` says; "bracket": `between` are the
            last run without and the first with the event; "every", "none": runs that have it.
        estimate: where it begins most likely, SI; None where the runs do not tell.
    """

    event: str
    at: float | None
    between: tuple[float, float]
    known: Literal["measured", "bracket", "every", "none"]
    estimate: float | None = None

    def words(self, unit: str) -> str:
        """The onset in words, of a first key with this SI unit: between 0.4 and 0.7 J/cm²."""
        # Ends in the unit of the field, the lower one first.
        low, high = sorted(self.between)
        ends = in_field_units(low, unit), in_field_units(high, unit)
        if self.known in ("every", "none"):
            return (
                f"in {'every' if self.known == 'every' else 'no'} run from {ends[0]} to {ends[1]}"
            )
        # A measured onset has an error; a bracket only its ends.
        if self.known == "measured" and self.estimate is not None:
            error = max(high - self.estimate, self.estimate - low)
            return in_field_units(self.estimate, unit, error)
        text = f"between {ends[0]} and {ends[1]}"
        if self.estimate is None:
            return text
        near = in_field_units(float(f"{self.estimate:.2g}"), unit)  # no digits that no run tells
        return f"{text}; as colder runs extrapolate, near {near}"


@dataclass(frozen=True, eq=False)
class ProcessMap:
    """Data of a process map, in SI.

    Attributes:
        axes: one or two keys.
        column: key of the number. unit: its unit.
        points: keys of each run (runs, axes). values: the number, NaN without one (runs,).
        names, status, reasons: of each run; why it has no result, empty for others.
        field: the number over the first axis (m,), or over both (second, first); NaN where no run
            tells it. deviation: its standard deviation, of an emulator; None without one.
        allowed: deviations above this are hatched.
        lines: where a region ends ("melts", "boils", "ablates") or a wanted value is reached
            ("target"): lines (k, 2), or points (k, 1) over one axis.
        bands: areas in which each of these regions ends: rings (k, 2) around them and around their
            holes, or stretches (2, 1) of one axis.
        onsets: the same on each line of a grid of runs, or over one key.
        target: the wanted value.
        notes: sentences for the reader.
    """

    axes: tuple[MapAxis, ...]
    column: str
    unit: str
    points: Array
    values: Array
    names: tuple[str, ...]
    status: tuple[str, ...]
    field: Array
    lines: Mapping[str, tuple[Array, ...]]
    bands: Mapping[str, tuple[Array, ...]] = dataclasses.field(default_factory=dict)
    onsets: tuple[Onset, ...] = ()
    deviation: Array | None = None
    allowed: float = float("inf")
    target: float | None = None
    notes: tuple[str, ...] = ()
    reasons: tuple[str, ...] = ()

    @property
    def words(self) -> str:
        """The number in words, as tables of a run say it; its key where no table does."""
        known = RESULTS.get(self.column)
        return known.words if known else self.column

    @property
    def is_usable(self) -> NDArray[np.bool_]:
        """Which runs have the number (runs,)."""
        return np.isfinite(self.values)

    def line_words(self, name: str) -> str:
        """Words for a line in a legend."""
        if name == "target" and self.target is not None:
            return format_quantity(self.target, self.unit, typographic=True)
        return EVENTS[name]

    def onset_words(self) -> list[tuple[str, str]]:
        """Each event and where it begins, on each line of the grid: boiling, 10 ns: between ..."""
        other = self.axes[-1].unit
        return [
            (
                self.line_words(one.event),
                ("" if one.at is None else f"{in_field_units(one.at, other)}: ")
                + one.words(self.axes[0].unit),
            )
            for one in self.onsets
        ]


def draw_process_map(shown: ProcessMap, levels: tuple[float, ...] = ()) -> Figure:
    """The figure of a map: a line with its band over one key, contours over two.

    Args:
        levels: of the contours, in SI; default: round ones.
    """
    # The number itself: a line over one key, a plane over two.
    figure, (axes,) = style.new_figure(height=4.2)
    units = [style.fitting_unit(axis.unit, float(np.max(axis.grid))) for axis in shown.axes]
    value_unit = style.fitting_unit(shown.unit, float(np.nanmax(np.abs(shown.values))))
    (_draw_line if len(shown.axes) == 1 else _draw_plane)(axes, shown, units, value_unit, levels)

    # Runs without a result are crossed, below the curve where they have no height.
    bad = ~shown.is_usable
    if np.any(bad):
        places = [points * u.factor for points, u in zip(shown.points[bad].T, units, strict=True)]
        if len(places) == 1:  # below the curve, where no value is
            places.append(np.full(len(places[0]), 0.02))
        axes.plot(
            *places,
            "x",
            color=style.COLORS[1],
            markersize=8,
            markeredgewidth=2,
            label="no result",
            transform=axes.get_xaxis_transform() if len(shown.axes) == 1 else axes.transData,
            clip_on=False,
            zorder=5,
        )

    # Scales and names of the axes.
    for axis, set_scale in zip(shown.axes, (axes.set_xscale, axes.set_yscale), strict=False):
        if axis.is_logarithmic:
            set_scale("log")
    names = [f"{axis.words} [{u.name}]" for axis, u in zip(shown.axes, units, strict=True)]
    value_name = _value_words(shown, value_unit)
    style.label(axes, names[0], names[1] if len(names) == 2 else value_name)
    _plain_ticks(axes)
    style.legend_above(figure, axes, columns=5)
    return figure


def _value_words(shown: ProcessMap, unit: style.Unit) -> str:
    """The number with its unit, in lines that an axis holds."""
    return style.wrapped(f"{shown.words} [{unit.name}]", 40)


def _draw_line(
    axes: Axes, shown: ProcessMap, units: list[style.Unit], unit: style.Unit, levels: object
) -> None:

    # The curve with its band of two standard deviations, and the runs as dots.
    x, y = shown.axes[0].grid * units[0].factor, shown.field * unit.factor
    axes.plot(x, y, color=style.COLORS[0], linewidth=1.4)
    if shown.deviation is not None:
        band = 2.0 * shown.deviation * unit.factor
        axes.fill_between(
            x, y - band, y + band, color=style.COLORS[0], alpha=0.2, linewidth=0, label="95 %"
        )
    good = shown.is_usable
    at = shown.points[good, 0] * units[0].factor
    axes.plot(at, shown.values[good] * unit.factor, "o", color=style.COLORS[6], markersize=4)
    # Areas between runs in which an event begins, then lines where it is known.
    for name, stretches in shown.bands.items():
        for k, ends in enumerate(stretches):
            label = None if name in shown.lines or k else f"{shown.line_words(name)}, between runs"
            color = LINE_STYLES[name][0]
            axes.axvspan(
                *(ends[:, 0] * units[0].factor), color=color, alpha=BAND, lw=0, label=label
            )
    for name, lines in shown.lines.items():
        color, dash = LINE_STYLES.get(name, (style.COLORS[2], ":"))
        for k, place in enumerate(np.concatenate(lines)[:, 0] if lines else ()):
            text = shown.line_words(name) if k == 0 else None
            axes.axvline(place * units[0].factor, color=color, linestyle=dash, label=text)
    if shown.target is not None:
        axes.axhline(shown.target * unit.factor, color=style.COLORS[2], linewidth=0.8)


def _draw_plane(
    axes: Axes,
    shown: ProcessMap,
    units: list[style.Unit],
    unit: style.Unit,
    levels: tuple[float, ...],
) -> None:
    from matplotlib.patheffects import withStroke
    from matplotlib.ticker import MaxNLocator

    # The field as steps of color between round numbers.
    x, y = (axis.grid * u.factor for axis, u in zip(shown.axes, units, strict=True))
    field = np.ma.masked_invalid(shown.field * unit.factor)
    steps = [level * unit.factor for level in levels] or MaxNLocator(LEVELS).tick_values(
        float(field.min()), float(field.max())
    )
    axes.grid(False)
    beyond = "both" if levels else "neither"
    image = axes.contourf(x, y, field, levels=steps, cmap=style.SPEED_COLORS, extend=beyond)
    image.set_edgecolor("face")  # no pale seams between the colors in SVG
    style.color_bar(axes, image, _value_words(shown, unit), aspect=22.0)

    # Hatched where the emulator is less sure than is allowed.
    if shown.deviation is not None and np.any(shown.deviation > shown.allowed):
        doubtful = np.ma.masked_invalid(np.where(shown.deviation > shown.allowed, 1.0, 0.0))
        doubtful = np.ma.array(doubtful, mask=np.ma.getmaskarray(field))
        axes.contourf(x, y, doubtful, levels=[0.5, 1.5], colors="none", hatches=["//"])
        allowed = format_quantity(shown.allowed, shown.unit, 2, typographic=True)
        axes.fill_between([], [], facecolor="none", hatch="///", label=f"sd above {allowed}")

    # Areas and lines of events, with an edge that stands out from any color.
    _draw_bands(axes, shown, units)
    for name, lines in shown.lines.items():
        color, dash = LINE_STYLES.get(name, (TARGET_COLOR, ":"))
        for k, line in enumerate(lines):
            at = [column * u.factor for column, u in zip(line.T, units, strict=True)]
            text = shown.line_words(name) if k == 0 else None
            edge = [withStroke(linewidth=3.6, foreground="0.15")]
            axes.plot(*at, dash, color=color, linewidth=2.0, label=text, path_effects=edge)

    # Runs as dots, above all else.
    good = [points * u.factor for points, u in zip(shown.points.T, units, strict=True)]
    good = [points[shown.is_usable] for points in good]
    axes.plot(
        *good,
        "o",
        markerfacecolor="white",
        markeredgecolor="0.2",
        markersize=3.5,
        label="run",
        clip_on=False,
        zorder=5,
    )


def _draw_bands(axes: Axes, shown: ProcessMap, units: list[style.Unit]) -> None:
    """Areas in which an event begins, behind its line."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path as Outline

    for name, rings in shown.bands.items():
        factors = np.array([unit.factor for unit in units])
        # Rings of an area and of its holes make one outline, filled between them.
        outline = Outline.make_compound_path(*(Outline(ring * factors) for ring in rings))
        label = None if name in shown.lines else f"{shown.line_words(name)}, between runs"
        options = {"edgecolor": LINE_STYLES[name][0], "hatch": BAND_HATCHES[name], "linewidth": 0.8}
        axes.add_patch(PathPatch(outline, facecolor="none", label=label, **options))


def _plain_ticks(axes: Axes) -> None:
    """Logarithmic axes over a decade or two with numbers at 1, 2 and 5; even steps where fewer than
    three of these are seen."""
    from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullLocator

    for axis in (axes.xaxis, axes.yaxis):
        if axis.get_scale() == "log":
            few, low, high = LogLocator(subs=(1.0, 2.0, 5.0)), *axis.get_view_interval()
            # Few numbers, unless the axis spans less than a decade.
            seen = [low <= tick <= high for tick in few.tick_values(low, high)]
            axis.set_major_locator(few if sum(seen) > 2 else MaxNLocator(6, steps=(1, 2, 5, 10)))
            axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
            axis.set_minor_locator(NullLocator())
