"""Folders of many runs and the table made from them, with an engine that computes nothing."""

import csv
import json
from dataclasses import replace

import numpy as np
import pytest
from sweep_runs import PretendingEngine

from lasersph.output import OutputError
from lasersph.output.errors import FolderLocked, FolderRefused
from lasersph.sweeps import Study, Table, build_plan, make_runs
from lasersph.sweeps.folder import SweepFolder


def made(folder, fluences, engine=None, columns=(), **more):
    """The table of a sweep over fluences [J/m^2]; spacings above 2 um are refused."""
    values = [f"{fluence} J/m^2" for fluence in fluences]
    plan = build_plan("dlip-steel", {"laser.fluence": values}, columns=columns)
    return make_runs(
        plan.points(),
        folder,
        plan.study,
        engine=engine or PretendingEngine(),
        **more,
    )


def test_table_of_complete_and_failed_runs(tmp_path):
    """Values in SI, NaN where a run failed, the reason in the table and nowhere else."""
    table = made(tmp_path / "s", [4000, 5000, 6000], PretendingEngine(fails={5000.0}))
    assert table.status == ("complete", "failed", "complete")
    assert table.varied == ("laser.fluence",)
    assert table.rows[1].reason == "no step converges"
    assert np.array_equal(table.values("laser.fluence"), [4000, 5000, 6000])
    found = table.values("melt.depth_max_m")
    assert np.array_equal(found, [4e-8, np.nan, 6e-8], equal_nan=True)
    assert list(table.is_complete) == [True, False, True]
    with pytest.raises(KeyError, match='number "melt'):
        table.values("melt.depth_mx_m")


def test_csv_is_the_table(tmp_path):
    """Names carry units; NumPy and csv read it; it is the same when made anew."""
    table = made(tmp_path, [4000, 5000], PretendingEngine(fails={5000.0}))
    text = (tmp_path / "table.csv").read_text()
    first, second = csv.DictReader(text.splitlines())
    assert first["laser.fluence [J/m^2]"] == "4000.0" and first["melt.depth_max [m]"] == "4e-08"
    assert first["wall_time [s]"] == "2.5" and first["run"] == f"0001-{first['hash']}"
    assert second["status"] == "failed" and second["reason"] == "no step converges"
    assert "is_steady" not in first
    numbers = np.genfromtxt(tmp_path / "table.csv", delimiter=",", names=True)
    assert numbers.shape == (2,)
    (tmp_path / "table.csv").unlink()
    assert Table.read(tmp_path).write().read_text() == text
    assert Table.read(tmp_path) == table


def test_csv_is_in_the_units_of_the_plan(tmp_path):
    """0.7 J/cm2 comes back as that, an energy of a 2-D run per length; the frame stays in SI."""
    plan = build_plan("dlip-steel", {"laser.fluence": ["0.4 J/cm^2", "0.7 J/cm^2"]})
    table = make_runs(plan.points(), tmp_path, plan.study, engine=PretendingEngine())
    rows = list(csv.DictReader((tmp_path / "table.csv").read_text().splitlines()))
    assert [row["laser.fluence [J/cm^2]"] for row in rows] == ["0.4", "0.7"]
    assert "laser.fluence_J_m2" in table.header()
    assert table.number_unit("melt.volume_max_m3") == "m^3"  # no run says how many dimensions
    flat = replace(table.rows[0], numbers={"dimensions": 2.0})
    assert replace(table, rows=(flat,)).number_unit("melt.volume_max_m3") == "m^2"
    assert replace(table, rows=(flat,)).number_unit("energy.absorbed_J") == "J/m"


def test_a_longer_plan_finds_its_runs(tmp_path):
    """By the hash of their cases, whatever their place in the plan is now."""
    first, second = PretendingEngine(), PretendingEngine()
    names = made(tmp_path, [4000, 6000], first).runs
    longer = made(tmp_path, [3000, 4000, 5000, 6000], second)
    assert (longer.runs[1], longer.runs[3]) == names
    assert [name[:4] for name in longer.runs] == ["0003", "0001", "0004", "0002"]
    assert len(second.made) == 2 and longer.status == ("complete",) * 4


