"""Settings for wanted values, from the emulated runs of a made-up sweep."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from bad_plans import assert_mistake
from sweep_runs import PretendingEngine

from lasersph.cli import main
from lasersph.input import QuantityError
from lasersph.output.errors import FolderRefused
from lasersph.studies import Target, find, find_settings, parse_target
from lasersph.studies.find_runs import read_find_plan
from lasersph.sweeps import Row, Table, make_runs


@pytest.fixture
def table():
    """Depth 500 nm times the fluence in J/cm^2, at most 4000 K times it, over 8 runs."""
    rows = []
    for number, fluence in enumerate(np.linspace(3000.0, 10000.0, 8)):
        numbers = {
            "melt.depth_max_m": 5e-11 * fluence,
            "temperature_max_K": 0.4 * fluence,
            "numerical_sd.melt.depth_max_m": 2e-9,
        }
        rows.append(Row(f"{number:04d}-a", "complete", {"laser.fluence": fluence}, numbers))
    return Table(Path("made-up"), tuple(rows), {"laser.fluence": "J/m^2"}, ())


def test_targets():
    """A band, and limits from above and below, in SI."""
    target = parse_target("melt.depth_max_m = 200 +- 10 nm")
    assert (target.low, target.high) == pytest.approx((190e-9, 210e-9))
    assert parse_target("temperature_max_K<3000 K").high == 3000.0
    assert parse_target("temperature_max_K > 300 K").low == 300.0


def test_number_of_runs_and_their_time_are_said_first(tmp_path, capsys, monkeypatch):
    """Before the first run; the same command again says what is complete."""
    plan, out = tmp_path / "plan.toml", tmp_path / "out"
    plan.write_text(PLAN.replace("most = 8", "most = 5"))
    engine = PretendingEngine(depth=lambda fluence: 1e-11 * fluence)
    monkeypatch.setattr("lasersph.sweeps.LocalEngine", lambda *_: engine)
    main(["find", str(plan), "--out", str(out)])
    first, then, *_ = capsys.readouterr().err.splitlines()
    assert first.startswith("4 to 5 runs, one after the other: roughly ") and " to " in first
    assert then.startswith("run ")
    main(["find", str(plan), "--out", str(out)])
    assert capsys.readouterr().err.splitlines()[0] == "4 to 5 runs, all complete"


@pytest.mark.parametrize(
    "text",
    ["200 nm", "melt.depth_mx_m < 2 nm", "melt.depth_max_m < 2 s", "melt.depth_max_m = 2 nm"],
)
def test_bad_targets(text):
    """No sign, no such number, another unit, no width."""
    with pytest.raises(QuantityError):
        parse_target(text)


def test_settings_by_hand(table):
    """200 nm need 0.4 J/cm^2, where the depth is within +- 10 nm nearly surely."""
    found = find_settings(table, [Target("melt.depth_max_m", 190e-9, 210e-9)])
    assert found[0].settings["laser.fluence"] == pytest.approx(4000.0, rel=0.03)
    assert found[0].probability > 0.99
    assert found[0].numbers["melt.depth_max_m"] == pytest.approx(200e-9, rel=0.03)


def test_limits_exclude(table):
    """As deep and as cold as wanted do not go together: 300 nm are 2400 K."""
    deep = Target("melt.depth_max_m", 300e-9, np.inf)
    assert find_settings(table, [deep, Target("temperature_max_K", -np.inf, 2000.0)]) == []
    found = find_settings(table, [deep, Target("temperature_max_K", -np.inf, 2800.0)])
    assert 6000.0 < found[0].settings["laser.fluence"] < 7000.0


def test_a_number_that_never_changes_is_named(table):
    """All runs reach the same temperature."""
    rows = [replace(row, numbers={"temperature_max_K": 3000.0}) for row in table.rows]
    with pytest.raises(ValueError, match="temperature_max_K: all 8 runs give 3000"):
        find_settings(replace(table, rows=tuple(rows)), [Target("temperature_max_K", 0.0, 2000.0)])


def test_under_a_calibration(table):
    """A factor of 1.25 +- 0.04 on the fluence: 0.32 J/cm^2 act as 0.4; 3 % of 200 nm are 6 nm, so
    that +- 10 nm hold about 88 % of the time."""
    factor = np.linspace(1.09, 1.41, 201)
    weights = np.exp(-0.5 * ((factor - 1.25) / 0.04) ** 2)
    content = {"unknowns": {"factor": {"key": "laser.fluence", "relation": "scales"}}}
    target = Target("melt.depth_max_m", 190e-9, 210e-9)
    points = np.column_stack([factor, weights])
    found = find_settings(table, [target], calibration=(content, points))
    assert found[0].settings["laser.fluence"] == pytest.approx(3200.0, rel=0.03)
    assert 0.7 < found[0].probability < 0.97
    assert found[0].numbers["melt.depth_max_m"] == pytest.approx(200e-9, rel=0.03)
    content["unknowns"]["factor"]["key"] = "laser.pulse.fwhm"
    with pytest.raises(ValueError, match="does not vary"):
        find_settings(table, [target], calibration=(content, points))


def test_command(table, capsys, monkeypatch, tmp_path):
    """`lasersph find` lists settings; what is wrong is one line."""
    assert main(["find", str(tmp_path), "--want", "temperature_max_K < 3000 K"]) == 2
    assert "holds no sweep" in capsys.readouterr().err
    monkeypatch.setattr("lasersph.sweeps.Table.read", lambda folder: table)
    assert main(["find", str(tmp_path), "--want", "melt.depth_max_m = 200 +- 10 nm"]) == 0
    head, _, first, *_ = capsys.readouterr().out.splitlines()
    assert "laser.fluence" in head and "laser.fluence_J_m2" not in head
    assert " %" in first and re.search(r" 0\.\d+ J/cm\^2 .* nm", first)
    assert main(["find", str(tmp_path), "--want", "melt.depth_max_m > 2 um"]) == 2
    said = capsys.readouterr().err
    assert "no settings" in said
    assert re.search(r"they reach melt\.depth_max_m from [0-9.]+ [nu]m to [0-9.]+ [nu]m; see", said)


PLAN = """case = "dlip-steel"
want = ["melt.depth_max_m = 60 +- 1 nm"]
[vary]
"laser.fluence" = { from = "0.3 J/cm^2", to = "1 J/cm^2" }
[runs]
first = 4
most = 8
"""


def test_runs_are_added_where_the_answer_is_unsure(tmp_path):
    """A depth that winds over the fluence: four runs do not tell where it is 60 nm, some more do.
    The same call again finds them and computes nothing."""
    plan = tmp_path / "plan.toml"
    plan.write_text(PLAN)

    def depth(fluence):
        return 1e-11 * (fluence + 600.0 * np.sin(fluence / 900.0))

    engine = PretendingEngine(depth=depth)
    found = find(plan, tmp_path / "out", engine=engine)
    assert 4 < len(engine.made) <= 8
    assert depth(found[0].settings["laser.fluence"]) == pytest.approx(60e-9, abs=1e-9)
    assert found[0].probability > 0.9 and found[0].emulator_share < 0.1
    made = list(engine.made)
    assert find(plan, tmp_path / "out", engine=engine) == found and engine.made == made
    sweep = read_find_plan(plan).sweep
    with pytest.raises(FolderRefused, match=r"another study \(search of dlip-steel over"):
        make_runs(sweep.points(), tmp_path / "out", sweep.study, engine=engine)


@pytest.mark.parametrize(
    ("old", "new", "line", "words"),
    [
        ("60 +- 1 nm", "60 nm", 2, "want: "),
        ('["melt.depth_max_m = 60 +- 1 nm"]', "[]", 2, "want: nothing is wanted"),
        ("first = 4", "fist = 4", 6, "runs.fist: unknown key"),
        ('from = "0.3 J/cm^2"', 'from = "0.3 J"', 4, "laser.fluence"),
        ('"1 J/cm^2"', '"1 J/cm^2", count = 4', 4, "laser.fluence: count is for grid and zip"),
        ("first = 4", "first = 9", 6, "runs.first: more than most, 8; write most = 9"),
        ("most = 8", "most = 2", 7, "runs.most: too few: an emulator of 1 key needs 3 runs"),
    ],
)
def test_wrong_plans(tmp_path, old, new, line, words):
    """One line with file and line, and nothing is written."""

    def find_in_folder(plan):
        find(plan, tmp_path / "out")

    assert_mistake(find_in_folder, tmp_path, PLAN.replace(old, new), line, words)


def test_folders_and_plans_take_their_own_options(tmp_path, capsys):
    """Wishes on the command line are for a folder, engines for a plan; a new plan can be read."""
    assert main(["find", str(tmp_path)]) == 2
    assert "takes --want" in capsys.readouterr().err
    assert main(["new", "--plan", "find", str(tmp_path / "a.toml")]) == 0
    assert len(read_find_plan(tmp_path / "a.toml").sweep.points()) == 8
    assert main(["find", str(tmp_path / "a.toml"), "--out", str(tmp_path), "--dry-run"]) == 0
    said = capsys.readouterr().out
    assert "8 to 16" in said and "laser.fluence, laser.pulse.fwhm" in said
    assert [one.name for one in tmp_path.iterdir()] == ["a.toml"]
    assert main(["find", str(tmp_path / "a.toml"), "--want", "temperature_max_K < 9 K"]) == 2
    assert "a plan says what is wanted" in capsys.readouterr().err
