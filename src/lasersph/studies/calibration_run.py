"""Calibration in a folder: its runs, the check of its answer, and the files that hold it.

runs/, table.csv, points.json, plan.toml, sweep.jsonl    as of every sweep
calibration.json    the unknowns with their bands, what fits how well, warnings, the check
posterior.csv       points of the posterior with their weights
best.toml           the case with the most probable unknowns, at the first measurement's settings
calibration.png     data over bands of the model; the posterior
"""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.case.overrides import override
from lasersph.input.schema import as_toml
from lasersph.output import OutputError
from lasersph.output.atomic import replace_json, replace_text
from lasersph.output.errors import install_hint
from lasersph.simulation.time_loop import Stopped
from lasersph.studies.calibration import Calibration, Numbers, Settings, calibrate_with
from lasersph.studies.calibration_plan import CalibrationPlan
from lasersph.studies.calibration_reading import read_calibration_plan
from lasersph.studies.measured_value import unit_of_number
from lasersph.studies.posterior import GRID
from lasersph.sweeps import Engine, Event, LocalEngine, Point, Study, Table, make_runs

ANSWER, POINTS, BEST, FIGURE = (
    "calibration.json",
    "posterior.csv",
    "best.toml",
    "calibration.png",
)
SCHEMA = 1
SHARES = {"low_68": 0.16, "high_68": 0.84, "low_95": 0.025, "high_95": 0.975}
LEAST_WEIGHT = 1e-6
"""Part of the largest weight below which a point is not written."""
MOST_POINTS = 4000
"""Points of a chain that are written, evenly taken."""


def calibrate(
    plan: str | PathLike[str] | CalibrationPlan,
    out: str | PathLike[str],
    *,
    workers: int | None = None,
    threads: int | None = None,
    retries: int = 2,
    engine: Engine | None = None,
    report: Callable[[str], None] = lambda line: None,
    should_stop: Callable[[], bool] = lambda: False,
) -> dict[str, Any]:
    """Find unknowns of a case from measured values; the same call again goes on.

        found = lasersph.calibrate("plan.toml", "runs/calibration")
        found["unknowns"]["factor"]["mean"]

    Args:
        plan: a plan or its file. out: folder of the runs and of the answer.
        workers, threads, retries: of the engine of this machine; see `sweeps.LocalEngine`.
        engine: another one in its place. report: called with lines on how far it is.
        should_stop: asked several times a second; True ends all runs with their checkpoints.

    Returns:
        Content of calibration.json.

    Raises:
        CaseError: every mistake of the plan or its case. FolderRefused: the folder holds something
            else. NoCalibration: the runs do not give what was measured.
        OutputError: scikit-learn, or emcee with three unknowns or more, is not installed.
        Stopped: `should_stop` said so.
    """
    if not isinstance(plan, CalibrationPlan):
        plan = read_calibration_plan(plan)
    _refuse_missing_libraries(plan)
    runs = _Runs(
        plan, Path(out), engine or LocalEngine(workers, threads, retries), report, should_stop
    )
    found = calibrate_with(plan, runs.make, report)
    content = answer(found)
    if plan.runs.check:
        content["check"] = _check(found, runs)
    path = Path(out)
    replace_json(path / ANSWER, content)
    replace_text(path / POINTS, posterior_text(found))
    replace_text(path / BEST, best_case_text(found))
    return content


@dataclass(frozen=True)
class _Runs:
    """Makes the runs of a plan exist in its folder."""

    plan: CalibrationPlan
    path: Path
    engine: Engine
    report: Callable[[str], None]
    should_stop: Callable[[], bool]

    def make(self, settings: Sequence[Settings]) -> list[Numbers | None]:
        """Numbers of the runs with these settings, None of those that fail."""
        points = [self.plan.template.point(dict(one)) for one in settings]
        return [
            row.numbers if row.status == "complete" else None for row in self.table(points).rows
        ]

    def table(self, points: Sequence[Point]) -> Table:
        """The table of these points, all runs made. Raises Stopped."""
        return make_or_stop(
            points, self.path, self.plan.study, self.engine, self.report, self.should_stop
        )


