"""Sweeps by real processes: nothing is lost and nothing is computed twice, whatever is killed."""

import json
import os
import signal
import subprocess
import sys

import numpy as np
import pytest
from reliability_runs import LONGEST_WAIT, wait_until
from sweep_runs import SETTINGS, children, contents, is_alive, plan_text

from lasersph.sweeps import LocalEngine, Table, build_plan, make_runs
from lasersph.sweeps.local import _Pool

FLUENCES = ["0.5 J/cm^2", "0.6 J/cm^2", "0.7 J/cm^2"]


def plan_of():
    """Three coarse runs of a second."""
    return build_plan("dlip-steel", {"laser.fluence": FLUENCES}, set=SETTINGS)


def make(folder, engine, plan=None, **more):
    """The table of the sweep."""
    plan = plan or plan_of()
    return make_runs(plan.points(), folder, plan.study, engine=engine, **more)


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """Folder and table of the sweep that nothing disturbs, by one worker."""
    folder = tmp_path_factory.mktemp("undisturbed")
    return folder, make(folder, LocalEngine(workers=1, threads=1))


def events_of(folder):
    """Run and event of each line of the log."""
    lines = (folder / "sweep.jsonl").read_text().splitlines()
    return [(entry["run"], entry["event"]) for entry in map(json.loads, lines)]


def test_undisturbed(undisturbed):
    """Every run is started once, by one warm worker, and complete."""
    folder, table = undisturbed
    assert table.status == ("complete",) * 3
    assert [event for _, event in events_of(folder)] == ["started", "complete"] * 3
    assert len(set(table.values("melt.depth_max_m"))) > 1


def test_killed_workers_are_replaced(undisturbed, tmp_path, monkeypatch):
    """Two workers die by SIGKILL in the middle of runs; the table and histories are the same."""
    killed = []
    tell = _Pool._tell

    def kill_and_tell(pool, worker, event):
        if event.kind == "progress" and len(killed) < 2 and worker.name not in killed:
            killed.append(worker.name)
            worker.process.kill()
        tell(pool, worker, event)

    monkeypatch.setattr(_Pool, "_tell", kill_and_tell)
    table = make(tmp_path, LocalEngine(workers=2, threads=1))
    assert len(killed) == 2 and table.status == ("complete",) * 3
    retries = [run for run, event in events_of(tmp_path) if event == "retry"]
    assert len(retries) == 2
    assert contents(tmp_path, table) == contents(*undisturbed)


def test_a_worker_that_always_dies(tmp_path, monkeypatch):
    """Its run fails with what was said, after the retries, and the others are complete."""
    tell, plan = _Pool._tell, plan_of()
    doomed = plan.points()[0].hash

    def kill_and_tell(pool, worker, event):
        if event.run.endswith(doomed):
            worker.process.kill()
        tell(pool, worker, event)

    monkeypatch.setattr(_Pool, "_tell", kill_and_tell)
    table = make(tmp_path, LocalEngine(workers=2, threads=1, retries=1), plan)
    assert table.status == ("failed", "complete", "complete")
    assert table.rows[0].reason == "its worker ended with signal 9 (tried 2 times)"


def test_stopped_command(undisturbed, tmp_path):
    """Ctrl-C and SIGTERM end all runs with checkpoints and say how to go on; the same command
    does."""
    plan, folder = tmp_path / "plan.toml", tmp_path / "out"
    plan.write_text(plan_of().text)
    command = [sys.executable, "-m", "lasersph", "sweep", str(plan), "--out", str(folder)]
    command += ["--workers", "2", "--threads", "1"]

    def checkpoints():
        return set(folder.glob("runs/*/checkpoint/*"))

    for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
        before = checkpoints()
        process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        wait_until(process, lambda before=before: checkpoints() - before)
        process.send_signal(number)
        _, said = process.communicate(timeout=LONGEST_WAIT)
        assert process.returncode == code and f"continue with: lasersph sweep {plan} --out" in said
        assert not list(folder.glob("runs/*/.lock"))
    again = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST_WAIT)
    assert again.returncode == 0, again.stderr
    assert "3 of 3 runs complete" in again.stdout
    assert contents(folder, Table.read(folder)) == contents(*undisturbed)


