"""The cells in which the melt of a round spot turns: a section through them, and over time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from lasersph.input import format_quantity
from lasersph.observers.flow_cells import CELLS, Cell, cells_of, stream_function
from lasersph.output import RunOrFolder, open_run
from lasersph.plots import style
from lasersph.plots.curves import any_above_zero, draw_columns
from lasersph.plots.flow_fields import (
    PlaneFlow,
    Raster,
    has_flow,
    plane_flow,
    pool_frame,
    raster,
    time_of_most_flow,
)
from lasersph.plots.flow_history import show_flow
from lasersph.plots.flow_map import METAL_GRAY, draw_streamlines, drawn_shape, finish, frame_unit
from lasersph.plots.particle_map import MAP_WIDTH, exaggeration_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLORS = "RdBu_r"
"""Outward cells red, inward ones blue."""
HISTORY_HEIGHT = 1.7
"""Of a panel over time [inch]."""


def flow_cell_map(run: RunOrFolder, time: float | None = None) -> Figure | None:
    """Cells of the melt of a round spot, on both sides of the axis; height and turnover over time.

    Args:
        run: the run. time: of the section [s]; if not given, when the melt had most kinetic energy.

    Returns:
        The figure; None where the run is no section (r, z) with a flat surface, or nothing turned.
    """
    run = open_run(run)
    shown = [name for name in CELLS if any_above_zero(run, f"flow_{name}_turnover_m3_s")]
    if not shown or not has_flow(run):
        return None
    flow = plane_flow(run, time_of_most_flow(run) if time is None else time)

    # Above the section, below it height and turnover over time.
    frame = pool_frame(run, flow)
    shape, exaggeration = drawn_shape(frame), exaggeration_of(frame.width / frame.height)
    section = MAP_WIDTH * shape + 0.75
    heights = [section, HISTORY_HEIGHT, HISTORY_HEIGHT + 0.3]
    figure, (above, *below) = style.new_figure(3, height=sum(heights))
    if (grid := above.get_gridspec()) is not None:
        grid.set_height_ratios(heights)
    unit = frame_unit(frame)
    draw_cells(above, flow, raster(flow, frame), unit)
    draw_streamlines(above, flow, frame, unit, color="black", density=1.2)
    finish(figure, [above], flow, frame, unit, exaggeration)
    for axes, column in zip(below, ("height_m", "turnover_m3_s"), strict=True):
        lines = {f"flow_{name}_{column}": f"{name} cell" for name in shown}
        draw_columns(axes, run, lines, label=column.partition("_")[0], gaps=True)
        axes.set_ylim(bottom=0.0)
        show_flow(axes, run)
        style.legend(axes)
    return figure


def draw_cells(axes: Axes, flow: PlaneFlow, picture: Raster, unit: style.Unit) -> None:
    """Stokes' stream function in color over the metal in gray, and what each cell turns."""
    step = flow.step
    psi, cells = section_cells(step)
    gray = {"cmap": "gray", "vmin": 0.0, "vmax": 1.0 / METAL_GRAY}
    style.paint(axes, picture.metal(), picture.edges, unit, across=picture.across, **gray)
    # One color scale for both directions, white where nothing turns.
    turnover = style.fitting_unit("m^3/s", float(np.max(np.abs(psi))))
    top = max(float(np.max(np.abs(psi))) * turnover.factor, 1e-12)
    options = {"cmap": COLORS, "vmin": -top, "vmax": top}
    values = picture.of(psi * turnover.factor, step["flows"] > 0)
    image = style.paint(axes, values, picture.edges, unit, across=picture.across, **options)
    style.color_bar(axes, image, f"$\\psi$ [{turnover.name}]")
    # Each cell is named above the section, as far as it exists at this time.
    words = [
        f"{name}: {one.turnover * turnover.factor:.3g} {turnover.name}, "
        f"{format_quantity(one.height, 'm', 3, typographic=True)} high"
        for name, one in cells.items()
        if one.turnover > 0.0
    ]
    axes.set_title("; ".join(words), fontsize=9, loc="left")


def section_cells(step: dict[str, np.ndarray]) -> tuple[np.ndarray, dict[str, Cell]]:
    """psi at the outer edges of the particles (n,) [m^3/s] of a snapshot, and the cells."""
    r, (width, height) = step["position"][0], step["width"]
    # What rises in a ring of width dr: 2 pi r dr w.
    rising = 2.0 * np.pi * r * width * step["velocity"][-1]
    psi = stream_function(r, rising, step["flows"] > 0)
    return psi, cells_of(psi, r, height)
