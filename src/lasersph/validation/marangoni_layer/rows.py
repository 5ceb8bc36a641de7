"""Speed of the surface and profiles of a layer that its surface tension drives."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lasersph.analytic.thermocapillary_layer import ThermocapillaryLayer
from lasersph.case import Case
from lasersph.observers.interpolation import interpolate
from lasersph.output import Run
from lasersph.validation.drawing import Panel, exact, marks
from lasersph.validation.study import Study

PLACES = 41
"""Heights at which profiles are compared."""


@dataclass(frozen=True)
class Layer:
    """Surface speed and profiles of one run.

    Attributes:
        surface_speed: sine part of u along the surface [m/s]. height: (m,) z over the depth.
        u, w: (m,) over the exact speed of the surface, at a quarter of the period and at its
            middle. error: root of the mean square error of both profiles.
    """

    surface_speed: float
    height: np.ndarray
    u: np.ndarray
    w: np.ndarray
    error: float


def compare(study: Study) -> None:
    """Judge surface and profiles from some number of rows on, and convergence."""
    solution = exact_solution(study.case())
    layers = {n: layer(study, n, solution) for n in study.plan.rows}
    # Runs with few rows are shown, not judged.
    for n, found in layers.items():
        judge, name = n >= study.plan.judged_from, "profiles"
        study.add("speed", found.surface_speed, solution.surface_speed, judge=judge, rows=n)
        study.add(name if judge else f"coarse_{name}", 100.0 * found.error, rows=n)
    fine, coarse = max(layers), min(layers)
    ratio = layers[fine].error / layers[coarse].error
    study.add("convergence", ratio, fine=fine, coarse=coarse)
    # Wave number and Reynolds number, which the solution takes as small.
    density = study.case().material.density_reference
    reynolds = abs(solution.surface_speed) * solution.depth * density / solution.viscosity
    wave = solution.wave_number * solution.depth
    study.remarks.append(f"k b = {wave:.4g}, Re = {reynolds:.2g}")
    draw(study, solution, layers)


def exact_solution(case: Case) -> ThermocapillaryLayer:
    """The exact flow of the case."""
    wave, slope = case.boundaries.surface_temperature_wave, case.material.surface_tension_slope
    assert wave is not None and slope is not None
    temperature = case.boundaries.surface_temperature or case.initial_temperature
    return ThermocapillaryLayer(
        depth=case.domain.depth,
        period=wave.period,
        amplitude=wave.amplitude,
        surface_tension_slope=float(case.material.at("surface_tension_slope", temperature)),
        viscosity=float(case.material.viscosity_at(temperature)),
    )


def layer(study: Study, count: int, solution: ThermocapillaryLayer, *settings: str) -> Layer:
    """A run with `count` rows, and further settings, measured at the center of each height."""
    spacing = f"particles.spacing={solution.depth / count!r} m"
    # Velocities at the columns where u and w are largest.
    one = study.run("-".join([f"{count}-rows", *settings]), spacing, *settings)
    last = one.snapshots[-1]
    height = -(np.arange(PLACES) + 0.5) / PLACES
    crest, node = columns(solution, height)
    u = interpolate(last["position"], last["velocity"], crest, degree=2)[0]
    w = interpolate(last["position"], last["velocity"], node, degree=2)[1]
    # Error of both profiles together, over the speed of the surface.
    errors = np.concatenate([u - solution.velocity(crest)[0], w - solution.velocity(node)[1]])
    scale = abs(solution.surface_speed)
    error = float(np.sqrt(np.mean(errors**2))) / scale
    return Layer(sine_part(one, solution), height, u / scale, w / scale, error)


def columns(solution: ThermocapillaryLayer, height: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places (2, m) at heights over the depth where u is largest, and where w is."""
    quarter = np.full(height.size, 0.25 * solution.period)
    z = height * solution.depth
    return np.stack([quarter, z]), np.stack([0.0 * quarter, z])


def sine_part(one: Run, solution: ThermocapillaryLayer) -> float:
    """U_s of u = U_s sin(k x) along the surface of the last snapshot [m/s], by least squares."""
    last = one.snapshots[-1]
    cells = np.flatnonzero(last["surface"])
    # Least squares of one function: (sine . u) / (sine . sine).
    sine = np.sin(solution.wave_number * last["position"][0, cells])
    return float(sine @ last["surface_velocity"][cells] / (sine @ sine))


def draw(study: Study, solution: ThermocapillaryLayer, layers: dict[int, Layer]) -> None:
    """(a) u where it is largest and (b) w where it is, over the depth."""
    z = np.linspace(-1.0, 0.0, 200)
    crest, node = columns(solution, z)
    scale = abs(solution.surface_speed)
    on_crest = [exact(solution.velocity(crest)[0] / scale, z)]
    on_node = [exact(solution.velocity(node)[1] / scale, z)]
    for k, (count, found) in enumerate(layers.items()):
        on_crest.append(marks(found.u, found.height, f"{count} rows", k))
        on_node.append(marks(found.w, found.height, k=k))
    study.draw(
        "marangoni-layer",
        Panel("u / speed of the surface [1]", "z / depth [1]", on_crest, "(a) x = period/4"),
        Panel("w / speed of the surface [1]", "z / depth [1]", on_node, "(b) x = 0"),
        height=3.6,
    )
