"""Along the surface at several times, from particles.vtkhdf: temperature, and with flow its
gradient and the velocity, as in Figs. 6 and 11 of [Demuth2020]."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.input import format_quantity
from lasersph.output import Run, RunOrFolder, open_run
from lasersph.plots import style
from lasersph.plots.curves import draw_corner_temperatures, material_of
from lasersph.plots.flow_fields import has_flow
from lasersph.plots.particle_map import Snapshot, in_cut

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PROFILES = 7
SLOW = 0.3
"""Times are chosen from those at which the surface is at least this part of its fastest."""


def surface_profiles(run: RunOrFolder, times: Sequence[float] | None = None) -> Figure | None:
    """Temperature along the surface at several times; None in 1-D or without snapshots.

    Args:
        run: the run. times: seconds; if not given, times around the hottest one.
    """
    run = open_run(run)
    if not len(run.snapshots) or run.snapshots.dimension == 1:
        return None
    figure, (axes,) = style.new_figure(height=3.6)

    # Snapshots, each with a color; as wide as the surface of the body.
    steps, styles = steps_at(run, warm_times(run) if times is None else times)
    curves = [profile(step, run.symmetry_factor, "temperature") for step in steps]
    half_width = max(float(np.max(np.abs(x))) for x, _ in curves)
    length = style.fitting_unit("m", half_width)
    for (x, temperature), options in zip(curves, styles, strict=True):
        axes.plot(x * length.factor, temperature, **options)
    right = half_width * length.factor
    axes.set_xlim(-right if run.symmetry_factor == 2 else None, right)
    draw_corner_temperatures(axes, material_of(run))
    style.label(axes, f"{run.across} [{length.name}]", "surface temperature [K]")
    style.legend_above(figure, axes, columns=7)
    return figure


def surface_flow_profiles(run: RunOrFolder, times: Sequence[float] | None = None) -> Figure | None:
    """(a) temperature, (b) its gradient and (c) velocity along the surface at several times.

    Args:
        run: the run.
        times: seconds; the closest snapshots are drawn. If not given, times around the largest
            speed of the surface.

    Returns:
        The figure; None where no surface moved.
    """
    run = open_run(run)
    if not has_flow(run) or not np.any(run.history["flow_surface_speed_max_m_s"] > 0.0):
        return None
    steps, styles = steps_at(run, fast_times(run) if times is None else times)
    figure, all_axes = style.new_figure(3, height=7.6, share_x=True)
    half_width = max(width_shown(step) for step in steps)
    length = style.fitting_unit("m", half_width)
    speed = style.speed_unit(max(np.max(np.abs(step["surface_velocity"])) for step in steps))
    panels = (
        ("surface_temperature", "temperature [K]", 1.0),
        ("surface_gradient", f"dT/d{run.across} [K/µm]", 1e-6),
        ("surface_velocity", f"velocity u [{speed.name}]", speed.factor),
    )
    # Panels of temperature, gradient and velocity at the same times.
    for axes, letter, (name, text, factor) in zip(all_axes, "abc", panels, strict=True):
        for step, options in zip(steps, styles, strict=True):
            x, values = profile(step, run.symmetry_factor, name)
            seen = np.abs(x) <= half_width
            axes.plot(x[seen] * length.factor, values[seen] * factor, lw=1.1, **options)
        lowest = f"{run.across} [{length.name}]" if letter == "c" else ""
        style.label(axes, lowest, text, title=f"({letter})")
        axes.set_xlim(-half_width * length.factor, half_width * length.factor)
    draw_corner_temperatures(all_axes[0], material_of(run))
    style.legend_above(figure, all_axes[0], columns=7)
    return figure


def steps_at(run: Run, times: Sequence[float]) -> tuple[list[Snapshot], list[dict[str, Any]]]:
    """The snapshots closest to some times in order, and color and label of each."""
    # Times that share a snapshot draw it once.
    steps = {step["time"]: step for step in (run.snapshots.nearest(time) for time in times)}
    return [steps[time] for time in sorted(steps)], time_styles(sorted(steps))


def time_styles(times: Sequence[float]) -> list[dict[str, Any]]:
    """Color and label of each time [s]."""
    colors = style.color_scale("viridis", len(times))
    texts = (format_quantity(float(time), "s", typographic=True) for time in times)
    return [{"color": c, "label": text} for c, text in zip(colors, texts, strict=True)]


def profile(step: Snapshot, symmetry: int, name: str) -> tuple[np.ndarray, np.ndarray]:
    """x [m] and a field of the surface cells in order of x; in 3-D of the row closest to y = 0.

    Half a period is mirrored, gradient and velocity with their signs; the velocity is NaN where
    the surface does not flow.
    """
    # Surface cells in order of x.
    cells = np.flatnonzero(step["surface"])
    if step["position"].shape[0] == 3:
        cells = cells[in_cut(step, cells)]
    cells = cells[np.argsort(step["position"][0, cells], kind="stable")]
    x, values = step["position"][0, cells], step[name][cells]
    if name == "surface_velocity":
        values = np.where(step["flows"][cells] > 0, values, np.nan)
    # u and dT/dx are odd about x = 0, the temperature is even.
    if symmetry == 2:
        sign = 1.0 if name.endswith("temperature") else -1.0
        values = np.concatenate([sign * values[::-1], values])
        x = np.concatenate([-x[::-1], x])
    return x, values


def width_shown(step: Snapshot) -> float:
    """Largest |x| that profiles show: a fifth more than where the surface flows [m]."""
    x = np.abs(step["position"][0])
    wet = (step["surface"] > 0) & (step["flows"] > 0)
    return min(1.2 * float(np.max(x, where=wet, initial=0.0)), float(np.max(x))) or float(np.max(x))


def warm_times(run: Run) -> list[float]:
    """Times of snapshots from the first heating to the cooling, as many as a figure shows."""
    peak, all_times = run.history["temperature_at_maximum_K"], run.history["time_s"]
    # From 15 % of the largest rise to 15 % of it.
    rise = peak - peak[0]
    warm = all_times[rise > 0.15 * np.max(rise)] if np.any(rise > 0) else all_times
    times = run.snapshots.times
    near = times[(times >= warm[0]) & (times <= warm[-1])]
    times = near if near.size else times
    # More times early, when heating is fast, than late.
    chosen = np.unique(np.round(np.linspace(0.0, 1.0, PROFILES) ** 1.7 * (times.size - 1)))
    return [float(times[int(k)]) for k in chosen]


def fast_times(run: Run) -> list[float]:
    """Times of snapshots at which the surface is fast, as many as a figure shows."""
    history, times = run.history, run.snapshots.times
    speed = np.interp(times, history["time_s"], history["flow_surface_speed_max_m_s"])
    fast = times[speed >= SLOW * np.max(speed)]
    chosen = np.unique(np.round(np.linspace(0.0, fast.size - 1.0, min(PROFILES, fast.size))))
    return [float(fast[int(k)]) for k in chosen]
