"""Where the particles lie, and temperature and melt fraction near the surface, from snapshots."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.output import Run, RunOrFolder, open_run
from lasersph.plots import style
from lasersph.plots.curves import draw_corner_temperatures, material_of, summary_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LARGEST_ASPECT = 4.0
MAP_WIDTH = 5.6
FIELDS = (
    ("temperature", "temperature [K]", style.TEMPERATURE_COLORS),
    ("melt_fraction", "melt fraction [1]", style.FRACTION_COLORS),
)
"""Fields that are drawn: name, words and colors; of a run without phase change the first alone."""
PIXELS = (320, 1280)
OUTSIDE = 0.8
"""A pixel farther than this part of a cell's width from its center lies in no cell."""

Snapshot = dict[str, Any]


@dataclass(frozen=True)
class Cells:
    """Cells of a plane section: x and z of their centers and their widths, (2, m) [m] each.

    `number` says which particle each cell is, (m,). `walls` are the edges of a closed box that the
    cells fill, as of `frame`: no point inside it lies outside all cells, however they moved.
    """

    center: np.ndarray
    size: np.ndarray
    number: np.ndarray
    walls: tuple[float, float, float, float] | None = None

    def mirrored(self) -> Cells:
        """The cells and their mirror images about x = 0."""
        image = self.center * np.array([[-1.0], [1.0]])
        walls = None if self.walls is None else (-self.walls[1], *self.walls[1:])
        return Cells(
            np.concatenate([image, self.center], axis=1),
            np.tile(self.size, 2),
            np.tile(self.number, 2),
            walls,
        )

    @property
    def frame(self) -> tuple[float, float, float, float]:
        """Left, right, bottom and top edge [m]."""
        if self.walls is not None:
            return self.walls
        # Edges of the outermost cells.
        low = np.min(self.center - 0.5 * self.size, axis=1)
        high = np.max(self.center + 0.5 * self.size, axis=1)
        return float(low[0]), float(high[0]), float(low[1]), float(high[1])

    def picture(
        self,
        frame: tuple[float, float, float, float] | None = None,
        pixels: tuple[int, int] = PIXELS,
    ) -> np.ndarray:
        """Number of the particle that each pixel of a frame shows: that of the closest cell.

        Args:
            frame: left, right, bottom and top edge [m]; that of the cells if not given.
            pixels: rows and columns.

        Returns:
            Array of `pixels` rows and columns, -1 outside all cells.
        """
        from scipy.spatial import KDTree

        # Centers of the pixels.
        left, right, bottom, top = self.frame if frame is None else frame
        rows, columns = pixels
        across = left + (np.arange(columns) + 0.5) * (right - left) / columns
        up = bottom + (np.arange(rows) + 0.5) * (top - bottom) / rows
        points = np.array([grid.ravel() for grid in np.meshgrid(across, up)])
        # Distances in widths of a cell, so that the closest cell is the one that covers the pixel.
        square = np.array([[np.median(self.size[1] / self.size[0])], [1.0]])
        _, cell = KDTree((self.center * square).T).query((points * square).T)
        cell = np.asarray(cell).reshape(pixels)
        is_covered = self.covers(points, cell.ravel()).reshape(pixels)
        if self.walls is None:
            is_covered &= ~self._above_top(up, cell, is_covered)
        return np.where(is_covered, self.number[cell], -1)

    def _above_top(self, up: np.ndarray, cell: np.ndarray, is_covered: np.ndarray) -> np.ndarray:
        """Which pixels lie above the upper face of the highest cell of their column.

        Args:
            up: heights of the rows of pixels [m]. cell: closest to each pixel, (rows, columns).
            is_covered: which pixels lie within their cells.
        """
        rows, columns = cell.shape
        highest = rows - 1 - np.argmax(is_covered[::-1], axis=0)
        top = cell[highest, np.arange(columns)]
        face = self.center[1, top] + 0.5 * self.size[1, top]
        return (cell == top) & (up[:, None] > face)

    def covers(self, points: np.ndarray, cell: np.ndarray) -> np.ndarray:
        """Whether points (2, k) lie within the cells (k,) that are closest to them, (k,)."""
        # In a closed box every point belongs to some cell.
        if self.walls is not None:
            left, right, bottom, top = self.walls
            x, z = points
            return (x > left) & (x < right) & (z > bottom) & (z < top)
        far = np.abs(points - self.center[:, cell]) > OUTSIDE * self.size[:, cell]
        return np.logical_not(far.any(axis=0))


