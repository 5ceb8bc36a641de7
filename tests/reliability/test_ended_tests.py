"""Tests that are ended leave no process behind."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import process_watch
import pytest
from reliability_runs import LONGEST_WAIT, wait_for

pytestmark = pytest.mark.skipif(
    not Path("/proc/self/environ").exists(), reason="tells of processes by /proc"
)
TESTS = """
import subprocess, sys
from pathlib import Path

import pytest


@pytest.mark.parametrize("name", ["one", "two"])
def test_that_waits(name):
    command = [sys.executable, "-c", "import signal; signal.pause()"]
    process = subprocess.Popen(command, start_new_session=True)
    Path(__file__).with_name(name).touch()
    process.wait()
"""


def hear_interrupts():
    """Let Ctrl-C end a process, also where a shell started these tests in its background, which has
    all of them ignore it."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_nothing_is_left(tmp_path, end):
    """After Ctrl-C, SIGTERM or SIGKILL of tests in two processes, each of which waits for one in a
    session of its own."""
    (tmp_path / "test_waits.py").write_text(TESTS)
    environment = {**os.environ, "TMPDIR": str(tmp_path), "PYTHONPATH": os.pathsep.join(sys.path)}
    del environment[process_watch.MARK]
    command = [sys.executable, "-m", "pytest", "-n", "2", "-p", "conftest", "test_waits.py"]
    tests = subprocess.Popen(
        command,
        cwd=tmp_path,
        env=environment,
        stdout=subprocess.DEVNULL,
        start_new_session=True,
        preexec_fn=hear_interrupts,
    )

    def started():
        return process_watch.processes_with("TMPDIR", str(tmp_path))

    try:
        wait_for(lambda: (tmp_path / "one").exists() and (tmp_path / "two").exists())
        assert len(started()) >= 5
        if end is signal.SIGINT:  # as a terminal sends it
            os.killpg(tests.pid, end)
        else:
            tests.send_signal(end)
        tests.wait(timeout=LONGEST_WAIT)
        wait_for(lambda: not started())
        assert not list(tmp_path.glob("lasersph-tests-*"))
    finally:
        for number in started():
            os.kill(number, signal.SIGKILL)
        tests.wait()
