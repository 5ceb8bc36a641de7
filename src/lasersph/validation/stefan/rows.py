"""Fronts and temperatures of runs at several spacings beside Neumann's solution."""

from __future__ import annotations

import numpy as np

from lasersph.analytic.stefan import Melting, PhaseProperties
from lasersph.case import Case
from lasersph.output import Run
from lasersph.validation.drawing import Panel, exact, marks
from lasersph.validation.study import Study


def compare(study: Study) -> None:
    """Judge the front at every spacing, its convergence, and the temperature of the finest run."""
    settings, spacings = study.plan.settings, study.plan.spacings
    # The exact solution, and runs by spacing.
    case = study.case(*settings)
    solution, end = exact_solution(case), case.time.end
    runs = {
        d: study.run(f"{d}nm", f"particles.spacing={d} nm", *settings) for d in study.plan.spacings
    }
    # Front at the end, its mean error, and the molten volume.
    for d, one in runs.items():
        front = 1e6 * float(solution.front(end))
        study.add("front", 1e6 * fronts(one)[-1], front, share=1e-3 * d, end=1e9 * end, spacing=d)
    errors = {d: mean_front_error(one, solution) for d, one in runs.items()}
    for d, error in errors.items():
        study.add("front_error", 1e9 * error, spacing=d)
    for d, one in runs.items():
        volume = 1e6 * one.summary["melt"]["volume_max_m3"]
        front = 1e6 * float(solution.front(end))
        study.add("melt_volume", volume, front, share=1e-3 * d, spacing=d)
    # Convergence, and the temperature of the finest run.
    coarse, fine = spacings[0], spacings[-1]
    study.add("convergence", errors[fine] / errors[coarse], fine=fine, coarse=coarse)
    error = temperature_error(runs[fine], solution)
    study.add("temperature_error", 100.0 * error, spacing=fine)
    study.remarks.append(
        f"lambda = {solution.front_constant:.6f}, Stefan number {solution.stefan_number:.4f}"
    )
    draw(study, runs, solution)


def exact_solution(case: Case) -> Melting:
    """Neumann's solution with the case's material and temperatures."""
    material = case.material
    # Both phases have the properties of the start.
    melting, hot = material.melting, case.boundaries.surface_temperature
    assert melting is not None and hot is not None
    temperature = case.initial_temperature
    phase = PhaseProperties(
        float(material.conductivity_at(temperature)), float(material.heat_capacity_at(temperature))
    )
    return Melting(
        surface_temperature=hot,
        melting_temperature=melting.solidus,
        initial_temperature=temperature,
        latent_heat=melting.latent_heat,
        density=material.density_reference,
        liquid=phase,
    )


def fronts(one: Run) -> np.ndarray:
    """Thickness of molten metal [m] at each snapshot."""
    return np.array([np.sum(s["melt_fraction"] * s["width"][-1]) for s in one.snapshots])


def mean_front_error(one: Run, solution: Melting) -> float:
    """Mean |front - exact| over the snapshots after the first [m]."""
    return float(np.mean(np.abs(fronts(one) - solution.front(one.snapshots.times))[1:]))


def temperature_error(one: Run, solution: Melting) -> float:
    """Mean |T - exact| over the liquid particles at the end, over the superheat."""
    last = one.snapshots[-1]
    # Fully molten particles at their depths.
    is_liquid = last["melt_fraction"] >= 1.0
    expected = solution.temperature(-last["position"][-1][is_liquid], last["time"])
    superheat = solution.surface_temperature - solution.melting_temperature
    return float(np.mean(np.abs(last["temperature"][is_liquid] - expected)) / superheat)


def draw(study: Study, runs: dict[int, Run], solution: Melting) -> None:
    """(a) front over time, (b) temperature over depth at the end."""
    # Fronts over time, temperatures over the depth at the end.
    end = list(runs.values())[-1].snapshots.times[-1]
    time = np.linspace(0.0, end, 200)
    depth = np.linspace(1e-9, 2.0 * float(solution.front(end)), 300)
    over_time = [exact(1e9 * time, 1e6 * solution.front(time))]
    over_depth = [exact(1e6 * depth, solution.temperature(depth, end))]
    for k, (spacing, one) in enumerate(runs.items()):
        over_time.append(marks(1e9 * one.snapshots.times, 1e6 * fronts(one), f"{spacing} nm", k))
        last = one.snapshots[-1]
        z, T = -last["position"][-1], last["temperature"]
        over_depth.append(marks(1e6 * z[z < depth[-1]], T[z < depth[-1]], k=k))
    study.draw(
        "stefan",
        Panel("time [ns]", "depth of the front [µm]", over_time, "(a)"),
        Panel("depth [µm]", "temperature [K]", over_depth, "(b) at the end"),
    )
