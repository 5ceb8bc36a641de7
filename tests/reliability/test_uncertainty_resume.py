"""A study that is killed goes on with the runs that are finished."""

import os
import signal
import subprocess
import sys

from reliability_runs import LONGEST_WAIT

from lasersph.case import load_case
from lasersph.output import open_run
from lasersph.studies import Input, assess_uncertainty

SETTINGS = (
    "particles.spacing=4 um",
    "laser.pulse.count=1",
    "time.end=20 ns",
    "output.checkpoint_every=9",
    "output.snapshots.interval=20 ns",
)
INPUTS = (Input("laser.fluence", 0.05, "made up"),)
SCRIPT = """
import os, signal, sys
from pathlib import Path
from lasersph.case import load_case
from lasersph.simulation import run
from lasersph.studies import Input, assess_uncertainty

left = int(sys.argv[2])

def act():
    global left
    left -= 1
    if left == 0:
        os.kill(os.getpid(), signal.SIGKILL)
    return False

def make(case, folder):
    return run(case, folder, resume=True, threads=1, should_stop=act)

case = load_case("pulsed-heating", sys.argv[3:])
inputs = [Input("laser.fluence", 0.05, "made up")]
assess_uncertainty(case, Path(sys.argv[1]), inputs=inputs, run=make)
"""
"""The study in a process that kills itself after so many steps of all its runs."""


def test_kill_within_a_companion(tmp_path):
    """Five runs of 40 steps, killed in the third: the finished ones are not computed again, the
    killed one is continued, and the answer is that of an undisturbed study."""
    folder = tmp_path / "killed"
    command = [sys.executable, "-c", SCRIPT, str(folder), "100", *SETTINGS]
    done = subprocess.run(
        command, stderr=subprocess.PIPE, timeout=LONGEST_WAIT, env=dict(os.environ), check=False
    )
    assert done.returncode == -signal.SIGKILL, done.stderr
    assert not (folder / "uncertainty.json").exists()
    case = load_case("pulsed-heating", SETTINGS)
    assess_uncertainty(case, folder, inputs=INPUTS)
    assess_uncertainty(case, tmp_path / "whole", inputs=INPUTS)
    answers = [(tmp_path / name / "uncertainty.json").read_bytes() for name in ("killed", "whole")]
    assert answers[0] == answers[1]
    runs = [folder, *sorted((folder / "companions").iterdir())]
    events = [[e["event"] for e in open_run(one).events] for one in runs]
    assert [each.count("started") for each in events] == [1] * 5
    assert [each.count("finished") for each in events] == [1] * 5
    assert sum(each.count("resumed") for each in events) == 1