def test_failed_runs_are_tried_again(tmp_path):
    """By the next call; what then succeeds is complete."""
    made(tmp_path, [4000, 5000], PretendingEngine(fails={5000.0}))
    engine = PretendingEngine()
    assert made(tmp_path, [4000, 5000], engine).status == ("complete", "complete")
    assert len(engine.made) == 1


def test_stopped_sweep(tmp_path):
    """Nothing is begun after the wish to stop, and the table says what is missing."""
    table = made(tmp_path, [4000, 5000], should_stop=lambda: True)
    assert table.status == ("missing", "missing")


def test_refused_points_are_wrong(tmp_path):
    """They keep their reason and a number, and no engine gets them."""
    plan = build_plan("dlip-steel", {"particles.spacing": ["32 nm", "900 um"]})
    engine = PretendingEngine()
    table = make_runs(plan.points(), tmp_path, plan.study, engine=engine)
    assert table.status == ("complete", "wrong") and len(engine.made) == 1
    assert table.rows[1].run == "0002" and "coarsest" in table.rows[1].reason


def test_damaged_log_is_read(tmp_path):
    """A line that a kill has cut does not hide the others."""
    made(tmp_path, [5000], PretendingEngine(fails={5000.0}))
    with open(tmp_path / "sweep.jsonl", "a") as file:
        file.write('{"clock": "2026')
    assert Table.read(tmp_path).status == ("failed",)


def test_other_folders_are_refused(tmp_path):
    """Of files, of another study, of other settings; nothing is written."""
    made(tmp_path / "a", [4000])
    other = build_plan("dlip-steel", {"laser.pulse.fwhm": ["5 ns"]})
    same = build_plan("dlip-steel", {"laser.fluence": ["1 J/m^2"]}, set={"time.end": "9 ns"})
    for plan, message in ((other, "holds another study"), (same, "with other settings")):
        with pytest.raises(FolderRefused, match=message):
            make_runs([], tmp_path / "a", plan.study)
    (tmp_path / "b").mkdir()
    (tmp_path / "b" / "note.txt").write_text("mine")
    with pytest.raises(FolderRefused, match="not empty"):
        made(tmp_path / "b", [4000])
    assert [path.name for path in (tmp_path / "b").iterdir()] == ["note.txt"]
    with pytest.raises(FolderRefused, match="is a file"):
        made(tmp_path / "b" / "note.txt", [4000])
    with pytest.raises(OutputError, match="holds no sweep"):
        Table.read(tmp_path / "b")


def test_one_process_at_a_time(tmp_path):
    """A second one is refused while the folder is open."""
    study = Study("sweep", "0")
    with SweepFolder(tmp_path, study), pytest.raises(FolderLocked, match="another process"):
        SweepFolder(tmp_path, study)
    SweepFolder(tmp_path, study).__exit__()


def test_log_has_every_event(tmp_path):
    """Clock, run, worker, event, exit code, message."""
    table = made(tmp_path, [4000])
    entry = json.loads((tmp_path / "sweep.jsonl").read_text())
    assert entry["run"] == table.runs[0] and entry["event"] == "complete"
    assert entry["exit_code"] == 0 and entry["clock"].endswith("+00:00")


def test_frame(tmp_path):
    """pandas, where it is installed, gets the same columns."""
    table = made(tmp_path, [4000, 5000])
    pytest.importorskip("pandas")
    frame = table.frame()
    assert list(frame["melt.depth_max_m"]) == [4e-8, 5e-8]
    assert list(frame.index) == list(table.runs)


def test_unknown_columns_are_told(tmp_path):
    """With the nearest name."""
    table = made(tmp_path, [4000], columns=["melt.depth_mx_m"])
    (line,) = table.unknown_columns()
    assert line == 'no run has a number "melt.depth_mx_m" (do you mean "melt.depth_max_m"?)'
