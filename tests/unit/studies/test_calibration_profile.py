"""Profiles as targets of a calibration: hidden factors, what they tell apart, what is refused."""

import json

import numpy as np
import pytest
from texture_cells import PERIOD, pools, relief, spot, table

import lasersph
from lasersph.input import CaseError
from lasersph.input.key_units import unit_of
from lasersph.output.height_map import HeightMap
from lasersph.plots.calibration import calibration_figure
from lasersph.studies import calibration_run
from lasersph.studies.calibration import NoCalibration, calibrate_with
from lasersph.studies.calibration_answer import answer, answer_lines
from lasersph.studies.calibration_reading import read_calibration_plan
from lasersph.studies.texture.cells import UNITS, Cell
from lasersph.studies.texture.relief import Relief, repeating_relief
from lasersph.sweeps import Event

NM, UM = 1e-9, 1e-6
SET = {
    "solver.flow.surface": "moving",
    "material.base": "steel-304",
    "particles.spacing": "100 nm",
}
SPOT = {**SET, "laser.spot.diameter": "50 um", "laser.spot.definition": "1/e^2"}
PULSES = {
    "laser.spot.shift": "60 um",
    "laser.pulse.count": 2,
    "laser.pulse.period": "0.5 us",
    "time.end": "0.6 us",
}
FACTOR = 'factor = { scales = "laser.fluence", between = [0.7, 1.3] }'
SLOPE = (
    'slope = { key = "material.surface_tension_slope", '
    'between = ["-6e-4 N/(m K)", "-2e-4 N/(m K)"] }'
)
ABSORPTIVITY = 'absorptivity = { complements = "laser.reflectivity", between = [0.3, 0.5] }'
SLOPE_HERE, REFLECTIVITY_HERE = -4.3e-4, 0.6


def height(x, fluence, slope=SLOPE_HERE, reflectivity=REFLECTIVITY_HERE):
    """A made-up relief [m]: rims twice as steep where the slope drives more."""
    absorbed = fluence * (1.0 - reflectivity) / (1.0 - REFLECTIVITY_HERE)
    rims = 10 * NM * (slope / SLOPE_HERE - 1.0) * np.cos(6.0 * np.pi * np.asarray(x) / PERIOD)
    return relief(absorbed, x) + rims * (absorbed > 2000.0)


def reliefs_of_runs(points):
    """Reliefs of runs with these settings."""
    places = (np.arange(256) + 0.5) * PERIOD / 256
    names = {
        "laser.fluence": "fluence",
        "material.surface_tension_slope": "slope",
        "laser.reflectivity": "reflectivity",
    }
    found = []
    for one in points:
        z = height(places, **{names[key]: value for key, value in one.items()})
        found.append(repeating_relief(Cell(places, {"height": z}, True), PERIOD))
    return found


def calibrated(plan, reliefs=reliefs_of_runs):
    """The calibration of a plan with runs of these reliefs."""
    return calibrate_with(plan, lambda points: [{} for _ in points], reliefs=reliefs)


def measurement(factor, seed=0, scale=1.01, rows=1, **more):
    """A profile (or a map) of 44 um, tilted, moved, stretched, with noise of 5 nm."""
    random = np.random.default_rng(seed)
    x, y = np.linspace(-22 * UM, 22 * UM, 500), np.linspace(0.0, 8 * UM, rows)
    X, Y = np.meshgrid(x, y)
    z = height((X - 0.7 * UM * random.normal()) / scale, 4500.0 * factor, **more)
    z = z + 2e-3 * X + 1e-3 * Y + 5 * NM * random.normal(size=X.shape)
    return HeightMap(x - x[0], y, z)


def plan_of(folder, surface, unknown=(FACTOR,), settings=SET, runs="first = 6\nmost = 12"):
    """A plan with one measured profile."""
    surface.write(folder / "line.csv")
    lines = [
        'case = "dlip-steel"',
        "[set]",
        *(f'"{k}" = {json.dumps(v)}' for k, v in settings.items()),
    ]
    lines += ["[unknown]", *unknown, "[[measured]]", 'set = { "laser.fluence" = "0.45 J/cm^2" }']
    lines += ['profile = { file = "line.csv", error = "5 nm" }', "[runs]", runs, ""]
    (folder / "plan.toml").write_text("\n".join(lines))
    return folder / "plan.toml"


