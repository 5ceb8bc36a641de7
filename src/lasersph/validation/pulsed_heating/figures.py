"""Figs. 10-16 of [Alshaer2017]: surface temperatures, errors, depths, profiles, heating rates."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from lasersph.analytic.half_space import pulse_train_rate
from lasersph.output import Run
from lasersph.plots import style
from lasersph.validation.drawing import Curve, Panel, exact, line
from lasersph.validation.pulsed_heating.light import Light
from lasersph.validation.study import Study

DEPTHS = (0, 2, 5, 7)
"""[um]"""
POLISHED = 0.95
"""Reflectivity of Figs. 15 and 16: the text gives heating rates that only this one has."""
SURFACE = ("time [ns]", "surface temperature [K]")


def over_time(one: Run, label: str, k: int, dash: int) -> Curve:
    """T of particle 1 over time in ns."""
    # A run that diverges leaves the axes; its numbers must not spoil them.
    T = np.clip(one.history["temperature_at_maximum_K"], -1e4, 1e4)
    return line(1e9 * one.history["time_s"], T, label, k, linestyle=style.LINES[dash])


def exact_surface(light: Light, end: float, reflectivity: float = 0.75) -> Curve:
    """Exact T of the surface over time in ns."""
    time = np.linspace(0.0, end, 1200)
    return exact(1e9 * time, light.temperature(0.0, time, reflectivity=reflectivity))


def draw_spacings(study: Study, light: Light, runs: Mapping[int, Mapping[float, Run]]) -> None:
    """Fig. 10: surface temperature by spacing; Fig. 11: error norm by spacing."""
    panels, errors = [], []
    # Surface temperature of each spacing, and its error.
    for n, (dimension, found) in enumerate(runs.items()):
        curves, norms = [exact_surface(light, 100e-9)], []
        for k, (spacing, one) in enumerate(found.items()):
            curves.append(over_time(one, f"{spacing:g} µm", k, k))
            T = light.temperature(0.0, one.history["time_s"])
            difference = one.history["temperature_at_maximum_K"] - T
            norms.append(float(np.sqrt(np.mean(difference**2))))
        panels.append(Panel(*SURFACE, curves, f"{dimension}-D"))
        errors.append(line(list(found), norms, f"{dimension}-D", n, marker="os"[n]))
    study.draw("fig10-spacing", *panels)
    # A line of first order through the error of the finest spacing.
    ends = np.array([0.25, 1.0])
    errors.append(exact(ends, errors[0].y[0] * ends, "first order"))
    norm = "root mean square error of the surface [K]"
    study.draw("fig11-error", Panel("spacing [µm]", norm, errors, scales=("log", "log")))


def draw_time_steps(study: Study, light: Light, runs: Mapping[float, Run | None]) -> None:
    """Fig. 12: surface temperature by fixed time step; a run that diverges leaves the axes."""
    curves = [exact_surface(light, 100e-9)]
    curves += [over_time(one, f"{d:g} ns", k, k) for k, (d, one) in enumerate(runs.items()) if one]
    study.draw("fig12-time-step", Panel(*SURFACE, curves, low=0.0, high=6000.0))


def draw_single_pulse(study: Study, light: Light, one: Run) -> None:
    """Fig. 13: one pulse and its cooling."""
    time, found = np.linspace(0.0, 8e-6, 2000), one.history
    T = light.temperature(0.0, time, count=1)
    sph = line(1e6 * found["time_s"], found["temperature_at_maximum_K"], "SPH", linestyle="--")
    curves = [exact(1e6 * time, T), sph]
    words = ("time [µs]", "surface temperature [K]")
    study.draw("fig13-single-pulse", Panel(*words, curves, level=(933.0, "$T_m$")))


def draw_trains(study: Study, light: Light, runs: Mapping[tuple[int, float], Run]) -> None:
    """Fig. 14: surface; Fig. 15: depths and profiles; Fig. 16: rates, for three pulses."""
    panels = []
    for R, letter in ((0.95, "a"), (0.75, "b")):
        curves = [exact_surface(light, 600e-9, R)]
        # One and three dimensions beside the exact curve, for both reflectivities.
        for k, dimension in enumerate((1, 3)):
            if (dimension, R) in runs:
                curves.append(over_time(runs[dimension, R], f"SPH {dimension}-D", k, k + 1))
        panels.append(Panel(*SURFACE, curves, f"({letter}) R = {R}"))
    study.draw("fig14-three-pulses", *panels)
    draw_depths(study, light, runs[1, POLISHED])
    draw_rates(study, light, runs[1, POLISHED])


def draw_depths(study: Study, light: Light, one: Run) -> None:
    """Fig. 15: temperature at depths over time, and over the depth at times."""
    time = one.history["time_s"]
    at_depths, at_times = [], []
    # Over time at depths, over the depth at times.
    for k, depth in enumerate(DEPTHS):
        T = light.temperature(1e-6 * depth, time, reflectivity=POLISHED)
        at_depths.append(exact(1e9 * time, T, "", color="0.8", linewidth=2.5))
        at_depths.append(line(1e9 * time, at_depth(one, depth), f"{depth} µm", k))
    for k, wanted in enumerate((50e-9, 100e-9, 200e-9, 300e-9, 500e-9, 600e-9)):
        snapshot = one.snapshots.nearest(wanted)
        z, T = -snapshot["position"][-1], snapshot["temperature"]
        near, label = z < 30e-6, f"{1e9 * snapshot['time']:.0f} ns"
        at_times.append(line(1e6 * z[near], T[near], label, k))
    study.draw(
        "fig15-depths",
        Panel("time [ns]", "temperature [K]", at_depths, "(a) exact: gray"),
        Panel("depth [µm]", "temperature [K]", at_times, "(b)"),
    )


def draw_rates(study: Study, light: Light, one: Run) -> None:
    """Fig. 16: heating rates at the surface and at depths."""
    # Rates in the middle between two times.
    time = one.history["time_s"]
    middle = 0.5 * (time[1:] + time[:-1])
    surface: list[Curve] = []
    depths: list[Curve] = []
    for k, depth in enumerate(DEPTHS):
        rate = np.diff(at_depth(one, depth)) / np.diff(time)
        expected = pulse_train_rate(1e-6 * depth, middle, **light.pulses(POLISHED, 3))
        (surface if depth == 0 else depths).extend(
            (
                exact(1e9 * middle, 1e-9 * expected, "", color="0.8", linewidth=2.5),
                line(1e9 * middle, 1e-9 * rate, f"{depth} µm" if depth else "", k),
            )
        )
    rates = ("time [ns]", "dT/dt [K/ns]")
    study.draw(
        "fig16-rates",
        Panel(*rates, surface, "(a) surface", low=-100.0, high=100.0),
        Panel(*rates, depths, "(b) depths"),
    )


def at_depth(one: Run, depth: int) -> np.ndarray:
    """T [K] over the run at a depth [um]; 0 is the first particle."""
    return one.history["probe_surface_K" if depth == 0 else f"probe_{depth}um_K"]
