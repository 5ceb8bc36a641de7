"""The crater in three dimensions with pyvista: an optional extra, `pip install lasersph[view]`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lasersph.observers.ablation_view import EJECTED
from lasersph.output import OutputError, Run
from lasersph.output.errors import clear_errors
from lasersph.output.height_map import height_map
from lasersph.plots import style
from lasersph.plots.ablation_fields import crater_snapshot, has_ablation
from lasersph.plots.crater_cut import temperature_range
from lasersph.plots.crater_view import surface_temperature

PIXELS = (1200, 900)
MICROMETERS = 1e6


def crater_scene(run: Run, path: Path, time: float | None = None) -> Path:
    """Draw surface and ejecta of a 3-D run with pyvista into a PNG, off screen.

    Args:
        run: the run.
        path: of the picture.
        time: seconds; if not given, when the crater had its final size.

    Returns:
        The file written.

    Raises:
        OutputError: pyvista is not installed, the run is not in 3-D or has no ablation.
    """
    try:
        import pyvista  # pyright: ignore[reportMissingImports]
    except ImportError as error:
        raise OutputError(
            "pyvista is not installed: pip install 'lasersph[view]' brings it"
        ) from error
    if not has_ablation(run) or run.snapshots.dimension != 3:
        raise OutputError(f"{run.path} is no 3-D run with ablation")
    step = crater_snapshot(run) if time is None else run.snapshots.nearest(time)
    limits = temperature_range(run)
    bar: Any = {"fmt": "%.0f", "color": "black", "vertical": True, "position_y": 0.25}
    look: dict[str, Any] = {"cmap": style.TEMPERATURE_COLORS, "clim": limits}
    surface = height_map(step)
    faces = surface.triangles()
    mesh = pyvista.PolyData(
        surface.vertices(), np.column_stack([np.full(len(faces), 3), faces]).ravel()
    )
    name = "temperature [K]"
    mesh[name] = np.nan_to_num(surface_temperature(step, surface).ravel(), nan=limits[0])
    plotter = pyvista.Plotter(off_screen=True, window_size=list(PIXELS))
    plotter.add_mesh(mesh, scalars=name, scalar_bar_args=bar, **look)
    flying = np.flatnonzero(step["stage"] == EJECTED)
    if flying.size:
        dots = pyvista.PolyData(MICROMETERS * step["position"][:, flying].T)
        dots[name] = step["temperature"][flying]
        size = 0.8 * MICROMETERS * float(np.min(step["width"]))
        balls: Any = dots.glyph(geom=pyvista.Sphere(radius=0.5 * size), scale=False, orient=False)
        plotter.add_mesh(balls, scalars=name, show_scalar_bar=False, **look)
    plotter.add_text(style.time_text(step["time"]), font_size=12, color="black")
    names: dict[str, Any] = {f"{axis}title": f"{axis} [um]" for axis in "xyz"}
    plotter.show_bounds(**names, color="black", location="outer", font_size=11)
    plotter.set_background("white")  # pyright: ignore[reportCallIssue, reportArgumentType]
    with clear_errors("write", path):
        plotter.screenshot(str(path))
    plotter.close()
    return path
