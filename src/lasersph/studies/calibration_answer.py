"""Texts of the answer of a calibration: JSON, words, the posterior, the best case."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lasersph.case.overrides import override
from lasersph.input import format_quantity
from lasersph.input.schema import as_toml
from lasersph.input.shown_unit import ShownUnit, units_written
from lasersph.plots.calibration import unit_of_unknown
from lasersph.studies.calibration import Calibration, Settings
from lasersph.studies.calibration_plan import CalibrationPlan
from lasersph.studies.calibration_profile import COMPONENT, ProfileFit
from lasersph.studies.identifiability import separability
from lasersph.studies.measured_value import unit_of_number
from lasersph.studies.posterior import GRID

Array = NDArray[np.float64]
PROFILE = "profile-{}.csv"
SCHEMA = 1
SHARES = {"low_68": 0.16, "high_68": 0.84, "low_95": 0.025, "high_95": 0.975}
LEAST_WEIGHT = 1e-6
"""Part of the largest weight below which a point is not written."""
MOST_POINTS = 4000
"""Points of a chain that are written, evenly taken."""


def answer(found: Calibration) -> dict[str, Any]:
    """Content of calibration.json but for the check."""
    plan, posterior, model = found.plan, found.posterior, found.model
    mean, covariance = posterior.mean, posterior.covariance
    unknowns, shown = {}, _shown_units(plan)
    for number, one in enumerate(plan.unknowns):
        quantiles = posterior.quantiles(posterior.unknowns[:, number], list(SHARES.values()))
        known = None if one.known is None else [one.known.value, one.known.sd]
        unknowns[one.name] = {
            "key": one.key,
            "relation": one.relation,
            "unit": one.unit,
            "shown_unit": shown[one.name]._asdict(),
            "mean": float(mean[number]),
            "sd": float(np.sqrt(covariance[number, number])),
            **{name: float(value) for name, value in zip(SHARES, quantiles, strict=True)},
            "most_probable": float(posterior.most_probable[number]),
            "between": [one.low, one.high],
            "known": known,
            "emulators_share_of_variance": float(posterior.emulators_share[number]),
            "is_fixed_by_data": one.name not in found.unidentified(),
        }

    # each measured value beside the computed one, with all errors
    total, freedom, probability = found.chi_squared
    computed, sd = model.predict(posterior.most_probable)
    value, error = model.measured
    data = [
        {
            "measurement": place + 1,
            "settings": dict(plan.conditions[place].settings),
            "number": column,
            "unit": _unit_of(column),
            "measured": float(value[number]),
            "standard_error": float(error[number]),
            "computed": float(computed[0, number]),
            "emulator_sd": float(sd[0, number]),
            "numerical_sd": float(model.numerical_sd[number]),
            "pull": float(found.pulls[number]),
        }
        for number, (place, column) in enumerate(model.data)
    ]
    # how well the emulators know the runs
    emulators = {
        column: {
            "runs": int(one.outputs.size),
            "leave_one_out_rms": float(np.sqrt(np.mean(one.leave_one_out()[0] ** 2))),
        }
        for column, one in model.emulators.items()
    }
    combinations = [
        {"unknowns": list(one.unknowns), "known": one.words, "mean": one.value, "sd": one.sd}
        for one in found.combinations
        if one.words
    ]
    return {
        "schema_version": SCHEMA,
        "case": Path(plan.template.file.document.file).stem,
        "units": dict(plan.units),
        "shown_units": {
            key: unit._asdict() for key, unit in units_written(plan.text, plan.units).items()
        },
        "unknowns": unknowns,
        "covariance": covariance.tolist(),
        "combinations": combinations,
        "sentence": separability(plan, posterior, found.combinations),
        "chi_squared": {"value": total, "degrees_of_freedom": freedom, "probability": probability},
        "data": data,
        "profiles": [_profile(found, one) for one in found.profiles],
        "emulators": emulators,
        "largest_emulator_ratio": found.ratio,
        "runs": len(found.settings),
        "failed_runs": sum(one is None for one in found.numbers),
        "warnings": found.warnings(),
    }


def _shown_units(plan: CalibrationPlan) -> dict[str, ShownUnit]:
    """Of each unknown the unit in which the plan gives its limits, by its name or its key."""
    by_name = units_written(plan.text, {one.name: one.unit for one in plan.unknowns})
    by_key = units_written(plan.text, {one.key: one.unit for one in plan.unknowns})
    return {
        one.name: by_name[one.name] if by_name[one.name].name != one.unit else by_key[one.key]
        for one in plan.unknowns
    }


def _profile(found: Calibration, fit: ProfileFit) -> dict[str, Any]:
    """Entry of a measured profile in calibration.json, SI."""
    target = found.plan.conditions[fit.number - 1].profile
    computed = computed_profile(found, fit)
    scale, error = (one["lateral_scale"] for one in (fit.comparison.values, fit.comparison.errors))
    return {
        "measurement": fit.number,
        "file": "" if target is None else target.file,
        "line": PROFILE.format(fit.number),
        "points": int(computed.size),
        "error_m": 0.0 if target is None else target.error,
        "correlation_points": fit.tau,
        "components": fit.names,
        "lateral_scale": {"value": scale, "standard_error": error},
        "difference_rms_m": fit.difference(computed),
    }


def computed_profile(found: Calibration, fit: ProfileFit) -> Array:
    """Heights (n,) at the points of a profile with the most probable unknowns [m]."""
    computed = found.model.predict(found.posterior.most_probable)[0][0]
    of_name = {column: float(computed[k]) for k, (_, column) in enumerate(found.model.data)}
    return fit.heights([of_name[name] for name in fit.names])


def profile_text(found: Calibration, fit: ProfileFit) -> str:
    """A profile and the most probable one as CSV, SI."""
    computed, ours = computed_profile(found, fit), fit.comparison
    rows = zip(ours.x, ours.y, fit.measured_beside(computed), computed, strict=True)
    lines = [",".join(f"{one:.9g}" for one in row) for row in rows]
    return "\n".join(["x_m,y_m,measured_m,computed_m", *lines]) + "\n"


def answer_lines(content: dict[str, Any]) -> list[str]:
    """The answer in lines for a terminal."""
    lines = []
    for name, one in content["unknowns"].items():
        # unknowns that the data do not fix have no number of their own
        if not one["is_fixed_by_data"]:
            continue
        unit = unit_of_unknown(one)
        mean, low, high = (unit.number(one[part]) for part in ("mean", "low_95", "high_95"))
        name_of_unit = f" {unit.name}" if unit.name else ""
        lines.append(
            f"{name} = {mean:.5g} +- {one['sd'] / unit.size:.2g}{name_of_unit} (95 %: {low:.5g} to "
            f"{high:.5g}{name_of_unit}); {100.0 * one['emulators_share_of_variance']:.2g} % of "
            "the variance is the emulator's"
        )
    for one in content["profiles"]:
        lines.append(
            f"{one['file']}: {1e9 * one['difference_rms_m']:.3g} nm rms from the computed profile, "
            f"{1e9 * one['error_m']:.3g} nm standard error of a point; lateral scale "
            f"{one['lateral_scale']['value']:.4g}"
        )
    lines.append(content["sentence"])
    fit = content["chi_squared"]
    lines.append(
        f"chi^2 = {fit['value']:.3g} with {fit['degrees_of_freedom']} degrees of freedom (p = "
        f"{fit['probability']:.2g}), {content['runs']} runs"
    )
    lines += [f"warning: {text}" for text in content["warnings"]]
    # the run of the answer, where one was made
    check = content.get("check", {"failed": "", "numbers": []})
    if check["failed"]:
        lines.append(f"check: the run of {check['failed']} failed")
    for one in check["numbers"]:
        unit = _unit_of(one["number"])
        run, emulated, error = (
            format_quantity(one[key], unit, digits)
            for key, digits in (("run", 5), ("emulated", 5), ("standard_error", 2))
        )
        text = f"check: {one['number']} {run}, emulated {emulated}"
        if one["shift_at_half_spacing"] is not None:
            shift = format_quantity(one["shift_at_half_spacing"], unit, 2)
            text += f"; half the spacing shifts it by {shift}"
        lines.append(f"{text} ({error} measured)")
    return lines


def _unit_of(column: str) -> str:
    """Unit of a number of a summary, or of a component of a profile."""
    return "m" if column.startswith(COMPONENT) else unit_of_number(column)


def posterior_text(found: Calibration) -> str:
    """Points of the posterior as CSV: the unknowns in SI and the weight."""
    posterior = found.posterior
    # points that weigh anything; of a chain every n-th
    keep = np.flatnonzero(posterior.weights > LEAST_WEIGHT * posterior.weights.max())
    if len(found.plan.unknowns) not in GRID:
        keep = keep[:: max(1, len(keep) // MOST_POINTS)]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*(one.name for one in found.plan.unknowns), "weight"])
    for point, weight in zip(posterior.unknowns[keep], posterior.weights[keep], strict=True):
        writer.writerow([repr(float(value)) for value in (*point, weight)])
    return text.getvalue()


def best_case_text(found: Calibration) -> str:
    """The case with the most probable unknowns, as a case file."""
    plan = found.plan
    document = plan.template.file.document
    data = override(document, plan.template.overrides(dict(best_settings(found)))).data
    # files beside the case are not beside its copy
    material, spot = data.get("material"), data.get("laser", {}).get("spot", {})
    if isinstance(material, str) and material.endswith(".toml"):
        data["material"] = str((Path(document.file).parent / material).absolute())
    if "image" in spot:
        spot["image"] = str((Path(document.file).parent / spot["image"]).absolute())
    values = zip(plan.unknowns, found.posterior.most_probable, strict=True)
    shown = ", ".join(f"{one.name} = {value:.6g} {one.unit}".rstrip() for one, value in values)
    lines = [f"# The most probable unknowns at the settings of the first measurement: {shown}"]
    # keys of the file itself come before all tables in TOML
    tables = {name: value for name, value in data.items() if isinstance(value, dict)}
    lines += [f"{name} = {as_toml(value)}" for name, value in data.items() if name not in tables]
    for name, table in tables.items():
        lines += ["", f"[{name}]", *(f"{key} = {as_toml(value)}" for key, value in table.items())]
    return "\n".join(lines) + "\n"


def best_settings(found: Calibration) -> Settings:
    """Keys of the first measurement with the most probable unknowns."""
    plan = found.plan
    inputs = plan.inputs(found.posterior.most_probable[None, :], plan.conditions[0])[0]
    return {key: float(f"{value:.12g}") for key, value in zip(plan.keys, inputs, strict=True)}
