"""A program that runs beside the tests, in a folder of its own, however many processes run them."""

import os
import signal
import subprocess
import threading
import time
from functools import cached_property
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
POLL = 0.2
"""Seconds between two looks at whether it has ended."""


class SideProcess:
    """A program; what it leaves in `folder` is asked for when it has ended.

    One process starts it and ends it, `start` and `end`; any that knows the folder asks for more.
    """

    def __init__(self, folder: Path):
        self.folder = folder
        self._status = folder / "status"

    def start(self, command, environment=None):
        """Start it with these variables over those of the tests."""
        self.folder.mkdir()
        with (self.folder / "log").open("w") as log:
            self._process = subprocess.Popen(
                command, cwd=ROOT, env=os.environ | (environment or {}),
                stdout=log, stderr=subprocess.STDOUT, start_new_session=True,
            )  # fmt: skip
        threading.Thread(target=self._write_status, daemon=True).start()

    def _write_status(self):
        code, part = self._process.wait(), self._status.with_suffix(".part")
        part.write_text(str(code))
        part.replace(self._status)

    @cached_property
    def returncode(self):
        """Its exit status, once it has ended."""
        assert self.folder.exists(), "started with the tests that ask for it: see tests/conftest.py"
        while not self._status.exists():
            time.sleep(POLL)
        return int(self._status.read_text())

    @property
    def text(self):
        """What it printed."""
        return (self.folder / "log").read_text()

    def end(self):
        """Stop it and what it has started where they still run."""
        if self._process.poll() is None:
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()
