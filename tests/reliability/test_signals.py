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


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_signal_leaves_a_checkpoint(tmp_path, number, code):
    """Exit code 130 or 143, a checkpoint, the command that continues."""
    folder = tmp_path / "run"
    command = [
        sys.executable,
        "-c",
        "import sys; from lasersph.cli import main; sys.exit(main())",
        "run",
        CASE,
    ]
    command += ["--out", str(folder), "--threads", "2", "--no-figures"]
    for setting in (*SETTINGS, FAR_END):
        command += ["--set", setting]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    wait_until(process, (folder / "checkpoint").is_dir)
    process.send_signal(number)
    said, _ = process.communicate(timeout=LONGEST_WAIT)
    assert process.returncode == code, said
    assert "--resume" in said
    assert list((folder / "checkpoint").glob("*.checkpoint"))
    assert not (folder / "summary.json").exists()
    with pytest.raises(Stopped):
        run(small_case(FAR_END), folder, resume=True, threads=2, should_stop=lambda: True)