@pytest.mark.parametrize(
    ("seed", "factor", "scale", "rows"), [(0, 0.91, 1.01, 1), (1, 1.08, 0.99, 1), (2, 1.0, 0.99, 9)]
)
def test_hidden_factor(tmp_path, seed, factor, scale, rows):
    """Within its 95 % interval of about a percent, from few runs, whatever was tilted or moved; the
    fit is as good as the noise."""
    surface = measurement(factor, seed, scale, rows)
    found = calibrated(read_calibration_plan(plan_of(tmp_path, surface)))
    content = answer(found)
    one, (profile,) = content["unknowns"]["factor"], content["profiles"]
    assert {unit_of(name) for fit in found.profiles for name in fit.names} == {"m"}
    assert one["low_95"] < factor < one["high_95"]
    assert 0.0005 < one["sd"] < 0.01
    assert profile["lateral_scale"]["value"] == pytest.approx(scale, abs=0.003)
    assert profile["difference_rms_m"] == pytest.approx(5 * NM, rel=0.1)
    assert content["sentence"].startswith("the data tell factor to ")
    assert not content["warnings"]


def test_two_that_are_told_apart(tmp_path):
    """A slope that changes the shape is found beside the factor, and the sentence says so."""
    surface = measurement(1.05, slope=-3.3e-4)
    plan = plan_of(tmp_path, surface, (FACTOR, SLOPE), runs="first = 12\nmost = 14")
    content = answer(calibrated(read_calibration_plan(plan)))
    for name, hidden in (("factor", 1.05), ("slope", -3.3e-4)):
        one = content["unknowns"][name]
        assert one["low_95"] < hidden < one["high_95"]
        assert one["is_fixed_by_data"]
    assert "apart; most alike are factor and slope" in content["sentence"]


def test_a_product(tmp_path):
    """Fluence and absorptivity are not told apart by a profile either."""
    plan = plan_of(tmp_path, measurement(1.0), (FACTOR, ABSORPTIVITY), runs="first = 14\nmost = 14")
    content = answer(calibrated(read_calibration_plan(plan)))
    (one,) = content["combinations"]
    assert one["known"] == "factor * absorptivity"
    assert one["mean"] == pytest.approx(0.4, rel=0.02)
    assert content["sentence"] == "the data fix none of factor, absorptivity by itself"


def test_a_relief_that_no_run_has(tmp_path):
    """It is said, with how much is left over."""
    surface = measurement(1.0, slope=-8e-4)
    found = calibrated(read_calibration_plan(plan_of(tmp_path, surface)))
    assert any("no sum of the runs has profile 1: " in text for text in found.warnings())


def test_runs_that_tell_nothing(tmp_path):
    """Reliefs far below the noise, none at all, or runs that fail are one line."""
    plan = read_calibration_plan(plan_of(tmp_path, measurement(1.0)))

    def faint(points):
        found = []
        for one in reliefs_of_runs(points):
            cell = Cell(one.table.x, {"height": 1e-4 * one.table.values["height"][0]}, True)
            found.append(repeating_relief(cell, PERIOD))
        return found

    with pytest.raises(NoCalibration, match="runs differ by less than its standard error of 5 nm"):
        calibrated(plan, faint)
    with pytest.raises(NoCalibration, match="fewer than two runs leave a relief"):
        calibrated(plan, lambda points: [None for _ in points])


WRONG = {
    "no file": (SET, "no-such.csv", "no-such.csv"),
    "surface": ({**SET, "solver.flow.surface": "flat"}, "line.csv", "does not move; write"),
    "spot that moves": ({**SPOT, **PULSES}, "line.csv", "what is measured is one spot"),
    "dark spot": ({**SPOT, "laser.reflectivity": 0.99}, "line.csv", "melt nothing"),
    "whole spot": (
        {**SPOT, "laser.spot.extent": "whole", "domain.extent": "full"},
        "line.csv",
        'write extent = "cell"',
    ),
    "width": ({**SET, "domain.width": "10 um"}, "line.csv", 'write domain.width = "5 um"'),
    "unit": (SET, "odd.csv", "is its unit right"),
}


@pytest.mark.parametrize(("settings", "name", "words"), WRONG.values(), ids=WRONG.keys())
def test_mistakes_have_a_line(tmp_path, settings, name, words):
    """A profile that the case does not compute, or that cannot be right, at its line."""
    surface = measurement(1.0)
    plan = plan_of(tmp_path, surface, settings=settings)
    HeightMap(1e-3 * surface.x, surface.y, surface.z).write(tmp_path / "odd.csv")
    plan.write_text(plan.read_text().replace("line.csv", name))
    line = 1 + plan.read_text().split("\n").index(
        f'profile = {{ file = "{name}", error = "5 nm" }}'
    )
    with pytest.raises(CaseError) as caught:
        read_calibration_plan(plan)
    (message,) = str(caught.value).splitlines()
    assert f"plan.toml:{line}: " in message
    assert words in message


def test_numbers_beside_a_spot(tmp_path):
    """A spot of cells has no number of a summary, and other measurements have no cells."""
    plan = plan_of(tmp_path, measurement(1.0), settings=SPOT, runs="cells = 6")
    text = plan.read_text()
    plan.write_text(
        text.replace("[runs]", 'values = { "melt.depth_max_m" = "200 +- 20 nm" }\n[runs]')
    )
    with pytest.raises(
        CaseError, match=r"plan.toml:\d+: .*spot that is assembled from cells has no"
    ):
        read_calibration_plan(plan)
    plan.write_text(text.replace('"laser.spot', '# "laser.spot'))
    with pytest.raises(CaseError, match=r"plan.toml:\d+: runs.cells.* no spot is measured"):
        read_calibration_plan(plan)


