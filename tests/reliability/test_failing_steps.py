"""Steps of a flow that fail: retried once, or told in one line with all that was reached kept."""

import shlex

import pytest
from reliability_runs import assert_same

from lasersph.cli import main
from lasersph.output import open_run
from lasersph.output.checkpoint import candidates, load
from lasersph.output.history import read_events
from lasersph.solvers.melt_pool.flow import Flow
from lasersph.solvers.step_control import NotConverged

CAVITY = (
    "run lid-driven-cavity --no-figures --threads 1 --set particles.spacing=100mm "
    '--set time.end=0.5s --set output.snapshots.interval=0.1s --out'
)  # fmt: skip
POOL = (
    "run dlip-steel --anyway --no-figures --threads 1 --set solver.kind=melt-pool "
    "--set particles.spacing=64nm --set time.step=1ns --out"
)


def lasersph(command, folder, *more):
    """Exit code of a command with its folder."""
    return main([*shlex.split(command), str(folder), *more])


def fail(monkeypatch, first, last):
    """Let the projections number `first` to `last` not converge, counted from 1."""
    right, calls = Flow.project, []

    def wrong(self, *arguments):
        calls.append(1)
        if first <= len(calls) <= last:
            raise NotConverged("the pressure equation is left with nothing good")
        return right(self, *arguments)

    monkeypatch.setattr(Flow, "project", wrong)
    return calls


@pytest.fixture(scope="module")
def cavity(tmp_path_factory):
    """Folder of a cavity's run without any failure."""
    folder = tmp_path_factory.mktemp("cavity") / "run"
    assert lasersph(CAVITY, folder) == 0
    return folder


def test_failing_once(tmp_path, cavity, monkeypatch):
    """The step is halved, the run goes on and ends where the other one ends, a bit later."""
    calls = fail(monkeypatch, 9, 9)
    folder = tmp_path / "run"
    assert lasersph(CAVITY, folder) == 0
    assert len(calls) > 9
    summary, reference = open_run(folder).summary, open_run(cavity).summary
    assert summary["time_s"] == reference["time_s"]
    assert summary["steps"] > reference["steps"]
    speed, expected = (s["flow"]["speed_max_m_s"] for s in (summary, reference))
    assert speed == pytest.approx(expected, rel=0.05)
    steps = open_run(folder).history["time_step_s"]
    assert 0.4 < steps[9] / steps[8] < 0.75


def test_failing_for_good(tmp_path, cavity, monkeypatch, capsys):
    """One line, exit code 1, a checkpoint, the last good snapshot; --resume repeats the bits."""
    folder = tmp_path / "run"
    with monkeypatch.context() as patch:
        fail(patch, 9, 10**9)
        assert lasersph(CAVITY, folder) == 1
    error = capsys.readouterr().err.splitlines()[-1]
    assert error.startswith("lasersph: the run failed: the pressure equation is left with nothing")
    assert "after 8 steps, the checkpoint and the last good snapshot are kept" in error
    checkpoint = load(max(candidates(folder / "checkpoint")))
    assert checkpoint.step == 8
    assert not (folder / "summary.json").exists()
    broken = open_run(folder)
    assert broken.snapshots.times[-1] == checkpoint.time
    seen = broken.snapshots[-1]["velocity"]
    assert seen == pytest.approx(checkpoint.arrays["velocity"], rel=1e-6)
    assert lasersph(CAVITY, folder, "--resume") == 0
    assert_same(folder, cavity)
    assert list(open_run(folder).snapshots.times) == list(open_run(cavity).snapshots.times)
    assert [e["event"] for e in read_events(folder / "events.jsonl")].count("resumed") == 1


def test_failing_again_after_resuming(tmp_path, cavity, monkeypatch):
    """A run that fails at the same place twice can still be resumed."""
    folder = tmp_path / "run"
    with monkeypatch.context() as patch:
        fail(patch, 9, 10**9)
        assert lasersph(CAVITY, folder) == 1
    with monkeypatch.context() as patch:
        fail(patch, 1, 10**9)
        assert lasersph(CAVITY, folder, "--resume") == 1
    assert lasersph(CAVITY, folder, "--resume") == 0
    assert_same(folder, cavity)


def test_tolerance_that_nothing_meets(tmp_path, capsys):
    """A pressure that cannot be solved well enough fails the run at its first step."""
    folder = tmp_path / "run"
    assert lasersph(CAVITY, folder, "--set", "solver.pressure_tolerance=1e-200") == 1
    error = capsys.readouterr().err.splitlines()
    assert "the pressure equation is left with a residual of" in error[-1]
    assert "after 0 steps" in error[-1]


def test_pool_too_deep(tmp_path, capsys):
    """Melt in graded layers ends the run with the key that helps; a deeper fine zone computes."""
    folder = tmp_path / "run"
    end = ("--set", "time.end=56ns")
    assert lasersph(POOL, folder, *end, "--set", "particles.fine_depth=128nm") == 1
    error = capsys.readouterr().err.splitlines()[-1]
    assert "deep and flows into layers coarser than" in error
    remedy = error.partition('give particles.fine_depth = "')[2].partition('"')[0]
    kept = open_run(folder)
    assert kept.snapshots.times[-1] > 4.6e-8
    assert load(max(candidates(folder / "checkpoint"))).time == kept.snapshots.times[-1]
    assert 128.0 < float(remedy.split()[0]) < 400.0
