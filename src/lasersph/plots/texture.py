"""The texture of a spot: its height as a map, and the line through its center with the melt."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.input import format_quantity
from lasersph.output.image_file import Maps
from lasersph.plots import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def texture_figure(maps: Maps, content: dict[str, Any]) -> Figure:
    """Above: maps of the height and of the depth of the melt. Below: both along x through the
    center, and the areal parameters.

    Args:
        content: of texture.json.
    """
    from lasersph.plots.notebook_figure import NotebookFigure

    figure = NotebookFigure(figsize=(style.WIDTH, 7.8), layout="constrained")

    # as high as two square maps side by side are, with their color bars
    parts: Any = figure.subfigures(2, 1, height_ratios=(4.6, 3.2))
    above, below = parts
    left, right = above.subplots(1, 2, sharey=True)
    _draw_map(left, maps, "height", "height", "RdBu_r", is_signed=True)
    _draw_map(right, maps, "melt_depth", "depth of the melt", style.FRACTION_COLORS)
    right.set_ylabel("")
    first, second = below.subplots(2, 1, sharex=True)

    # The line through the center, with the error of the interpolation as a band.
    row = int(np.argmin(np.abs(maps.y)))
    unit = style.unit_for(float(np.max(np.abs(maps.x))), style.LENGTHS)
    for axes, name, words, color in (
        (first, "height", "height", style.COLORS[0]),
        (second, "melt_depth", "molten to", style.COLORS[1]),
    ):
        line = maps.fields[name][row]
        up = style.fitting_unit("m", float(np.max(np.abs(line))) or 1e-9)
        sign = 1.0 if name == "height" else -1.0
        axes.plot(maps.x * unit.factor, sign * line * up.factor, color=color, linewidth=0.9)
        error = content["interpolation_error"][name]["largest"] * up.factor
        low, high = sign * line * up.factor - error, sign * line * up.factor + error
        if name == "melt_depth":  # no melt above the surface, nor where cells tell of none
            low, high = np.where(line > 0.0, low, 0.0), np.minimum(high, 0.0)
        places = maps.x * unit.factor
        axes.fill_between(places, low, high, color=color, alpha=0.2, linewidth=0.0)
        axes.set_xlim(maps.x[0] * unit.factor, maps.x[-1] * unit.factor)
        axes.grid(True, color="0.9", linewidth=0.6)
        is_last = name == "melt_depth"
        style.label(axes, f"x [{unit.name}]" if is_last else "", f"{words} [{up.name}]")

    # Areal parameters above the line of heights.
    found = content["areal_parameters"]
    sizes = ", ".join(f"{n} {format_quantity(found[n], 'm', 3)}" for n in ("Sa", "Sq", "Sz"))
    first.set_title(
        f"ISO 25178: {sizes}, Ssk {found['Ssk']:.2g}, Sdr {100.0 * found['Sdr']:.2g} %\n"
        "band: error of the interpolation",
        fontsize=9,
        loc="left",
    )
    return figure


def _draw_map(
    axes: Axes, maps: Maps, name: str, words: str, colors: str, *, is_signed: bool = False
) -> None:
    """One map in its unit, x and y to one scale."""
    values = maps.fields[name]
    length = style.unit_for(float(np.max(np.abs(maps.x))), style.LENGTHS)
    largest = float(np.max(np.abs(values))) or 1e-9
    up = style.fitting_unit("m", largest)
    limit = largest * up.factor
    edges = (maps.x[0], maps.x[-1], maps.y[0], maps.y[-1])
    options = {"cmap": colors, "vmin": -limit if is_signed else 0.0, "vmax": limit}
    image = style.paint(axes, values * up.factor, edges, length, aspect="equal", **options)
    style.label(axes, f"x [{length.name}]", f"y [{length.name}]")
    above = axes.inset_axes((0.0, 1.03, 1.0, 0.05))  # as wide as the map
    bar = axes.figure.colorbar(image, cax=above, orientation="horizontal", location="top")
    bar.set_label(f"{words} [{up.name}]", fontsize=10)
