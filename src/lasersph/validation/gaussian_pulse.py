"""Laser interference patterning without phase change against its exact solution.

The cases `dlip-steel` and `dlip-aluminium` with constant properties and reflectivity and without
melting: a Gaussian pulse, absorbed by Beer and Lambert, under the pattern 1 + cos(2 pi x / period).
The temperature of the surface particle at the maximum is compared at that particle's own place, and
that of the probe `even` at the surface itself.

Steps of 20 ps: backward Euler lags by half a step, 25 ps of the published 50, in which the rise
grows by 0.2-0.6 % where it is steepest. That is shown beside; the error in space is judged without.

Exact: pulse convolved with the response of the half-space, uniform part and cosine mode, by images
for the adiabatic bottom. Shorter: the uniform beam in 1-D, where runs take seconds.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lasersph.analytic.pulsed_source import gaussian_pulse_rise, interference_rise
from lasersph.case import load_case
from lasersph.output import Run
from lasersph.plots import style
from lasersph.validation.report import Report
from lasersph.validation.runs import computed
from lasersph.validation.verdict import Row, judged, shown

TITLE = "Gaussian pulse and interference pattern without phase change, against the exact solution"
SOURCE = "half-space response convolved with the pulse (erfcx), Demuth & Lasagni 2020, eq. (11)"
TOLERANCE = 0.003
"""Of the rise at that time."""
TIMES = (40, 45, 50, 55, 60, 80, 100, 150, 200)
"""[ns]"""
FLAT = ["solver.dimensions=1", "domain.extent=full", 'laser.beam={kind="uniform"}']
TOP = 'probes=[{name="maximum", depth="0 nm", method="even"}]'
NARROW = ["domain.width=1 um", 'laser.beam={kind="interference", period="1 um"}', TOP]
CASES = {
    "steel 1-D": ("dlip-steel", [*FLAT, "particles.spacing=3.97 nm"]),
    "aluminium 1-D": ("dlip-aluminium", [*FLAT, "particles.spacing=3.97 nm"]),
    "steel 2-D": ("dlip-steel", ["particles.spacing=3.97 nm"]),
    "aluminium 2-D": ("dlip-aluminium", ["particles.spacing=3.97 nm"]),
}
STEP, PUBLISHED_STEP = 20, 50
"""[ps]"""
QUICK = {
    "steel 1-D": ("dlip-steel", [*FLAT, "particles.spacing=4 nm", "time.end=60 ns"]),
    "steel 2-D": ("dlip-steel", [*NARROW, "particles.spacing=5 nm", "time.end=60 ns"]),
}
REFLECTIVITY = {"dlip-steel": 0.556, "dlip-aluminium": 0.8}


def run(out_dir: Path, *, quick: bool = False) -> Report:
    """Both metals in 1-D and 2-D; `quick` takes steel only, to 60 ns, in 2-D a period of 1 um."""
    rows: list[Row] = []
    figures = []
    for label, (name, settings) in (QUICK if quick else CASES).items():
        one = without_phase_change(name, settings, STEP, out_dir, label)
        times, temperature = one.history["time_s"], one.history["temperature_at_maximum_K"]
        place, depth = first_particle(one)
        exact = exact_temperature(name, one, times, place, depth)
        rows += compared(f"{label}: T of the particle at the maximum", one, temperature, exact)
        surface = exact_temperature(name, one, times, 0.0, 0.0)
        rows += compared(f"{label}: T of the surface", one, one.history["probe_maximum_K"], surface)
        figures.append(draw(out_dir, label, times, temperature, exact))
        if label.startswith("steel 1-D"):
            one = without_phase_change(name, settings, PUBLISHED_STEP, out_dir, label)
            T = one.history["temperature_at_maximum_K"]
            exact = exact_temperature(name, one, one.history["time_s"], place, depth)
            name_of_row = f"{label}, steps of 50 ps: T of the particle"
            rows += compared(name_of_row, one, T, exact, is_judged=False)
    return Report("gaussian-pulse", TITLE, tuple(rows), tuple(figures), (), quick)


def without_phase_change(
    name: str, settings: list[str], step: int, out_dir: Path, label: str
) -> Run:
    """Run of a case without melting, with constant reflectivity and steps up to `step` [ps]."""
    constant = ["solver.kind=conduction", "solver.phase_change=false",
                f"laser.reflectivity={REFLECTIVITY[name]}"]  # fmt: skip
    every = [*settings, f"time.step={step} ps", *constant]
    return computed(name, every, out_dir, f"{label.replace(' ', '-')}-{step}ps")


def compared(
    label: str, one: Run, temperature: np.ndarray, exact: np.ndarray, *, is_judged: bool = True
) -> list[Row]:
    """T [K] at TIMES beside the exact one, within TOLERANCE of the rise."""
    times, initial = one.history["time_s"], one.case["initial_temperature"]
    rows = []
    for at in (t for t in TIMES if t * 1e-9 <= times[-1] * (1.0 + 1e-9)):
        value, expected = _at(times, temperature, at), _at(times, exact, at)
        if is_judged:
            rows.append(judged(f"{label}, {at} ns", "K", value, expected,
                               TOLERANCE * (expected - initial), source=SOURCE))  # fmt: skip
        else:
            rows.append(shown(f"{label}, {at} ns", "K", value, reference=expected, source=SOURCE))
    return rows


def first_particle(one: Run) -> tuple[float, float]:
    """x and depth of the surface particle at the maximum [m]; x = 0 in 1-D."""
    position = one.snapshots[0]["position"]
    lateral = position[:-1]
    place = int(np.lexsort((np.sum(lateral**2, axis=0), -position[-1]))[0])
    return float(lateral[0, place]) if lateral.size else 0.0, -float(position[-1, place])


def exact_temperature(
    name: str, one: Run, times: np.ndarray, place: float, depth: float
) -> np.ndarray:
    """Exact T [K] at x = place and a depth [m], (times,)."""
    case = load_case(name)
    if case.laser is None:
        raise ValueError(f"the case {name} has no laser")
    material, T0 = case.material, case.initial_temperature
    pulse = {
        "fluence": (1.0 - REFLECTIVITY[name]) * one.case["laser"]["fluence"],
        "fwhm": one.case["laser"]["pulse"]["fwhm"],
        "center": one.case["laser"]["pulse"]["center"],
        "conductivity": float(material.conductivity_at(T0)),
        "volumetric_heat_capacity": material.density_reference
        * float(material.heat_capacity_at(T0)),
        "absorption_coefficient": case.laser.absorption_coefficient(material),
        "thickness": one.case["domain"]["depth"],
    }
    if one.case["solver"]["dimensions"] == 1:
        return T0 + gaussian_pulse_rise(depth, times, **pulse)[:, 0]
    period = one.case["domain"]["width"]
    return T0 + interference_rise(place, depth, times, period=period, **pulse)[:, 0]


def _at(times: np.ndarray, values: np.ndarray, nanoseconds: float) -> float:
    return float(np.interp(nanoseconds * 1e-9, times, values))


def draw(
    out_dir: Path, label: str, times: np.ndarray, computed_T: np.ndarray, exact: np.ndarray
) -> Path:
    """(a) temperature at the maximum over time, (b) deviation in parts of the rise."""
    figure, axes = style.new_figure(1, 2, height=3.2)
    axes[0].plot(1e9 * times, exact, color=style.GRAY, label="exact")
    axes[0].plot(1e9 * times, computed_T, "--", color=style.COLORS[0], label="SPH")
    rise = exact - exact[0]
    is_warm = rise > 10.0
    deviation = 100.0 * (computed_T - exact)[is_warm] / rise[is_warm]
    axes[1].plot(1e9 * times[is_warm], deviation, color=style.COLORS[0])
    style.label(axes[0], "time [ns]", "temperature at the maximum [K]", title=f"(a) {label}")
    style.label(axes[1], "time [ns]", "deviation [% of the rise]", title="(b)")
    style.legend(axes[0])
    return style.save(figure, out_dir / f"{label.replace(' ', '-')}.png")
