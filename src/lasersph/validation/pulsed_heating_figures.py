"""Figs. 10-16 of [Alshaer2017]: surface temperatures, errors, depths, profiles, heating rates."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.analytic.half_space import pulse_train_rate
from lasersph.output import Run
from lasersph.plots import style

DEPTHS = (0, 2, 5, 7)
"""[um]"""


def spacings(
    out_dir: Path, light: Any, runs: Mapping[int, Mapping[float, Run]]
) -> tuple[Path, Path]:
    """Fig. 10: surface temperature by spacing; Fig. 11: error norm by spacing."""
    figure, all_axes = style.new_figure(1, len(runs), height=3.4)
    errors: dict[int, dict[float, float]] = {}
    for axes, (dimension, found) in zip(all_axes, runs.items(), strict=True):
        time = np.linspace(0.0, 100e-9, 300)
        axes.plot(1e9 * time, light.temperature(0.0, time), color=style.GRAY, label="exact")
        errors[dimension] = {}
        for k, (spacing, one) in enumerate(found.items()):
            t, T = one.history["time_s"], one.history["temperature_at_maximum_K"]
            axes.plot(1e9 * t, T, style.LINES[k], color=style.COLORS[k], label=f"{spacing:g} µm")
            difference = T - light.temperature(0.0, t)
            errors[dimension][spacing] = float(np.sqrt(np.mean(difference**2)))
        style.label(axes, "time [ns]", "surface temperature [K]", title=f"{dimension}-D")
    style.legend(all_axes[0])
    first = style.save(figure, out_dir / "fig10-spacing.png")
    figure, (axes,) = style.new_figure(height=3.4)
    for k, (dimension, found) in enumerate(errors.items()):
        axes.loglog(list(found), list(found.values()), "os"[k] + "-", color=style.COLORS[k],
                    label=f"{dimension}-D")  # fmt: skip
    ends = np.array([0.25, 1.0])
    axes.loglog(ends, errors[1][1.0] * ends, color=style.GRAY, label="first order")
    style.label(axes, "spacing [µm]", "root mean square error of the surface [K]")
    style.legend(axes)
    return first, style.save(figure, out_dir / "fig11-error.png")


def time_steps(out_dir: Path, light: Any, runs: Mapping[float, Run | None]) -> Path:
    """Fig. 12: surface temperature by fixed time step; a run that diverges leaves the axes."""
    figure, (axes,) = style.new_figure(height=3.4)
    time = np.linspace(0.0, 100e-9, 300)
    axes.plot(1e9 * time, light.temperature(0.0, time), color=style.GRAY, label="exact")
    for k, (step, one) in enumerate(runs.items()):
        if one is None:
            continue
        T = np.clip(one.history["temperature_at_maximum_K"], -1e4, 1e4)
        axes.plot(1e9 * one.history["time_s"], T, style.LINES[k], color=style.COLORS[k],
                  label=f"{step:g} ns")  # fmt: skip
    axes.set_ylim(0.0, 6000.0)
    style.label(axes, "time [ns]", "surface temperature [K]")
    style.legend(axes)
    return style.save(figure, out_dir / "fig12-time-step.png")


def single_pulse(out_dir: Path, light: Any, one: Run) -> Path:
    """Fig. 13: one pulse and its cooling."""
    figure, (axes,) = style.new_figure(height=3.4)
    time = np.linspace(0.0, 8e-6, 2000)
    axes.plot(1e6 * time, light.temperature(0.0, time, count=1), color=style.GRAY, label="exact")
    axes.plot(1e6 * one.history["time_s"], one.history["temperature_at_maximum_K"], "--",
              color=style.COLORS[0], label="SPH")  # fmt: skip
    style.level_line(axes, 933.0, "$T_m$")
    style.label(axes, "time [µs]", "surface temperature [K]")
    style.legend(axes)
    return style.save(figure, out_dir / "fig13-single-pulse.png")


def trains(
    out_dir: Path, light: Any, runs: Mapping[tuple[int, float], Run]
) -> tuple[Path, Path, Path]:
    """Fig. 14: surface; Fig. 15: depths and profiles; Fig. 16: rates, for three pulses."""
    one = runs[1, 0.75]
    return (
        _surfaces(out_dir / "fig14-three-pulses.png", light, runs),
        _depths(out_dir / "fig15-depths.png", light, one),
        _rates(out_dir / "fig16-rates.png", light, one),
    )


def _surfaces(path: Path, light: Any, runs: Mapping[tuple[int, float], Run]) -> Path:
    figure, all_axes = style.new_figure(1, 2, height=3.4)
    time = np.linspace(0.0, 600e-9, 1200)
    for axes, R, letter in zip(all_axes, (0.95, 0.75), "ab", strict=True):
        axes.plot(1e9 * time, light.temperature(0.0, time, reflectivity=R), color=style.GRAY,
                  label="exact")  # fmt: skip
        for k, dimension in enumerate((1, 3)):
            if (dimension, R) in runs:
                history = runs[dimension, R].history
                axes.plot(1e9 * history["time_s"], history["temperature_at_maximum_K"],
                          style.LINES[k + 1], color=style.COLORS[k],
                          label=f"SPH {dimension}-D")  # fmt: skip
        title = f"({letter}) R = {R}"
        style.label(axes, "time [ns]", "surface temperature [K]", title=title)
    style.legend(all_axes[0])
    return style.save(figure, path)


def _depths(path: Path, light: Any, one: Run) -> Path:
    figure, axes = style.new_figure(1, 2, height=3.4)
    time = one.history["time_s"]
    for k, depth in enumerate(DEPTHS):
        axes[0].plot(1e9 * time, light.temperature(1e-6 * depth, time), color="0.8", linewidth=2.5)
        axes[0].plot(1e9 * time, _at_depth(one, depth), color=style.COLORS[k],
                     label=f"{depth} µm")  # fmt: skip
    for k, wanted in enumerate((50e-9, 100e-9, 200e-9, 300e-9, 500e-9, 600e-9)):
        snapshot = one.snapshots.nearest(wanted)
        z = -snapshot["position"][-1]
        is_near = z < 30e-6
        axes[1].plot(1e6 * z[is_near], snapshot["temperature"][is_near], color=style.COLORS[k],
                     label=f"{1e9 * snapshot['time']:.0f} ns")  # fmt: skip
    style.label(axes[0], "time [ns]", "temperature [K]", title="(a) exact: gray")
    style.label(axes[1], "depth [µm]", "temperature [K]", title="(b)")
    for one_axes in axes:
        style.legend(one_axes)
    return style.save(figure, path)


def _rates(path: Path, light: Any, one: Run) -> Path:
    figure, axes = style.new_figure(1, 2, height=3.4)
    time = one.history["time_s"]
    middle = 0.5 * (time[1:] + time[:-1])
    for k, depth in enumerate(DEPTHS):
        rate = np.diff(_at_depth(one, depth)) / np.diff(time)
        panel = axes[0] if depth == 0 else axes[1]
        exact = pulse_train_rate(1e-6 * depth, middle, **light.pulses(0.75, 3))
        panel.plot(1e9 * middle, exact, color="0.8", linewidth=2.5)
        panel.plot(1e9 * middle, rate, color=style.COLORS[k], label=f"{depth} µm")
    axes[0].set_ylim(-4e11, 4e11)
    for panel, title in zip(axes, ("(a) surface", "(b) depths"), strict=True):
        style.label(panel, "time [ns]", "dT/dt [K/s]", title=title)
    style.legend(axes[1])
    return style.save(figure, path)


def _at_depth(one: Run, depth: int) -> np.ndarray:
    """T [K] over the run at a depth [um]; 0 is the first particle."""
    return one.history["probe_surface_K" if depth == 0 else f"probe_{depth}um_K"]
