"""The published rod under pulses, with and without cold side walls [Alshaer2017, Section 4.3.3].

A rod of 20 x 20 um at 0.5 um spacing (`pulsed-heating` in 3-D; plain weights, explicit, as
published): one pulse of 100 ns watched for 8 us (Fig. 13) and three pulses (Fig. 14), with side
walls of particles at 300 K and with periodic sides. The paper blames the walls for the 2.5 % by
which its peaks stay below the exact ones. Measured here is what the walls do on the axis and on
average over the surface; the rest of the deviation is that of the 3-D lattice and its weights,
whose second moment is 1.0101.

Without walls the rod must follow a periodic lattice of 4 x 4 columns to rounding. Heat goes 23 um
in 8 us, so that 100 um of depth give the same as the published 200 um: the exact solution differs
by less than 1e-6 there.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lasersph.output import Run
from lasersph.plots import style
from lasersph.validation.pulsed_heating import EXACT, Light
from lasersph.validation.report import Report
from lasersph.validation.runs import computed
from lasersph.validation.verdict import Row, at_most, judged, shown

TITLE = "A rod under pulses: what its cold side walls do to the temperature"
PAPER = "Alshaer et al. 2017, Section 4.3.3"
SPACING, QUICK_SPACING = 0.5, 1.0
"""[um]"""
REFLECTIVITIES = (0.95, 0.75)
WALLED, OPEN = "side walls at 300 K", "no side walls"
DEPTH = 100
"""[um]"""
PARTICLE_1 = {0.5: 4314.85, 1.0: 4061.52}
"""T [K] of the first particle of a 3-D lattice after 100 ns, R = 0.75: an independent program."""
PROGRAM = "independent program with the same discretization"
COLUMNS = 4
STEP = {0.5: 1.0, 1.0: 4.0}
"""Time step [ns] of the long run by spacing [um], below the limit 0.741 dx^2/D."""


def run(out_dir: Path, *, quick: bool = False) -> Report:
    """Both figures; `quick`: 1 um and R = 0.75 only, the long run up to 2 us."""
    light, spacing = Light(), QUICK_SPACING if quick else SPACING
    reflectivities = REFLECTIVITIES[1:] if quick else REFLECTIVITIES
    end = 2.0 if quick else 8.0
    long = {name: one_pulse(out_dir, name, spacing, end) for name in (WALLED, OPEN)}
    trains = {
        (name, R): train(out_dir, name, spacing, R)
        for name in (WALLED, OPEN) for R in reflectivities
    }  # fmt: skip
    rows = [*lattice_rows(trains, spacing), *train_rows(light, trains, reflectivities)]
    rows += long_rows(light, long)
    drawn = (draw_long(out_dir, light, long), draw_trains(out_dir, light, trains, reflectivities))
    return Report("quasi-1d-heating", TITLE, tuple(rows), drawn, REMARKS, quick)


REMARKS = (
    "on the axis walls 10 um away take 0.1 % of the first peak but about 5 and 12 % of the second"
    " and third: they cannot be why all published peaks stay 2.5 % too low; a 3-D lattice with"
    " these weights stays as low without any walls",
    "after a microsecond the walls rule: heat crosses 10 um in 1.5 us, and the rod between cold"
    " walls is cold when the half-space of the exact solution still is at 1000 K; Fig. 13, which"
    " follows the exact solution to 8 us, was not computed with such walls",
)


def sides(name: str, spacing: float) -> list[str]:
    """Overrides for the rod with walls, or a lattice of a few columns with periodic sides."""
    wanted = ["solver.dimensions=3", f"particles.spacing={spacing} um", f"domain.depth={DEPTH} um"]
    if name == WALLED:
        return [*wanted, "boundaries.sides=wall"]
    return [*wanted, f"domain.width={COLUMNS * spacing} um"]


def one_pulse(out_dir: Path, name: str, spacing: float, end: float) -> Run:
    """One pulse and its cooling until `end` [us]."""
    settings = [
        "laser.pulse.count=1", f"time.end={end} us", f"time.step={STEP[spacing]} ns",
        "output.snapshots.interval=500 ns",
    ]  # fmt: skip
    return computed("pulsed-heating", [*sides(name, spacing), *settings], out_dir,
                    f"one-{name.split()[0]}-{spacing}um")  # fmt: skip


def train(out_dir: Path, name: str, spacing: float, reflectivity: float) -> Run:
    """Three pulses."""
    settings = [f"laser.reflectivity={reflectivity}", "output.snapshots.interval=100 ns"]
    label = f"train-{name.split()[0]}-{spacing}um-R{100 * reflectivity:.0f}"
    return computed("pulsed-heating", [*sides(name, spacing), *settings], out_dir, label)


def on_axis(one: Run, time: float) -> float:
    """T [K] of the first particle on the axis at a time [s]."""
    return float(np.interp(time, one.history["time_s"], one.history["temperature_at_maximum_K"]))


def over_surface(one: Run, time: float) -> float:
    """Mean T [K] of the first layer at the snapshot closest to a time [s]."""
    step = one.snapshots.nearest(time)
    return float(np.mean(step["temperature"][step["surface"] > 0]))


def lattice_rows(trains: dict[tuple[str, float], Run], spacing: float) -> list[Row]:
    """The first particle after 100 ns, and that a periodic lattice is flat."""
    one = trains[OPEN, 0.75]
    step = one.snapshots.nearest(100e-9)
    surface = step["temperature"][step["surface"] > 0]
    return [
        judged(f"T of particle 1 at 100 ns, no walls, dx = {spacing:g} um", "K",
               on_axis(one, 100e-9), PARTICLE_1[spacing], 0.5, source=PROGRAM),
        at_most("its spread over the surface", "K", float(np.ptp(surface)), 1e-3,
                source="uniform light and periodic sides"),
    ]  # fmt: skip


def train_rows(light: Light, trains, reflectivities) -> list[Row]:
    """Peaks of three pulses below the exact ones, and the part of the walls."""
    rows: list[Row] = []
    for R in reflectivities:
        for pulse in range(3):
            at = (2 * pulse + 1) * light.duration
            exact = float(light.temperature(0.0, at, reflectivity=R))
            T = {name: on_axis(trains[name, R], at) for name in (WALLED, OPEN)}
            rows += [
                shown(f"R = {R}, peak {pulse + 1}: axis below the exact one, {name}", "%",
                      100.0 * (1.0 - T[name] / exact), published=2.5 if name == WALLED else None,
                      source=f"{PAPER}.2, Fig. 14; {EXACT}")
                for name in T
            ]  # fmt: skip
            rows.append(
                shown(f"R = {R}, peak {pulse + 1}: share of the walls on the axis", "%",
                      100.0 * (T[OPEN] - T[WALLED]) / exact, source=f"{PAPER}.2")
            )  # fmt: skip
        end = 5.0 * light.duration
        cooled = over_surface(trains[OPEN, R], end) - over_surface(trains[WALLED, R], end)
        exact = float(light.temperature(0.0, end, reflectivity=R))
        rows.append(
            shown(f"R = {R}, peak 3: share of the walls, mean of the surface", "%",
                  100.0 * cooled / exact, source=f"{PAPER}.2")
        )  # fmt: skip
    walls = [row for row in rows if "on the axis" in row.quantity and "peak 1" in row.quantity]
    largest = max(abs(float(row.computed or 0.0)) for row in walls)
    rows.append(
        at_most("share of the walls in the 2.5 % of the first peak, on the axis", "%", largest,
                0.25, source="a tenth of it: heat goes 2.6 um in 100 ns, the walls are 10 um away")
    )  # fmt: skip
    return rows


def long_rows(light: Light, long: dict[str, Run]) -> list[Row]:
    """Cooling after one pulse: with walls, without, exact."""
    end = float(long[OPEN].history["time_s"][-1])
    rows: list[Row] = []
    for time in (t for t in (0.5e-6, 1e-6, 2e-6, 4e-6, 8e-6) if t <= end * (1.0 + 1e-9)):
        exact = float(light.temperature(0.0, time, count=1))
        rows.append(
            judged(f"one pulse: T at {1e6 * time:g} us, no walls", "K", on_axis(long[OPEN], time),
                   exact, 0.02 * (exact - light.initial), source=f"{PAPER}.1, Fig. 13; {EXACT}")
        )  # fmt: skip
        rows.append(
            shown(f"one pulse: T at {1e6 * time:g} us, side walls", "K",
                  on_axis(long[WALLED], time), reference=exact, source=f"{PAPER}.1, Fig. 13")
        )  # fmt: skip
    for name, one in long.items():
        after = one.history["time_s"] > light.duration
        below = one.history["time_s"][after][one.history["temperature_at_maximum_K"][after] < 933.0]
        rows.append(
            shown(f"one pulse: surface below 933 K after, {name}", "us", 1e6 * float(below[0]),
                  published="< 2", source=f"{PAPER}.1, Fig. 13")
        )  # fmt: skip
    return rows


def draw_long(out_dir: Path, light: Light, long: dict[str, Run]) -> Path:
    """Fig. 13: one pulse and its cooling."""
    figure, (axes,) = style.new_figure(height=3.6)
    end = float(long[OPEN].history["time_s"][-1])
    time = np.concatenate([np.linspace(0.0, 2e-7, 200), np.linspace(2e-7, end, 400)[1:]])
    axes.plot(1e6 * time, light.temperature(0.0, time, count=1), color=style.GRAY, label="exact")
    for k, (name, one) in enumerate(long.items()):
        axes.plot(1e6 * one.history["time_s"], one.history["temperature_at_maximum_K"],
                  style.LINES[k + 1], color=style.COLORS[k], label=f"3-D, {name}")  # fmt: skip
    axes.axhline(933.0, color=style.GRAY, lw=0.7, ls=":")
    style.label(axes, "time [µs]", "surface temperature [K]", title="Fig. 13: one pulse of 100 ns")
    style.legend(axes)
    return style.save(figure, out_dir / "fig13-single-pulse.png")


def draw_trains(out_dir: Path, light: Light, trains, reflectivities) -> Path:
    """Fig. 14: three pulses."""
    figure, all_axes = style.new_figure(1, len(reflectivities), height=3.6)
    time = np.linspace(0.0, 600e-9, 601)
    for axes, R in zip(all_axes, reflectivities, strict=True):
        exact = light.temperature(0.0, time, reflectivity=R)
        axes.plot(1e9 * time, exact, color=style.GRAY, label="exact")
        for k, name in enumerate((WALLED, OPEN)):
            history = trains[name, R].history
            axes.plot(1e9 * history["time_s"], history["temperature_at_maximum_K"],
                      style.LINES[k + 1], color=style.COLORS[k], label=name)  # fmt: skip
        style.label(axes, "time [ns]", "surface temperature [K]", title=f"R = {R}")
    style.legend(all_axes[0])
    return style.save(figure, out_dir / "fig14-three-pulses.png")
