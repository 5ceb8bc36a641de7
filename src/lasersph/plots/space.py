"""Figures in space, from particles.vtkhdf: surface profiles, particle map, arrangement."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.output import Run
from lasersph.plots import style
from lasersph.plots.history import draw_corner_temperatures, material_of, summary_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PROFILES = 7
LARGEST_STRETCH = 4.0
MAP_WIDTH = 5.6

Snapshot = dict[str, Any]


def surface_profiles(run: Run, times: Sequence[float] | None = None) -> Figure | None:
    """Temperature along the surface at several times; None in 1-D or without snapshots.

    Args:
        run: the run.
        times: seconds; if not given, times around the hottest one.
    """
    if not len(run.snapshots) or run.snapshots.dimension == 1:
        return None
    wanted = interesting_times(run) if times is None else list(times)
    figure, (axes,) = style.new_figure(height=3.6)
    steps = {s["time"]: s for s in (run.snapshots.nearest(time) for time in wanted)}
    unit = style.unit_for(max(steps), style.TIMES)
    colors = color_scale("viridis", len(steps))
    reach, length = 0.0, style.LENGTHS[1]
    for color, (time, step) in zip(colors, sorted(steps.items()), strict=True):
        x, temperature = profile(step, symmetry_of(run))
        length = style.unit_for(float(np.max(np.abs(x))), style.LENGTHS)
        text = f"{time * unit.factor:.4g} {unit.name}"
        axes.plot(x * length.factor, temperature, color=color, label=text)
        reach = max(reach, float(np.max(np.abs(x))) * length.factor)
    axes.set_xlim(-reach if symmetry_of(run) == 2 else None, reach)
    draw_corner_temperatures(axes, material_of(run))
    style.label(axes, f"x [{length.name}]", "surface temperature [K]")
    style.legend(axes, columns=2)
    return figure


def particle_map(run: Run, time: float | None = None) -> Figure | None:
    """Temperature and melt fraction of the particles near the surface at one time.

    In 1-D both are drawn against depth; in 3-D the cells of the cut y = 0 are shown.

    Args:
        run: the run.
        time: seconds; if not given, when the melt is deepest, else when the metal is hottest.
    """
    if not len(run.snapshots):
        return None
    step = run.snapshots.nearest(telling_time(run) if time is None else time)
    depth = shown_depth(run, step)
    if run.snapshots.dimension == 1:
        return depth_profile(step, depth, material_of(run))
    x, z, width, height, chosen = cells_of_cut(step, depth)
    values = {
        "temperature [K]": (step["temperature"][chosen], style.TEMPERATURE_COLORS, None),
        "melt fraction [1]": (step["melt_fraction"][chosen], style.FRACTION_COLORS, (0.0, 1.0)),
    }
    if symmetry_of(run) == 2:
        x, z = np.concatenate([-x, x]), np.concatenate([z, z])
        width, height = np.tile(width, 2), np.tile(height, 2)
    shape = float(np.max(x + 0.5 * width) - np.min(x - 0.5 * width)) / depth
    stretch = max(1.0, shape / LARGEST_STRETCH)
    stretch = 1.0 if stretch < 1.25 else stretch
    figure, all_axes = style.new_figure(2, height=2.0 * MAP_WIDTH * stretch / shape + 1.7)
    time_unit = style.unit_for(step["time"], style.TIMES)
    for axes, (name, (field, colors, limits)) in zip(all_axes, values.items(), strict=True):
        field = np.tile(field, x.size // field.size)
        unit = draw_cells(axes, (x, z), (width, height), field, name, colors, limits)
        axes.set_ylim(-depth * unit.factor, 0.02 * depth * unit.factor)
        axes.set_aspect(stretch)
        style.label(axes, f"x [{unit.name}]", f"z [{unit.name}]")
    note = f"; the depth is drawn {stretch:.3g} times larger" if stretch > 1.0 else ""
    text = f"t = {step['time'] * time_unit.factor:.4g} {time_unit.name}{note}"
    all_axes[0].set_title(text, fontsize=10, loc="left")
    return figure


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
    reach = float(max(right - left, -bottom))
    edge = min(110.0 * float(np.min(width[1])), 0.4 * reach) if detail is None else detail
    frames = ((left, min(left + reach, right), bottom, 0.0), (left, left + edge, -edge, 0.0))
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


def profile(step: Snapshot, symmetry: int) -> tuple[np.ndarray, np.ndarray]:
    """Temperature of the surface cells in order of x; mirrored where half a period is computed.

    In 3-D the row of cells closest to y = 0.
    """
    cells = np.flatnonzero(step["surface"])
    if step["position"].shape[0] == 3:
        cells = cells[in_cut(step, cells)]
    cells = cells[np.argsort(step["position"][0, cells], kind="stable")]
    x, temperature = step["position"][0, cells], step["temperature"][cells]
    if symmetry == 2:
        return np.concatenate([-x[::-1], x]), np.concatenate([temperature[::-1], temperature])
    return x, temperature


def in_cut(step: Snapshot, cells: np.ndarray) -> np.ndarray:
    """Which of some cells of a 3-D snapshot the plane y = 0 (nearest row) passes through."""
    y, width = step["position"][1, cells], step["width"][1, cells]
    return np.abs(y - y[np.argmin(np.abs(y))]) < 0.5 * width


def cells_of_cut(step: Snapshot, depth: float) -> tuple[np.ndarray, ...]:
    """x, z, width, height and indices of the cells down to a depth; in 3-D of the cut y = 0."""
    z, height = step["position"][-1], step["width"][-1]
    chosen = np.flatnonzero(z + 0.5 * height > -depth)
    if step["position"].shape[0] == 3:
        chosen = chosen[in_cut(step, chosen)]
    x, width = step["position"][0, chosen], step["width"][0, chosen]
    return x, z[chosen], width, height[chosen], chosen


def draw_cells(
    axes: Axes,
    center: tuple[np.ndarray, np.ndarray],
    size: tuple[np.ndarray, np.ndarray],
    field: np.ndarray,
    name: str,
    colors: str,
    limits: tuple[float, float] | None,
) -> style.Unit:
    """Draw cells as colored rectangles with a color bar; returns the unit of length."""
    from matplotlib.collections import PolyCollection

    x, z = center
    unit = style.unit_for(float(np.max(np.abs(x) + size[0])), style.LENGTHS)
    half = 0.5 * np.array(size) * unit.factor
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=float)
    middle = np.stack([x, z], axis=1) * unit.factor
    polygons = middle[:, None, :] + corners[None] * half.T[:, None, :]
    cells = PolyCollection(
        list(polygons), array=field, cmap=colors, edgecolors="face", linewidths=0.2, rasterized=True
    )
    if limits is not None:
        cells.set_clim(*limits)
    axes.add_collection(cells)
    axes.grid(False)
    edge = (np.abs(x) + 0.5 * size[0]) * unit.factor
    axes.set_xlim(-float(np.max(edge)) if np.any(x < 0.0) else 0.0, float(np.max(edge)))
    bar = axes.figure.colorbar(cells, ax=axes, pad=0.015, aspect=14)
    bar.set_label(name, fontsize=10)
    return unit


def depth_profile(step: Snapshot, depth: float, corners: dict[str, Any]) -> Figure:
    """Temperature and melt fraction against depth of a 1-D run."""
    below = -step["position"][-1]
    order = np.argsort(below)
    order = order[below[order] < depth]
    unit = style.unit_for(depth, style.LENGTHS)
    time_unit = style.unit_for(step["time"], style.TIMES)
    figure, (above, under) = style.new_figure(2, height=4.6, share_x=True)
    text = f"t = {step['time'] * time_unit.factor:.4g} {time_unit.name}"
    for axes, name, color, label in (
        (above, "temperature", style.COLORS[1], "temperature [K]"),
        (under, "melt_fraction", style.COLORS[0], "melt fraction [1]"),
    ):
        axes.plot(below[order] * unit.factor, step[name][order], ".-", ms=3, lw=1.0, color=color)
        style.label(axes, "", label)
    above.set_title(text, fontsize=10, loc="left")
    draw_corner_temperatures(above, corners)
    under.set_ylim(-0.05, 1.05)
    under.set_xlabel(f"depth [{unit.name}]", fontsize=10)
    under.set_xlim(0.0, depth * unit.factor)
    return figure


def shown_depth(run: Run, step: Snapshot) -> float:
    """Depth that a map shows: the melt and half as much again, else where it is warm [m]."""
    z, height = step["position"][-1], step["width"][-1]
    bottom = float(np.max(0.5 * height - z))
    melt = summary_of(run).get("melt", {}).get("depth_any_max_m") or 0.0
    if melt == 0.0:
        rise = step["temperature"] - float(np.min(step["temperature"]))
        warm = rise > 0.05 * float(np.max(rise))
        melt = float(np.max(-z[warm])) if np.any(warm) else 0.5 * bottom
    return min(max(1.6 * melt, 8.0 * float(np.min(height))), bottom)


def telling_time(run: Run) -> float:
    """When the melt is deepest, else when the metal is hottest [s]."""
    history = run.history
    depth = history.get("melt_depth_any_m", np.zeros(0))
    if np.any(depth > 0.0):
        deepest = np.flatnonzero(depth == np.max(depth))
        return float(history["time_s"][deepest[deepest.size // 2]])
    return float(history["time_s"][np.argmax(history["temperature_max_K"])])


def interesting_times(run: Run) -> list[float]:
    """Times of snapshots from the first heating to the cooling, as many as a figure shows."""
    history = run.history
    peak = history["temperature_at_maximum_K"]
    rise = peak - peak[0]
    warm = history["time_s"][rise > 0.15 * np.max(rise)] if np.any(rise > 0) else history["time_s"]
    times = run.snapshots.times
    times = times[(times >= warm[0]) & (times <= warm[-1])]
    if times.size == 0:
        times = run.snapshots.times
    chosen = np.unique(np.round(np.linspace(0.0, 1.0, PROFILES) ** 1.7 * (times.size - 1)))
    return [float(times[int(k)]) for k in chosen]


def symmetry_of(run: Run) -> int:
    """2 where half a period was computed, else 1."""
    return int(summary_of(run).get("surface", {}).get("symmetry_factor", 1))


def color_scale(name: str, count: int) -> list[Any]:
    """Colors from a scale, dark to light without the palest end."""
    from matplotlib import colormaps

    return list(colormaps[name](np.linspace(0.0, 0.9, count)))
