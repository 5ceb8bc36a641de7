"""Decay of vortices in runs with and without particle shifting, beside the exact one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from lasersph.analytic.taylor_green import TaylorGreen
from lasersph.case import Case
from lasersph.output import Run, open_run
from lasersph.solvers.step_control import StepFailed
from lasersph.validation.drawing import Panel, exact, line
from lasersph.validation.study import Study


@dataclass(frozen=True)
class Decay:
    """Decay of the vortices in one run.

    Attributes:
        run: the run. failure: why it ended early, or "".
        rate: fitted rate of the kinetic energy over the exact one [1].
        times: of the snapshots [s]. errors: of the velocities at these times [1].
    """

    run: Run
    failure: str
    rate: float
    times: np.ndarray
    errors: np.ndarray


def compare(study: Study) -> None:
    """Judge the finest run with shifting, and convergence; show those without."""
    # Runs with shifting and without, by number of particles.
    vortices, counts = vortices_of(study.case()), study.plan.particles
    shifted = {n: decay(study, vortices, n) for n in counts}
    plain = {n: decay(study, vortices, n, "solver.shifting=0") for n in counts}
    # Rate and error of those with shifting; the finest is judged.
    coarse, fine = counts[0], counts[-1]
    for n, found in shifted.items():
        study.add("rate", found.rate, judge=n == fine, count=n)
        study.add("velocity", 100.0 * found.errors[-1], judge=n == fine, count=n)
    # Convergence and order over all numbers of particles.
    ratio = shifted[fine].errors[-1] / shifted[coarse].errors[-1]
    study.add("convergence", ratio, fine=fine, coarse=coarse)
    study.add("order", order(counts, [found.errors[-1] for found in shifted.values()]))
    time = 1.0 / vortices.decay_rate
    study.remarks.append(f"Re = {vortices.reynolds_number:.4g}, speeds fall by 1/e in {time:.4g} s")
    # Without shifting: how far they come, and how close particles get.
    for n, found in plain.items():
        history, case = found.run.history, found.run.case
        least = float(np.min(history["flow_spacing_min_m"])) * n / case["domain"]["width"]
        study.add("plain_end", history["time_s"][-1] / case["time"]["end"], count=n)
        study.add("plain_velocity", 100.0 * found.errors[-1], count=n)
        study.add("plain_rate", found.rate, count=n)
        study.add("plain_spacing", least, count=n)
        if found.failure:
            end = f"ended early at {found.times[-1]:.4g} s"
            study.remarks.append(f"without shifting, {n} a side: {end}: {found.failure}")
    draw(study, vortices, shifted, plain)


def vortices_of(case: Case) -> TaylorGreen:
    """The exact solution of the case."""
    start = case.flow.initial if case.flow is not None else None
    assert start is not None and start.kind == "taylor-green" and case.domain.width is not None
    temperature = case.initial_temperature
    return TaylorGreen(
        speed=start.speed,
        period=start.period or case.domain.width,
        viscosity=float(case.material.kinematic_viscosity_at(temperature)),
        density=case.material.density_reference,
    )


def decay(study: Study, vortices: TaylorGreen, count: int, *settings: str) -> Decay:
    """A run with `count` particles a side, to its end or until it fails."""
    case = study.case()
    wanted = [f"particles.spacing={(case.domain.width or 0.0) / count!r} m", *settings]
    if study.quick:
        wanted.append(f"time.end={case.time.end / study.plan.shortened!r} s")
    label, failure = f"{count}{'-without-shifting' if settings else ''}", ""
    # A run without shifting may fail: what it has computed is compared.
    try:
        one = study.run(label, *wanted)
    except StepFailed as error:
        one, failure = open_run(study.folder / "runs" / label), str(error)
    steps = [step for step in one.snapshots if "velocity" in step]
    errors = np.array([velocity_error(step, vortices) for step in steps])
    times = np.array([step["time"] for step in steps])
    return Decay(one, failure, energy_rate(one, vortices), times, errors)


def velocity_error(step: dict[str, Any], vortices: TaylorGreen) -> float:
    """Root of the mean square of |v - exact| over the largest exact speed of that time."""
    # v = v(0) exp(-2 nu k^2 t): errors count over the speed of their time.
    time = float(step["time"])
    expected = vortices.velocity(step["position"], time)
    square = np.mean(np.sum((step["velocity"] - expected) ** 2, axis=0))
    return float(np.sqrt(square)) / (vortices.speed * np.exp(-vortices.decay_rate * time))


def energy_rate(one: Run, vortices: TaylorGreen) -> float:
    """Slope of the logarithm of the kinetic energy over time, over the exact -4 nu k^2 [1]."""
    # Slope of ln E over time, as E falls with exp(-4 nu k^2 t).
    time, energy = one.history["time_s"], one.history["flow_kinetic_energy_J"]
    is_moving = energy > 0.0
    if np.count_nonzero(is_moving) < 3:
        return float("nan")
    slope = np.polyfit(time[is_moving], np.log(energy[is_moving]), 1)[0]
    return float(-slope / (2.0 * vortices.decay_rate))


def order(counts: list[int], errors: list[float]) -> float:
    """Order by which errors fall with the spacing, fitted over numbers of particles a side."""
    return float(-np.polyfit(np.log(np.array(counts, float)), np.log(errors), 1)[0])


def draw(
    study: Study, vortices: TaylorGreen, shifted: dict[int, Decay], plain: dict[int, Decay]
) -> None:
    """(a) kinetic energy, (b) error of the velocities over time."""
    # Energies and errors, dotted without shifting.
    energies = []
    errors = []
    longest = 0.0
    for found, style, word in ((shifted, "-", ""), (plain, ":", ", no shifting")):
        for k, (n, one) in enumerate(found.items()):
            time, energy = one.run.history["time_s"], one.run.history["flow_kinetic_energy_J"]
            longest = max(longest, float(time[-1]))
            label = f"{n} a side{word}"
            energies.append(line(time, energy / energy[0], label, k, linestyle=style))
            errors.append(line(one.times, 100.0 * one.errors, k=k, linestyle=style))
    time = np.linspace(0.0, longest, 50)
    expected = vortices.kinetic_energy(time) / vortices.kinetic_energy(0.0)
    energies.append(exact(time, expected, linestyle="--"))
    log = ("linear", "log")
    # a run that bursts leaves the picture: the others are to be told apart
    low = 0.1 * float(expected[-1])
    study.draw(
        "taylor-green",
        Panel("time [s]", "kinetic energy / initial [1]", energies, "(a)", log, low, 2.0),
        Panel("time [s]", "error of velocities [% of largest]", errors, "(b)", log, 0.1, 100.0),
        height=3.6,
    )
