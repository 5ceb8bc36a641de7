"""Temperatures of particles under pulses beside the exact solution and an independent program."""

from __future__ import annotations

import numpy as np

from lasersph.analytic.convergence import assess, grid_convergence_index, relative_error
from lasersph.output import Run
from lasersph.solvers.step_control import NotConverged
from lasersph.validation.pulsed_heating import figures, statements
from lasersph.validation.pulsed_heating.light import Light
from lasersph.validation.study import Study

BOUNDED = 1e4
"""A surface hotter than this [K] has diverged: the exact one stays below 5000 K."""
STABLE_STEP = 0.767
"""Von Neumann's limit 0.846 dx^2/D at 0.25 um [ns]."""


def compare(study: Study) -> None:
    """One pulse by spacing and by time step, its cooling, and three pulses."""
    plan = study.plan
    light = Light(plan.intensity, plan.duration)
    # The exact solution itself, then runs by spacing.
    add_exact(study)
    by_spacing = {}
    for dimension in (1, 3):
        spacings = plan.spacings[str(dimension)]
        by_spacing[dimension] = {d: one_pulse(study, dimension, d) for d in spacings}
        add_spacings(study, light, dimension, by_spacing[dimension])
    figures.draw_spacings(study, light, by_spacing)
    # Fixed steps: stable below von Neumann's limit, unbounded above it.
    by_step = {step: with_fixed_step(study, step) for step in plan.steps}
    published = {0.5: "stable", 1.0: "unstable", 5.0: "unstable"}
    for step, one in by_step.items():
        wanted = float(step < STABLE_STEP)
        study.add("bounded", is_bounded(one), wanted, published=published.get(step), step=step)
    figures.draw_time_steps(study, light, by_step)
    # Cooling after one pulse, and trains of three.
    if plan.cooling:
        add_cooling(study, light)
    reflectivities = (0.75, 0.95)
    trains = {(n, R): pulse_train(study, n, R) for R in reflectivities for n in plan.trains}
    add_trains(study, light, trains)
    figures.draw_trains(study, light, trains)
    # Statements of the text.
    statements.add_errors(study, light, by_spacing)
    statements.add_rates(study, light, {R: trains[1, R] for R in reflectivities})
    statements.add_peaks(study, light, trains)


def lattice(dimension: int, spacing: float) -> list[str]:
    """Overrides for a spacing [um]; in 3-D 4 x 4 columns."""
    settings = [f"solver.dimensions={dimension}", f"particles.spacing={spacing} um"]
    return settings + ([f"domain.width={4.0 * spacing} um"] if dimension == 3 else [])


def one_pulse(study: Study, dimension: int, spacing: float) -> Run:
    """One pulse, watched for 100 ns."""
    end = ["time.end=100 ns", "output.snapshots.interval=100 ns"]
    return study.run(f"{dimension}d-{spacing:g}um", *lattice(dimension, spacing), *end)


def with_fixed_step(study: Study, step: float) -> Run | None:
    """One pulse with a fixed time step [ns]; None where the run broke off."""
    fixed = [f"time.step={step} ns", "time.is_fixed=true"]
    end = ["time.end=100 ns", "output.snapshots.interval=100 ns"]
    try:
        with np.errstate(over="ignore"):  # snapshots of a diverging run are single precision
            return study.run(f"step-{step:g}ns", *lattice(1, 0.25), *fixed, *end)
    except (NotConverged, ArithmeticError):
        return None


def pulse_train(study: Study, dimension: int, reflectivity: float) -> Run:
    """Three pulses."""
    label = f"train-{dimension}d-R{100 * reflectivity:.0f}"
    return study.run(label, *lattice(dimension, 0.25), f"laser.reflectivity={reflectivity}")


def surface(one: Run) -> np.ndarray:
    """T [K] of particle 1 over the run."""
    return one.history["temperature_at_maximum_K"]


