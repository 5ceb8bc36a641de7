"""Pressure of water at rest over wall particles, at every snapshot."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lasersph.output import Run
from lasersph.validation.drawing import Panel, exact, line, marks
from lasersph.validation.study import Study


@dataclass(frozen=True)
class Column:
    """Numbers of a run at its snapshots (k,), over the exact pressure at the bottom.

    Attributes:
        run: where they are from. slope: dP/d(depth) over rho g. bottom: pressure of the fitted line
            at the bottom. deviation: root of the mean square of the particles' deviations from
            rho g depth.
    """

    run: Run
    slope: np.ndarray
    bottom: np.ndarray
    deviation: np.ndarray


def compare(study: Study) -> None:
    """Judge the worst of all snapshots in every dimension."""
    columns: dict[str, Column] = {}
    for dimension in study.plan.dimensions:
        # A run in each dimension; the worst snapshot counts.
        name = f"{dimension}-D"
        one = study.run(f"{dimension}d", f"solver.dimensions={dimension}", *study.plan.settings)
        columns[name] = found = fit_lines(one, *weight(study))
        # Drift: the mean of the second half against that of the first.
        half = one.snapshots.times.size // 2
        drift = abs(float(np.mean(found.bottom[half:]) - np.mean(found.bottom[1:half])))
        study.add("slope", 100.0 * float(np.max(np.abs(found.slope - 1.0))), name=name)
        study.add("bottom", 100.0 * float(np.max(np.abs(found.bottom - 1.0))), name=name)
        study.add("deviation", 100.0 * float(np.max(found.deviation)), name=name)
        study.add("drift", 100.0 * drift, name=name)
        study.add("speed", one.summary["motion"]["speed_max_m_s"], name=name)
    draw(study, columns)


def weight(study: Study) -> tuple[float, float]:
    """rho g [Pa/m] and the depth [m] of the case."""
    case = study.case()
    gravity = case.model_dump()["solver"]["gravity"]
    return case.material.density_reference * gravity, case.domain.depth


def fit_lines(one: Run, gradient: float, depth: float) -> Column:
    """Lines through the pressures of each snapshot; args as of `weight`."""
    found = []
    # A line through the pressures of all particles, and their distance from rho g depth.
    for snapshot in one.snapshots:
        below, pressure = -snapshot["position"][-1], snapshot["pressure"]
        slope, offset = np.polyfit(below, pressure, 1)
        deviation = np.sqrt(np.mean((pressure - gradient * below) ** 2))
        found.append((slope / gradient, offset + slope * depth, deviation))
    slope, bottom, deviation = np.array(found).T
    scale = gradient * depth
    return Column(one, slope, bottom / scale, deviation / scale)


def draw(study: Study, columns: dict[str, Column]) -> None:
    """(a) pressure over depth at the end, (b) pressure at the bottom over time."""
    gradient, depth = weight(study)
    at_end, at_bottom = [exact([0.0, depth], [0.0, 1e-3 * gradient * depth], "rho g z")], []
    # At the end over the depth, and over time at the bottom.
    for k, (name, found) in enumerate(columns.items()):
        last, times = found.run.snapshots[-1], found.run.snapshots.times
        at_end.append(marks(-last["position"][-1], 1e-3 * last["pressure"], name, k))
        at_bottom.append(line(times, found.bottom, name, k))
    at_bottom += [exact(times[[0, -1]], [edge, edge], "") for edge in (0.99, 1.01)]
    study.draw(
        "hydrostatic-column",
        Panel("depth [m]", "pressure [kPa]", at_end, "(a) at the end"),
        Panel("time [s]", "pressure at the bottom / exact [1]", at_bottom, "(b)"),
    )