def make_or_stop(
    points: Sequence[Point],
    folder: Path,
    study: Study,
    engine: Engine,
    report: Callable[[str], None],
    should_stop: Callable[[], bool],
) -> Table:
    """The table of points, all runs made.

    Args:
        report: called with a line on each run that ends or is tried again.

    Raises:
        Stopped: before all were made. FolderRefused, OutputError: see `make_runs`.
    """

    def note(event: Event, _: Table) -> None:
        if event.kind in ("complete", "failed", "retry", "wrong"):
            message = f": {event.message}" if event.message else ""
            report(f"run {event.run} {event.kind}{message}")

    table = make_runs(points, folder, study, engine=engine, report=note, should_stop=should_stop)
    if should_stop() and any(one in ("stopped", "missing") for one in table.status):
        raise Stopped(f"stopped with {table.count('complete')} of {len(points)} runs complete")
    return table


def answer(found: Calibration) -> dict[str, Any]:
    """Content of calibration.json but for the check."""
    plan, posterior, model = found.plan, found.posterior, found.model
    mean, covariance = posterior.mean, posterior.covariance
    unknowns = {}
    for number, one in enumerate(plan.unknowns):
        quantiles = posterior.quantiles(posterior.unknowns[:, number], list(SHARES.values()))
        known = None if one.known is None else [one.known.value, one.known.sd]
        unknowns[one.name] = {
            "key": one.key,
            "relation": one.relation,
            "unit": one.unit,
            "mean": float(mean[number]),
            "sd": float(np.sqrt(covariance[number, number])),
            **{name: float(value) for name, value in zip(SHARES, quantiles, strict=True)},
            "most_probable": float(posterior.most_probable[number]),
            "between": [one.low, one.high],
            "known": known,
            "emulators_share_of_variance": float(posterior.emulators_share[number]),
            "is_fixed_by_data": one.name not in found.loose(),
        }
    total, freedom, probability = found.chi_squared
    computed, sd = model.predict(posterior.most_probable)
    value, error = model.measured
    data = [
        {
            "measurement": place + 1,
            "settings": dict(plan.conditions[place].settings),
            "number": column,
            "unit": unit_of_number(column),
            "measured": float(value[number]),
            "standard_error": float(error[number]),
            "computed": float(computed[0, number]),
            "emulator_sd": float(sd[0, number]),
            "numerical_sd": float(model.numerical_sd[number]),
            "pull": float(found.pulls[number]),
        }
        for number, (place, column) in enumerate(model.data)
    ]
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
        "unknowns": unknowns,
        "covariance": covariance.tolist(),
        "combinations": combinations,
        "chi_squared": {"value": total, "degrees_of_freedom": freedom, "probability": probability},
        "data": data,
        "emulators": emulators,
        "largest_emulator_ratio": found.ratio,
        "runs": len(found.settings),
        "failed_runs": sum(one is None for one in found.numbers),
        "warnings": found.warnings(),
    }


def answer_lines(content: dict[str, Any]) -> list[str]:
    """The answer in lines for a terminal."""
    lines = []
    for name, one in content["unknowns"].items():
        if not one["is_fixed_by_data"]:
            continue
        unit = f" {one['unit']}" if one["unit"] else ""
        lines.append(
            f"{name} = {one['mean']:.5g} +- {one['sd']:.2g}{unit} (95 %: {one['low_95']:.5g} to "
            f"{one['high_95']:.5g}{unit}); {100.0 * one['emulators_share_of_variance']:.2g} % of "
            "the variance is the emulator's"
        )
    fit = content["chi_squared"]
    lines.append(
        f"chi^2 = {fit['value']:.3g} with {fit['degrees_of_freedom']} degrees of freedom (p = "
        f"{fit['probability']:.2g}), {content['runs']} runs"
    )
    lines += [f"warning: {text}" for text in content["warnings"]]
    for one in content.get("check", {}).get("numbers", []):
        text = f"check: {one['number']} {one['run']:.5g}, emulated {one['emulated']:.5g}"
        if one["shift_at_half_spacing"] is not None:
            text += f"; half the spacing shifts it by {one['shift_at_half_spacing']:.2g}"
        lines.append(f"{text} ({one['standard_error']:.2g} measured)")
    return lines