SCRIPT = """
import sys
from sweep_runs import SETTINGS
import lasersph
lasersph.sweep("dlip-steel", sys.argv[1], vary={{"laser.fluence": {fluences!r}}},
               set=SETTINGS, workers=2, threads=1)
"""
"""Without `if __name__ == "__main__"`."""


def begins(folder):
    """Lines of the log about runs that a worker began."""
    log = folder / "sweep.jsonl"
    lines = log.read_text().splitlines() if log.exists() else []
    return [line for line in lines if "started" in line]


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="looks into /proc")
def test_killed_driver_leaves_nobody(undisturbed, tmp_path):
    """Killed twice, its workers end by themselves; the same call again completes the table."""
    here = os.pathsep.join([os.path.dirname(os.path.dirname(__file__)), *sys.path])
    script = tmp_path / "script.py"
    script.write_text(SCRIPT.format(fluences=FLUENCES))
    folder = tmp_path / "runs"
    command = [sys.executable, str(script), str(folder)]
    workers = []
    for _ in range(2):
        begun = len(begins(folder))
        process = subprocess.Popen(command, env={**os.environ, "PYTHONPATH": here})
        wait_until(process, lambda begun=begun: len(begins(folder)) >= begun + 2)
        workers += children(process.pid)
        process.send_signal(signal.SIGKILL)
        process.wait(timeout=LONGEST_WAIT)
    assert len(workers) == 4
    again = subprocess.run(command, env={**os.environ, "PYTHONPATH": here}, timeout=LONGEST_WAIT)
    assert again.returncode == 0
    assert not any(map(is_alive, workers))
    table = Table.read(folder)
    assert table.status == ("complete",) * 3
    assert contents(folder, table) == contents(*undisturbed)


def study(*words, but=()):
    """Answer of `lasersph` with these words and the settings of a run of a second."""
    from lasersph.cli import main

    settings = {**SETTINGS, "time.end": "50 ns"}
    given = [f"--set={key}={value}" for key, value in settings.items() if key not in but]
    assert main([*map(str, words), *given, "--threads", "1"]) == 0


@pytest.mark.parametrize(
    ("verb", "options", "workers", "made"),
    [
        ("converge", ["--spacing", "200nm,150nm,100nm"], 2, "spacing-150nm: complete"),
        ("threshold", ["--of", "melt", "--tolerance", "0.2"], 3, "fluence-0.45: complete"),
    ],
)
def test_studies_are_made_by_workers(tmp_path, capfd, verb, options, workers, made):
    """Several runs at a time give what one after the other gives, and are found when their turn
    comes."""
    answers = []
    for count in (1, workers):
        folder, answer = tmp_path / str(count), tmp_path / f"{count}.json"
        out = ["--out", folder, "--json", answer, "--workers", count]
        study(verb, "dlip-steel", *options, *out, but=("particles.spacing",) * (verb == "converge"))
        answers.append(json.loads(answer.read_text()))
        assert {log.read_text().count("finished") for log in folder.glob("*/run.log")} == {1}
    assert answers[0] == answers[1]
    assert made in capfd.readouterr().err


def test_found_by_real_runs(tmp_path, capfd):
    """Two workers make the runs of `find`; the same command finds them, and the same answer."""
    from lasersph.cli import main

    plan, out = tmp_path / "plan.toml", tmp_path / "out"
    vary = (
        '"laser.fluence" = { from = "0.2 J/cm^2", to = "0.4 J/cm^2" }\n[runs]\nfirst = 3\nmost = 4'
    )
    wish = 'want = ["temperature_max_K = 1800 +- 20 K"]\n'
    plan.write_text(wish + plan_text([]).partition("[vary]")[0] + "[vary]\n" + vary)
    command = ["find", str(plan), "--out", str(out), "--workers", "2", "--threads", "1"]
    answers = []
    for _ in range(2):
        assert main(command) == 0
        answers.append(capfd.readouterr().out)
    assert answers[0] == answers[1]
    best = float(answers[0].splitlines()[2].split()[2])
    # hand: the rise of temperature is in proportion to the fluence but for the heat of melting
    table = Table.read(out)
    fluence, hottest = table.values("laser.fluence"), table.values("temperature_max_K")
    order = np.argsort(hottest)
    expected = 1e-4 * np.interp(1800.0, hottest[order], fluence[order])  # J/cm^2, as the plan
    assert best == pytest.approx(expected, rel=0.02)
    assert [event for _, event in events_of(out)].count("started") == len(table.rows)
