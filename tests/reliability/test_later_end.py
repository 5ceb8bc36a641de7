"""A run resumed with a later end, or with other times of its output, goes on; nothing is lost."""

import json
import random
import shutil

import numpy as np
import pytest
from reliability_runs import assert_same, kill_after, results, small_case

from lasersph.cli import main
from lasersph.output import FolderRefused, checkpoint, open_run, run_folder, run_owner
from lasersph.simulation import run
from lasersph.simulation.time_loop import Stopped

EARLY, LATE = ("time.end=46ns",), ("time.end=62ns", "output.snapshots.interval=4ns")


def compute(folder, *settings, **options):
    """Run or resume the small case without words."""
    return run(small_case(*settings), folder, resume=True, threads=2, warn=False, **options)


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    """Folders of a run to the early end, and of one that was extended to the late end."""
    place = tmp_path_factory.mktemp("later")
    compute(place / "early", *EARLY)
    compute(place / "late", *EARLY)
    compute(place / "late", *LATE)
    return place / "early", place / "late"


@pytest.fixture
def early(folders, tmp_path):
    """Function that makes a folder of the run to the early end; the folder, `run` by default."""
    return lambda name="run": shutil.copytree(folders[0], tmp_path / name)


def test_a_complete_run_goes_on(folders):
    """Its rows and frames stay, with the particles that it began with, and new ones follow; the
    numbers are those of a run that never stopped, but for the step that was cut to the old end."""
    early, late = (open_run(folder) for folder in folders)
    old, new = early.history["time_s"], late.history["time_s"]
    assert np.array_equal(new[: old.size], old)
    assert new[-1] == 62e-9
    assert late.summary["particles"] == early.summary["particles"]
    assert late.summary["time_s"] == 62e-9
    frames = late.snapshots.times * 1e9
    assert np.allclose(frames, [0, 10, 20, 30, 40, 46, 48, 52, 56, 60, 62])
    assert [text for text in late.summary["warnings"] if "379 particles were laid out" in text]
    assert late.resolved["started_with"]["time.end"] == 46e-9
    assert late.case["time"]["end"] == 62e-9
    assert [one["event"] for one in late.events].count("finished") == 1


def test_numbers_of_an_extended_run(folders, tmp_path):
    """Temperature and depth are those of one run to the late end, within what a step changes."""
    whole = compute(tmp_path / "run", *LATE).summary
    extended = open_run(folders[1]).summary
    for section, key in (("melt", "depth_half_max_m"), ("melt", "width_half_max_m")):
        assert np.isclose(extended[section][key], whole[section][key], rtol=0.02)
    assert np.isclose(extended["temperature_max_K"], whole["temperature_max_K"], rtol=1e-3)


@pytest.mark.parametrize("seed", [1, 2])
def test_a_killed_extension_is_resumed(folders, early, seed):
    """Killed at random moments, then resumed, it ends with the bits of one left alone."""
    moments, folder = random.Random(seed), early()
    for _ in range(2):
        kill_after(folder, moments.randint(1, 9), moments.uniform(0.0, 0.005), *LATE)
    assert not open_run(folder).is_complete
    compute(folder, *LATE)
    assert_same(folder, folders[1])


@pytest.mark.parametrize("place", ["replace_text", "write_origin", "last_good"])
def test_a_kill_while_the_summary_is_retracted(folders, early, place, monkeypatch):
    """After each of its steps the old run comes back to its summary, or the new one goes on."""

    class Killed(BaseException):
        """Nothing handles it."""

    def die(*_):
        raise Killed

    owner = run_folder.RunFolder if place == "last_good" else run_owner
    both = [early(name) for name in ("back", "forth")]
    for folder in both:
        with monkeypatch.context() as patch:
            if place == "write_origin":
                patch.setattr(run_owner, "replace_json", die)
            else:
                patch.setattr(owner, place, die)
            with pytest.raises(Killed):
                compute(folder, *LATE)
        assert not (folder / "summary.json").exists()
    compute(both[1], *LATE)
    assert_same(both[1], folders[1])
    if place == "last_good":  # from here on the folder is of the new case
        with pytest.raises(FolderRefused, match=r"to a later end \(time.end is 6.2e-08 there"):
            compute(both[0], *EARLY)
    else:
        compute(both[0], *EARLY)
        assert_same(both[0], folders[0])