def _check(found: Calibration, runs: _Runs) -> dict[str, Any]:
    """Runs of the most probable unknowns, with the spacing of the case and half of it."""
    plan, model = found.plan, found.model
    condition = plan.conditions[0]
    best = _best_settings(found)
    first = plan.template.point(dict(best))
    if first.case is None:
        return {"numbers": [], "failed": first.reason}
    half = plan.template.point({**best, "particles.spacing": 0.5 * first.case.particles.spacing})
    points = [plan.template.point(dict(one)) for one in found.settings]
    coarse, fine = runs.table([*points, first, half]).rows[-2:]
    emulated = model.predict(found.posterior.most_probable)[0][0]
    numbers = []
    for number, (place, column) in enumerate(model.data):
        if place == 0 and column in coarse.numbers:
            at_half = fine.numbers.get(column)
            shift = None if at_half is None else at_half - coarse.numbers[column]
            numbers.append(
                {
                    "number": column,
                    "run": coarse.numbers[column],
                    "emulated": float(emulated[number]),
                    "shift_at_half_spacing": shift,
                    "standard_error": condition.values[column].sd,
                }
            )
    failed = "; ".join(
        row.reason or row.status for row in (coarse, fine) if row.status != "complete"
    )
    return {"runs": [coarse.run, fine.run], "numbers": numbers, "failed": failed}


def _best_settings(found: Calibration) -> Settings:
    """Keys of the first measurement with the most probable unknowns."""
    plan = found.plan
    inputs = plan.inputs(found.posterior.most_probable[None, :], plan.conditions[0])[0]
    return {key: float(f"{value:.12g}") for key, value in zip(plan.keys, inputs, strict=True)}


def posterior_text(found: Calibration) -> str:
    """Points of the posterior as CSV: the unknowns in SI and the weight."""
    posterior = found.posterior
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
    data = override(document, plan.template.overrides(dict(_best_settings(found)))).data
    material = data.get("material")
    if isinstance(material, str) and material.endswith(".toml"):
        data["material"] = str((Path(document.file).parent / material).absolute())
    values = zip(plan.unknowns, found.posterior.most_probable, strict=True)
    told = ", ".join(f"{one.name} = {value:.6g} {one.unit}".rstrip() for one, value in values)
    lines = [f"# The most probable unknowns at the settings of the first measurement: {told}"]
    tables = {name: value for name, value in data.items() if isinstance(value, dict)}
    lines += [f"{name} = {as_toml(value)}" for name, value in data.items() if name not in tables]
    for name, table in tables.items():
        lines += ["", f"[{name}]", *(f"{key} = {as_toml(value)}" for key, value in table.items())]
    return "\n".join(lines) + "\n"


def read_answer(folder: str | PathLike[str]) -> tuple[dict[str, Any], np.ndarray]:
    """Content of calibration.json, and unknowns and weights (n, p + 1) of posterior.csv.

    Raises:
        OutputError: the folder holds no finished calibration.
    """
    path = Path(folder)
    try:
        content = json.loads((path / ANSWER).read_text(encoding="utf-8"))
        points = np.loadtxt(path / POINTS, delimiter=",", skiprows=1, ndmin=2)
    except (OSError, ValueError) as error:
        raise OutputError(f"{folder} holds no finished calibration: {error}") from None
    return content, points


def _refuse_missing_libraries(plan: CalibrationPlan) -> None:
    """Say what is missing before hours of runs, not after. Raises OutputError."""
    needed = {"sklearn": "scikit-learn"}
    if len(plan.unknowns) not in GRID:
        needed["emcee"] = "emcee"
    for module, name in needed.items():
        if find_spec(module) is None:
            raise OutputError(install_hint(name, "study"))
