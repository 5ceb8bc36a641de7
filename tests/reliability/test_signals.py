"""Ctrl-C and SIGTERM end `lasersph run` with a checkpoint and the way to go on."""

import signal
import subprocess
import sys

import pytest
from reliability_runs import CASE, LONGEST_WAIT, SETTINGS, small_case, wait_until

from lasersph.simulation import run
from lasersph.simulation.time_loop import Stopped

FAR_END = "time.end=90us"
"""So late that the signal comes before it, however slow the machine that sends it."""


def start_run(folder, *options):
    """`lasersph run` with a pipe as its standard input, which has written a checkpoint."""
    command = [
        *(sys.executable, "-c", "import sys; from lasersph.cli import main; sys.exit(main())"),
        *("run", CASE, "--out", str(folder), "--threads", "2", "--no-figures"),
        *("--anyway", *options),
        *(word for setting in (*SETTINGS, FAR_END) for word in ("--set", setting)),
    ]
    process = subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    wait_until(process, (folder / "checkpoint").is_dir)
    return process


def assert_stopped(folder, process, code):
    """Exit code, a checkpoint, the command that continues, and that it can be continued."""
    said, _ = process.communicate(timeout=LONGEST_WAIT)
    assert process.returncode == code, said
    assert "--resume" in said
    assert list((folder / "checkpoint").glob("*.checkpoint"))
    assert not (folder / "summary.json").exists()
    assert not (folder / ".lock").exists()
    with pytest.raises(Stopped):
        run(small_case(FAR_END), folder, resume=True, threads=2, should_stop=lambda: True)


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_signal_leaves_a_checkpoint(tmp_path, number, code):
    """Exit code 130 or 143, a checkpoint, the command that continues."""
    process = start_run(tmp_path / "run")
    process.send_signal(number)
    assert_stopped(tmp_path / "run", process, code)


def test_end_of_stdin_leaves_a_checkpoint(tmp_path):
    """A run whose starter is gone ends as after SIGTERM; what came through the pipe is no end."""
    process = start_run(tmp_path / "run", "--until-stdin-closes")
    process.stdin.write("something")
    process.stdin.flush()
    assert process.poll() is None
    process.stdin.close()
    process.stdin = None
    assert_stopped(tmp_path / "run", process, 143)
