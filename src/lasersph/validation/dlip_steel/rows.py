"""Melt pools that flow under interfering beams beside finite volumes and the paper's numbers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from lasersph.observers.interpolation import interpolate
from lasersph.output import Run
from lasersph.validation.comparison import Words, number_at
from lasersph.validation.dlip_steel.figures import draw
from lasersph.validation.study import Study

Runs = dict[tuple[float, str], Run]
"""By fluence [J/cm2] and reading of the plateau."""
ROW_BELOW = 3.97e-9
"""Depth of the second row of particles at the published spacing [m]."""


def compare(study: Study) -> None:
    """All fluences in all readings of the plateau, the detailed one, and the experiment."""
    plan = study.plan
    runs: Runs = {}
    # Every fluence in every reading.
    for plateau in plan.plateaus:
        for fluence in plan.fluences:
            runs[fluence, plateau] = one = run_pool(study, fluence, plateau)
            add_common(study, f"{fluence} {plateau}", one)
    # The detailed run, with and without Marangoni stress.
    detail, label = runs[plan.detail, "hold"], f"{plan.detail} hold"
    still = run_pool(study, plan.detail, "hold", "solver.marangoni=false", label="-still")
    add_detail(study, label, detail)
    add_sizes(study, label, detail, still)
    add_paper(study, label, detail)
    # Claims compare fluences, the experiment has one of its own.
    if len(plan.fluences) > 1:
        add_claims(study, runs)
    if plan.experiment:
        add_experiment(study)
    draw(study, runs, still, lambda depths: profile_below(study, detail, depths))


def run_pool(study: Study, fluence: float, plateau: str, *settings: str, label: str = "") -> Run:
    """Run at a fluence [J/cm2] in a folder named after it."""
    plan = study.plan
    # The detailed run alone has the published spacing.
    is_detail = plateau == "hold" and fluence == plan.detail and label != "-fig12"
    spacing = plan.detail_spacing if is_detail else plan.spacing
    times = ", ".join(f'"{t:g} ns"' for t in plan.profile_times if t <= plan.end)
    return study.run(
        f"{plan.case}-{fluence}-{plateau}-{spacing:g}nm{label}",
        "solver.kind=melt-pool",
        f"laser.fluence={fluence} J/cm^2",
        f"particles.spacing={spacing} nm",
        f"solver.plateau={plateau}",
        f"time.end={plan.end:g} ns",
        f"output.snapshots.times=[{times}]",
        *settings,
    )


def at_instant(study: Study, one: Run, column: str) -> float:
    """Value of a history column at the instant of the reference."""
    return float(np.interp(1e-9 * study.plan.instant, one.history["time_s"], one.history[column]))


def profile_below(study: Study, one: Run, depths: np.ndarray) -> np.ndarray:
    """u [m/s] at depths (m,) [m] below the place of the largest speed at the instant, (m,)."""
    # Particles around the column below the fastest place.
    x = at_instant(study, one, "flow_surface_speed_max_x_m")
    step = one.snapshots.nearest(1e-9 * study.plan.instant)
    near = np.abs(step["position"][0] - x) < 12.0 * np.min(step["width"])
    places = np.stack([np.full(depths.size, x), -depths])
    return interpolate(step["position"][:, near], step["velocity"][0, near], places)


def add_common(study: Study, label: str, one: Run) -> None:
    """Add the numbers of every run, and its energy balance."""
    # Balance of energy, least distance, and numbers that rows.toml names.
    study.add("imbalance", abs(one.summary["energy"]["imbalance_relative"]), label=label)
    least = number_at(one.summary, "flow.spacing_min_m", 1.0 / one.summary["spacing_m"])
    study.add("spacing", least, label=label)
    study.add_group("common", one, label=label)


def add_detail(study: Study, label: str, one: Run) -> None:
    """Velocities, place and layer against finite volumes."""
    # References by their names, at the instant that they hold for.
    table, share = study.table(), study.plan.share
    wanted = dict(zip(table["quantity"], table["value"], strict=True))
    name = f"{label}, {study.plan.instant:g} ns"
    words: Words = {"label": label, "name": name, "share": share}
    # Largest speed and when.
    largest = number_at(one.summary, "flow.surface_speed_max_m_s")
    when = number_at(one.summary, "flow.surface_speed_max_at_s", 1e9)
    study.add("largest", largest, wanted["largest"], **words)
    study.add("largest_at", when, wanted["largest_at"], **words)
    # Surface and return flow at the instant, then the second row of particles.
    columns = {"surface": "flow_surface_speed_max_m_s", "back": "flow_return_speed_m_s"}
    for key, column in columns.items():
        study.add(key, at_instant(study, one, column), wanted[key], **words)
    below = float(profile_below(study, one, np.array([ROW_BELOW]))[0])
    study.add("below", below, wanted["below"], **words)
    # Place of the largest speed, and thickness of the layer.
    place = 1e6 * at_instant(study, one, "flow_surface_speed_max_x_m")
    layer = 1e9 * at_instant(study, one, "flow_layer_thickness_m")
    study.add("place", place, known(wanted["place"]), **words)
    published = study.plan.paper["layer"]
    study.add("layer", layer, known(wanted["layer"]), published=published, **words)
    # The profile below it.
    profile = study.table("profile.csv")
    values = profile_below(study, one, 1e-9 * profile["depth"])
    words["share"] = share * wanted["surface"]
    for depth, u, found in zip(profile["depth"], profile["u"], values, strict=True):
        study.add("profile", found, u, depth=depth, **words)


def known(value: float) -> float | None:
    """A number of a table; None where its cell is empty."""
    return None if np.isnan(value) else value


def add_sizes(study: Study, label: str, one: Run, still: Run) -> None:
    """Largest width and depth against those of the same run without Marangoni stress."""
    share = study.plan.share * study.plan.size_band
    # Without Marangoni stress nothing carries heat sideways.
    for level, suffix in (("f_m = 1", ""), ("f_m = 0.5", "_half")):
        for quantity in ("width", "depth"):
            path = f"melt.{quantity}{suffix}_max_m"
            found, wanted = (number_at(run.summary, path, 1e9) for run in (one, still))
            words: Words = {"label": label, "quantity": quantity, "level": level}
            study.add("size", found, wanted or np.nan, share=share, **words)


def add_paper(study: Study, label: str, one: Run) -> None:
    """Numbers that only the text of the paper has."""
    paper, name = study.plan.paper, f"{label}, {study.plan.instant:g} ns"
    # Numbers that follow from the estimate of the speed, delta/eta |dgamma/dT dT/dx|.
    estimate = at_instant(study, one, "flow_estimate_m_s")
    speed = at_instant(study, one, "flow_surface_speed_max_m_s")
    period = one.case["domain"]["width"]
    over = paper["surface_over_estimate"]
    printed_speed = round(paper["estimate"] * over, 2)
    found = {
        "gradient": (1e-6 * at_instant(study, one, "flow_gradient_mean_K_m"), paper["gradient"]),
        "estimate": (estimate, paper["estimate"]),
        "estimate_time": (0.5e9 * period / estimate if estimate else None, paper["estimate_time"]),
        "over_estimate": (speed / estimate if estimate else None, over),
        "paper_surface": (speed, printed_speed),
    }
    for row, (value, published) in found.items():
        study.add(row, value, published=published, name=name)
    for saying in study.plan.sayings:
        add_printed(study, "saying", one, saying, label=label)


def add_printed(study: Study, row: str, one: Run, entry: Words, **words: Any) -> None:
    """A number of the summary beside one that the paper prints, as `case.toml` names it."""
    value = number_at(one.summary, entry["path"], entry["factor"])
    what, unit = entry["what"], entry["unit"]
    study.add(row, value, published=entry["published"], what=what, unit=unit, **words)


def add_claims(study: Study, runs: Runs) -> None:
    """Statements of the text over all fluences, by `hold`."""
    fluences = study.plan.fluences
    # Power of the speed over the fluence, middle and highest fluence.
    ordered = [runs[f, "hold"].summary for f in fluences]
    speeds = [number_at(one, "flow.surface_speed_max_m_s") or 1e-3 for one in ordered]
    power = float(np.polyfit(np.log(fluences), np.log(speeds), 1)[0])
    middle = len(fluences) // 2
    extremum = "flow.extrema.{}_speed_max_m_s"
    inner, outer = (number_at(ordered[-1], extremum.format(n)) or 0.0 for n in ("inner", "outer"))
    # Statements as functions, of which the case names those that it makes.
    claims: dict[str, Callable[[], bool]] = {
        "superlinear": lambda: power > 1.0,
        "fast": lambda: max(speeds[: middle + 1]) > 10.0,
        "inner_dominates": lambda: inner > outer,
        "none_at_lowest": lambda: not number_at(ordered[0], "flow.extrema.inner_lasted_s"),
    }
    for claim in study.plan.claims:
        study.add(claim, claims[claim](), power=power, fluence=fluences[middle])


def add_experiment(study: Study) -> None:
    """The measurements of Fig. 12 beside runs at their period and fluence."""
    # Period and fluence of the experiment, in every reading.
    experiment = study.plan.experiment
    period, fluence = experiment["period"], experiment["fluence"]
    beam = f'laser.beam={{kind="interference", period="{period} um"}}'
    settings = [beam, f"domain.width={period} um", "probes=[]"]
    for plateau in study.plan.plateaus:
        one = run_pool(study, fluence, plateau, *settings, label="-fig12")
        words: Words = {"period": period, "fluence": fluence, "plateau": plateau}
        for measured in experiment["measured"]:
            add_printed(study, "measured", one, measured, **words)
