"""Calibration in a folder and from the command line, with an engine that computes nothing."""

import json
import re

import numpy as np
import pytest

import lasersph
from lasersph.case import load_case
from lasersph.cli import main
from lasersph.output import FolderRefused
from lasersph.plots.calibration import calibration_figure
from lasersph.simulation.time_loop import Stopped
from lasersph.studies import calibration_run, read_calibration_plan
from lasersph.studies.calibration_answer import answer_lines
from lasersph.sweeps import Event

PLAN = """case = "dlip-steel"
[set]
"solver.kind" = "conduction"
"particles.spacing" = "24 nm"
[unknown]
factor = { scales = "laser.fluence", between = [0.7, 1.6] }
[[measured]]
set = { "laser.fluence" = "0.5 J/cm^2" }
values = { "melt.depth_max_m" = "251 +- 6 nm", "melt.width_half_max_m" = "2.74 +- 0.06 um" }
[[measured]]
set = { "laser.fluence" = "0.7 J/cm^2" }
values = { "melt.depth_max_m" = "352 +- 6 nm" }
[runs]
first = 4
most = 6
"""
"""Measured where the depth is 457 nm times the fluence in J/cm^2: a factor of 1.1."""


class FormulaEngine:
    """Writes summaries by a formula, notes how many runs it made, and stops after some."""

    def __init__(self, stop_after=99):
        self.made, self.stop_after = 0, stop_after

    def make(self, tasks, report, should_stop):
        """Make the folders of all tasks exist."""
        for task in tasks:
            if self.made >= self.stop_after:
                report(Event(task.run, "stopped", exit_code=143))
                continue
            self.made += 1
            fluence = 1e-4 * task.case.laser.fluence
            melt = {"depth_max_m": 457e-9 * fluence, "width_half_max_m": 2.9e-6 * fluence**0.1}
            spacing = task.case.particles.spacing
            summary = {"melt": melt, "numerical_sd": {"melt.depth_max_m": spacing / 12.0**0.5}}
            task.folder.mkdir(parents=True)
            (task.folder / "summary.json").write_text(json.dumps(summary))
            report(Event(task.run, "complete", exit_code=0))


@pytest.fixture
def plan(tmp_path):
    """A plan file."""
    file = tmp_path / "plan.toml"
    file.write_text(PLAN)
    return file


def contents(folder):
    """The files of an answer."""
    names = ("calibration.json", "posterior.csv", "best.toml", "table.csv")
    return [(folder / name).read_text() for name in names]


def test_answer_in_a_folder(plan, tmp_path):
    """The factor, a case to run with it, points of the posterior, the check at both spacings."""
    engine, out = FormulaEngine(), tmp_path / "out"
    found = lasersph.calibrate(plan, out, engine=engine)
    assert found == json.loads((out / "calibration.json").read_text())
    factor = found["unknowns"]["factor"]
    assert factor["mean"] == pytest.approx(1.1, abs=0.03)
    assert engine.made == found["runs"] + 2
    assert {one["number"] for one in found["check"]["numbers"]} == {
        "melt.depth_max_m",
        "melt.width_half_max_m",
    }
    assert found["check"]["numbers"][0]["shift_at_half_spacing"] == 0.0
    best = load_case(out / "best.toml")
    assert best.laser.fluence == pytest.approx(5000.0 * factor["most_probable"])
    assert best.particles.spacing == pytest.approx(24e-9)
    content, points = calibration_run.read_answer(out)
    assert content["unknowns"].keys() == {"factor"}
    assert np.sum(points[:, 0] * points[:, 1]) == pytest.approx(factor["mean"], rel=1e-3)
    assert any("factor = 1." in line for line in answer_lines(found))


@pytest.mark.parametrize("stop_after", [2, 4, 5])
def test_stopped_and_repeated(plan, tmp_path, stop_after):
    """The same bytes as undisturbed, and no run made twice."""
    lasersph.calibrate(plan, tmp_path / "whole", engine=FormulaEngine())
    first, second = FormulaEngine(stop_after), FormulaEngine()
    with pytest.raises(Stopped, match=f"{stop_after} of"):
        calibration_run.calibrate(
            plan,
            tmp_path / "out",
            engine=first,
            should_stop=lambda: first.made >= stop_after,
        )
    lasersph.calibrate(plan, tmp_path / "out", engine=second)
    assert contents(tmp_path / "out") == contents(tmp_path / "whole")
    assert first.made + second.made == len(list((tmp_path / "whole" / "runs").iterdir()))


def test_folder_of_another_study(plan, tmp_path):
    """It is refused, and nothing is written."""
    lasersph.calibrate(plan, tmp_path / "out", engine=FormulaEngine())
    before = contents(tmp_path / "out")
    other = tmp_path / "other.toml"
    other.write_text(PLAN.replace('scales = "laser.fluence"', 'scales = "laser.pulse.fwhm"'))
    with pytest.raises(FolderRefused, match="another study"):
        lasersph.calibrate(other, tmp_path / "out", engine=FormulaEngine())
    assert contents(tmp_path / "out") == before


def test_command(plan, tmp_path, capsys, monkeypatch):
    """`lasersph calibrate` says the answer and draws it; --dry-run computes nothing."""
    out = tmp_path / "out"
    assert main(["calibrate", str(plan), "--out", str(out), "--dry-run"]) == 0
    text = capsys.readouterr().out
    assert "4 to 6, and two checks" in text
    assert "0.35 J/cm^2 to 1.12 J/cm^2" in text
    assert not out.exists()
    monkeypatch.setattr("lasersph.sweeps.LocalEngine", lambda *_: FormulaEngine())
    assert main(["calibrate", str(plan), "--out", str(out)]) == 0
    text, err = capsys.readouterr()
    first, then, *_ = err.splitlines()
    assert first.startswith("4 to 6 runs, and two checks, one after the other: roughly ")
    assert then.startswith("run ")
    assert "factor = 1." in text
    assert "half the spacing shifts it by 0" in text
    (check, *_) = (line for line in text.splitlines() if line.startswith("check: "))
    number = r"[0-9.]+ [nu]m"
    assert re.fullmatch(rf"check: \S+ {number}, emulated {number}; .* \({number} measured\)", check)
    assert (out / "calibration.png").stat().st_size > 10_000
    content, points = calibration_run.read_answer(out)
    panel = calibration_figure(content, points).axes[0]
    assert panel.get_xlabel() == "laser fluence [J/cm^2]"
    assert panel.get_ylabel().startswith("largest ") and "melt." not in panel.get_ylabel()
    plan.write_text(PLAN.replace("between = [0.7, 1.6]", "betwen = [0.7, 1.6]"))
    assert main(["calibrate", str(plan), "--out", str(tmp_path / "new")]) == 2
    assert "plan.toml:6" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


def test_new_plan(tmp_path, capsys):
    """`lasersph new --plan calibrate` writes a plan that is right."""
    assert main(["new", "--plan", "calibrate", str(tmp_path / "a.toml")]) == 0
    assert "lasersph calibrate" in capsys.readouterr().out
    assert read_calibration_plan(tmp_path / "a.toml").runs.most == 8


def test_missing_library(plan, tmp_path, monkeypatch):
    """Said before the first run."""
    monkeypatch.setattr(calibration_run, "find_spec", lambda name: None)
    engine = FormulaEngine()
    with pytest.raises(lasersph.output.OutputError, match="scikit-learn"):
        lasersph.calibrate(plan, tmp_path / "out", engine=engine)
    assert engine.made == 0
