"""The run folder: refusals, completion, and resuming after a kill at any moment."""

import json
import os
import random
import shutil
import signal
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from lasersph.output import FolderRefused, OutputError, RunFolder, checkpoint, open_run
from lasersph.output.run_folder import Origin

CASE = Origin('spacing = "8 nm"\n', {"spacing": 8e-9}, {"lasersph": "1"})
SUMMARY = {
    "case": "toy",
    "solver": "toy",
    "particles": 20,
    "steps": 30,
    "time_s": 3.0,
    "wall_time_s": 0.1,
    "temperature_max_K": 1.0,
    "energy": {"unit": "J/m"},
}

TOY = """
import signal, sys
from pathlib import Path
sys.path.insert(0, {here!r})
from test_run_folder import toy_run
calls = 0

def count(*_):
    global calls
    calls += 1
    if calls == {call}:
        signal.setitimer(signal.ITIMER_REAL, {delay})

sys.setprofile(count)
toy_run(Path(sys.argv[1]))
sys.setprofile(None)
print(calls)
"""
"""A run that dies `delay` [s] after a number of function calls: nothing handles its alarm."""


def toy_run(path, steps=40):
    """A run whose state is a chaotic map: any lost or repeated step shows in the end."""
    run, found = RunFolder.resume(path, CASE)
    if run.is_complete:
        run.close()
        return
    state = np.linspace(0.1, 0.9, 20) if found is None else found.arrays["state"]
    first = 0 if found is None else found.step
    for step in range(first + 1, steps + 1):
        state = 3.9 * state * (1.0 - state)
        run.history.append({"time_s": step * 0.1, "state_max": float(state.max())})
        if step % 4 == 0:
            run.particles.append(step * 0.1, np.zeros((1, 20)), {"state": state})
            run.events.append("snapshot", time=step * 0.1, step=step)
        if step % 7 == 0:
            run.save_checkpoint(step=step, time=step * 0.1, arrays={"state": state}, scalars={})
    run.finish(SUMMARY)
    run.close()


def outcome(path):
    """What a finished run left, without its dates."""
    run = open_run(path)
    events = [{k: v for k, v in e.items() if k != "clock"} for e in run.events]
    snapshots = [(s["time"], s["state"].tobytes()) for s in run.snapshots]
    return (path / "history.csv").read_bytes(), events, snapshots, run.summary


def test_files_of_a_complete_run(tmp_path):
    """The folder holds the contract's files, and summary and case carry their schema version."""
    toy_run(tmp_path / "run")
    run = open_run(tmp_path / "run")
    assert run.is_complete
    assert run.summary["schema_version"] == 2
    assert run.resolved["schema_version"] == 2
    assert run.case == {"spacing": 8e-9}
    assert run.case_text == CASE.case_text
    assert run.history["time_s"].shape == (40,)
    assert len(run.snapshots) == 10
    with pytest.raises(OutputError, match="not a run folder"):
        open_run(tmp_path)


def test_existing_folder_is_refused(tmp_path):
    """A folder with files in it is never written over."""
    (tmp_path / "notes.txt").write_text("mine")
    with pytest.raises(FolderRefused, match="is not empty"):
        RunFolder.create(tmp_path, CASE)
    with pytest.raises(FolderRefused, match="not a run folder"):
        RunFolder.resume(tmp_path, CASE)
    with pytest.raises(FolderRefused, match="is a file"):
        RunFolder.create(tmp_path / "notes.txt", CASE)
    assert [path.name for path in tmp_path.iterdir()] == ["notes.txt"]


def test_unwritable_place_is_refused(tmp_path):
    """A folder that cannot be made gives one clear line."""
    with pytest.raises(FolderRefused, match="cannot write"):
        RunFolder.create("/proc/lasersph-run", CASE)
    (tmp_path / "file").write_text("")
    with pytest.raises(FolderRefused, match="cannot write"):
        RunFolder.create(tmp_path / "file" / "run", CASE)


def test_two_processes_cannot_share_a_folder(tmp_path):
    """The second one is told so."""
    first = RunFolder.create(tmp_path / "run", CASE)
    with pytest.raises(FolderRefused, match="another process"):
        RunFolder.resume(tmp_path / "run", CASE)
    first.close()
    RunFolder.resume(tmp_path / "run", CASE)[0].close()


def test_another_case_is_refused(tmp_path):
    """A run is only resumed with the case that it was started with."""
    toy_run(tmp_path / "run")
    with pytest.raises(FolderRefused, match=r"another case .spacing is 8e-09 there, not 4e-09, SI"):
        RunFolder.resume(tmp_path / "run", replace(CASE, case={"spacing": 4e-9}))


def test_summary_needs_its_keys(tmp_path):
    """A summary that lacks a key of the contract is a mistake of the program."""
    run = RunFolder.create(tmp_path / "run", CASE)
    with pytest.raises(ValueError, match="lacks energy"):
        run.finish({key: value for key, value in SUMMARY.items() if key != "energy"})
    assert not run.is_complete
    run.close()


def test_finished_run_is_left_alone(tmp_path):
    """Resuming a complete run changes nothing."""
    toy_run(tmp_path / "run")
    before = outcome(tmp_path / "run")
    toy_run(tmp_path / "run")
    assert outcome(tmp_path / "run") == before