def particle_map(run: RunOrFolder, time: float | None = None) -> Figure | None:
    """Temperature and melt fraction of the particles near the surface at one time.

    In 1-D both are drawn against depth; in 3-D the cells of the cut y = 0 are shown. Half a period
    is mirrored.

    Args:
        run: the run.
        time: seconds; if not given, when the melt is deepest, else when the metal is hottest.

    Returns:
        The figure; None where the run has no snapshots.
    """
    run = open_run(run)
    if not len(run.snapshots):
        return None
    step = run.snapshots.nearest(deepest_melt_time(run) if time is None else time)
    depth = shown_depth(run, step)
    if run.snapshots.dimension == 1:
        return depth_profile(step, depth, material_of(run))

    # Without phase change there is no melt to show.
    fields = FIELDS if material_of(run).get("solidus_K", 0.0) is not None else FIELDS[:1]
    cells = cells_of_cut(step, depth)
    cells = cells.mirrored() if run.symmetry_factor == 2 else cells
    left, right, _, top = cells.frame
    # Rims stand above the original surface.
    top = max(top, 0.0) + 0.02 * depth

    # The depth of a flat map is drawn larger than to scale.
    shape = (right - left) / (depth + top)
    exaggeration = exaggeration_of(shape)
    height = 1.02 * MAP_WIDTH * exaggeration / shape
    figure, all_axes = style.new_figure(len(fields), height=len(fields) * (height + 0.55) + 0.4)
    picture = cells.picture()
    unit = style.unit_for(max(abs(left), abs(right)), style.LENGTHS)

    # One panel a field, with the cells as pixels.
    for axes, (field, text, colors) in zip(all_axes, fields, strict=True):
        values = np.where(picture < 0, np.nan, step[field][picture])
        image = style.paint(axes, values, cells.frame, unit, across=run.across, cmap=colors)
        if field == "melt_fraction":
            image.set_clim(0.0, 1.0)
        style.color_bar(axes, image, text)
        axes.set_ylim(-depth * unit.factor, top * unit.factor)
        axes.set_aspect(exaggeration)
    note = f"; the depth is drawn {exaggeration:.3g} times larger" if exaggeration > 1.0 else ""
    all_axes[0].set_title(style.time_text(step["time"]) + note, fontsize=10, loc="left")
    return figure


def exaggeration_of(aspect: float) -> float:
    """Factor by which the depth of a picture is drawn larger than to scale, 1 of all but flat ones.

    Args:
        aspect: width over height of what is shown.
    """
    factor = aspect / LARGEST_ASPECT
    # A little more than to scale would only mislead.
    return factor if factor >= 1.25 else 1.0


def cells_of_cut(step: Snapshot, depth: float) -> Cells:
    """The cells down to a depth; in 3-D of the cut y = 0."""
    position, width = step["position"], step["width"]
    # Cells down to the depth that is shown, and in space those of the cut.
    chosen = np.flatnonzero(position[-1] + 0.5 * width[-1] > -depth)
    if position.shape[0] == 3:
        chosen = chosen[in_cut(step, chosen)]
    axes = np.array([0, position.shape[0] - 1])
    return Cells(position[axes[:, None], chosen], width[axes[:, None], chosen], chosen)


def in_cut(step: Snapshot, cells: np.ndarray) -> np.ndarray:
    """Which of some cells of a 3-D snapshot lie within their width of the plane just beyond y = 0.

    Just beyond, because layers with an even number of rows have a face at y = 0. Within their
    width, because particles that flow leave places on the plane to which others are closest.
    """
    y, width = step["position"][1, cells], step["width"][1, cells]
    return np.abs(y - 1e-3 * np.min(width)) < width


