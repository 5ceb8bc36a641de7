"""Velocity along the center lines of a box, from the last snapshot in particles.vtkhdf."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from lasersph.observers.box_sections import Box, CenterLines, center_lines
from lasersph.output import Run
from lasersph.plots import style
from lasersph.plots.flow_fields import has_flow, is_box

if TYPE_CHECKING:
    from matplotlib.figure import Figure

POINTS = 201


def lines_of(run: Run, shares: np.ndarray, number: int = -1) -> CenterLines:
    """Velocity along both center lines of a box.

    Args:
        run: a run with flow in a box.
        shares: (m,) places between 0 and 1, of the height and of the width.
        number: of the snapshot; the last if not given.
    """
    start, step = run.snapshots[0], run.snapshots[number]
    box = Box.around(start["position"], start["width"])
    return center_lines(step["position"], step["velocity"], box, shares)


def center_line_figure(run: Run) -> Figure | None:
    """(a) u over z at half the width and (b) w over x at half the height, at the end.

    None where the run is no box or nothing moved.
    """
    if not has_flow(run) or not is_box(run):
        return None
    lines = lines_of(run, np.linspace(0.0, 1.0, POINTS))
    largest = float(max(np.max(np.abs(lines.u)), np.max(np.abs(lines.w))))
    if largest == 0.0:
        return None
    speed = style.speed_unit(largest)
    length = style.unit_for(max(np.ptp(lines.x), np.ptp(lines.z)), style.LENGTHS)
    figure, (left, right) = style.new_figure(1, 2, height=3.4)
    left.plot(lines.u * speed.factor, lines.z * length.factor, color=style.COLORS[0])
    right.plot(lines.x * length.factor, lines.w * speed.factor, color=style.COLORS[1])
    style.label(left, f"u [{speed.name}]", f"z [{length.name}]", title="(a) at half the width")
    style.label(right, f"x [{length.name}]", f"w [{speed.name}]", title="(b) at half the height")
    left.axvline(0.0, color=style.GRAY, linewidth=0.8)
    right.axhline(0.0, color=style.GRAY, linewidth=0.8)
    return figure
