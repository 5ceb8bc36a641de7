"""Calibration in a folder: its runs, the check of its answer, and the files that hold it.

runs/, table.csv, points.json, plan.toml, sweep.jsonl    as of every sweep
calibration.json    the unknowns with their bands, what fits how well, warnings, the check
posterior.csv       points of the posterior with their weights
best.toml           the case with the most probable unknowns, at the first measurement's settings
profile-1.csv       a measured profile, aligned, and the most probable one
calibration.png     data over bands of the model; the posterior
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from importlib.util import find_spec
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lasersph.input import CaseError
from lasersph.output import OutputError, open_run
from lasersph.output.atomic import replace_json, replace_text
from lasersph.output.errors import install_hint
from lasersph.plots import style
from lasersph.plots.calibration import calibration_figure
from lasersph.simulation.time_loop import Stopped
from lasersph.studies.calibration import Calibration, Numbers, Settings, calibrate_with
from lasersph.studies.calibration_answer import (
    PROFILE,
    answer,
    best_case_text,
    best_settings,
    computed_profile,
    posterior_text,
    profile_text,
)
from lasersph.studies.calibration_plan import CalibrationPlan
from lasersph.studies.calibration_reading import read_calibration_plan
from lasersph.studies.posterior import GRID
from lasersph.studies.texture.cells import Cell
from lasersph.studies.texture.compare import AnyRelief
from lasersph.studies.texture.dot_cells import read_any_cell
from lasersph.studies.texture.relief import repeating_relief
from lasersph.studies.texture.round_relief import RoundRelief, read_round_relief
from lasersph.studies.texture.spot import NoTexture
from lasersph.sweeps import Engine, Event, LocalEngine, Point, Study, Table, make_runs
from lasersph.sweeps.folder import RUNS
from lasersph.sweeps.table import Row

if TYPE_CHECKING:
    from lasersph.plots.notebook_figure import Figure

ANSWER, POINTS, BEST, FIGURE = (
    "calibration.json",
    "posterior.csv",
    "best.toml",
    "calibration.png",
)


def calibrate(
    plan: str | PathLike[str] | CalibrationPlan,
    out: str | PathLike[str],
    *,
    workers: int | None = None,
    threads: int | None = None,
    retries: int = 2,
    engine: Engine | None = None,
    report: Callable[[str], None] | None = None,
    should_stop: Callable[[], bool] | None = None,
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
    # runs and answer, then the check of the most probable unknowns
    runs = _Runs(
        plan, Path(out), engine or LocalEngine(workers, threads, retries), report, should_stop
    )
    found = calibrate_with(plan, runs.make, report, runs.reliefs)
    content = answer(found)
    if plan.runs.check:
        content["check"] = _check(found, runs)

    # files, once all runs are made
    path = Path(out)
    replace_json(path / ANSWER, content)
    replace_text(path / POINTS, posterior_text(found))
    replace_text(path / BEST, best_case_text(found))
    for fit in found.profiles:
        replace_text(path / PROFILE.format(fit.number), profile_text(found, fit))
    style.save(figure_of_calibration(path), path / FIGURE)
    return content


def figure_of_calibration(folder: str | PathLike[str]) -> Figure:
    """Data over bands of the model, and the posterior, of a calibration that is complete.

    Raises:
        OutputError: there is none in the folder.
    """
    content, points = read_answer(folder)
    return calibration_figure(content, points, read_profiles(Path(folder), content))


@dataclass(frozen=True)
class _Runs:
    """Makes the runs of a plan exist in its folder."""

    plan: CalibrationPlan
    path: Path
    engine: Engine
    report: Callable[[str], None] | None
    should_stop: Callable[[], bool] | None
    cells: dict[str, Cell] = field(default_factory=dict)

    def make(self, settings: Sequence[Settings]) -> list[Numbers | None]:
        """Numbers of the runs with these settings, None of those that fail; none of a spot."""
        if self.plan.spot is not None:
            return [None if one is None else {} for one in self.reliefs(settings)]
        rows = self.table([self.plan.template.point(dict(one)) for one in settings]).rows
        return [row.numbers if row.status == "complete" else None for row in rows]

    def reliefs(self, settings: Sequence[Settings]) -> list[AnyRelief | None]:
        """Reliefs of the runs with these settings, or of the spots; None of those that fail, and
        where no profile is measured."""
        profile = next((one.profile for one in self.plan.conditions if one.profile), None)
        if profile is None:
            return [None] * len(settings)
        spot = self.plan.spot
        points = [self._points(one) for one in settings]
        # spots share cells: each is made once
        every = {point.hash: point for cells in points for point in cells}
        rows = dict(zip(every, self.table(list(every.values())).rows, strict=True))
        if profile.is_round:
            return [self._round(rows[one.hash]) for (one,) in points]
        found = [[self._cell(rows[one.hash], profile.period) for one in cells] for cells in points]
        if spot is not None:
            return [
                spot.relief(one, cells) if cells else None
                for one, cells in zip(settings, found, strict=True)
            ]
        return [None if one is None else repeating_relief(one, profile.period) for (one,) in found]

    def _points(self, settings: Settings) -> list[Point]:
        """The run with these settings, or the cells of their spot; none where it has none."""
        if self.plan.spot is None:
            return [self.plan.template.point(dict(settings))]
        try:
            return self.plan.spot.points(settings)
        except (NoTexture, CaseError):
            return []

    def _cell(self, row: Row, period: float) -> Cell | None:
        """The cell of a run, read once."""
        if row.status == "complete" and row.run not in self.cells:
            self.cells[row.run] = read_any_cell(open_run(self.path / RUNS / row.run), period)
        return self.cells.get(row.run)

    def _round(self, row: Row) -> RoundRelief | None:
        """The relief of a run of a section (r, z); None of one that failed."""
        done = row.status == "complete"
        return read_round_relief(self.path / RUNS / row.run) if done else None

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
    report: Callable[[str], None] | None,
    should_stop: Callable[[], bool] | None,
) -> Table:
    """The table of points, all runs made.

    Args:
        report: called with a line on each run that ends or is tried again.

    Raises:
        Stopped: before all were made. FolderRefused, OutputError: see `make_runs`.
    """

    def note(event: Event, _: Table) -> None:
        if report is not None and event.kind in ("complete", "failed", "retry", "wrong"):
            message = f": {event.message}" if event.message else ""
            report(f"run {event.run} {event.kind}{message}")

    table = make_runs(points, folder, study, engine=engine, report=note, should_stop=should_stop)
    is_stopped = should_stop is not None and should_stop()
    if is_stopped and any(one in ("stopped", "missing") for one in table.status):
        raise Stopped(f"stopped with {table.count('complete')} of {len(points)} runs complete")
    return table


def _check(found: Calibration, runs: _Runs) -> dict[str, Any]:
    """Runs of the most probable unknowns, with the spacing of the case and half of it."""
    plan, model = found.plan, found.model
    condition = plan.conditions[0]
    best = best_settings(found)
    first = plan.template.point(dict(best))
    if first.case is None:
        return {"numbers": [], "failed": first.reason}
    # the most probable unknowns at the case's spacing and at half of it, after all other runs
    half = {**best, "particles.spacing": 0.5 * first.case.particles.spacing}
    pair = runs.make([*found.settings, best, half])[-2:]
    words = zip(("the most probable one", "half the spacing"), pair, strict=True)
    failed = " and ".join(word for word, one in words if one is None)
    coarse, fine = (one or {} for one in pair)
    # numbers of the first measurement: of the run, emulated, and shift with the spacing
    emulated = model.predict(found.posterior.most_probable)[0][0]
    numbers = []
    for number, (place, column) in enumerate(model.data):
        if place == 0 and column in coarse:
            at_half = fine.get(column)
            shift = None if at_half is None else at_half - coarse[column]
            numbers.append(
                {
                    "number": column,
                    "run": coarse[column],
                    "emulated": float(emulated[number]),
                    "shift_at_half_spacing": shift,
                    "standard_error": condition.values[column].sd,
                }
            )
    # the profile by its distance from the measurement
    if condition.profile is not None and not failed:
        fit = found.profiles[0]
        reliefs = runs.reliefs([*found.settings, best, half])[-2:]
        first_rms, fine_rms = (fit.difference(fit.at(one)) for one in reliefs if one is not None)
        numbers.append(
            {
                "number": "profile_1.difference_rms_m",
                "run": first_rms,
                "emulated": fit.difference(computed_profile(found, fit)),
                "shift_at_half_spacing": fine_rms - first_rms,
                "standard_error": condition.profile.error,
            }
        )
    return {"numbers": numbers, "failed": failed}


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


def read_profiles(folder: str | PathLike[str], content: dict[str, Any]) -> list[np.ndarray]:
    """Columns x, y, measured, computed (n, 4) [m] of each profile of an answer."""
    files = [Path(folder) / one["line"] for one in content["profiles"]]
    return [np.loadtxt(file, delimiter=",", skiprows=1, ndmin=2) for file in files]


def _refuse_missing_libraries(plan: CalibrationPlan) -> None:
    """Say what is missing before hours of runs, not after. Raises OutputError."""
    # a grid takes up to two unknowns; more are sampled
    needed = {"sklearn": "scikit-learn"}
    if len(plan.unknowns) not in GRID:
        needed["emcee"] = "emcee"
    for module, name in needed.items():
        if find_spec(module) is None:
            raise OutputError(install_hint(name, "study"))
