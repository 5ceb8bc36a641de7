"""A cut through the crater with its temperature and the ejecta above, as in Figs. 19 and 22 of
[Alshaer2017]."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.observers.box_sections import Box
from lasersph.output import Run, RunOrFolder, open_run
from lasersph.plots import style
from lasersph.plots.ablation_fields import Cut, crater_snapshot, cut_frame, has_ablation, plane_cut
from lasersph.plots.curves import draw_corner_temperatures, material_of
from lasersph.plots.flow_map import frame_unit
from lasersph.plots.particle_map import MAP_WIDTH

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

NARROW = 0.4
"""A frame narrower than this part of its height is drawn wider than to scale."""
BESIDE = 0.7
"""Cuts higher than this part of their width are drawn beside each other."""
ARROW = 0.06
"""Length of the arrow of the fastest particle over the height of the picture or half its width."""
MOST_ARROWS = 400
PIXELS = (400, 800)
TO_SCALE: dict[str, Any] = {"angles": "xy", "scale_units": "xy", "scale": 1.0, "zorder": 3}
"""Arrows as long as their components in units of the axes."""
DPI = 100


def crater_cut(run: RunOrFolder, time: float | None = None) -> Figure | None:
    """Temperature of body and ejecta in the cut through the beam's axis, with velocities.

    In 1-D the temperature against height.

    Args:
        run: the run. time: seconds; if not given, when the crater had its final size.

    Returns:
        The figure; None where the run has no ablation.
    """
    run = open_run(run)
    if not has_ablation(run):
        return None
    step = crater_snapshot(run) if time is None else run.snapshots.nearest(time)
    cut, frame = plane_cut(run, step), cut_frame(run)
    # A column has no cut: temperature against height.
    if run.snapshots.dimension == 1:
        return height_profile(cut, frame, material_of(run))
    figure, (axes,) = style.new_figure(height=figure_height(frame))
    draw_cut(axes, cut, frame, temperature_range(run))
    axes.set_title(style.time_text(cut.time), fontsize=10, loc="left")
    return figure


def ejecta_vectors(run: RunOrFolder, times: tuple[float, ...] = ()) -> Figure | None:
    """The cut at several times below each other: speed and direction of the ejecta.

    Args:
        run: the run, 2-D or 3-D.
        times: seconds; if not given, two: when a third and when all of the volume had left. Cuts
            in which nothing flies yet are left out.

    Returns:
        The figure; None where nothing was ejected, or in 1-D.
    """
    run = open_run(run)
    if not has_ablation(run) or run.snapshots.dimension == 1:
        return None
    count = run.history["ejected_count"]
    if count[-1] == 0.0:
        return None

    # Two moments: a third, and all of the volume has left.
    if not times:
        moments = (count >= count[-1] / 3.0, count >= count[-1])
        times = tuple(float(run.history["time_s"][np.argmax(one)]) for one in moments)

    # the first snapshot from each time on: the one closest to it may lie before anything left
    later = np.minimum(np.searchsorted(run.snapshots.times, times), len(run.snapshots) - 1)
    cuts = [plane_cut(run, run.snapshots[int(number)]) for number in np.unique(later)]
    cuts = [cut for cut in cuts if cut.ejecta.size]

    # One scale of arrows and one frame for all cuts.
    frame, largest = cut_frame(run), 0.0
    for cut in cuts:
        largest = max(largest, float(np.max(np.hypot(*cut.velocity), initial=0.0)))
    if largest == 0.0:
        return None

    # High cuts stand beside each other, flat ones below each other.
    if frame.height > BESIDE * frame.width:
        figure, all_axes = style.new_figure(1, len(cuts), height=figure_height(frame) * 0.6 + 0.5)
    else:
        height = len(cuts) * (figure_height(frame) - 0.3)
        figure, all_axes = style.new_figure(len(cuts), height=height)
    arrows: Any = None
    for axes, cut, letter in zip(all_axes, cuts, "abcdefgh", strict=False):
        arrows = draw_speeds(axes, cut, frame, largest)
        axes.set_title(f"({letter}) {style.time_text(cut.time)}", fontsize=10, loc="left")
    style.color_bar(all_axes, arrows, "speed [m/s]", 22.0)
    return figure


def figure_height(frame: Box) -> float:
    """Height of a figure with one cut [inch]."""
    return float(np.clip(MAP_WIDTH * frame.height / frame.width, 1.3, 5.6)) + 0.9


def temperature_range(run: Run) -> tuple[float, float]:
    """Lowest and highest temperature of the whole run [K]."""
    coldest = float(np.min(run.snapshots[0]["temperature"]))
    return coldest, max(float(np.max(run.history["temperature_max_K"])), coldest + 1.0)


def draw_cut(axes: Axes, cut: Cut, frame: Box, limits: tuple[float, float]) -> list[Any]:
    """Body as cells and ejecta as dots, colored by temperature [K], with arrows of velocity.

    Returns what was drawn of the ejecta.
    """
    low, high = limits
    options = {"cmap": style.TEMPERATURE_COLORS, "vmin": low, "vmax": high}
    image = draw_body(axes, body_picture(cut, frame), frame, **options)
    style.color_bar(axes, image, "temperature [K]", 22.0)
    return draw_ejecta(axes, cut, frame, limits)


def draw_body(axes: Axes, values: np.ndarray, frame: Box, **options: Any) -> Any:
    """A picture of the body below the line of the original surface; returns the image."""
    unit = frame_unit(frame)
    axes.axhline(0.0, color=style.GRAY, linewidth=0.8, linestyle=(0, (4, 3)), zorder=1)
    # Only the part below the original surface is body; above it fly the ejecta.
    edges = (frame.left, frame.right, frame.bottom, 0.0)
    image = style.paint(axes, values, edges, unit, zorder=2, **options)
    axes.set_xlim(frame.left * unit.factor, frame.right * unit.factor)
    axes.set_ylim(frame.bottom * unit.factor, frame.top * unit.factor)
    # A narrow frame is drawn wider than to scale.
    axes.set_aspect(min(frame.width / frame.height / NARROW, 1.0))
    return image


def body_picture(cut: Cut, frame: Box) -> np.ndarray:
    """Temperature of the body below the original surface as pixels [K]; NaN outside."""
    numbers = cut.body.picture((frame.left, frame.right, frame.bottom, 0.0), PIXELS)
    return cut.temperature(numbers)


def draw_ejecta(axes: Axes, cut: Cut, frame: Box, limits: tuple[float, float]) -> list[Any]:
    """Dots of the ejecta in the frame, with arrows; returns what was drawn."""
    # Ejecta above the frame are not shown.
    shown = cut.flying[1] < frame.top
    if not np.any(shown):
        return []
    unit, (low, high) = frame_unit(frame), limits
    x, z = cut.flying[:, shown] * unit.factor
    options = {"cmap": style.TEMPERATURE_COLORS, "vmin": low, "vmax": high, "linewidths": 0.3}
    colors = cut.temperature(cut.ejecta)[shown]
    dots = axes.scatter(x, z, s=9.0, c=colors, edgecolors="black", zorder=4, **options)
    # Arrows of some: more would cover the dots.
    some = np.arange(0, x.size, max(1, x.size // MOST_ARROWS))
    velocity = cut.velocity[:, shown][:, some]
    # The fastest one has the full length, all others in proportion.
    longest = arrow_length(frame) * unit.factor / max(float(np.max(np.hypot(*velocity))), 1e-300)
    options = {**TO_SCALE, "color": "0.35", "width": 0.0016}
    return [dots, axes.quiver(x[some], z[some], *(velocity * longest), **options)]


def draw_speeds(axes: Axes, cut: Cut, frame: Box, largest: float) -> Any:
    """The body in gray, arrows of the ejecta colored by their speed [m/s]; returns the arrows."""
    is_body = np.where(np.isnan(body_picture(cut, frame)), np.nan, 1.0)
    draw_body(axes, is_body, frame, cmap="Greys", vmin=0.0, vmax=3.0)
    shown = np.flatnonzero(cut.flying[1] < frame.top)
    unit = frame_unit(frame)
    x, z = cut.flying[:, shown] * unit.factor
    velocity = cut.velocity[:, shown]
    longest = arrow_length(frame) * unit.factor / largest
    options = {**TO_SCALE, "cmap": f"{style.SPEED_COLORS}_r", "width": 0.0026}
    arrows = axes.quiver(x, z, *(velocity * longest), np.hypot(*velocity), **options)
    arrows.set_clim(0.0, largest)
    return arrows


def arrow_length(frame: Box) -> float:
    """Length of the arrow of the fastest particle [m]."""
    return ARROW * max(frame.height, 0.5 * frame.width)


def height_profile(cut: Cut, frame: Box, corners: dict[str, Any]) -> Figure:
    """Temperature over height of a 1-D run: body and ejecta."""
    unit = style.fitting_unit("m", frame.height)
    figure, (axes,) = style.new_figure(height=3.6)
    # Body from below to above, ejecta as single dots.
    z, temperature = cut.body.center[1] * unit.factor, cut.temperature(cut.body.number)
    order, flying = np.argsort(z), cut.flying[1] * unit.factor
    blue, orange = style.COLORS[:2]
    axes.plot(z[order], temperature[order], ".-", ms=4, lw=1.0, color=blue, label="body")
    axes.plot(flying, cut.temperature(cut.ejecta), "o", ms=5, color=orange, label="ejecta")
    axes.axvline(0.0, color=style.GRAY, linewidth=0.8, linestyle=(0, (4, 3)), zorder=1)
    axes.set_xlim(frame.bottom * unit.factor, frame.top * unit.factor)
    draw_corner_temperatures(axes, corners)
    style.label(axes, f"z [{unit.name}]", "temperature [K]", title=style.time_text(cut.time))
    style.legend(axes)
    return figure


def crater_frames(run: Run, times: Iterable[float]) -> Iterator[Figure]:
    """One figure again and again, each time with the snapshot closest to another time [s].

    Colors keep their meaning over all frames.
    """
    frame, limits = cut_frame(run), temperature_range(run)
    height = 2.0 * round(0.5 * figure_height(frame) * DPI) / DPI  # even pixels, which mp4 wants
    figure, (axes,) = style.new_figure(height=height)
    # The first frame lays the figure out; later ones replace picture and ejecta.
    for k, time in enumerate(times):
        cut = plane_cut(run, run.snapshots.nearest(float(time)))
        if k == 0:
            ejecta = draw_cut(axes, cut, frame, limits)
            figure.draw_without_rendering()
            figure.set_layout_engine(None)
        else:
            axes.images[0].set_data(body_picture(cut, frame))
            for drawn in ejecta:
                drawn.remove()
            ejecta = draw_ejecta(axes, cut, frame, limits)
        axes.set_title(style.time_text(cut.time), fontsize=10, loc="left")
        yield figure
