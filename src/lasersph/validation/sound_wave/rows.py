"""Speed and damping of a sound wave in a periodic column."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lasersph.output import Run
from lasersph.sph.kernels import kernel
from lasersph.sph.lattice_sums import second_moment
from lasersph.validation.drawing import Panel, exact, marks
from lasersph.validation.study import Study

COARSEST = 50
"""Particles in a wave for which the bands are given; they fall as the spacing squared."""


@dataclass(frozen=True)
class Wave:
    """Wave of one run: times [s], phase [rad] and amplitude [m/s] at them, speed [m/s], and the
    second moment of its lattice."""

    run: Run
    times: np.ndarray
    phase: np.ndarray
    amplitude: np.ndarray
    speed: float
    moment: float


def compare(study: Study) -> None:
    """Judge speed and amplitude of every run."""
    waves = {name: wave(study, name) for name in study.plan.names}
    # The speed is that of the state equation times the second moment of the lattice.
    for name, found in waves.items():
        case = found.run.case
        share = (COARSEST * case["particles"]["spacing"] / case["domain"]["depth"]) ** 2
        wanted = case["solver"]["sound_speed"] * found.moment
        study.add("speed", found.speed, wanted, share=share, name=name)
        # Damping: the largest change of the amplitude.
        start = case["solver"]["motion"]["amplitude"]
        change = 100.0 * float(np.max(np.abs(found.amplitude / start - 1.0)))
        study.add("amplitude", change, share=share, name=name)
        study.remarks.append(f"{name}: second moment of the lattice {found.moment:.5f}")
    draw(study, waves)


def wave(study: Study, name: str) -> Wave:
    """One run, measured."""
    plan = study.plan.runs[name]
    # A column in which one wave fits.
    shape = plan["kernel"]
    ratio = plan["support_ratio"]
    dimension = plan["dimension"]
    one = study.run(
        name.replace(", ", "-").replace(" ", "-"),
        f"solver.dimensions={dimension}",
        f"particles.kernel={shape}",
        f"particles.support_ratio={ratio}",
        *plan["settings"],
    )
    # Mode of the wave, 2 <v exp(i k x)>: its phase runs, its amplitude should stay.
    k = 2.0 * np.pi / one.case["domain"]["depth"]
    velocity_mode = [
        2.0 * np.mean(s["velocity"][-1] * np.exp(1j * k * s["position"][-1])) for s in one.snapshots
    ]
    times, phase = one.snapshots.times, np.unwrap(np.angle(velocity_mode))
    speed = float(np.polyfit(times, phase, 1)[0]) / k
    moment = second_moment(kernel(shape, dimension), ratio)
    return Wave(one, times, phase, np.abs(velocity_mode), speed, moment)


def draw(study: Study, waves: dict[str, Wave]) -> None:
    """(a) distance that the wave has run, (b) its amplitude over time."""
    found = list(waves.values())
    sound_speed = found[0].run.case["solver"]["sound_speed"]
    time = np.array([0.0, max(one.times[-1] for one in found)])
    # Distance that the phase has run.
    distances, amplitudes = [exact(1e9 * time, 1e6 * sound_speed * time, "c_0 t")], []
    for k, (name, one) in enumerate(waves.items()):
        distance = one.phase * one.speed / np.polyfit(one.times, one.phase, 1)[0]
        distances.append(marks(1e9 * one.times, 1e6 * distance, name, k))
        gain = 1e6 * (one.amplitude / one.amplitude[0] - 1.0)
        amplitudes.append(marks(1e9 * one.times, gain, k=k))
    study.draw(
        "sound-wave",
        Panel("time [ns]", "distance of the wave [µm]", distances, "(a)"),
        Panel("time [ns]", "amplitude beyond the initial [ppm]", amplitudes, "(b)"),
    )
