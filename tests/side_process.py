"""A program that runs beside the tests, in a folder of its own; the tests seldom use two cores."""

import os
import signal
import subprocess
import tempfile
from functools import cached_property
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


class SideProcess:
    """A program; what it leaves in `folder` is asked for when it has ended."""

    def __init__(self):
        self._temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self._temporary.name)

    def start(self, command, environment=None):
        """Start it with these variables over those of the tests."""
        with (self.folder / "log").open("w") as log:
            self._process = subprocess.Popen(
                command, cwd=ROOT, env=os.environ | (environment or {}),
                stdout=log, stderr=subprocess.STDOUT, start_new_session=True,
            )  # fmt: skip

    @cached_property
    def returncode(self):
        """Its exit status, once it has ended."""
        return self._process.wait()

    @property
    def text(self):
        """What it printed."""
        return (self.folder / "log").read_text()

    def end(self):
        """Stop it and what it has started where they still run, and remove its files."""
        if self._process.poll() is None:
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()
        self._temporary.cleanup()
