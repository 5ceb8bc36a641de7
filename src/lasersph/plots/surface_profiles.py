"""Temperature along the surface at several times, from particles.vtkhdf."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from lasersph.input import format_quantity
from lasersph.output import Run
from lasersph.plots import style
from lasersph.plots.history import draw_corner_temperatures, material_of, symmetry_of
from lasersph.plots.particle_map import Snapshot, in_cut

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PROFILES = 7


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
    colors = style.color_scale("viridis", len(steps))
    reach, length = 0.0, style.LENGTHS[1]
    for color, (time, step) in zip(colors, sorted(steps.items()), strict=True):
        x, temperature = profile(step, symmetry_of(run))
        length = style.unit_for(float(np.max(np.abs(x))), style.LENGTHS)
        text = format_quantity(time, "s", typographic=True)
        axes.plot(x * length.factor, temperature, color=color, label=text)
        reach = max(reach, float(np.max(np.abs(x))) * length.factor)
    axes.set_xlim(-reach if symmetry_of(run) == 2 else None, reach)
    draw_corner_temperatures(axes, material_of(run))
    style.label(axes, f"x [{length.name}]", "surface temperature [K]")
    style.legend_above(figure, axes, columns=7)
    return figure


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
