"""A run killed at any moment and resumed ends with the same bits as one left alone."""

import json
import random

import pytest
from reliability_runs import assert_same, kill_after, small_case, start_and_pause

from lasersph.output import FolderRefused, OutputError, open_run
from lasersph.output.history import read_events
from lasersph.simulation import run
from lasersph.simulation.time_loop import Stopped

SEEDS = (1, 2)
KILLS = 2


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    """Folder of an uninterrupted run."""
    folder = tmp_path_factory.mktemp("reference") / "run"
    run(small_case(), folder, threads=2)
    return folder


@pytest.mark.parametrize("seed", SEEDS)
def test_kill_at_random_moments(tmp_path, reference, seed):
    """`kill -9` at random moments, each time resumed: summary, history and snapshots agree."""
    moments = random.Random(seed)
    folder = tmp_path / "run"
    for _ in range(KILLS):
        kill_after(folder, moments.randint(9, 40), moments.uniform(0.0, 0.005))
    assert not (folder / "summary.json").exists()
    run(small_case(), folder, resume=True, threads=2)
    assert_same(folder, reference)
    assert [e["event"] for e in read_events(folder / "events.jsonl")].count("resumed") >= 1


def test_kill_before_the_first_checkpoint(tmp_path, reference):
    """A run killed at its start begins anew."""
    folder = tmp_path / "run"
    kill_after(folder, 1, 0.0)
    run(small_case(), folder, resume=True, threads=2)
    assert_same(folder, reference)


@pytest.mark.parametrize("steps", [1, 40])
def test_stop_leaves_a_checkpoint(tmp_path, reference, steps):
    """Asked to stop after any step, a run saves that step and says where; resuming ends it."""
    folder = tmp_path / "run"
    done = []

    def should_stop():
        done.append(1)
        return len(done) == steps

    with pytest.raises(Stopped, match=f"after {steps} steps"):
        run(small_case(), folder, threads=2, should_stop=should_stop)
    assert (folder / "checkpoint" / f"step-{steps:010d}.checkpoint").exists()
    assert not (folder / "summary.json").exists()
    run(small_case(), folder, resume=True, threads=2)
    assert_same(folder, reference)


def test_stop_after_every_few_steps(tmp_path, reference):
    """Eight stops and resumptions change nothing."""
    folder = tmp_path / "run"
    for number in range(8):
        left = iter(range(number % 4, -1, -1))
        with pytest.raises(Stopped):
            run(small_case(), folder, resume=number > 0, threads=2,
                should_stop=lambda left=left: next(left) == 0)  # fmt: skip
    run(small_case(), folder, resume=True, threads=1)
    results = open_run(folder)
    assert results.summary["threads"] == 1
    assert (folder / "history.csv").read_bytes() == (reference / "history.csv").read_bytes()


def test_damaged_checkpoint_falls_back(tmp_path, reference):
    """A torn last checkpoint is passed over for the one before it, and the log says so."""
    folder = tmp_path / "run"
    kill_after(folder, 30, 0.0)
    latest = max((folder / "checkpoint").glob("*.checkpoint"))
    latest.write_bytes(latest.read_bytes()[:-100])
    run(small_case(), folder, resume=True, threads=2)
    assert_same(folder, reference, but=("warnings",))
    assert "is damaged" in (folder / "run.log").read_text()
    told, usual = (open_run(one).summary["warnings"] for one in (folder, reference))
    (own,) = (text for text in told if text not in usual)
    assert "is damaged; going on from step" in own


def test_all_checkpoints_damaged(tmp_path):
    """Where no checkpoint is whole, one line says so and the files stay."""
    folder = tmp_path / "run"
    kill_after(folder, 30, 0.0)
    for file in (folder / "checkpoint").glob("*.checkpoint"):
        file.write_bytes(b"nothing")
    with pytest.raises(OutputError, match="no earlier checkpoint can be used"):
        run(small_case(), folder, resume=True, threads=2)
    assert (folder / "history.csv").stat().st_size > 0


def test_existing_folder_is_refused(reference):
    """Without resume a folder with a run is refused; with resume a finished run is left alone."""
    before = (reference / "summary.json").read_bytes()
    with pytest.raises(FolderRefused, match="is not empty"):
        run(small_case(), reference, threads=2)
    assert run(small_case(), reference, resume=True, threads=2).summary["steps"] > 0
    assert (reference / "summary.json").read_bytes() == before


def test_other_case_or_precision_is_refused(reference):
    """A folder is resumed only by the case and the precision that it was started with."""
    with pytest.raises(FolderRefused, match="another case"):
        run(small_case("laser.fluence=0.5 J/cm^2"), reference, resume=True, threads=2)
    with pytest.raises(FolderRefused, match="another case"):
        run(small_case(), reference, resume=True, threads=2, precision="float32")


def test_second_process_is_refused(tmp_path):
    """While a run writes into a folder, a second one is refused."""
    folder = tmp_path / "run"
    process = start_and_pause(folder, 1)
    try:
        with pytest.raises(FolderRefused, match=f"another process is writing.*{process.pid} on "):
            run(small_case(), folder, resume=True, threads=2)
    finally:
        process.kill()
        process.communicate()


def test_folder_taken_over(tmp_path):
    """A run whose folder another machine took over while it slept writes nothing more."""
    folder = tmp_path / "run"
    done, written = [], {}

    def files():
        return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}

    def take_over():
        done.append(1)
        if len(done) == 3:
            (folder / ".lock").unlink()
            owner = {"process": 7, "host": "node7", "since": "now", "machine": "another"}
            (folder / ".lock").write_text(json.dumps(owner))
            written.update(files())
        return False

    with pytest.raises(OutputError, match="was taken over by process 7 on node7"):
        run(small_case(), folder, threads=2, should_stop=take_over)
    assert len(done) == 3 and files() == written


def test_no_lock_is_left(reference):
    """A finished run leaves no lock."""
    assert not (reference / ".lock").exists()
