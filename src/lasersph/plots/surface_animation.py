"""Frames of a surface over x and y: its height, or the speed of a flat one, and its temperature,
side by side."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from lasersph.output import Run
from lasersph.output.height_map import surface_map
from lasersph.plots import style
from lasersph.plots.relief import largest
from lasersph.plots.surface_maps import edges

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MAP_WIDTH, HIGHEST = 2.2, 4.0
"""Width of a map, and how high one may be [inches]. Format: two beside each other with color bars
fill a page."""
COLORS = {
    "height": "RdBu_r",
    "speed": style.SPEED_COLORS,
    "temperature": style.TEMPERATURE_COLORS,
}


def surface_frames(run: Run, times: np.ndarray) -> Iterator[Figure]:
    """One figure again and again, each time with the surface closest to another of `times` [s].

    Colors keep their meaning over all frames.
    """
    steps = [run.surface.nearest(float(time)) for time in times]
    first = surface_map(steps[0], run.surface.shape, run.mirrored)
    unit = style.fitting_unit("m", max(np.max(np.abs(first.x)), np.max(np.abs(first.y))))
    # Scales of all frames: heights around 0, speeds from 0 on, temperatures from the coldest to
    # the hottest.
    shown = "height" if run.surface_moves else "speed"
    most = max(largest(step[shown]) for step in steps)
    up = style.fitting_unit("m", most) if run.surface_moves else style.speed_unit(most)
    factors = {shown: up.factor, "temperature": 1.0}
    heat = [float(end(step["temperature"])) for step in steps for end in (np.min, np.max)]
    ends = {
        shown: (-most * up.factor * run.surface_moves, most * up.factor),
        "temperature": (min(heat), max(heat)),
    }
    names = {shown: f"{shown} [{up.name}]", "temperature": "temperature [K]"}
    # as high as two maps side by side are, so that the color bars are not higher
    left, right, lower, upper = edges(first)
    height = MAP_WIDTH * (upper - lower) / (right - left)
    figure, panels = style.new_figure(1, 2, height=round(min(height, HIGHEST) + 0.8, 1))
    images = []
    for axes, name in zip(panels, names, strict=True):
        low, high = ends[name]
        empty = np.zeros(first.z.shape)
        image = style.paint(axes, empty, edges(first), unit, cmap=COLORS[name], vmin=low, vmax=high)
        style.label(axes, f"x [{unit.name}]", f"y [{unit.name}]")
        style.color_bar(axes, image, names[name])
        images.append((name, image))

    # The same pictures with other values, and the time above them.
    for step in steps:
        for name, image in images:
            values = surface_map(step, run.surface.shape, run.mirrored, name).z
            image.set_data(values * factors[name])
        panels[0].set_title(style.time_text(step["time"]), fontsize=10, loc="left")
        yield figure
