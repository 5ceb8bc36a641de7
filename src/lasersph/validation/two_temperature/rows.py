"""Electrons and lattice beside exact solutions, beside one temperature, and their energies."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.analytic.two_temperatures import HalfSpace, pulse_rise
from lasersph.case import Case
from lasersph.output import Run
from lasersph.simulation.case_forecast import skin_estimate
from lasersph.studies.fluence_threshold import Event, threshold
from lasersph.validation.drawing import Panel, exact, marks
from lasersph.validation.runs import run_case
from lasersph.validation.study import Study

PARTS = {"electrons": "electron_temperature", "lattice": "temperature"}

DRAWN = 1e-6
"""Depth of the figure [m]."""


def compare(study: Study) -> None:
    """Judge the half space, the two limits, the energy, and thresholds beside published ones."""
    half_space(study)
    strong_coupling(study)
    long_pulse(study)
    energy(study)
    ablation(study)
    gold_coating(study)
    films(study)


def half_space(study: Study) -> None:
    """Rises at some depths and times, within a share of the largest one there."""
    plan = study.plan
    times = 1e-12 * np.array(plan.times)
    one = study.run(
        "half-space",
        f"particles.spacing={plan.spacing} nm",
        *plan.constant,
        f"output.snapshots.times={[f'{time} ps' for time in plan.times]}",
    )
    taken = zip(one.snapshots.times, one.snapshots, strict=True)
    snapshots = {round(1e12 * float(time), 6): shot for time, shot in taken}
    depth = -snapshots[plan.times[0]]["position"][-1]
    for wanted in plan.depths:
        place = int(np.argmin(np.abs(depth - 1e-9 * wanted)))
        rises = pulse_rise(float(depth[place]), times, exact_body())
        for part, expected in zip(PARTS, rises, strict=True):
            largest = float(np.max(expected))
            found = [float(snapshots[t][PARTS[part]][place]) for t in plan.times]
            for time, T, rise in zip(plan.times, found, expected, strict=True):
                labels = {"part": part, "depth": wanted, "time": time}
                study.add("rise", T, 300.0 + float(rise), share=largest, **labels)
    draw(study, one)


def exact_body() -> HalfSpace:
    """The half space of the plan: its lattice has what the electrons leave of 2511 J/(kg K)."""
    return HalfSpace(2.1e4, 2.49e6, 2.1e16, 318.0, 8e6, 10.0, 150e-15, 0.5e-12)


def strong_coupling(study: Study) -> None:
    """The surface with a strong coupling, beside one temperature."""
    plan = study.plan
    runs = [
        study.run(f"strong-{heat}", *plan.constant, *plan.strong, f"solver.heat={heat}-temperature")
        for heat in ("two", "one")
    ]
    for number, time in enumerate(runs[0].snapshots.times):
        if round(1e9 * float(time), 3) in plan.strong_times:
            both = (run.snapshots[number]["temperature"] for run in runs)
            found, wanted = (float(np.max(T)) - 300.0 for T in both)
            study.add("strong", found, wanted, time=round(1e9 * float(time), 3))


def long_pulse(study: Study) -> None:
    """Melt depth of steel under a pulse of 10 ns, with two temperatures and with one."""
    depths = [
        study.run(
            f"steel-{heat}", *study.plan.steel, f"solver.heat={heat}-temperature", case="dlip-steel"
        ).summary["melt"]["volume_max_m3"]
        for heat in ("two", "one")
    ]
    study.add("melt", 1e9 * depths[0], 1e9 * depths[1])


def energy(study: Study) -> None:
    """Heat of electrons and lattice of gold that melts, over what was absorbed."""
    one = study.run("gold")
    seen, absorbed = one.summary["electrons"], one.summary["energy"]["absorbed_J"]
    study.add("energy", (seen["energy_J"] + seen["lattice_energy_J"]) / absorbed, 1.0)
    study.add("latent", 1e9 * one.summary["melt"]["depth_half_max_m"])


def ablation(study: Study) -> None:
    """Both estimates of ablation beside thresholds measured in air, and where melting begins."""
    seen: set[str] = set()
    for one in study.plan.measured:
        metal, measured = one["metal"], one["threshold"]
        start = (f"material={metal}", *study.plan.short, f"laser.fluence={measured} J/cm^2")
        case = study.case(*start, *light(one))
        words = {"metal": metal, "paper": one["source"]}
        add_threshold(study, "skin", skin_estimate(case), measured, **words)
        if "explodes" in one:
            found = lowest(study, case, "explode", f"{metal}-explode", one["explodes"])
            add_threshold(study, "explosion", found, measured, **words)
        if metal not in seen:
            study.add("molten", lowest(study, case, "melt", f"{metal}-melt"), metal=metal)
            seen.add(metal)


def light(one: dict[str, Any]) -> tuple[str, ...]:
    """Settings of the light of an experiment: n and k that hot electrons change, or R and alpha."""
    if "refraction" not in one:
        return (
            f"laser.reflectivity={one['reflectivity']}",
            f"laser.absorption.absorption_coefficient={one['absorption']} 1/m",
        )
    n, k = one["refraction"]
    optics = f"refractive_index = {n}, extinction_coefficient = {k}, source = 'see README'"
    wavelength = one["wavelength"]
    return (
        f'material.optics.by_wavelength={{ "{wavelength}" = {{ {optics} }} }}',
        f"laser.wavelength={wavelength}",
    )


def gold_coating(study: Study) -> None:
    """Fluence from which gold melts, beside one that damages mirrors of gold."""
    case = study.case(*study.plan.short, *study.plan.coating)
    found = lowest(study, case, "melt", "gold-coating")
    add_threshold(study, "damage", found, study.comparisons["damage"].reference or 0.0)


def films(study: Study) -> None:
    """Absorbed fluences that melt free films, beside published ones."""
    for one in study.plan.films:
        metal, depth = one["metal"], one["depth"]
        case = study.case(
            *study.plan.film,
            f"material={metal}",
            f"domain.depth={depth} nm",
            f"laser.fluence={one['fluence']} J/m^2",
            f"laser.absorption.absorption_coefficient={one['absorption']} 1/m",
        )
        electrons = case.material.electrons
        assert electrons is not None and case.laser is not None
        # what light and electrons' range leave in the film
        reach = 1.0 / case.laser.absorption_coefficient(case.material)
        reach += electrons.ballistic_range or 0.0
        taken = 1.0 - float(np.exp(-case.domain.depth / reach))
        found = 1e4 * taken * lowest(study, case, "melt", f"{metal}-film")
        words = {"metal": metal, "depth": depth, "paper": one["source"]}
        add_threshold(study, "film", found, one["threshold"], **words)


def lowest(
    study: Study, case: Case, of: Event, name: str, ends: list[float] | None = None
) -> float:
    """Threshold of a case, between two ends where they are given [J/cm^2]."""

    def kept(one: Case, folder: str | PathLike[str]) -> Any:
        return run_case(one, Path(folder), threads=study.threads, backend=study.device)

    tolerance, folder = study.plan.tolerance, study.folder / "runs" / name
    bracket = (1e4 * ends[0], 1e4 * ends[1]) if ends else None
    return 1e-4 * threshold(case, of, folder, tolerance=tolerance, bracket=bracket, run=kept).value


def add_threshold(
    study: Study, kind: str, found: float | None, measured: float, **words: Any
) -> None:
    """A row whose band is a factor either way: below the measured one it is 1 - 1/1.5."""
    is_below = found is not None and found < measured
    study.add(kind, found, measured, share=2.0 / 3.0 if is_below else 1.0, **words)


def draw(study: Study, one: Run) -> None:
    """Both temperatures over depth at the last time but one, beside exact ones."""
    time, shot = one.snapshots.times[-2], one.snapshots[len(one.snapshots) - 2]
    depth = -shot["position"][-1]
    order = np.argsort(depth)
    places = depth[order][depth[order] < DRAWN]
    panels = []
    for number, (part, name) in enumerate(PARTS.items()):
        rises = [pulse_rise(float(z), float(time), exact_body(), 8001)[number] for z in places[::4]]
        curve = exact(1e9 * places[::4], 300.0 + np.ravel(rises))
        points = marks(1e9 * places[::8], shot[name][order][: places.size : 8], "SPH")
        panels.append(Panel("depth [nm]", f"{part} [K]", [curve, points]))
    study.draw("half-space", *panels)