def add_exact(study: Study) -> None:
    """The exact solution with the printed diffusivity at the times of the table."""
    # The printed diffusivity, which is not that of the particles.
    plan, table = study.plan, study.table("exact.csv")
    light = Light(plan.intensity, plan.duration, plan.printed_diffusivity)
    for R in (0.75, 0.95):
        for k, wanted in enumerate(table[f"R{R}"]):
            found = light.temperature(0.0, (k + 1) * plan.duration, reflectivity=R)
            study.add("exact", float(found), wanted, time=int(table["time_ns"][k]), R=R)


def add_spacings(study: Study, light: Light, dimension: int, runs: dict[float, Run]) -> None:
    """T of particle 1 by spacing, observed order, GCI and error of the finest."""
    # The last temperature of the first particle, by dimension and spacing.
    table = study.table("particle_1.csv")
    wanted = dict(
        zip(zip(table["dimension"], table["spacing"], strict=True), table["T"], strict=True)
    )
    values = {spacing: float(surface(one)[-1]) for spacing, one in runs.items()}
    for d, value in values.items():
        study.add("particle_1", value, wanted[dimension, d], dimension=dimension, spacing=d)
    if len(values) < 3:
        return
    # Order and grid convergence index of three spacings.
    study_of_grids = assess(list(values.values()), list(values))
    exact = float(light.temperature(0.0, 100e-9))
    error = relative_error(values[0.25], exact)
    order = study_of_grids.order
    study.add("order", order, study.plan.orders[str(dimension)], dimension=dimension)
    study.add("error", error, dimension=dimension)
    study.add("gci", grid_convergence_index(error, 2.0, order), dimension=dimension)
    study.add("gci_two", study_of_grids.gci, dimension=dimension)
    study.add("extrapolated", study_of_grids.extrapolated, exact, dimension=dimension)


def is_bounded(one: Run | None) -> bool:
    """Whether a run came to its end with all temperatures finite and moderate."""
    return one is not None and bool(np.all(np.abs(one.history["temperature_max_K"]) < BOUNDED))


def add_cooling(study: Study, light: Light) -> None:
    """Time at which the surface is again below the melting point, after one pulse (Fig. 13)."""
    times = ["time.end=8 us", "output.snapshots.interval=1 us"]
    one = study.run("one-pulse", *lattice(1, 0.25), "laser.pulse.count=1", *times)
    # First time below the melting point, in the run and in the exact solution.
    after = one.history["time_s"] > light.duration
    time, T = one.history["time_s"][after], surface(one)[after]
    exact_time = np.linspace(light.duration, 8e-6, 100_000)
    exact = light.temperature(0.0, exact_time, count=1)
    study.add("cooling", 1e6 * time[T < 933.0][0], 1e6 * exact_time[exact < 933.0][0])
    figures.draw_single_pulse(study, light, one)


def add_trains(study: Study, light: Light, trains: dict[tuple[int, float], Run]) -> None:
    """Peaks of three pulses, temperatures at depths, heating rate."""
    published = {1: "0.8", 3: "2.5"}
    # Peaks at the ends of the pulses.
    for (dimension, R), one in trains.items():
        for k in (0, 1, 2):
            at = (2 * k + 1) * light.duration
            exact = float(light.temperature(0.0, at, reflectivity=R))
            found = 100.0 * (1.0 - np.interp(at, one.history["time_s"], surface(one)) / exact)
            names = {"dimension": dimension, "R": R, "pulse": k + 1}
            study.add("peak", found, published=published[dimension], **names)
    # Peaks at depths, and by how much they come later.
    one = trains[1, 0.75]
    time = one.history["time_s"]
    for depth in (2, 5, 7):
        column = one.history[f"probe_{depth}um_K"]
        exact = light.temperature(1e-6 * depth, time)
        k, highest = int(np.argmax(exact)), float(np.max(exact))
        study.add("depth", np.max(column), highest, share=highest - light.initial, depth=depth)
        if k < time.size - 1:  # at 7 um the peak comes after the end of the run
            delays = (1e9 * float(time[i]) - 500.0 for i in (int(np.argmax(column)), k))
            study.add("delay", *delays, depth=depth)
    # The steepest rise of the surface.
    study.add("rate", np.max(np.diff(surface(one)) / np.diff(time)))
