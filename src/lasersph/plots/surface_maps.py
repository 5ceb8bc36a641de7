"""The surface of a run in 3-D as maps: speed, temperature; where it moves height and sections.

They show the whole period, mirrored where half or a quarter of it was computed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.output import Run, RunOrFolder, open_run
from lasersph.output.height_map import HeightMap, surface_map, whole_map
from lasersph.output.last_pulse import last_pulse
from lasersph.plots import style
from lasersph.plots.relief import largest

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

CONTOURS = 8
"""Lines of equal height at most."""
LINE_SHARE = 0.02
"""Largest speed over that of the run below which no streamlines are drawn."""
HEIGHT, MAP_HEIGHT, BESIDE_MAP = 5.2, 4.45, 1.75
"""Of a figure with a map, of the map in it, and width of labels and color bar beside it [in].
Display: measured on a map that is as wide as it is high."""


def has_maps(run: Run) -> bool:
    """Whether the run has a surface over x and y, below which melt flows."""
    return len(run.surface) > 0 and run.surface.dimension == 3


def surface_height_map(run: RunOrFolder) -> Figure | None:
    """Height at the end, with lines of equal height; None without a surface over x and y that
    moves."""
    run = open_run(run)
    if not (has_maps(run) and run.surface_moves):
        return None
    relief = run.relief()
    up = style.fitting_unit("m", largest(relief.z))
    z = relief.z * up.factor
    limit = largest(relief.z) * up.factor
    # Zero in the middle of the colors: pits and rims are told apart.
    figure, axes, unit = _painted(
        relief, z, f"height [{up.name}]", cmap="RdBu_r", vmin=-limit, vmax=limit
    )
    if np.ptp(z) > 0.0:
        x, y = relief.x * unit.factor, relief.y * unit.factor
        lines = axes.contour(x, y, z, levels=CONTOURS, colors="0.2", linewidths=0.7)
        axes.clabel(lines, fontsize=7.5, fmt="%g", inline_spacing=2)
    axes.set_title(f"Height of the surface, {style.time_text(relief.time)}", fontsize=10)
    return figure


def surface_sections(run: RunOrFolder) -> Figure | None:
    """Sections at the end through x = y = 0: along x, y and the diagonal; None without a surface
    over x and y that moves."""
    run = open_run(run)
    if not (has_maps(run) and run.surface_moves):
        return None
    relief = run.relief()
    reach = min(np.max(np.abs(relief.x)), np.max(np.abs(relief.y)))
    # On the diagonal places count along it.
    along = np.linspace(-reach, reach, 401)
    lines = {
        "along x, y = 0": (relief.x, relief.x, 0.0 * relief.x),
        "along y, x = 0": (relief.y, 0.0 * relief.y, relief.y),
        "along the diagonal x = y": (np.sqrt(2.0) * along, along, along),
    }
    length = style.fitting_unit("m", np.sqrt(2.0) * reach)
    up = style.fitting_unit("m", largest(relief.z))
    figure, (axes,) = style.new_figure(height=3.6)
    for (words, (place, x, y)), color, dashes in zip(
        lines.items(), style.COLORS, style.LINES, strict=False
    ):
        axes.plot(
            place * length.factor,
            heights_at(relief, x, y) * up.factor,
            lw=1.4,
            color=color,
            ls=dashes,
            label=words,
        )
    axes.axhline(0.0, color=style.GRAY, lw=0.8, ls=":")
    label = f"distance from the middle [{length.name}]"
    style.label(axes, label, f"height of the surface [{up.name}]")
    style.legend_above(figure, axes, columns=3)
    return figure


def heights_at(relief: HeightMap, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Heights at places (n,), (n,) [m], linear between columns; beyond the last ones theirs."""
    from scipy.ndimage import map_coordinates

    dx, dy = relief.steps
    places = [(y - relief.y[0]) / dy, (x - relief.x[0]) / dx]
    return map_coordinates(relief.z, places, order=1, mode="nearest")


