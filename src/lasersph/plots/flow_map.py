"""Pictures of a flow from particles.vtkhdf: temperature, phase, speed with arrows, streamlines."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from lasersph.observers.box_sections import Box
from lasersph.output import RunOrFolder, open_run
from lasersph.plots import style
from lasersph.plots.flow_fields import (
    PlaneFlow,
    Raster,
    body_frame,
    has_flow,
    is_box,
    plane_flow,
    pool_frame,
    raster,
    time_of_most_flow,
)
from lasersph.plots.particle_map import MAP_WIDTH, exaggeration_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ARROWS = 34
BOX_ARROWS = 22
"""Arrows along the longer edge of a picture."""
LONGEST = 1.1
"""Length of the longest arrow over the distance of arrows."""
STREAM_COLUMNS = 160
METAL_GRAY = 0.85
"""Brightness of metal at rest."""
PHASES = ("solid", "mush", "liquid", "at $T_v$")
PHASE_COLORS = ("#a3adb8", "#c5dff0", "#fff0b0", "#f2a07b")
LEAST_SPREAD = 1e-6
PANEL_MARGIN = 1.7
"""Width of the labels and the color bar of a panel [inch]."""
FLAT = 0.5
"""Height over width of a box below which its panels stand above each other."""


def pool_flow_map(run: RunOrFolder, time: float | None = None) -> Figure | None:
    """Temperature, speed with arrows, and phase with streamlines of the melt pool at one time.

    Args:
        run: the run. time: seconds; if not given, when the melt had most kinetic energy.

    Returns:
        The figure; None where nothing flowed or the run is a box.
    """
    run = open_run(run)
    if not has_flow(run) or is_box(run):
        return None
    flow = plane_flow(run, time_of_most_flow(run) if time is None else time)
    if flow.fastest == 0.0:
        return None

    # Temperature, speed with arrows, phase with streamlines.
    frame = pool_frame(run, flow)
    figure, all_axes, exaggeration = stack_panels(frame, 3)
    unit, picture = frame_unit(frame), raster(flow, frame)
    draw_temperature(all_axes[0], picture, unit)
    draw_speed(all_axes[1], picture, unit, flow.fastest)
    draw_arrows(all_axes[1], flow, frame, unit, flow.fastest, ARROWS)
    draw_phase(all_axes[2], picture, unit)
    draw_streamlines(all_axes[2], flow, frame, unit, color="black", density=1.8)
    finish(figure, all_axes, flow, frame, unit, exaggeration)
    return figure


def box_flow_map(run: RunOrFolder, time: float | None = None) -> Figure | None:
    """Speed with arrows, and streamlines over the temperature where it varies.

    Args:
        run: the run. time: seconds; the end if not given.

    Returns:
        The figure; None where the run is no box or nothing moved.
    """
    run = open_run(run)
    if not has_flow(run) or not is_box(run):
        return None
    flow = plane_flow(run, time_of_most_flow(run) if time is None else time)
    if flow.fastest == 0.0:
        return None

    # Panels beside each other in a high box, above each other in a flat one.
    frame = body_frame(flow)
    unit, picture = frame_unit(frame), raster(flow, frame)
    if are_beside(frame):
        height = beside_height(frame, 2)
        exaggeration = 1.0
        count = BOX_ARROWS
        figure, all_axes = style.new_figure(1, 2, height=height)
    else:
        (figure, all_axes, exaggeration), count = stack_panels(frame, 2), ARROWS
    # Speed with arrows, then streamlines over the temperature where it varies.
    draw_speed(all_axes[0], picture, unit, flow.fastest)
    draw_arrows(all_axes[0], flow, frame, unit, flow.fastest, count)
    warm = varies(flow)
    if warm:
        draw_temperature(all_axes[1], picture, unit)
    color = "white" if warm else "black"
    draw_streamlines(all_axes[1], flow, frame, unit, color=color, density=1.1)
    style.label(all_axes[1], f"x [{unit.name}]", f"z [{unit.name}]")
    finish(figure, all_axes, flow, frame, unit, exaggeration)
    return figure


def are_beside(frame: Box) -> bool:
    """Whether the panels of a box stand beside each other."""
    return shape_of(frame) >= FLAT


def beside_height(frame: Box, panels: int) -> float:
    """Height of a figure with panels beside each other [inch]."""
    return (style.WIDTH / panels - PANEL_MARGIN) * shape_of(frame) + 0.9


def varies(flow: PlaneFlow) -> bool:
    """Whether the temperature differs from place to place."""
    temperature = flow.step["temperature"]
    return float(np.ptp(temperature)) > LEAST_SPREAD * float(np.max(temperature))


def draw_temperature(
    axes: Axes, picture: Raster, unit: style.Unit, limits: tuple[float, float] | None = None
) -> None:
    """Temperature of the particles."""
    colors = style.TEMPERATURE_COLORS
    image = style.paint(
        axes, picture.temperature(), picture.edges, unit, across=picture.across, cmap=colors
    )
    if limits is not None:
        image.set_clim(*limits)
    style.color_bar(axes, image, "temperature [K]")


def draw_phase(axes: Axes, picture: Raster, unit: style.Unit) -> None:
    """Phase of the particles: solid, mush, liquid, boiling."""
    from matplotlib.colors import ListedColormap

    options = {"cmap": ListedColormap(list(PHASE_COLORS)), "vmin": -0.5, "vmax": 3.5}
    image = style.paint(
        axes, picture.phase(), picture.edges, unit, across=picture.across, **options
    )
    style.color_bar(axes, image, "phase").set_ticks(range(4), labels=PHASES)


def draw_speed(axes: Axes, picture: Raster, unit: style.Unit, largest: float) -> None:
    """Speed of the liquid in color over the metal in gray, two images of the panel.

    Args:
        largest: end of the color scale [m/s].
    """
    speed = style.speed_unit(largest)
    # Metal in gray below the colors of what flows.
    gray = {"cmap": "gray", "vmin": 0.0, "vmax": 1.0 / METAL_GRAY}
    style.paint(axes, picture.metal(), picture.edges, unit, across=picture.across, **gray)
    values, top = picture.speed() * speed.factor, max(largest * speed.factor, 1e-12)
    options = {"cmap": style.SPEED_COLORS, "vmin": 0.0, "vmax": top}
    image = style.paint(axes, values, picture.edges, unit, across=picture.across, **options)
    style.color_bar(axes, image, f"speed [{speed.name}]")


def draw_arrows(
    axes: Axes, flow: PlaneFlow, frame: Box, unit: style.Unit, largest: float, count: int
) -> None:
    """Arrows of the direction, longer with the root of the speed.

    Args:
        largest: speed of the longest arrow [m/s].
        count: arrows along the longer edge of the picture.
    """
    columns, rows = grid_of(frame, count)
    x, z, velocity = flow.on_grid(frame, columns, rows)
    speed = np.hypot(*velocity)
    # Length of an arrow over the largest: sqrt(u / u_max), so that slow flow is seen as well.
    length = 1.0 / np.sqrt(np.maximum(speed, 1e-12 * largest) * largest)
    # The longest arrow is a little longer than the distance of two.
    step = unit.factor * min(
        frame.width / columns, frame.height / rows * exaggeration_of(1.0 / shape_of(frame))
    )
    axes.quiver(
        x * unit.factor,
        z * unit.factor,
        *(velocity * length * step * LONGEST),
        angles="xy",
        scale_units="x",
        scale=1.0,
        color="white",
        width=0.0022,
        headwidth=4.0,
        headlength=4.5,
        headaxislength=4.0,
        minlength=0.4,
        pivot="mid",
    )


def draw_streamlines(
    axes: Axes, flow: PlaneFlow, frame: Box, unit: style.Unit, *, color: str, density: float
) -> None:
    """Streamlines of the liquid."""
    columns, rows = grid_of(frame, STREAM_COLUMNS)
    x, z, velocity = flow.on_grid(frame, columns, rows)
    # A flat picture needs fewer streamlines across than along.
    shape = drawn_shape(frame)
    axes.streamplot(
        x * unit.factor,
        z * unit.factor,
        *velocity,
        color=color,
        density=(density, density * max(min(shape, 1.0), 0.35)),
        linewidth=0.8,
        arrowsize=0.8,
    )
    axes.grid(False)


def stack_panels(frame: Box, panels: int) -> tuple[Figure, list[Axes], float]:
    """A figure of panels above each other, and how much larger than to scale depth is drawn."""
    exaggeration = exaggeration_of(1.0 / shape_of(frame))
    height = MAP_WIDTH * drawn_shape(frame)
    figure, all_axes = style.new_figure(panels, height=panels * (height + 0.55) + 0.4)
    return figure, all_axes, exaggeration


def finish(
    figure: Figure,
    all_axes: list[Axes],
    flow: PlaneFlow,
    frame: Box,
    unit: style.Unit,
    exaggeration: float,
) -> None:
    """Limits, proportions and the line above that says the time."""
    for axes in all_axes:
        axes.set_xlim(frame.left * unit.factor, frame.right * unit.factor)
        axes.set_ylim(frame.bottom * unit.factor, frame.top * unit.factor)
        axes.set_aspect(exaggeration)
    note = f"; the depth is drawn {exaggeration:.3g} times larger" if exaggeration > 1.0 else ""
    figure.suptitle(style.time_text(flow.time) + note, fontsize=10)


def frame_unit(frame: Box) -> style.Unit:
    """Unit of length for a frame."""
    return style.unit_for(max(abs(frame.left), abs(frame.right)), style.LENGTHS)


def shape_of(frame: Box) -> float:
    """Height over width."""
    return frame.height / frame.width


def drawn_shape(frame: Box) -> float:
    """Height over width as a frame is drawn, the depth of a flat one larger than to scale."""
    return shape_of(frame) * exaggeration_of(1.0 / shape_of(frame))


def grid_of(frame: Box, longer: int) -> tuple[int, int]:
    """Columns and rows of a grid that looks even in the picture."""
    # The grid is even as it is drawn, not in meters.
    shape = drawn_shape(frame)
    if shape <= 1.0:
        return longer, max(round(longer * shape), 3)
    return max(round(longer / shape), 3), longer
