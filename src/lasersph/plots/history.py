"""Figures over time, from history.csv: temperature, melt pool, energy, time step."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.observers.energy_budget import IMBALANCE_ALLOWED, IMBALANCE_ALLOWED_WITH_FLOW
from lasersph.output import Run
from lasersph.plots import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LEVELS = {"solidus_K": "$T_s$", "liquidus_K": "$T_l$", "vaporization_K": "$T_v$"}


def temperature_history(run: Run) -> Figure:
    """Temperature of the surface (at x = 0), the largest, and at probes; pulse shaded."""
    history = run.history
    figure, (axes,) = style.new_figure()
    time, name = time_axis(history)
    at_maximum, largest = history["temperature_at_maximum_K"], history["temperature_max_K"]
    draw_pulse(axes, history, time)
    place = " at x = 0" if "melt_width_m" in history else ""
    axes.plot(time, at_maximum, color=style.COLORS[0], label=f"surface{place}")
    if np.max(np.abs(largest - at_maximum)) > 1e-3 * np.max(largest):
        axes.plot(time, largest, color=style.COLORS[1], linestyle="--", label="largest anywhere")
    probes = [column for column in history if column.startswith("probe_")]
    for k, column in enumerate(probes):
        color, line = style.COLORS[(k + 2) % 8], style.LINES[k // 6 % 4]
        axes.plot(time, history[column], color=color, linestyle=line, label=probe_name(column))
    draw_corner_temperatures(axes, material_of(run))
    style.label(axes, name, "temperature [K]")
    axes.set_xlim(time[0], time[-1])
    style.legend_above(figure, axes, columns=4)
    return figure


def melt_pool_history(run: Run) -> Figure | None:
    """Width and depth of the melt pool at f_m = 1, 0.5 and above 0; None where nothing melts."""
    history = run.history
    if not np.any(history.get("melt_depth_any_m", np.zeros(1)) > 0.0):
        return None
    quantities = [q for q in ("width", "depth") if f"melt_{q}_m" in history]
    figure, all_axes = style.new_figure(len(quantities), height=2.6 * len(quantities), share_x=True)
    time, name = time_axis(history)
    levels = {"": "$f_m = 1$", "half_": "$f_m = 0.5$", "any_": "$f_m > 0$"}
    for axes, quantity in zip(all_axes, quantities, strict=True):
        unit = style.unit_for(float(np.max(history[f"melt_{quantity}_any_m"])), style.LENGTHS)
        for k, (level, text) in enumerate(levels.items()):
            values = history[f"melt_{quantity}_{level}m"] * unit.factor
            x, y = style.without_stairs(time, values)
            axes.plot(x, y, color=style.COLORS[k], linestyle=style.LINES[k], label=text)
        style.label(axes, "", f"melt pool {quantity} [{unit.name}]")
        axes.set_ylim(bottom=0.0)
    wet = np.flatnonzero(history["melt_depth_any_m"] > 0.0)
    margin = 0.1 * (time[wet[-1]] - time[wet[0]]) + 1e-9 * time[-1]
    all_axes[-1].set_xlim(
        max(time[wet[0]] - margin, time[0]), min(time[wet[-1]] + margin, time[-1])
    )
    all_axes[-1].set_xlabel(name, fontsize=10)
    style.legend_above(figure, all_axes[0], columns=3)
    return figure


def energy_history(run: Run) -> Figure:
    """Where the absorbed energy is, and how well the balance closes."""
    history = run.history
    figure, (above, below) = style.new_figure(2, height=4.6, share_x=True)
    time, name = time_axis(history)
    unit = summary_of(run).get("energy", {}).get("unit", "J")
    largest = max(float(np.max(history[f"energy_{term}_J"])) for term in ("absorbed", "stored"))
    for k, term in enumerate(("absorbed", "stored", "lost", "removed", "discarded")):
        values = history[f"energy_{term}_J"]
        if term in ("absorbed", "stored") or np.max(np.abs(values)) > 1e-6 * largest:
            above.plot(
                time, values, color=style.COLORS[k], linestyle=style.LINES[k % 4], label=term
            )
    style.label(above, "", f"energy [{unit.replace('^2', '$^2$')}]")
    style.legend(above)
    imbalance = history["energy_imbalance_relative"]
    shown = np.maximum(imbalance, 1e-17)
    below.semilogy(time, shown, color=style.COLORS[6], linewidth=1.0)
    with_flow = "flow_speed_max_m_s" in history
    allowed = IMBALANCE_ALLOWED_WITH_FLOW if with_flow else IMBALANCE_ALLOWED
    text = f"allowed: {allowed:.0e}".replace("e-0", "e-")
    below.axhline(allowed, color=style.COLORS[1], linewidth=0.8, linestyle="--", label=text)
    top = max(10.0 * allowed, 3.0 * float(np.max(shown)))
    below.set_ylim(max(1e-17, 0.3 * float(np.min(shown))), top)
    style.label(below, name, "imbalance / absorbed [1]")
    style.legend(below)
    below.set_xlim(time[0], time[-1])
    return figure


def time_step_history(run: Run) -> Figure:
    """The time step, colored by what limited it, and the iterations of each step."""
    history = run.history
    counts = [column for column in history if column.startswith("iterations_")]
    figure, all_axes = style.new_figure(1 + bool(counts), height=4.6, share_x=True)
    time, name = time_axis(history)
    step, limit = history["time_step_s"], history["limit"]
    taken = step > 0.0
    unit = style.unit_for(float(np.max(step)), style.TIMES)
    for k, reason in enumerate(sorted(set(limit[taken].astype(str)))):
        of_reason = taken & (limit == reason)
        color = style.COLORS[k % len(style.COLORS)]
        values = step[of_reason] * unit.factor
        all_axes[0].plot(
            time[of_reason], values, ".", ms=3.5, color=color, label=reason or "unnamed"
        )
    if np.max(step[taken]) > 20.0 * np.min(step[taken]):
        all_axes[0].set_yscale("log")
    else:
        all_axes[0].set_ylim(bottom=0.0)
    style.label(all_axes[0], "", f"time step [{unit.name}]")
    style.legend_above(figure, all_axes[0], columns=4)
    for k, column in enumerate(counts):
        text = column.removeprefix("iterations_").replace("_", " ")
        axes = all_axes[1]
        axes.plot(time[taken], history[column][taken], color=style.COLORS[k], lw=0.9, label=text)
    if counts:
        style.label(all_axes[1], "", "iterations per step [1]")
        all_axes[1].set_ylim(bottom=0.0)
        style.legend(all_axes[1])
    all_axes[-1].set_xlabel(name, fontsize=10)
    all_axes[-1].set_xlim(time[0], time[-1])
    return figure


def time_axis(history: dict[str, np.ndarray]) -> tuple[np.ndarray, str]:
    """Times in a unit that suits them, and the name of the axis."""
    unit = style.unit_for(float(history["time_s"][-1]), style.TIMES)
    return history["time_s"] * unit.factor, f"time [{unit.name}]"


def incident_power(history: dict[str, np.ndarray]) -> np.ndarray:
    """Power of the incident light relative to its largest value, (rows,); zeros without light."""
    energy, time = history["energy_incident_J"], history["time_s"]
    if energy.size < 3 or energy[-1] <= 0.0:
        return np.zeros(energy.size)
    rate = np.concatenate([[0.0], np.diff(energy) / np.maximum(np.diff(time), 1e-300)])
    centered = np.interp(time, 0.5 * (time + np.concatenate([time[:1], time[:-1]])), rate)
    return np.maximum(centered, 0.0) / max(float(np.max(centered)), 1e-300)


def draw_pulse(axes: Axes, history: dict[str, np.ndarray], time: np.ndarray) -> None:
    """The shape of the pulse as a shade at the foot of the axes."""
    power = incident_power(history)
    if np.any(power > 0.0):
        axes.fill_between(
            time,
            0.0,
            0.25 * power,
            transform=axes.get_xaxis_transform(),
            color="#E69F00",
            alpha=0.35,
            linewidth=0.0,
            zorder=0,
            label="power of the light (no scale)",
        )


def draw_corner_temperatures(axes: Axes, corners: dict[str, Any]) -> None:
    """Lines at the melting range and the vaporization temperature, where these are in view."""
    top = axes.get_ylim()[1]
    solidus, liquidus = corners.get("solidus_K"), corners.get("liquidus_K")
    for key, text in LEVELS.items():
        value = corners.get(key)
        if value is None or value > top:
            continue
        if key == "solidus_K" and liquidus is not None:
            text = "$T_m$" if liquidus == value else "$T_s$, $T_l$"
        elif key == "liquidus_K" and solidus is not None:
            if liquidus != solidus:
                axes.axhline(value, color=style.GRAY, lw=0.8, ls=(0, (4, 3)), zorder=1)
            continue
        style.level_line(axes, float(value), text)


def probe_name(column: str) -> str:
    """`probe_<name>_K` as words."""
    return "probe " + column.removeprefix("probe_").removesuffix("_K")


def summary_of(run: Run) -> dict[str, Any]:
    """The summary of a run; empty while it is not complete."""
    return run.summary if run.is_complete else {}


def material_of(run: Run) -> dict[str, Any]:
    """Corner temperatures of the material, where the summary gives them."""
    return summary_of(run).get("material", {})


def symmetry_of(run: Run) -> int:
    """2 where half a period was computed, else 1."""
    return int(summary_of(run).get("surface", {}).get("symmetry_factor", 1))
