"""A coarse run in a process of its own, to be killed and resumed, and what it must leave."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from lasersph.case import load_case
from lasersph.output import open_run
from lasersph.simulation.time_loop import Stopped, run

CASE = "dlip-steel"
SETTINGS = (
    "particles.spacing=100nm",
    "time.step=1ns",
    "time.end=60ns",
    "output.snapshots.interval=10ns",
    "output.checkpoint_every=9",
)
SCRIPT = """
import itertools, signal, sys
from lasersph.case import load_case
from lasersph.simulation import run
steps = itertools.count(1)

def act():
    if next(steps) == {step}:
        {action}
    return False

case = load_case(sys.argv[1], sys.argv[3:])
run(case, sys.argv[2], resume=True, threads=2, should_stop=act)
"""
"""A run that does something to itself after so many steps, however fast it is."""
LONGEST_WAIT = 600.0
"""Only a process that hangs takes so long [s]."""
POLL = 0.02
"""Time between two looks at a process [s]."""


def small_case(*more):
    """The case that is computed."""
    return load_case(CASE, [*SETTINGS, *more])


def start(folder: Path, step: int, action: str, *more: str) -> subprocess.Popen:
    """Begin or resume the run in another process.

    Args:
        action: the statement that it executes after `step` steps of its own.
        more: settings of the case beside those of all runs here.
    """
    script = SCRIPT.format(step=step, action=action)
    command = [sys.executable, "-c", script, CASE, str(folder), *SETTINGS, *more]
    return subprocess.Popen(command, stderr=subprocess.PIPE, text=True, env=dict(os.environ))


def start_and_pause(folder: Path, step: int) -> subprocess.Popen:
    """Begin the run in another process, which stands still after `step` steps, alive."""
    process = start(folder, step, "signal.raise_signal(signal.SIGSTOP)")
    os.waitpid(process.pid, os.WUNTRACED)
    return process


def kill_after(folder: Path, step: int, delay: float, *more: str) -> None:
    """Begin or resume the run in a process that dies `delay` [s] after `step` steps of its own.

    Nothing handles its alarm, so that it ends wherever it is, as by `kill -9`; no other process,
    which a busy machine may keep waiting, has to end it in time.
    """
    alarm = f"signal.setitimer(signal.ITIMER_REAL, {max(delay, 1e-6)!r})"
    process = start(folder, step, alarm, *more)
    _, error = process.communicate(timeout=LONGEST_WAIT)
    assert process.returncode == -signal.SIGALRM, error


def wait_until(process: subprocess.Popen, ready) -> None:
    """Wait until `ready()` or the process ends. Raises TimeoutError where it hangs."""
    for _ in range(round(LONGEST_WAIT / POLL)):
        if ready() or process.poll() is not None:
            return
        time.sleep(POLL)
    process.kill()
    raise TimeoutError("the process does not get on")


def wait_for(ready):
    """What `ready()` gives once it is true. Raises TimeoutError where it never is."""
    for _ in range(round(LONGEST_WAIT / POLL)):
        if found := ready():
            return found
        time.sleep(POLL)
    raise TimeoutError("what was waited for did not come")


def results(folder: Path, but: tuple[str, ...] = ()):
    """Summary without times of the clock, history as bytes, the last snapshot, and all lines of a
    surface that moves."""
    run = open_run(folder)
    left_out = ("wall_time_s", *but)
    summary = {key: value for key, value in run.summary.items() if key not in left_out}
    lines = [(step["time"], step["position"].tobytes()) for step in run.surface]
    return json.dumps(summary), (folder / "history.csv").read_bytes(), run.snapshots[-1], lines


def assert_same(folder: Path, reference: Path, but: tuple[str, ...] = ()) -> None:
    """Both folders hold the same results to the last bit, but for some keys of the summary."""
    found, expected = results(folder, but), results(reference, but)
    summary, history, snapshot, lines = found
    assert summary == expected[0]
    assert history == expected[1]
    assert lines == expected[3]
    assert list(snapshot) == list(expected[2])
    for name, values in snapshot.items():
        assert np.array_equal(values, expected[2][name]), name


def stop_and_resume(case, folder, steps):
    """Run a case on two threads, stopped after some steps and continued."""
    done = []

    def should_stop():
        done.append(1)
        return len(done) == steps

    with pytest.raises(Stopped):
        run(case, folder, threads=2, warn=False, should_stop=should_stop)
    run(case, folder, resume=True, threads=2, warn=False)