def depth_profile(step: Snapshot, depth: float, corners: dict[str, Any]) -> Figure:
    """Temperature and melt fraction against depth of a 1-D run."""
    below = -step["position"][-1]
    order = np.argsort(below)
    order = order[below[order] < depth]
    unit = style.fitting_unit("m", depth)
    figure, (above, under) = style.new_figure(2, height=4.6, share_x=True)
    for axes, name, color, text in (
        (above, "temperature", style.COLORS[1], "temperature [K]"),
        (under, "melt_fraction", style.COLORS[0], "melt fraction [1]"),
    ):
        axes.plot(below[order] * unit.factor, step[name][order], ".-", ms=3, lw=1.0, color=color)
        style.label(axes, f"depth [{unit.name}]" if axes is under else "", text)
    above.set_title(style.time_text(step["time"]), fontsize=10, loc="left")
    draw_corner_temperatures(above, corners)
    under.set_ylim(-0.05, 1.05)
    under.set_xlim(0.0, depth * unit.factor)
    return figure


def shown_depth(run: Run, step: Snapshot) -> float:
    """Depth that a map shows: the melt and half as much again, else where it is warm [m]."""
    z, height = step["position"][-1], step["width"][-1]
    # The melt and half as much again, or where the metal is warm.
    bottom = float(np.max(0.5 * height - z))
    melt = summary_of(run).get("melt", {}).get("depth_any_max_m") or 0.0
    if melt == 0.0:
        rise = step["temperature"] - float(np.min(step["temperature"]))
        warm = rise > 0.05 * float(np.max(rise))
        melt = float(np.max(-z[warm])) if np.any(warm) else 0.5 * bottom
    return min(max(1.6 * melt, 8.0 * float(np.min(height))), bottom)


def deepest_melt_time(run: Run) -> float:
    """When the melt is deepest, else when the metal is hottest [s]."""
    history = run.history
    depth = history.get("melt_depth_any_m", np.zeros(0))
    if np.any(depth > 0.0):
        # The melt can be deepest for a while: its middle.
        deepest = np.flatnonzero(depth == np.max(depth))
        return float(history["time_s"][deepest[deepest.size // 2]])
    return float(history["time_s"][np.argmax(history["temperature_max_K"])])


def arrangement(
    step: Snapshot,
    *,
    dummies: np.ndarray | None = None,
    detail: float | None = None,
    across: str = "x",
) -> Figure | None:
    """Where the particles lie: the whole body and a detail at the surface (2-D; as Fig. 2).

    Args:
        step: a snapshot with position (2, n) and width (2, n) [m].
        dummies: positions (2, m) of dummy particles, drawn lighter.
        detail: edge of the detail [m]; if not given, 110 of the smallest cells.
        across: letter of the level axis.
    """
    position, width = step["position"], step["width"]
    if position.shape[0] != 2:
        return None

    # The whole body, and a detail of some cells at the surface.
    bottom = float(np.min(position[1] - 0.5 * width[1]))
    left, right = float(np.min(position[0])), float(np.max(position[0]))
    extent = float(max(right - left, -bottom))
    edge = min(110.0 * float(np.min(width[1])), 0.4 * extent) if detail is None else detail
    frames = ((left, min(left + extent, right), bottom, 0.0), (left, left + edge, -edge, 0.0))
    figure, all_axes = style.new_figure(1, 2, height=3.9)
    for axes, frame in zip(all_axes, frames, strict=True):
        unit = style.unit_for(max(frame[1] - frame[0], -frame[2]), style.LENGTHS)
        margin = 0.06 * (frame[3] - frame[2])
        # Dummies lighter, behind the particles.
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
        style.label(axes, f"{across} [{unit.name}]", f"z [{unit.name}]")
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
    # Points of a printer per meter of the picture.
    points_per_meter = 200.0 / max(frame[1] - frame[0], frame[3] - frame[2])
    sizes = np.maximum(0.75 * width[1] * points_per_meter, 0.35) ** 2
    if own:
        return sizes[shown]
    return float(np.min(sizes[near])) if np.any(near) else 1.0