@pytest.mark.parametrize(
    ("settings", "text"),
    [
        (("time.end=40ns",), r"to a later end \(time.end is 4.6e-08 there, not 4e-08, SI\)"),
        (("time.end=62ns", "laser.fluence=1 J/cm^2"), r"another case \(laser.fluence is"),
        (("time.end=62ns", "time.step=2ns"), r"another case \(time.step is 1e-09 there"),
    ],
)
def test_other_changes_are_refused(folders, settings, text):
    """In one line with the key, and the folder is as it was."""
    before = results(folders[0])[:2]
    with pytest.raises(FolderRefused, match=text):
        compute(folders[0], *EARLY, *settings)
    assert results(folders[0])[:2] == before


def test_a_damaged_last_checkpoint_is_no_end_to_go_on_from(early):
    """The summary is kept."""
    folder = early()
    (file,) = checkpoint.candidates(folder / "checkpoint")
    file.write_bytes(file.read_bytes()[:-50])
    with pytest.raises(checkpoint.OutputError, match="there is nothing to go on from"):
        compute(folder, *LATE)
    assert open_run(folder).is_complete


def test_a_stopped_run_goes_on_with_other_output(tmp_path):
    """Rows and frames so far stay; from then on they come as often as asked for."""
    folder = tmp_path / "run"
    steps = iter(range(1, 99))
    with pytest.raises(Stopped):
        compute(folder, *EARLY, should_stop=lambda: next(steps) == 20)
    more = ("output.snapshots.interval=4ns", "output.history_every=3", "output.checkpoint_every=5")
    compute(folder, *EARLY, *more)
    found = open_run(folder)
    numbers = found.history["step"]
    assert np.array_equal(numbers[:21], np.arange(21))
    assert all(number % 3 == 0 for number in numbers[21:])
    assert found.resolved["started_with"]["output"]["history_every"] == 1
    assert np.allclose(np.diff(found.snapshots.times)[-3:-1], 4e-9)


def test_overwriting(early, tmp_path, capsys):
    """The run is replaced when the new case is right; a file of the user's stays."""
    folder = early()
    (folder / "notes.txt").write_text("mine")
    (folder / "report.html").write_text("old")
    summary = (folder / "summary.json").read_bytes()
    command = ["run", "dlip-steel", "--out", str(folder), "--overwrite", "--no-figures", "--anyway"]
    command += ["--set"]
    assert main([*command, "particles.spacing=-1nm"]) == 2
    assert main([*command, "particles.spacing=100nm", "--resume"]) == 2
    assert (folder / "summary.json").read_bytes() == summary
    settings = ["time.step=1ns", "time.end=5ns"]
    more = [word for text in settings for word in ("--set", text)]
    assert main([*command, "particles.spacing=100nm", *more]) == 0
    found = open_run(folder)
    assert found.summary["time_s"] == 5e-9
    assert json.loads((folder / "resolved.json").read_text())["case"]["time"]["end"] == 5e-9
    assert (folder / "notes.txt").read_text() == "mine"
    assert not (folder / "report.html").exists()
    capsys.readouterr()
    other = tmp_path / "other"
    other.mkdir()
    (other / "thesis.tex").write_text("mine")
    command[3] = str(other)
    assert main([*command, "particles.spacing=100nm"]) == 2
    assert "not the folder of a run, and nothing else is overwritten" in capsys.readouterr().err
    assert [path.name for path in other.iterdir()] == ["thesis.tex"]


def test_a_run_that_may_not_have_another_end_says_why(tmp_path):
    """Of a train whose pauses are jumped over the end is the length of a pulse."""
    case = {"time": {"end": 1e-7}, "output": {}}
    run_owner.write_origin(tmp_path, run_owner.Origin("", case, {}), {})
    later = run_owner.Origin("", {**case, "time": {"end": 2e-7}}, {}, changeable=("output",))
    with pytest.raises(FolderRefused, match="how long each pulse is computed where pauses"):
        run_owner.check_owner(tmp_path, later)
