"""Temperatures under a Gaussian pulse, uniform or with an interference pattern."""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.analytic.pulsed_source import gaussian_pulse_rise, interference_rise
from lasersph.case import load_case
from lasersph.output import Run
from lasersph.validation.drawing import Panel, exact, line
from lasersph.validation.study import Study

AT_MAXIMUM = "temperature_at_maximum_K"


def compare(study: Study) -> None:
    """Judge the particle at the maximum and the surface; show what longer steps do."""
    for label, plan in study.plan.cases.items():
        # Both the particle at the maximum and the surface above it.
        one = without_phase_change(study, label, study.plan.step)
        place, depth = first_particle(one)
        expected = exact_temperature(study, plan["case"], one, place, depth)
        name = f"{label}: T of the"
        add_rows(study, f"{name} particle at the maximum", one, one.history[AT_MAXIMUM], expected)
        surface = exact_temperature(study, plan["case"], one, 0.0, 0.0)
        add_rows(study, f"{name} surface", one, one.history["probe_maximum_K"], surface)
        draw(study, label, one, expected)
        # Steps as long as the paper's, shown only.
        if label == "steel 1-D":
            one = without_phase_change(study, label, study.plan.published_step)
            expected = exact_temperature(study, plan["case"], one, place, depth)
            name = f"{label}, steps of {study.plan.published_step} ps: T of the particle"
            add_rows(study, name, one, one.history[AT_MAXIMUM], expected, judge=False)


def without_phase_change(study: Study, label: str, step: int) -> Run:
    """Run of a case without melting, with constant reflectivity and steps up to `step` [ps]."""
    plan = study.plan.cases[label]
    return study.run(
        f"{label.replace(' ', '-')}-{step}ps",
        *(study.plan.flat["settings"] if plan.get("flat") else ()),
        *plan["settings"],
        f"time.step={step} ps",
        "solver.kind=conduction",
        "solver.phase_change=false",
        f"laser.reflectivity={study.plan.reflectivity[plan['case']]}",
        case=plan["case"],
    )


def add_rows(
    study: Study,
    label: str,
    one: Run,
    temperature: np.ndarray,
    expected: np.ndarray,
    *,
    judge: bool = True,
) -> None:
    """T [K] at the times of the plan beside the exact one."""
    # Times of the plan that the run has reached.
    times, initial = one.history["time_s"], one.case["initial_temperature"]
    for at in study.plan.times:
        if at * 1e-9 <= times[-1] * (1.0 + 1e-9):
            found, T = (float(np.interp(at * 1e-9, times, x)) for x in (temperature, expected))
            study.add("rise", found, T, judge=judge, share=T - initial, label=label, time=at)


def first_particle(one: Run) -> tuple[float, float]:
    """x and depth of the surface particle at the maximum [m]; x = 0 in 1-D."""
    # Uppermost particles first, of these the one closest to x = 0.
    position = one.snapshots[0]["position"]
    lateral = position[:-1]
    place = int(np.lexsort((np.sum(lateral**2, axis=0), -position[-1]))[0])
    return float(lateral[0, place]) if lateral.size else 0.0, -float(position[-1, place])


def exact_temperature(study: Study, name: str, one: Run, place: float, depth: float) -> np.ndarray:
    """Exact T [K] at x = place and a depth [m], at all times of a run."""
    case, times = load_case(name), one.history["time_s"]
    assert case.laser is not None
    # Constant properties at the start, in the units of the solution.
    material, T0 = case.material, case.initial_temperature
    heat_capacity = material.density_reference * float(material.heat_capacity_at(T0))
    pulse: dict[str, Any] = {
        "fluence": (1.0 - study.plan.reflectivity[name]) * one.case["laser"]["fluence"],
        "fwhm": one.case["laser"]["pulse"]["fwhm"],
        "center": one.case["laser"]["pulse"]["center"],
        "conductivity": float(material.conductivity_at(T0)),
        "volumetric_heat_capacity": heat_capacity,
        "absorption_coefficient": case.laser.absorption_coefficient(material),
        "thickness": one.case["domain"]["depth"],
    }
    # One dimension, or the mean and the first harmonic over x.
    if one.case["solver"]["dimensions"] == 1:
        return T0 + gaussian_pulse_rise(depth, times, **pulse)[:, 0]
    period = one.case["domain"]["width"]
    return T0 + interference_rise(place, depth, times, period=period, **pulse)[:, 0]


def draw(study: Study, label: str, one: Run, expected: np.ndarray) -> None:
    """(a) temperature at the maximum over time, (b) deviation in parts of the rise."""
    # Deviations count where the metal is warm.
    times, found = 1e9 * one.history["time_s"], one.history[AT_MAXIMUM]
    rise = expected - expected[0]
    warm = rise > 10.0
    deviation = 100.0 * (found - expected)[warm] / rise[warm]
    over_time = [exact(times, expected), line(times, found, "SPH", linestyle="--")]
    study.draw(
        label.replace(" ", "-"),
        Panel("time [ns]", "temperature at the maximum [K]", over_time, f"(a) {label}"),
        Panel("time [ns]", "deviation [% of the rise]", [line(times[warm], deviation)], "(b)"),
        height=3.2,
    )
