"""A rod under pulses with cold side walls and without, beside the exact half-space."""

from __future__ import annotations

import numpy as np

from lasersph.output import Run
from lasersph.validation.drawing import Panel, exact, line
from lasersph.validation.pulsed_heating.light import Light
from lasersph.validation.study import Study

WALLED, OPEN = "side walls at 300 K", "no side walls"
Trains = dict[tuple[str, float], Run]


def compare(study: Study) -> None:
    """One long pulse and three pulses, with walls and without."""
    light = Light(study.plan.intensity, study.plan.duration)
    # One pulse and trains, with walls and without.
    long = {name: one_pulse(study, name) for name in (WALLED, OPEN)}
    reflectivities = study.plan.reflectivities
    trains = {
        (name, R): pulse_train(study, name, R) for name in (WALLED, OPEN) for R in reflectivities
    }
    # The lattice must be flat, and walls take a share of the peaks.
    add_lattice(study, trains[OPEN, 0.75])
    largest = max(add_train(study, light, trains, R) for R in reflectivities)
    study.add("largest_share", largest)
    add_cooling(study, light, long)
    draw_long(study, light, long)
    draw_trains(study, light, trains)


def sides(study: Study, name: str) -> list[str]:
    """Overrides for the rod with walls, or a lattice of a few columns with periodic sides."""
    spacing, depth = study.plan.spacing, study.plan.depth
    # Walls at the sides of the rod, or a few columns that repeat.
    wanted = ["solver.dimensions=3", f"particles.spacing={spacing} um", f"domain.depth={depth} um"]
    if name == WALLED:
        return [*wanted, "boundaries.sides=wall"]
    return [*wanted, f"domain.width={study.plan.columns * spacing} um"]


def one_pulse(study: Study, name: str) -> Run:
    """One pulse and its cooling until the end of the plan."""
    return study.run(
        f"one-{name.split()[0]}-{study.plan.spacing}um",
        *sides(study, name),
        "laser.pulse.count=1",
        f"time.end={study.plan.end} us",
        f"time.step={study.plan.step} ns",
        "output.snapshots.interval=500 ns",
    )


def pulse_train(study: Study, name: str, reflectivity: float) -> Run:
    """Three pulses."""
    label = f"train-{name.split()[0]}-{study.plan.spacing}um-R{100 * reflectivity:.0f}"
    light = [f"laser.reflectivity={reflectivity}", "output.snapshots.interval=100 ns"]
    return study.run(label, *sides(study, name), *light)


def on_axis(one: Run, time: float) -> float:
    """T [K] of the first particle on the axis at a time [s]."""
    return float(np.interp(time, one.history["time_s"], one.history["temperature_at_maximum_K"]))


def at_surface(one: Run, time: float) -> np.ndarray:
    """T [K] of the first layer at the snapshot closest to a time [s]."""
    step = one.snapshots.nearest(time)
    return step["temperature"][step["surface"] > 0]


def add_lattice(study: Study, one: Run) -> None:
    """The first particle after 100 ns, and that a periodic lattice is flat."""
    wanted, spacing = study.plan.particle_1, study.plan.spacing
    study.add("particle_1", on_axis(one, 100e-9), wanted, spacing=spacing)
    study.add("flat", np.ptp(at_surface(one, 100e-9)))


def add_train(study: Study, light: Light, trains: Trains, R: float) -> float:
    """Peaks of three pulses below the exact ones, and the part of the walls.

    Returns:
        That part of the first peak on the axis [%].
    """
    shares = []
    # At the end of each pulse, on the axis.
    for pulse in (1, 2, 3):
        at = (2 * pulse - 1) * light.duration
        expected = float(light.temperature(0.0, at, reflectivity=R))
        T = {name: on_axis(trains[name, R], at) for name in (WALLED, OPEN)}
        for name, found in T.items():
            below, published = 100.0 * (1.0 - found / expected), 2.5 if name == WALLED else None
            study.add("peak", below, published=published, R=R, pulse=pulse, name=name)
        shares.append(100.0 * (T[OPEN] - T[WALLED]) / expected)
        study.add("share", shares[-1], R=R, pulse=pulse)
    # The mean over the surface at the end.
    end = 5.0 * light.duration
    T_open, T_walled = (float(np.mean(at_surface(trains[name, R], end))) for name in (OPEN, WALLED))
    expected = float(light.temperature(0.0, end, reflectivity=R))
    study.add("mean_share", 100.0 * (T_open - T_walled) / expected, R=R)
    return abs(shares[0])


def add_cooling(study: Study, light: Light, long: dict[str, Run]) -> None:
    """Cooling after one pulse: with walls, without, exact."""
    end = float(long[OPEN].history["time_s"][-1])
    # Times that the run has reached.
    for time in (t for t in (0.5e-6, 1e-6, 2e-6, 4e-6, 8e-6) if t <= end * (1.0 + 1e-9)):
        T = float(light.temperature(0.0, time, count=1))
        rise, at = T - light.initial, 1e6 * time
        study.add("open", on_axis(long[OPEN], time), T, share=rise, time=at)
        study.add("walled", on_axis(long[WALLED], time), T, time=at)
    # First time below the melting point.
    for name, one in long.items():
        after = one.history["time_s"] > light.duration
        below = one.history["time_s"][after][one.history["temperature_at_maximum_K"][after] < 933.0]
        study.add("cooling", 1e6 * float(below[0]), name=name)


def draw_long(study: Study, light: Light, long: dict[str, Run]) -> None:
    """Fig. 13: one pulse and its cooling."""
    end = float(long[OPEN].history["time_s"][-1])
    time = np.concatenate([np.linspace(0.0, 2e-7, 200), np.linspace(2e-7, end, 400)[1:]])
    curves = [exact(1e6 * time, light.temperature(0.0, time, count=1))]
    for k, (name, one) in enumerate(long.items()):
        T = one.history["temperature_at_maximum_K"]
        curves.append(line(1e6 * one.history["time_s"], T, f"3-D, {name}", k))
    words = ("time [µs]", "surface temperature [K]")
    panel = Panel(*words, curves, "Fig. 13: one pulse of 100 ns", level=(933.0, "$T_m$"))
    study.draw("fig13-single-pulse", panel, height=3.6)


def draw_trains(study: Study, light: Light, trains: Trains) -> None:
    """Fig. 14: three pulses."""
    panels, time = [], np.linspace(0.0, 600e-9, 601)
    # Each reflectivity, with walls and without.
    for R in study.plan.reflectivities:
        curves = [exact(1e9 * time, light.temperature(0.0, time, reflectivity=R))]
        for k, name in enumerate((WALLED, OPEN)):
            history = trains[name, R].history
            T = history["temperature_at_maximum_K"]
            curves.append(line(1e9 * history["time_s"], T, name, k))
        panels.append(Panel("time [ns]", "surface temperature [K]", curves, f"R = {R}"))
    study.draw("fig14-three-pulses", *panels, height=3.6)
