"""Pulsed heating of aluminium without phase change [Alshaer2017, Section 4.3, Figs. 10-16].

A uniform beam of 9.6e11 W/m^2, 100 ns on and 100 ns off, on AA6014 with constant properties; cubic
spline, h = 1.5 dx, plain weights, free surface, explicit predictor-corrector. "3-D" is a lattice of
4 x 4 columns with periodic sides: with these weights the published rod without its cold side walls.

Exact: superposition of steps, A.1-A.4. The temperatures of particle 1 are those of an independent
program with the same discretization.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lasersph.analytic.convergence import assess, grid_convergence_index, relative_error
from lasersph.analytic.half_space import pulse_train_temperature, thermal_penetration
from lasersph.case import load_case
from lasersph.output import Run
from lasersph.solvers.step_control import NotConverged
from lasersph.validation import pulsed_heating_figures as figures
from lasersph.validation.report import Report
from lasersph.validation.runs import computed
from lasersph.validation.verdict import Row, judged, shown

TITLE = "Three laser pulses on aluminium at rest: surface and depths against the exact solution"
PAPER = "Alshaer et al. 2017, Section 4.3"
EXACT = "Alshaer et al. 2017, Appendix A, as superposition of steps"
PROGRAM = "independent program with the same discretization"
SPACINGS = (1.0, 0.5, 0.25)
"""[um]"""
PARTICLE_1 = {1: (4141.70, 4384.94, 4489.66), 3: (4061.52, 4314.85, 4429.21)}
"""T [K] of the first particle after 100 ns, R = 0.75, by dimension."""
ORDER = {1: 1.22, 3: 1.15}
EXACT_SURFACE = {
    0.75: (4556.57, 2063.13, 5909.46, 3203.67, 6914.30, 4112.12),
    0.95: (1151.31, 652.63, 1421.89, 880.73, 1622.86, 1062.42),
}
"""T [K] at 100, 200, ..., 600 ns by reflectivity."""
PRINTED_DIFFUSIVITY = 6.89e-5
"""D [m^2/s] of Table 1, with which EXACT_SURFACE was computed; k / (rho c_p) is 6.8904e-5."""
STEPS = (0.1, 0.5, 1.0, 5.0)
"""Fixed time steps [ns] of the time-step study."""
BOUNDED = 1e4
"""A surface hotter than this [K] has diverged: the exact one stays below 5000 K."""


def run(out_dir: Path, *, quick: bool = False) -> Report:
    """All studies; `quick` leaves out the finest 3-D lattices and the trains of pulses in 3-D."""
    light = Light()
    rows: list[Row] = [*exact_rows(Light(PRINTED_DIFFUSIVITY))]
    drawn: list[Path] = []
    by_spacing = {}
    for dimension in (1, 3):
        spacings = SPACINGS[:-1] if quick and dimension == 3 else SPACINGS
        by_spacing[dimension] = {d: single(out_dir, dimension, d) for d in spacings}
        rows += spacing_rows(light, dimension, by_spacing[dimension])
    drawn += figures.spacings(out_dir, light, by_spacing)
    steps = STEPS[1:3] if quick else STEPS
    by_step = {step: with_fixed_step(out_dir, step) for step in steps}
    rows += step_rows(by_step)
    drawn.append(figures.time_steps(out_dir, light, by_step))
    if not quick:
        long = one_pulse_to_8_us(out_dir)
        rows.append(cooling_row(light, long))
        drawn.append(figures.single_pulse(out_dir, light, long))
    trains = {
        (dimension, R): train(out_dir, dimension, R)
        for R in EXACT_SURFACE
        for dimension in ((1,) if quick else (1, 3))
    }
    rows += train_rows(light, trains)
    drawn += figures.trains(out_dir, light, trains)
    remarks = (
        "the table of exact temperatures belongs to the printed D = 6.89e-5 m2/s; the particles "
        "conduct with k / (rho c_p) = 6.89035e-5, with which it is 0.05 to 0.17 K higher",
        "with the printed -0.0086 and P = 1.12 eq. (37) gives 0.0092; the paper prints 0.019",
        "the deviation of the 3-D lattice is that of its kernel: the second moment of the weights "
        "is 1.0101 in 3-D and 0.988 in 1-D, not 1; there are no cold side walls here",
        f"heat travels {1e6 * thermal_penetration(light.diffusivity, 5e-9):.2f} um in 5 ns "
        "(eq. 34; printed 0.6 um)",
    )
    return Report("pulsed-heating", TITLE, tuple(rows), tuple(drawn), remarks, quick)


class Light:
    """Exact temperatures for the material and the light of the case `pulsed-heating`.

    Args:
        diffusivity: D [m^2/s]; None takes k / (rho c_p), as the particles do.
    """

    def __init__(self, diffusivity: float | None = None) -> None:
        case = load_case("pulsed-heating")
        if case.laser is None:
            raise ValueError("the case has no laser")
        self.initial = case.initial_temperature
        self.conductivity = float(case.material.conductivity_at(self.initial))
        self.diffusivity = diffusivity or self.conductivity / (
            case.material.density_reference * float(case.material.heat_capacity_at(self.initial))
        )
        self.intensity, self.duration = 9.6e11, 100e-9

    def pulses(self, reflectivity: float, count: int) -> dict[str, Any]:
        """Arguments of the exact solution."""
        return {
            "flux": (1.0 - reflectivity) * self.intensity, "pulse_duration": self.duration,
            "off_time": self.duration, "count": count,
            "conductivity": self.conductivity, "diffusivity": self.diffusivity,
        }  # fmt: skip

    def temperature(self, depth, time, *, reflectivity: float = 0.75, count: int = 3):
        """Exact T [K] at depths [m] and times [s]."""
        return pulse_train_temperature(
            depth, time, initial_temperature=self.initial, **self.pulses(reflectivity, count)
        )


def single(out_dir: Path, dimension: int, spacing: float) -> Run:
    """One pulse, watched for 100 ns."""
    settings = [*lattice(dimension, spacing), "time.end=100 ns", "output.snapshots.interval=100 ns"]
    return computed("pulsed-heating", settings, out_dir, f"{dimension}d-{spacing:g}um")


def lattice(dimension: int, spacing: float) -> list[str]:
    """Overrides for a spacing [um]; in 3-D 4 x 4 columns."""
    settings = [f"solver.dimensions={dimension}", f"particles.spacing={spacing} um"]
    return settings + ([f"domain.width={4.0 * spacing} um"] if dimension == 3 else [])


def with_fixed_step(out_dir: Path, step: float) -> Run | None:
    """One pulse with a fixed time step [ns]; None where the run broke off."""
    settings = [*lattice(1, 0.25), "time.end=100 ns", f"time.step={step} ns", "time.is_fixed=true",
                "output.snapshots.interval=100 ns"]  # fmt: skip
    try:
        with np.errstate(over="ignore"):  # snapshots of a diverging run are single precision
            return computed("pulsed-heating", settings, out_dir, f"step-{step:g}ns")
    except (NotConverged, ArithmeticError):
        return None


def one_pulse_to_8_us(out_dir: Path) -> Run:
    """One pulse and its cooling, as in Fig. 13."""
    settings = [*lattice(1, 0.25), "laser.pulse.count=1", "time.end=8 us",
                "output.snapshots.interval=1 us"]  # fmt: skip
    return computed("pulsed-heating", settings, out_dir, "one-pulse")


def train(out_dir: Path, dimension: int, reflectivity: float) -> Run:
    """Three pulses."""
    settings = [*lattice(dimension, 0.25), f"laser.reflectivity={reflectivity}"]
    label = f"train-{dimension}d-R{100 * reflectivity:.0f}"
    return computed("pulsed-heating", settings, out_dir, label)


def surface(one: Run) -> np.ndarray:
    """T [K] of particle 1 over the run."""
    return one.history["temperature_at_maximum_K"]


def exact_rows(light: Light) -> list[Row]:
    """The exact solution with the printed diffusivity at the times of the table, to 0.01 K."""
    return [
        judged(f"exact T of the surface at {100 * (k + 1)} ns, R = {R}", "K",
               float(light.temperature(0.0, 100e-9 * (k + 1), reflectivity=R)), value, 0.01,
               source=EXACT)
        for R, values in EXACT_SURFACE.items() for k, value in enumerate(values)
    ]  # fmt: skip


def spacing_rows(light: Light, dimension: int, runs: dict[float, Run]) -> list[Row]:
    """T of particle 1 by spacing, observed order, GCI and error of the finest."""
    label = f"{dimension}-D"
    values = {spacing: float(surface(one)[-1]) for spacing, one in runs.items()}
    rows = [
        judged(f"{label}: T of particle 1 at 100 ns, dx = {d:g} um", "K", value, reference, 0.5,
               source=PROGRAM)
        for (d, value), reference in zip(values.items(), PARTICLE_1[dimension], strict=False)
    ]  # fmt: skip
    if len(values) < 3:
        return rows
    study = assess(list(values.values()), list(values))
    exact = float(light.temperature(0.0, 100e-9))
    error = relative_error(values[0.25], exact)
    gci = grid_convergence_index(error, 2.0, study.order)
    rows += [
        judged(f"{label}: order P of eq. (35)", "1", study.order, ORDER[dimension], 0.01,
               published=1.12, source=f"{PAPER}, eq. (35); {PROGRAM}"),
        shown(f"{label}: relative error of eq. (36), dx = 0.25 um", "1", error,
              published=-0.0086, source=f"{PAPER}, eq. (36)"),
        shown(f"{label}: GCI of eq. (37)", "1", gci, published=0.019,
              source=f"{PAPER}, eq. (37)"),
        shown(f"{label}: GCI from the last two spacings", "1", study.gci, source="Roache 1997"),
        shown(f"{label}: extrapolated T at 100 ns", "K", study.extrapolated, reference=exact,
              source=EXACT),
    ]  # fmt: skip
    return rows


def step_rows(runs: dict[float, Run | None]) -> list[Row]:
    """Which fixed time steps stay bounded: 1 or 0."""
    published = {0.5: "stable", 1.0: "unstable", 5.0: "unstable"}
    limit = "von Neumann limit 0.846 dx^2/D = 0.767 ns"
    return [
        judged(f"fixed step of {step:g} ns stays bounded (1) or diverges (0)", "1",
               float(is_bounded(one)), float(step < 0.767), 0.0, published=published.get(step),
               source=f"{PAPER}.2, Fig. 12; {limit}")
        for step, one in runs.items()
    ]  # fmt: skip


def is_bounded(one: Run | None) -> bool:
    """Whether a run came to its end with all temperatures finite and moderate."""
    return one is not None and bool(np.all(np.abs(one.history["temperature_max_K"]) < BOUNDED))


def cooling_row(light: Light, one: Run) -> Row:
    """Time at which the surface is again below the melting point, one pulse."""
    after = one.history["time_s"] > light.duration
    time, T = one.history["time_s"][after], surface(one)[after]
    exact_time = np.linspace(light.duration, 8e-6, 100_000)
    exact = light.temperature(0.0, exact_time, count=1)
    return judged(
        "one pulse, R = 0.75: surface below 933 K after", "us", 1e6 * float(time[T < 933.0][0]),
        1e6 * float(exact_time[exact < 933.0][0]), 0.02, published="< 2",
        source=f"{PAPER}.3.1, Fig. 13; {EXACT}",
    )  # fmt: skip


def train_rows(light: Light, trains: dict[tuple[int, float], Run]) -> list[Row]:
    """Peaks of three pulses, temperatures at depths, heating rate."""
    rows = []
    published = {1: "0.8", 3: "2.5"}
    for (dimension, R), one in trains.items():
        time, T = one.history["time_s"], surface(one)
        for k in (0, 1, 2):
            at = (2 * k + 1) * light.duration
            exact = float(light.temperature(0.0, at, reflectivity=R))
            deviation = 100.0 * (1.0 - float(np.interp(at, time, T)) / exact)
            rows.append(
                shown(f"{dimension}-D, R = {R}: peak {k + 1} below the exact surface", "%",
                      deviation, published=published[dimension], source=f"{PAPER}.3.2, Fig. 14")
            )  # fmt: skip
    one = trains[1, 0.75]
    for depth in (2, 5, 7):  # at 7 um the peak comes after the end of the run
        column = one.history[f"probe_{depth}um_K"]
        time = one.history["time_s"]
        exact = light.temperature(1e-6 * depth, time)
        k = int(np.argmax(exact))
        rows.append(
            judged(f"1-D, R = 0.75: highest T at a depth of {depth} um", "K",
                   float(np.max(column)), float(exact[k]), 0.02 * (float(exact[k]) - light.initial),
                   source=EXACT)
        )  # fmt: skip
        if k < time.size - 1:
            rows.append(
                judged(f"1-D, R = 0.75: delay of that peak, {depth} um", "ns",
                       1e9 * float(time[int(np.argmax(column))]) - 500.0,
                       1e9 * float(time[k]) - 500.0, 2.0, published="10-60",
                       source=f"{PAPER}.3.3, Fig. 15; {EXACT}")
            )  # fmt: skip
    rate = float(np.max(np.diff(surface(one)) / np.diff(one.history["time_s"])))
    rows.append(
        shown("1-D, R = 0.75: highest heating rate of particle 1", "K/s", rate,
              published="about 6e10 in the first 20-40 ns", source=f"{PAPER}.3.3, Fig. 16")
    )  # fmt: skip
    return rows
