"""A coarse run in a process of its own, to be killed and resumed, and what it must leave."""

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

from lasersph.case import load_case
from lasersph.output import open_run

CASE = "dlip-steel"
SETTINGS = (
    "particles.spacing=100nm",
    "time.step=1ns",
    "time.end=90ns",
    "output.snapshots.interval=10ns",
    "output.checkpoint_every=9",
)
SCRIPT = """
import sys
from lasersph.case import load_case
from lasersph.simulation import run
run(load_case(sys.argv[1], sys.argv[3:]), sys.argv[2], resume=True, threads=2)
"""
PATIENCE = 60.0


def small_case(*more):
    """The case that is computed."""
    return load_case(CASE, [*SETTINGS, *more])


def start(folder: Path, *more: str) -> subprocess.Popen:
    """Begin or resume the run in another process."""
    command = [sys.executable, "-c", SCRIPT, CASE, str(folder), *SETTINGS, *more]
    return subprocess.Popen(command, stderr=subprocess.PIPE, text=True, env=dict(os.environ))


def wait_until(process: subprocess.Popen, ready) -> None:
    """Wait until `ready()` or the process ends. Raises TimeoutError after a minute."""
    deadline = time.monotonic() + PATIENCE
    while not ready() and process.poll() is None:
        if time.monotonic() > deadline:
            process.kill()
            raise TimeoutError("the run does not get on")
        time.sleep(0.002)


def kill_after_checkpoints(folder: Path, count: int, delay: float, *more: str) -> None:
    """Resume the run and `kill -9` it `delay` [s] after it wrote `count` further checkpoints.

    Args:
        more: settings of the case beside those of all runs here.
    """
    seen = set((folder / "checkpoint").glob("*.checkpoint"))
    known = set(seen)

    def ready() -> bool:
        seen.update((folder / "checkpoint").glob("*.checkpoint"))
        return len(seen - known) >= count

    process = start(folder, *more)
    wait_until(process, ready)
    time.sleep(delay)
    process.kill()
    process.communicate()


def results(folder: Path, but: tuple[str, ...] = ()):
    """Summary without times of the clock, history as bytes, and the last snapshot."""
    run = open_run(folder)
    left_out = ("wall_time_s", *but)
    summary = {key: value for key, value in run.summary.items() if key not in left_out}
    return json.dumps(summary), (folder / "history.csv").read_bytes(), run.snapshots[-1]


def assert_same(folder: Path, reference: Path, but: tuple[str, ...] = ()) -> None:
    """Both folders hold the same results to the last bit, but for some keys of the summary."""
    (summary, history, snapshot), expected = results(folder, but), results(reference, but)
    assert summary == expected[0]
    assert history == expected[1]
    assert list(snapshot) == list(expected[2])
    for name, values in snapshot.items():
        assert np.array_equal(values, expected[2][name]), name
