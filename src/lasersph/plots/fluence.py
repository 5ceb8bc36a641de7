"""Maps of the fluence of one pulse: some periods of the pattern, and the spot."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol

import numpy as np

from lasersph.plots import style

if TYPE_CHECKING:
    from matplotlib.figure import Figure


PAIR = 3.2
"""Height of two square maps side by side [inch]."""
SINGLE = 5.3
"""Height of one map [inch]."""
LINE = 0.18
"""Height of a line of the note above [inch]."""
BESIDE, NARROWEST = 1.6, 5.2
"""Width of a map's labels and color bar, and of a note [inch]."""


class Map(Protocol):
    """Fluence (y, x) [J/m^2] at centers of pixels x and y [m], and what it shows, in words."""

    @property
    def x(self) -> np.ndarray: ...
    @property
    def y(self) -> np.ndarray: ...
    @property
    def fluence(self) -> np.ndarray: ...
    @property
    def words(self) -> str: ...


def fluence_figure(maps: Sequence[Map], note: str) -> Figure:
    """One panel a map with its own scale; `note` says above them what the numbers are."""
    height = (PAIR if len(maps) > 1 else SINGLE) + LINE * (1 + note.count("\n"))
    figure, panels = style.new_figure(1, len(maps), height=height)
    # Pixels lie around their centers: the edges are half a pixel out.
    for axes, each in zip(panels, maps, strict=True):
        unit = style.unit_for(float(each.x[-1]), style.LENGTHS)
        half = 0.5 * (each.x[1] - each.x[0]), 0.5 * (each.y[1] - each.y[0])
        edges = each.x[0] - half[0], each.x[-1] + half[0], each.y[0] - half[1], each.y[-1] + half[1]
        picture = style.paint(
            axes, 1e-4 * each.fluence, edges, unit, cmap=style.TEMPERATURE_COLORS, vmin=0.0
        )
        highest = 1e-4 * float(each.fluence.max())
        title = f"{each.words}, at most {highest:.4g} J/cm$^2$"
        style.label(axes, f"x [{unit.name}]", f"y [{unit.name}]", title=title)
        style.color_bar(axes, picture, "fluence of a pulse [J/cm$^2$]")
    # A tall map leaves no white beside it.
    if len(maps) == 1:
        tall = np.ptp(maps[0].y) / np.ptp(maps[0].x)
        figure.set_figwidth(min(style.WIDTH, max(NARROWEST, SINGLE / tall + BESIDE)))
    figure.suptitle(note, fontsize=9.5)
    return figure
