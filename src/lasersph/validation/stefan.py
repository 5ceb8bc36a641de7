"""One-phase Stefan problem against Neumann's solution: the front within 1 % and converging.

The case `stefan`: aluminium at its melting point (0.01 K below it), its face held 400 K above. The
front is the thickness of molten metal, sum_i f_m dz_i, at the end of the run.

Exact: s = 2 lambda sqrt(D t), sqrt(pi) lambda exp(lambda^2) erf(lambda) = c_p (T_hot - T_m) / L_f
[Alexiades1993, Chapter 2.1].
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lasersph.analytic.stefan import Melting, Phase
from lasersph.case import Case, load_case
from lasersph.output import Run
from lasersph.plots import style
from lasersph.validation.report import Report
from lasersph.validation.runs import computed
from lasersph.validation.verdict import Row, at_most, judged, shown

TITLE = "Melting from a hot face: front and temperature against Neumann's exact solution"
SOURCE = "Neumann's solution; Alexiades & Solomon 1993, Chapter 2.1"
SPACINGS = (400, 200, 100)
QUICK_SPACINGS = (800, 400)
FRONT_TOLERANCE = 0.01
TEMPERATURE_TOLERANCE = 0.01
"""Of the superheat, on average over the liquid."""


def run(out_dir: Path, *, quick: bool = False) -> Report:
    """Compute the front at three spacings [nm]; `quick`: two coarse ones, a quarter of the time."""
    spacings = QUICK_SPACINGS if quick else SPACINGS
    short = ["time.end=250 ns", "time.step=2 ns", "output.snapshots.interval=25 ns"]
    settings = short if quick else []
    case = load_case("stefan", settings)
    exact = exact_solution(case)
    end = case.time.end
    runs = {
        d: computed("stefan", [f"particles.spacing={d} nm", *settings], out_dir, f"{d}nm")
        for d in spacings
    }
    front = float(exact.front(end))
    rows: list[Row] = [
        judged(f"front after {end * 1e9:.0f} ns, spacing {d} nm", "um", 1e6 * fronts(one)[-1],
               1e6 * front, 1e6 * FRONT_TOLERANCE * front, source=SOURCE)
        for d, one in runs.items()
    ]  # fmt: skip
    errors = {d: mean_front_error(one, exact) for d, one in runs.items()}
    rows += [
        shown(f"mean error of the front over the run, spacing {d} nm", "nm", 1e9 * error,
              source=SOURCE)
        for d, error in errors.items()
    ]  # fmt: skip
    rows.append(
        at_most(f"mean error of the front, {spacings[-1]} nm over {spacings[0]} nm", "1",
                errors[spacings[-1]] / errors[spacings[0]], 0.75, source="converges")
    )  # fmt: skip
    rows.append(
        at_most(f"mean error of T in the liquid at the end, spacing {spacings[-1]} nm", "%",
                100.0 * temperature_error(runs[spacings[-1]], exact),
                100.0 * TEMPERATURE_TOLERANCE, source=SOURCE)
    )  # fmt: skip
    remarks = (f"lambda = {exact.front_constant:.6f}, Stefan number {exact.stefan_number:.4f}",)
    figures = (draw(out_dir, runs, exact),)
    return Report("stefan", TITLE, tuple(rows), figures, remarks, quick)


def exact_solution(case: Case) -> Melting:
    """Neumann's solution with the case's material and temperatures."""
    material = case.material
    melting, hot = material.melting, case.boundaries.surface_temperature
    if melting is None or hot is None:
        raise ValueError("the case neither melts nor is held hot")
    temperature = case.initial_temperature
    phase = Phase(
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


def mean_front_error(one: Run, exact: Melting) -> float:
    """Mean |front - exact| over the snapshots after the first [m]."""
    return float(np.mean(np.abs(fronts(one) - exact.front(one.snapshots.times))[1:]))


def temperature_error(one: Run, exact: Melting) -> float:
    """Mean |T - exact| over the liquid particles at the end, over the superheat."""
    last: dict[str, Any] = one.snapshots[-1]
    is_liquid = last["melt_fraction"] >= 1.0
    expected = exact.temperature(-last["position"][-1][is_liquid], last["time"])
    superheat = exact.surface_temperature - exact.melting_temperature
    return float(np.mean(np.abs(last["temperature"][is_liquid] - expected)) / superheat)


def draw(out_dir: Path, runs: dict[int, Run], exact: Melting) -> Path:
    """(a) front over time, (b) temperature over depth at the end."""
    figure, axes = style.new_figure(1, 2, height=3.4)
    finest = list(runs.values())[-1]
    time = np.linspace(0.0, finest.snapshots.times[-1], 200)
    axes[0].plot(1e9 * time, 1e6 * exact.front(time), color=style.GRAY, label="exact")
    depth = np.linspace(1e-9, 2.0 * float(exact.front(time[-1])), 300)
    axes[1].plot(1e6 * depth, exact.temperature(depth, time[-1]), color=style.GRAY, label="exact")
    for k, (spacing, one) in enumerate(runs.items()):
        mark = {"color": style.COLORS[k], "marker": "os^"[k], "linestyle": "", "markersize": 3}
        axes[0].plot(1e9 * one.snapshots.times, 1e6 * fronts(one), label=f"{spacing} nm", **mark)
        last = one.snapshots[-1]
        is_near = -last["position"][-1] < depth[-1]
        axes[1].plot(
            -1e6 * last["position"][-1][is_near], last["temperature"][is_near],
            label=f"{spacing} nm", **mark,
        )  # fmt: skip
    style.label(axes[0], "time [ns]", "depth of the front [µm]", title="(a)")
    style.label(axes[1], "depth [µm]", "temperature [K]", title="(b) at the end")
    style.legend(axes[0])
    return style.save(figure, out_dir / "stefan.png")