class ReliefEngine:
    """Makes run folders whose reliefs a formula gives."""

    def make(self, tasks, report, should_stop):
        """Make the folders of all tasks exist."""
        for task in tasks:
            task.folder.mkdir(parents=True)
            fluence = {"fluence": task.case.laser.fluence}
            (task.folder / "resolved.json").write_text("{}")
            (task.folder / "summary.json").write_text(json.dumps(fluence))
            report(Event(task.run, "complete", exit_code=0))


def test_answer_in_a_folder(tmp_path, monkeypatch):
    """The aligned profile is written beside the most probable one, drawn, and checked by a run."""

    def from_summary(run, period):
        table = reliefs_of_runs([{"laser.fluence": run.summary["fluence"]}])[0].table
        return Cell(table.x, {"height": table.values["height"][0]}, True)

    monkeypatch.setattr(calibration_run, "read_any_cell", from_summary)
    out = tmp_path / "out"
    plan = plan_of(tmp_path, measurement(1.05))
    content = lasersph.calibrate(plan, out, engine=ReliefEngine())
    (line,) = calibration_run.read_profiles(out, content)
    assert np.std(line[:, 2] - line[:, 3]) == pytest.approx(5 * NM, rel=0.1)
    (check,) = content["check"]["numbers"]
    assert check["run"] == pytest.approx(5 * NM, rel=0.1)
    assert check["shift_at_half_spacing"] == 0.0
    assert any("nm rms from the computed profile" in text for text in answer_lines(content))
    points = calibration_run.read_answer(out)[1]
    panels = calibration_figure(content, points, [line]).axes
    assert next(axes.get_ylabel() for axes in panels) == "height [nm]"


def test_hidden_factor_of_a_spot(tmp_path, monkeypatch):
    """A map of a whole spot that lies at an angle: its factor comes back from cells that all trials
    share; those at half the spacing are the check."""

    def from_summary(run, period):
        x = (np.arange(100) + 0.5) * period / 100
        return Cell(x, {name: pools(run.summary["fluence"], x) for name in UNITS}, True)

    monkeypatch.setattr(calibration_run, "read_any_cell", from_summary)
    x = np.linspace(-24 * UM, 24 * UM, 385)
    fluence = spot(center=0.95 * 4500.0).at(*np.meshgrid(x, x))
    hidden = Relief("hidden", table(24, 400, pools), x, x, fluence)
    x, y = np.linspace(-16 * UM, 16 * UM, 60), np.linspace(-10 * UM, 10 * UM, 16)
    X, Y = np.meshgrid(x, y)
    moved, turned = (X - 0.4 * UM) / 1.01, (Y + 0.9 * UM) / 1.01
    z = hidden.at(moved + 0.03 * turned, turned - 0.03 * moved, 1.0) + 2e-3 * X - 1e-3 * Y
    z = HeightMap(x - x[0], y - y[0], z + 5 * NM * np.random.default_rng(3).normal(size=z.shape))
    plan = plan_of(tmp_path, z, settings=SPOT, runs="first = 6\nmost = 6\ncells = 6")
    content = lasersph.calibrate(plan, tmp_path / "out", engine=ReliefEngine())
    one, (profile,) = content["unknowns"]["factor"], content["profiles"]
    assert one["low_95"] < 0.95 < one["high_95"]
    assert one["sd"] < 0.01
    assert profile["lateral_scale"]["value"] == pytest.approx(1.01, abs=0.003)
    assert profile["difference_rms_m"] == pytest.approx(5 * NM, rel=0.1)
    assert len(list((tmp_path / "out/runs").iterdir())) == 6 + 6
    assert content["check"]["numbers"][0]["shift_at_half_spacing"] == 0.0


def test_cells_of_spots(tmp_path):
    """Light and size of a spot change no cell; reflectivity does."""
    unknown = (FACTOR, ABSORPTIVITY)
    plan = plan_of(tmp_path, measurement(1.0), unknown, SPOT, runs="first = 8\ncells = 6")
    cells = read_calibration_plan(plan).spot
    some = {"laser.fluence": 4000.0, "laser.reflectivity": 0.6}
    first, dark, bright = (
        [one.hash for one in cells.points({**some, **other})]
        for other in ({}, {"laser.fluence": 5000.0}, {"laser.reflectivity": 0.5})
    )
    assert first == dark and not set(first) & set(bright)
    assert cells.points(some)[-1].settings["laser.fluence"] == pytest.approx(1.3 * 4500.0)
    assert list(cells.cell_units) == ["laser.fluence", "laser.reflectivity"]
