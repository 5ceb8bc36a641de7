"""Speed and damping of a sound wave in a periodic column, against the equation of state.

The case `sound-wave`. The phase of the wave is that of sum v exp(i k z) over the particles; its
slope in time is the speed. A kernel on a lattice changes it by its second moment, which multiplies
both the divergence of the velocities and the gradient of pressure: by 0.1 % for the quintic spline
with a support of 3.75 spacings, by -1.2 % in 1-D for the cubic spline with h = 1.5 dx, so that the
latter is compared with the speed times that moment.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lasersph.boundaries.initial_motion import SoundWave
from lasersph.case import load_case
from lasersph.plots import style
from lasersph.sph.kernels import kernel
from lasersph.sph.lattice_sums import second_moment
from lasersph.validation.report import Report
from lasersph.validation.runs import computed
from lasersph.validation.verdict import Row, at_most, judged

TITLE = "Sound in matter that moves: its speed is that of the equation of state"
SOURCE = "c_0 of the equation of state; Alshaer et al. 2017, eq. (26)"
SPEED_TOLERANCE = 0.01
AMPLITUDE_TOLERANCE = 0.01
QUINTIC, CUBIC = ("quintic-spline", 3.75), ("cubic-spline", 3.0)
RUNS = {
    "1-D": (1, QUINTIC, ()),
    "2-D": (2, QUINTIC, ("domain.width=9 um",)),
    "3-D": (3, CUBIC, ("domain.width=14 um", "particles.spacing=2 um")),
    "1-D, cubic spline": (1, CUBIC, ()),
}
"""Name: dimension, kernel and support over spacing, further settings."""


@dataclass(frozen=True)
class Wave:
    """What one run says: times [s], phase [rad] and amplitude [m/s] at them, speed [m/s], and the
    second moment of its lattice."""

    times: np.ndarray
    phase: np.ndarray
    amplitude: np.ndarray
    speed: float
    moment: float


def run(out_dir: Path, *, quick: bool = False) -> Report:
    """Four runs; `quick`: the first."""
    sound_speed, start = _given()
    names = list(RUNS)[: 1 if quick else None]
    waves = {name: wave(out_dir, name) for name in names}
    rows: list[Row] = []
    for name, found in waves.items():
        expected = sound_speed * (found.moment if RUNS[name][1] == CUBIC else 1.0)
        rows.append(
            judged(f"speed, {name}", "m/s", found.speed, expected, SPEED_TOLERANCE * expected,
                   source=SOURCE)
        )  # fmt: skip
        change = float(np.max(np.abs(found.amplitude / start - 1.0)))
        rows.append(
            at_most(f"change of the amplitude without viscosity, {name}", "%", 100.0 * change,
                    100.0 * AMPLITUDE_TOLERANCE, source="energy is conserved")
        )  # fmt: skip
    remarks = tuple(
        f"{name}: second moment of the lattice {found.moment:.5f}" for name, found in waves.items()
    )
    return Report(
        "sound-wave", TITLE, tuple(rows), (draw(out_dir, waves, sound_speed),), remarks, quick
    )


def _given() -> tuple[float, float]:
    """Speed of sound and amplitude of the shipped case [m/s]."""
    case = load_case("sound-wave")
    motion = case.motion
    if not isinstance(motion, SoundWave) or case.solver.kind != "ablation":
        raise ValueError("the case sound-wave has no sound wave")
    return case.solver.sound_speed, motion.amplitude


def wave(out_dir: Path, name: str) -> Wave:
    """Run one of RUNS, measured."""
    dimension, (shape, ratio), settings = RUNS[name]
    label = name.replace(", ", "-").replace(" ", "-")
    overrides = [
        f"solver.dimensions={dimension}", f"particles.kernel={shape}",
        f"particles.support_ratio={ratio}", *settings,
    ]  # fmt: skip
    one = computed("sound-wave", overrides, out_dir, label)
    depth = one.case["domain"]["depth"]
    k = 2.0 * np.pi / depth
    modes = np.array(
        [2.0 * np.mean(s["velocity"][-1] * np.exp(1j * k * s["position"][-1]))
         for s in one.snapshots]
    )  # fmt: skip
    times, phase = one.snapshots.times, np.unwrap(np.angle(modes))
    speed = float(np.polyfit(times, phase, 1)[0]) / k
    moment = second_moment(kernel(shape, dimension), ratio)
    return Wave(times, phase, np.abs(modes), speed, moment)


def draw(out_dir: Path, waves: dict[str, Wave], sound_speed: float) -> Path:
    """(a) way of the wave, (b) its amplitude over time."""
    figure, axes = style.new_figure(1, 2, height=3.4)
    longest = max(float(found.times[-1]) for found in waves.values())
    time = np.linspace(0.0, longest, 2)
    axes[0].plot(1e9 * time, 1e6 * sound_speed * time, color=style.GRAY, label="c_0 t")
    for k, (name, found) in enumerate(waves.items()):
        mark = {"color": style.COLORS[k], "marker": "os^v"[k], "linestyle": "", "markersize": 3}
        slope = np.polyfit(found.times, found.phase, 1)[0]
        way = found.phase * found.speed / slope
        axes[0].plot(1e9 * found.times, 1e6 * way, label=name, **mark)
        axes[1].plot(1e9 * found.times, found.amplitude / found.amplitude[0], **mark)
    style.label(axes[0], "time [ns]", "way of the wave [µm]", title="(a)")
    style.label(axes[1], "time [ns]", "amplitude / initial [1]", title="(b)")
    style.legend(axes[0])
    return style.save(figure, out_dir / "sound-wave.png")
