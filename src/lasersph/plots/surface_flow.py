"""Temperature, its gradient and velocity along the surface at several times: Figs. 6 and 11 of
[Demuth2020], from particles.vtkhdf."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from lasersph.input import format_quantity
from lasersph.output import Run
from lasersph.plots import style
from lasersph.plots.flow_fields import has_flow
from lasersph.plots.history import draw_corner_temperatures, material_of, symmetry_of
from lasersph.plots.particle_map import Snapshot

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PROFILES = 7
SLOW = 0.3
"""Times are chosen from those at which the surface is at least this part of its fastest."""


def surface_flow_profiles(run: Run, times: Sequence[float] | None = None) -> Figure | None:
    """(a) temperature, (b) its gradient and (c) velocity along the surface at several times.

    Args:
        run: the run.
        times: seconds; the closest snapshots are drawn. If not given, times around the largest
            speed of the surface.

    Returns:
        The figure; None where no surface moved.
    """
    if not has_flow(run) or not np.any(run.history["flow_surface_speed_max_m_s"] > 0.0):
        return None
    wanted = telling_times(run) if times is None else list(times)
    steps = {s["time"]: s for s in (run.snapshots.nearest(time) for time in wanted)}
    figure, all_axes = style.new_figure(3, height=7.6, share_x=True)
    colors = style.color_scale("viridis", len(steps))
    reach = max(reach_of(step) for step in steps.values())
    length = style.unit_for(reach, style.LENGTHS)
    speed = style.speed_unit(max(np.max(np.abs(s["surface_velocity"])) for s in steps.values()))
    for color, (time, step) in zip(colors, sorted(steps.items()), strict=True):
        x, temperature, gradient, velocity = profiles(step, symmetry_of(run))
        text = format_quantity(time, "s", typographic=True)
        for axes, values in zip(
            all_axes, (temperature, gradient * 1e-6, velocity * speed.factor), strict=True
        ):
            seen = np.abs(x) <= reach
            axes.plot(x[seen] * length.factor, values[seen], color=color, lw=1.1, label=text)
    draw_corner_temperatures(all_axes[0], material_of(run))
    style.label(all_axes[0], "", "temperature [K]", title="(a)")
    style.label(all_axes[1], "", "dT/dx [K/µm]", title="(b)")
    style.label(all_axes[2], f"x [{length.name}]", f"velocity u [{speed.name}]", title="(c)")
    for axes in all_axes:
        axes.set_xlim(-reach * length.factor, reach * length.factor)
    style.legend_above(figure, all_axes[0], columns=7)
    return figure


def profiles(
    step: Snapshot, symmetry: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """x [m], temperature [K], dT/dx [K/m] and u [m/s] of the surface in order of x.

    u is NaN where the surface does not flow. Half a period is mirrored.
    """
    cells = np.flatnonzero(step["surface"])
    cells = cells[np.argsort(step["position"][0, cells], kind="stable")]
    x = step["position"][0, cells]
    temperature, gradient = step["surface_temperature"][cells], step["surface_gradient"][cells]
    velocity = np.where(step["flows"][cells] > 0, step["surface_velocity"][cells], np.nan)
    if symmetry == 2:
        x = np.concatenate([-x[::-1], x])
        temperature = np.concatenate([temperature[::-1], temperature])
        gradient = np.concatenate([-gradient[::-1], gradient])
        velocity = np.concatenate([-velocity[::-1], velocity])
    return x, temperature, gradient, velocity


def reach_of(step: Snapshot) -> float:
    """Largest |x| that profiles show: a fifth more than where the surface flows [m]."""
    x = np.abs(step["position"][0])
    wet = (step["surface"] > 0) & (step["flows"] > 0)
    return min(1.2 * float(np.max(x, where=wet, initial=0.0)), float(np.max(x))) or float(np.max(x))


def telling_times(run: Run) -> list[float]:
    """Times of snapshots at which the surface is fast, as many as a figure shows."""
    history, times = run.history, run.snapshots.times
    speed = np.interp(times, history["time_s"], history["flow_surface_speed_max_m_s"])
    fast = times[speed >= SLOW * np.max(speed)]
    chosen = np.unique(np.round(np.linspace(0.0, fast.size - 1.0, min(PROFILES, fast.size))))
    return [float(fast[int(k)]) for k in chosen]