def surface_flow_map(run: RunOrFolder) -> Figure | None:
    """Speed of the surface when it was fastest, with streamlines; None where it never moved."""
    run = open_run(run)
    steps = _steps(run, "speed")
    fastest = max((float(np.max(step["speed"])) for step in steps), default=0.0)
    if fastest <= 0.0:
        return None
    step = max(steps, key=lambda one: float(np.max(one["speed"])))
    speed = surface_map(step, run.surface.shape, run.mirrored, "speed")
    unit_of_speed = style.speed_unit(fastest)
    figure, axes, unit = _painted(
        speed,
        speed.z * unit_of_speed.factor,
        f"speed of the surface [{unit_of_speed.name}]",
        cmap=style.SPEED_COLORS,
        vmin=0.0,
    )
    # What hardly moves has no streamlines.
    u, v = velocity_maps(run, step)
    still = speed.z < LINE_SHARE * fastest
    axes.streamplot(
        np.linspace(speed.x[0], speed.x[-1], speed.x.size) * unit.factor,
        np.linspace(speed.y[0], speed.y[-1], speed.y.size) * unit.factor,
        np.where(still, np.nan, u),
        np.where(still, np.nan, v),
        color="w",
        linewidth=0.7,
        arrowsize=0.7,
        density=1.3,
    )
    _fit(axes, speed, unit)
    axes.set_title(f"Speed of the surface, {style.time_text(speed.time)}", fontsize=10)
    return figure


def velocity_maps(run: Run, step: dict[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Velocity of the surface along x and along y, (ny, nx) each [m/s]: mirrored, with its sign.

    Args:
        step: of `Run.surface`.
    """
    x, y, u, v = (
        values.reshape(run.surface.shape)
        for values in (*step["position"][:2], *step["velocity"][:2])
    )
    # u changes its sign across x = 0, v across y = 0
    along_x, along_y = (
        whole_map(x[:, 0], y[0], values, run.mirrored, odd)[2].T
        for values, odd in ((u, (True, False)), (v, (False, True)))
    )
    return along_x, along_y


def surface_temperature_map(run: RunOrFolder) -> Figure | None:
    """Temperature of the surface when it was hottest; None without a surface over x and y."""
    run = open_run(run)
    steps = _steps(run, "temperature")
    if not steps:
        return None
    step = max(steps, key=lambda one: float(np.max(one["temperature"])))
    found = surface_map(step, run.surface.shape, run.mirrored, "temperature")
    figure, axes, unit = _painted(
        found, found.z, "temperature of the surface [K]", cmap=style.TEMPERATURE_COLORS
    )
    # Lines at the corners of the melting range, where the surface has them.
    material = run.summary.get("material", {}) if run.is_complete else {}
    corners = {float(material[key]) for key in ("solidus_K", "liquidus_K") if material.get(key)}
    levels = sorted(one for one in corners if np.min(found.z) < one < np.max(found.z))
    if levels:
        x, y = found.x * unit.factor, found.y * unit.factor
        lines = axes.contour(x, y, found.z, levels=levels, colors="w", linewidths=0.9)
        axes.clabel(lines, fontsize=7.5, fmt="%.0f K")
    axes.set_title(f"Temperature of the surface, {style.time_text(found.time)}", fontsize=10)
    return figure


def _steps(run: Run, name: str) -> list[dict[str, Any]]:
    """Surfaces of the last pulse that hold a field; none without a surface over x and y."""
    found = list(last_pulse(run).surface) if has_maps(run) else []
    return [step for step in found if name in step]


def _painted(
    place: HeightMap, values: np.ndarray, name: str, **options: Any
) -> tuple[Figure, Axes, style.Unit]:
    """A map of values (ny, nx) with a color bar of a name; figure, axes, unit of the places."""
    unit = style.fitting_unit("m", max(np.max(np.abs(place.x)), np.max(np.abs(place.y))))
    left, right, bottom, top = edges(place)
    figure, (axes,) = style.new_figure(height=HEIGHT)
    # As wide as the map with its labels and color bar, so that no margin stays empty.
    width = MAP_HEIGHT * (right - left) / (top - bottom) + BESIDE_MAP
    figure.set_size_inches(min(width, style.WIDTH), HEIGHT)
    image = style.paint(axes, values, edges(place), unit, **options)
    style.label(axes, f"x [{unit.name}]", f"y [{unit.name}]")
    style.color_bar(axes, image, name, aspect=24.0)
    return figure, axes, unit


def edges(place: HeightMap) -> tuple[float, float, float, float]:
    """Left, right, lower and upper edge of the columns of a map [m]."""
    dx, dy = (0.5 * step for step in place.steps)
    x, y = place.x, place.y
    return x[0] - dx, x[-1] + dx, y[0] - dy, y[-1] + dy


def _fit(axes: Axes, place: HeightMap, unit: style.Unit) -> None:
    """Let axes show a map and no more."""
    left, right, bottom, top = (edge * unit.factor for edge in edges(place))
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
