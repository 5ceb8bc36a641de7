"""Temperatures, times and sizes of melt pools under interfering beams beside finite volumes."""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.case import load_case
from lasersph.output import Run
from lasersph.plots import melt_pools, surface_temperatures
from lasersph.validation.comparison import Words, number_at
from lasersph.validation.dlip_thermal.claims import Runs, add_claims_of_both, add_claims_of_metal
from lasersph.validation.dlip_thermal.finite_volumes import Columns
from lasersph.validation.study import Study

COARSE = 8.0
"""Spacing of the study of time steps [nm]."""
LEVELS = ("f_m > 0", "f_m = 0.5", "f_m = 1")


def compare(study: Study) -> None:
    """All fluences of both metals; shortened, steel at its reference fluence."""
    runs: dict[str, Runs] = {}
    for label, metal in study.plan.metals.items():
        judged = metal["reference_fluence"]
        # A shortened validation has the fluence with a reference alone.
        fluences = metal["fluences"]
        if not study.plan.is_whole:
            fluences = [judged] if label == "steel" else []
        # the fluence with a reference first: it tells early whether the others are worth the time
        order = sorted(fluences, key=lambda fluence: fluence != judged)
        found = {f: run_fluence(study, metal, f, study.plan.spacing) for f in order}
        runs[label] = {f: found[f] for f in fluences}
        for fluence, one in runs[label].items():
            name = f"{label} {fluence}"
            add_common(study, name, metal, one)
            # Temperatures, sizes and columns at the fluence with a reference.
            if fluence == judged:
                add_temperatures(study, name, label, one)
                add_sizes(study, name, label, metal, one)
                add_columns(study, name, label, metal)
        # Claims need all fluences.
        if study.plan.is_whole:
            add_claims_of_metal(study, label, metal, runs[label])
        if runs[label]:
            temperature, pool = metal["figures"]
            shown = list(runs[label].values())
            study.save(f"{temperature}-{label}-temperature", surface_temperatures(shown))
            study.save(f"{pool}-{label}-melt-pool", melt_pools(shown))
    if study.plan.is_whole:
        add_claims_of_both(study, runs)
        add_steps(study)


def run_fluence(
    study: Study, metal: dict[str, Any], fluence: float, spacing: float, step: float = 50.0
) -> Run:
    """Run of a fluence [J/cm2] at a spacing [nm] with steps of at most `step` [ps]."""
    return study.run(
        f"{metal['case']}-{fluence}-{spacing:g}nm-{step:g}ps",
        "solver.kind=conduction",
        f"laser.fluence={fluence} J/cm^2",
        f"particles.spacing={spacing} nm",
        f"time.step={step} ps",
        case=metal["case"],
    )


def at_times(study: Study, one: Run) -> np.ndarray:
    """T of the surface at the maximum [K] at the times of the plan."""
    times = 1e-9 * np.array(study.plan.times)
    return np.interp(times, one.history["time_s"], one.history["probe_maximum_K"])


def add_common(study: Study, label: str, metal: dict[str, Any], one: Run) -> None:
    """Add the numbers of every fluence, and the energy balance."""
    study.add("imbalance", abs(one.summary["energy"]["imbalance_relative"]), label=label)
    study.add_group("common", one, label=label)
    keys = ("start_any_s", "end_any_s", "width_half_max_m", "depth_half_max_m")
    # Begin, end and sizes of the pool.
    begin, end, width, depth = (number_at(one.summary, f"melt.{key}") for key in keys)
    lasts = None if begin is None or end is None else 1e9 * (end - begin)
    study.add("lasts", lasts, label=label)
    if width and depth:
        study.add("aspect", depth / width, published=metal["aspect"], label=label)


def add_temperatures(study: Study, label: str, metal: str, one: Run) -> None:
    """Temperatures and events against finite volumes."""
    events = study.table("events.csv")
    # Temperatures at the times of the table, events at theirs.
    wanted = study.table("temperature.csv")[metal]
    for at, T, expected in zip(study.plan.times, at_times(study, one), wanted, strict=True):
        study.add("temperature", T, expected, label=label, time=at)
    for event, path, expected in zip(events["event"], events["path"], events[metal], strict=True):
        found = number_at(one.summary, path, 1e9)
        study.add("event", found, expected, label=label, event=event)


def add_sizes(study: Study, label: str, name: str, metal: dict[str, Any], one: Run) -> None:
    """Largest widths and depths against finite volumes."""
    sizes = study.table("sizes.csv")
    # Sizes by level; where columns are too wide, the width of fine ones is the reference.
    for k, level in enumerate(LEVELS):
        suffix, words = sizes["suffix"][k], Words(label=label, level=level)
        width, depth = (
            number_at(one.summary, f"melt.{q}{suffix}_max_m", 1e9) for q in ("width", "depth")
        )
        given: Words = {"published": metal.get("published_width"), "share": metal["width_band"]}
        coarse = level == metal["column_limited"]
        study.add("width", width, sizes[f"{name}_width"][k], judge=not coarse, **given, **words)
        if coarse:
            study.add("fine_width", width, sizes[f"{name}_fine"][k], **given, **words)
        given = {"published": metal["published_depth"], "share": metal["depth_bands"][k]}
        study.add("depth", depth, sizes[f"{name}_depth"][k], **given, **words)


def add_columns(study: Study, label: str, name: str, metal: dict[str, Any]) -> None:
    """Widths of finite volumes by the width of their columns, beside the reference."""
    case, wanted = load_case(metal["case"]), study.table("sizes.csv")[f"{name}_width"]
    # The same case by finite volumes with columns of some widths.
    for column in study.plan.columns:
        widths = Columns(case, 1e-9 * column).widest()
        for level, width, reference in zip(LEVELS, widths, wanted, strict=True):
            words: Words = {"label": label, "column": column, "level": level}
            study.add("column_width", 1e9 * width, reference, **words)


def add_steps(study: Study) -> None:
    """Steps of 50 ps against 10 ps, steel 0.6 J/cm2, 8 nm."""
    metal = study.plan.metals["steel"]
    # Long steps beside short ones, all else the same.
    long, short = (run_fluence(study, metal, 0.6, COARSE, step) for step in (50.0, 10.0))
    temperatures = (at_times(study, one) for one in (long, short))
    for at, a, b in zip(study.plan.times, *temperatures, strict=True):
        study.add("step_temperature", a, b, time=at)
    depths = (number_at(one.summary, "melt.depth_half_max_m", 1e9) for one in (long, short))
    study.add("step_depth", *depths)
