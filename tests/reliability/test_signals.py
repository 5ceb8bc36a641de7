"""Ctrl-C and SIGTERM end `lasersph run` with a checkpoint and the way to go on."""

import signal
import subprocess
import sys

import pytest
from reliability_runs import CASE, SETTINGS, small_case, wait_until

from lasersph.simulation import run


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
    for setting in SETTINGS:
        command += ["--set", setting]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    wait_until(process, (folder / "checkpoint").is_dir)
    process.send_signal(number)
    said, _ = process.communicate(timeout=60)
    assert process.returncode == code, said
    assert "--resume" in said
    assert list((folder / "checkpoint").glob("*.checkpoint"))
    assert not (folder / "summary.json").exists()
    assert run(small_case(), folder, resume=True, threads=2).summary["steps"] > 9
