"""Layer under a surface that is warm and cold in turns, against the exact slow flow.

The case `marangoni-layer`: a layer over a wall at rest, its flat free surface held at a temperature
mean + dT cos(k x), run to a steady state with 10, 20 and 40 rows of particles. Reynolds and Peclet
numbers are far below one, so that the flow is Stokes'. The speed of the surface is the sine part of
u along it, U_s = 2 <u sin(k x)>; below it u is compared where it is largest, w where it is.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lasersph.analytic.thermocapillary_layer import ThermocapillaryLayer
from lasersph.case import Case, load_case
from lasersph.observers.interpolation import interpolate
from lasersph.output import Run
from lasersph.plots import style
from lasersph.validation.report import Report
from lasersph.validation.runs import computed
from lasersph.validation.verdict import Row, at_most, judged, shown

TITLE = "Layer driven by its surface tension: speed of the surface and profiles, exact solution"
SOURCE = "exact; limit of one layer of Pendse & Esmaeeli 2010"
ROWS = (10, 20, 40)
QUICK_ROWS = (10, 20)
JUDGED_FROM = 20
"""Rows from which the speed of the surface is judged."""
SPEED_TOLERANCE = 0.02
PROFILE_TOLERANCE = 0.02
"""Root of the mean square, over the speed of the surface."""
CONVERGED = {False: 0.5, True: 0.75}
"""Error of the profiles with most over that with fewest rows, by `quick`."""
PLACES = 41


@dataclass(frozen=True)
class Layer:
    """What one run says.

    Attributes:
        one: the run. surface_speed: sine part of u along the surface [m/s].
        height: (m,) z over the depth. u, w: (m,) over the exact speed of the surface, at a quarter
            of the period and at its middle.
        error: root of the mean square error of both profiles.
    """

    one: Run
    surface_speed: float
    height: np.ndarray
    u: np.ndarray
    w: np.ndarray
    error: float


def run(out_dir: Path, *, quick: bool = False) -> Report:
    """Three spacings; `quick`: 10 and 20 rows."""
    exact = exact_solution(load_case("marangoni-layer"))
    layers = {n: layer(out_dir, n, exact) for n in (QUICK_ROWS if quick else ROWS)}
    rows: list[Row] = []
    finest, coarsest = max(layers), min(layers)
    for n, found in layers.items():
        name = f"{n} rows: speed of the surface"
        if n < JUDGED_FROM:
            rows.append(shown(name, "m/s", found.surface_speed, reference=exact.surface_speed,
                              source=SOURCE))  # fmt: skip
            rows.append(shown(f"{n} rows: RMS error of u and w in depth", "%", 100.0 * found.error))
        else:
            rows.append(
                judged(name, "m/s", found.surface_speed, exact.surface_speed,
                       SPEED_TOLERANCE * abs(exact.surface_speed), source=SOURCE)
            )  # fmt: skip
            rows.append(at_most(f"{n} rows: RMS error of u and w in depth", "%",
                                100.0 * found.error, 100.0 * PROFILE_TOLERANCE,
                                source=SOURCE))  # fmt: skip
    rows.append(at_most(f"error of the profiles, {finest} over {coarsest} rows", "1",
                        layers[finest].error / layers[coarsest].error, CONVERGED[quick],
                        source="converges"))  # fmt: skip
    remarks = (f"k b = {exact.wave_number * exact.depth:.4g}, Re = {reynolds(exact):.2g}",)
    return Report("marangoni-layer", TITLE, tuple(rows), (draw(out_dir, exact, layers),), remarks,
                  quick)  # fmt: skip


def exact_solution(case: Case) -> ThermocapillaryLayer:
    """The exact flow of the case."""
    wave, slope = case.boundaries.surface_temperature_wave, case.material.surface_tension_slope
    if wave is None or slope is None:
        raise ValueError(f"{case.name} has no surface whose temperature varies")
    temperature = case.boundaries.surface_temperature or case.initial_temperature
    return ThermocapillaryLayer(
        depth=case.domain.depth,
        period=wave.period,
        amplitude=wave.amplitude,
        surface_tension_slope=float(case.material.at("surface_tension_slope", temperature)),
        viscosity=float(case.material.viscosity_at(temperature)),
    )


def layer(out_dir: Path, count: int, exact: ThermocapillaryLayer) -> Layer:
    """Run with `count` rows, compared."""
    settings = [f"particles.spacing={exact.depth / count!r} m"]
    one = computed("marangoni-layer", settings, out_dir, f"{count}-rows")
    last = one.snapshots[-1]
    height = -(np.arange(PLACES) + 0.5) / PLACES
    quarter = np.full(PLACES, 0.25 * exact.period)
    crest = np.stack([quarter, height * exact.depth])
    node = np.stack([0.0 * quarter, height * exact.depth])
    u = interpolate(last["position"], last["velocity"], crest, degree=2)[0]
    w = interpolate(last["position"], last["velocity"], node, degree=2)[1]
    errors = np.concatenate([u - exact.velocity(crest)[0], w - exact.velocity(node)[1]])
    scale = abs(exact.surface_speed)
    return Layer(
        one, sine_part(one, exact), height, u / scale, w / scale,
        float(np.sqrt(np.mean(errors**2))) / scale,
    )  # fmt: skip


def sine_part(one: Run, exact: ThermocapillaryLayer) -> float:
    """U_s of u = U_s sin(k x) along the surface of the last snapshot [m/s], by least squares."""
    last = one.snapshots[-1]
    cells = np.flatnonzero(last["surface"])
    sine = np.sin(exact.wave_number * last["position"][0, cells])
    return float(sine @ last["surface_velocity"][cells] / (sine @ sine))


def reynolds(exact: ThermocapillaryLayer) -> float:
    """U_s b/nu."""
    density = load_case("marangoni-layer").material.density_reference
    return abs(exact.surface_speed) * exact.depth * density / exact.viscosity


def draw(out_dir: Path, exact: ThermocapillaryLayer, layers: dict[int, Layer]) -> Path:
    """(a) u where it is largest and (b) w where it is, over the depth."""
    figure, axes = style.new_figure(1, 2, height=3.6)
    z = np.linspace(-1.0, 0.0, 200)
    scale = abs(exact.surface_speed)
    quarter = np.full(z.size, 0.25 * exact.period)
    u = exact.velocity(np.stack([quarter, z * exact.depth]))[0] / scale
    w = exact.velocity(np.stack([0.0 * quarter, z * exact.depth]))[1] / scale
    for one, values in zip(axes, (u, w), strict=True):
        one.plot(values, z, color=style.GRAY, label="exact")
    for k, (count, found) in enumerate(layers.items()):
        mark = {"color": style.COLORS[k], "markersize": 3, "label": f"{count} rows"}
        axes[0].plot(found.u, found.height, "os^"[k], **mark)
        axes[1].plot(found.w, found.height, "os^"[k], **mark)
    style.label(axes[0], "u / speed of the surface [1]", "z / depth [1]", title="(a) x = period/4")
    style.label(axes[1], "w / speed of the surface [1]", "z / depth [1]", title="(b) x = 0")
    style.legend(axes[0])
    return style.save(figure, out_dir / "marangoni-layer.png")
