"""The crater in three dimensions: surface colored by temperature, ejecta above, as in Fig. 18 of
[Alshaer2017]. `crater_scene` draws the same with pyvista, an optional extra: `lasersph[view]`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.observers.ablation_view import EJECTED
from lasersph.output import OutputError, RunOrFolder, open_run
from lasersph.output.errors import clear_errors
from lasersph.output.height_map import HeightMap, height_map
from lasersph.plots import style
from lasersph.plots.ablation_fields import crater_snapshot, has_ablation
from lasersph.plots.crater_cut import temperature_range
from lasersph.plots.particle_map import Snapshot

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_CELLS = 110
"""Cells of the surface along an axis; of finer maps only some are drawn."""
MOST_EJECTA = 1500
FLATTEST = 0.35
"""Height of the picture over its width, at least; flat craters are drawn deeper than to scale."""
PIXELS = (1200, 900)
"""Of a scene."""
MICROMETERS = 1e6


def crater_view(run: RunOrFolder, time: float | None = None) -> Figure | None:
    """Surface of the crater and ejecta of a 3-D run, colored by temperature.

    Args:
        run: the run. time: seconds; if not given, when the crater had its final size.

    Returns:
        The figure; None where the run is not in 3-D or has no ablation.
    """
    run = open_run(run)
    if not has_ablation(run) or run.snapshots.dimension != 3:
        return None
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    from lasersph.plots.notebook_figure import NotebookFigure

    # Height map and color scale; the scale holds for the whole run.
    step = crater_snapshot(run) if time is None else run.snapshots.nearest(time)
    surface = height_map(step)
    scale = Normalize(*temperature_range(run))
    colors = colormaps[style.TEMPERATURE_COLORS]
    unit = style.unit_for(float(np.ptp(surface.x)), style.LENGTHS)
    figure = NotebookFigure(figsize=(style.WIDTH, 4.4), layout="constrained")
    axes: Any = figure.add_subplot(projection="3d", computed_zorder=False)
    draw_surface(axes, surface, colors(scale(surface_temperature(step, surface))), unit)
    highest = draw_ejecta(axes, step, colors, scale, unit)

    # Proportions: flat craters are drawn deeper than to scale.
    low = float(np.nanmin(surface.z)) * unit.factor
    across = [float(np.ptp(side)) * unit.factor for side in (surface.x, surface.y)]
    height = max(highest - low, 1e-12)
    axes.set_box_aspect((across[0], across[1], max(height, FLATTEST * across[0])), zoom=1.2)
    axes.view_init(elev=28.0, azim=-60.0)
    for name in ("x", "y", "z"):
        getattr(axes, f"set_{name}label")(f"{name} [{unit.name}]", fontsize=9)
    axes.tick_params(labelsize=8)
    figure.suptitle(style.time_text(step["time"]), fontsize=10)
    bar = figure.colorbar(ScalarMappable(scale, colors), ax=axes, shrink=0.6, pad=0.08)
    bar.set_label("temperature [K]", fontsize=10)
    return figure


def surface_temperature(step: Snapshot, surface: HeightMap) -> np.ndarray:
    """Temperature of the uppermost particle of each column, (ny, nx) [K]; NaN where none is."""
    return np.where(surface.top < 0, np.nan, step["temperature"][surface.top])


def draw_surface(axes: Any, surface: HeightMap, colors: np.ndarray, unit: style.Unit) -> None:
    """The height map as a lit surface."""
    # Every `thin`-th column: more cells would not be seen.
    thin = max(1, -(-max(surface.z.shape) // MOST_CELLS))
    x, y = np.meshgrid(surface.x[::thin], surface.y[::thin])
    lowest = float(np.nanmin(surface.z))
    z = np.where(np.isnan(surface.z), lowest, surface.z)[::thin, ::thin]
    # sides of the block, which hide the outside of the crater's wall
    x = np.pad(x, 1, "edge")
    y = np.pad(y, 1, "edge")
    z = np.pad(z, 1, constant_values=lowest)
    shown = np.pad(colors[::thin, ::thin], ((1, 1), (1, 1), (0, 0)), "edge")
    options = {"rstride": 1, "cstride": 1, "linewidth": 0.0, "antialiased": False, "shade": False}
    places = (side * unit.factor for side in (x, y, z))
    axes.plot_surface(*places, facecolors=shown, zorder=1, **options)


def draw_ejecta(axes: Any, step: Snapshot, colors: Any, scale: Any, unit: style.Unit) -> float:
    """Ejecta as dots; returns the height of the highest, at least that of the surface."""
    flying = np.flatnonzero(step["stage"] == EJECTED)
    if flying.size == 0:
        return 0.0
    # Some of the ejecta: more dots would hide the crater.
    shown = flying[:: max(1, flying.size // MOST_EJECTA)]
    x, y, z = step["position"][:, shown] * unit.factor
    options = {"depthshade": False, "linewidths": 0.2, "edgecolors": "black", "zorder": 2}
    axes.scatter(x, y, z, s=5.0, c=colors(scale(step["temperature"][shown])), **options)
    return float(np.max(z))


def crater_scene(run: RunOrFolder, path: Path, time: float | None = None) -> Path:
    """Draw surface and ejecta of a 3-D run with pyvista into a PNG, off screen.

    Args:
        run: the run. path: of the picture.
        time: seconds; if not given, when the crater had its final size.

    Returns:
        The file written.

    Raises:
        OutputError: pyvista is not installed, the run is not in 3-D or has no ablation.
    """
    run = open_run(run)
    try:
        import pyvista  # pyright: ignore[reportMissingImports]
    except ImportError as error:
        raise OutputError(
            "pyvista is not installed: pip install 'lasersph[view]' brings it"
        ) from error
    if not has_ablation(run) or run.snapshots.dimension != 3:
        raise OutputError(f"{run.path} is no 3-D run with ablation")

    # Surface as triangles, colored by the temperature of its particles.
    step = crater_snapshot(run) if time is None else run.snapshots.nearest(time)
    limits = temperature_range(run)
    bar: Any = {"fmt": "%.0f", "color": "black", "vertical": True, "position_y": 0.25}
    options: dict[str, Any] = {"cmap": style.TEMPERATURE_COLORS, "clim": limits}
    surface = height_map(step)
    faces = surface.triangles()
    mesh = pyvista.PolyData(
        surface.vertices(), np.column_stack([np.full(len(faces), 3), faces]).ravel()
    )
    name = "temperature [K]"
    mesh[name] = np.nan_to_num(surface_temperature(step, surface).ravel(), nan=limits[0])
    plotter = pyvista.Plotter(off_screen=True, window_size=list(PIXELS))
    plotter.add_mesh(mesh, scalars=name, scalar_bar_args=bar, **options)

    # Ejecta as balls a little smaller than a particle.
    flying = np.flatnonzero(step["stage"] == EJECTED)
    if flying.size:
        dots = pyvista.PolyData(MICROMETERS * step["position"][:, flying].T)
        dots[name] = step["temperature"][flying]
        size = 0.8 * MICROMETERS * float(np.min(step["width"]))
        balls: Any = dots.glyph(geom=pyvista.Sphere(radius=0.5 * size), scale=False, orient=False)
        plotter.add_mesh(balls, scalars=name, show_scalar_bar=False, **options)
    plotter.add_text(style.time_text(step["time"]), font_size=12, color="black")
    names: dict[str, Any] = {f"{axis}title": f"{axis} [um]" for axis in "xyz"}
    plotter.show_bounds(**names, color="black", location="outer", font_size=11)
    plotter.set_background("white")  # pyright: ignore[reportCallIssue, reportArgumentType]
    with clear_errors("write", path):
        plotter.screenshot(str(path))
    plotter.close()
    return path