def test_kill_at_random_moments_changes_nothing(tmp_path):
    """Killed with SIGKILL again and again, then resumed, a run ends bit for bit the same."""
    whole = run_toy(tmp_path / "whole", call=0, delay=0.0)
    calls = int(whole.stdout)
    expected = outcome(tmp_path / "whole")
    rng = random.Random(1)
    killed = 0
    for _ in range(6):
        moment = {"call": rng.randint(1, calls // 4), "delay": rng.uniform(1e-6, 1e-3)}
        killed += run_toy(tmp_path / "run", **moment).returncode == -signal.SIGALRM
    assert killed
    toy_run(tmp_path / "run")
    assert outcome(tmp_path / "run") == expected


def run_toy(path, **moment):
    """Run or resume the toy in a process of its own; without a moment it ends by itself."""
    script = TOY.format(here=os.path.dirname(__file__), **moment)
    return subprocess.run([sys.executable, "-c", script, path], capture_output=True, text=True)


def prepare_cut_run(path):
    """A run folder as a kill leaves it: no summary, rows and snapshots after the checkpoint."""
    toy_run(path)
    (path / "summary.json").unlink()


def test_files_torn_after_the_checkpoint_are_repaired(tmp_path):
    """History and events cut anywhere behind the checkpoint, and torn temporary files."""
    toy_run(tmp_path / "whole")
    expected = outcome(tmp_path / "whole")
    rng = random.Random(2)
    for number in range(5):
        path = tmp_path / f"run{number}"
        prepare_cut_run(path)
        for name, kept in (("history.csv", 36), ("events.jsonl", 8)):
            data = (path / name).read_bytes()
            least = len(b"".join(data.splitlines(keepends=True)[:kept]))
            (path / name).write_bytes(data[: rng.randint(least, len(data))])
        (path / "checkpoint" / "step-0000000042.checkpoint.writing").write_bytes(b"torn")
        (path / "summary.json.writing").write_text("{")
        toy_run(path)
        assert outcome(path) == expected


def test_damaged_checkpoint_falls_back_to_the_one_before(tmp_path):
    """The run goes on from the earlier checkpoint, says so, and ends the same."""
    toy_run(tmp_path / "whole")
    path = tmp_path / "run"
    prepare_cut_run(path)
    (path / "checkpoint" / "step-0000000035.checkpoint").write_bytes(b"rubbish")
    toy_run(path)
    history, events, snapshots, _ = outcome(path)
    expected = outcome(tmp_path / "whole")
    assert (history, snapshots) == (expected[0], expected[2])
    warnings = [e["message"] for e in events if e["event"] == "warning"]
    assert len(warnings) == 1
    assert "it is damaged; going on from step 28" in warnings[0]


def test_all_checkpoints_damaged_is_one_clear_line(tmp_path):
    """Nothing is lost: the files stay as they are."""
    path = tmp_path / "run"
    prepare_cut_run(path)
    for file in (path / "checkpoint").iterdir():
        file.write_bytes(b"rubbish")
    before = (path / "history.csv").read_bytes()
    with pytest.raises(OutputError, match="no earlier checkpoint"):
        toy_run(path)
    assert (path / "history.csv").read_bytes() == before


def test_damaged_particle_file_is_set_aside(tmp_path):
    """Snapshots that a failing disk destroyed do not keep the run from going on."""
    path = tmp_path / "run"
    prepare_cut_run(path)
    (path / "particles.vtkhdf").write_bytes(b"rubbish" * 1000)
    toy_run(path)
    assert (path / "particles.vtkhdf.damaged").exists()
    assert len(open_run(path).snapshots) == 2
    assert any("it is kept as" in e.get("message", "") for e in open_run(path).events)


def test_a_kill_before_the_first_checkpoint_starts_again(tmp_path):
    """Without a checkpoint, or with nothing but a torn first file, a resumed run starts anew."""
    toy_run(tmp_path / "whole")
    path = tmp_path / "run"
    prepare_cut_run(path)
    shutil.rmtree(path / "checkpoint")
    toy_run(path)
    assert outcome(path) == outcome(tmp_path / "whole")
    torn = tmp_path / "torn"
    torn.mkdir()
    (torn / "resolved.json.writing").write_text("{")
    toy_run(torn)
    assert outcome(torn) == outcome(tmp_path / "whole")


def test_tables_for_other_tools(tmp_path):
    """pandas and xarray views where these are installed, one clear line where not."""
    toy_run(tmp_path / "run")
    run = open_run(tmp_path / "run")
    for package, view in (("pandas", run.history_frame), ("xarray", run.snapshots_dataset)):
        try:
            __import__(package)
        except ImportError:
            with pytest.raises(OutputError, match=f"{package} is not installed"):
                view()
        else:
            assert len(view())
    assert json.dumps(run.summary)


def test_checkpoint_of_an_earlier_version(tmp_path, monkeypatch):
    """One line says so before anything is touched, also where the hash of the case has changed."""
    folder = tmp_path / "run"
    with monkeypatch.context() as patch:
        patch.setattr(checkpoint, "CHECKPOINT_SCHEMA", 3)
        run = RunFolder.create(folder, CASE)
        run.save_checkpoint(step=4, time=0.4, arrays={}, scalars={})
        run.close()
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    for case_hash in ("", "another"):
        with pytest.raises(FolderRefused) as told:
            RunFolder.resume(folder, replace(CASE, case_hash=case_hash))
        formats = f"its format is 3, this version reads {checkpoint.CHECKPOINT_SCHEMA}; "
        assert f"of another version of lasersph: {formats}" in str(told.value)
    assert before == {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
