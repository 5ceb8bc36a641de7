"""Where the particles lie, as in Fig. 2 of [Demuth2020]."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from lasersph.plots import style
from lasersph.plots.particle_map import Snapshot

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def arrangement(
    step: Snapshot, *, dummies: np.ndarray | None = None, detail: float | None = None
) -> Figure | None:
    """Where the particles lie: the whole body and a detail at the surface (2-D; as Fig. 2).

    Args:
        step: a snapshot with position (2, n) and width (2, n) [m].
        dummies: positions (2, m) of dummy particles, drawn lighter.
        detail: edge of the detail [m]; if not given, 110 of the smallest cells.
    """
    position, width = step["position"], step["width"]
    if position.shape[0] != 2:
        return None
    bottom = float(np.min(position[1] - 0.5 * width[1]))
    left, right = float(np.min(position[0])), float(np.max(position[0]))
    extent = float(max(right - left, -bottom))
    edge = min(110.0 * float(np.min(width[1])), 0.4 * extent) if detail is None else detail
    frames = ((left, min(left + extent, right), bottom, 0.0), (left, left + edge, -edge, 0.0))
    figure, all_axes = style.new_figure(1, 2, height=3.9)
    for axes, frame in zip(all_axes, frames, strict=True):
        unit = style.unit_for(max(frame[1] - frame[0], -frame[2]), style.LENGTHS)
        margin = 0.06 * (frame[3] - frame[2])
        for points, color in ((dummies, "0.75"), (position, style.COLORS[0])):
            if points is None:
                continue
            near = inside(points, frame, margin)
            size = dot_size(width, inside(position, frame, margin), frame, points is position, near)
            axes.scatter(
                *(points[:, near] * unit.factor), s=size, c=color, linewidths=0, rasterized=True
            )
        low, high = (frame[0] - margin) * unit.factor, (frame[1] + margin) * unit.factor
        axes.set_xlim(low, high)
        axes.set_ylim((frame[2] - margin) * unit.factor, (frame[3] + margin) * unit.factor)
        axes.set_aspect("equal")
        style.label(axes, f"x [{unit.name}]", f"z [{unit.name}]")
    all_axes[0].set_title("(a) the whole body", fontsize=10, loc="left")
    all_axes[1].set_title("(b) at the surface", fontsize=10, loc="left")
    return figure


def inside(points: np.ndarray, frame: tuple[float, ...], margin: float) -> np.ndarray:
    """Which points (2, n) lie in a frame (left, right, bottom, top)."""
    x, z = points
    across = (x >= frame[0] - margin) & (x <= frame[1] + margin)
    return across & (z >= frame[2] - margin) & (z <= frame[3] + margin)


def dot_size(
    width: np.ndarray, near: np.ndarray, frame: tuple[float, ...], own: bool, shown: np.ndarray
) -> np.ndarray | float:
    """Area of the dots in points squared: cells of the frame drawn to scale, at least visible."""
    points_per_meter = 200.0 / max(frame[1] - frame[0], frame[3] - frame[2])
    sizes = np.maximum(0.75 * width[1] * points_per_meter, 0.35) ** 2
    if own:
        return sizes[shown]
    return float(np.min(sizes[near])) if np.any(near) else 1.0
