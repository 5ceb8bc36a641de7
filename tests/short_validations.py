"""The shortened form of validations, computed by a process of its own beside the other tests."""

import json
import os
import sys

from side_process import SideProcess


class ShortValidations(SideProcess):
    """`lasersph validate NAMES --quick`, behind what the tests compute themselves."""

    def __init__(self, names):
        super().__init__()
        self._json = self.folder / "reports.json"
        lasersph = [sys.executable, "-m", "lasersph", "validate", "--quick", "--threads", "1"]
        files = ["--out", str(self.folder), "--json", str(self._json)]
        niceness = ["nice", "-n", "10"] if os.name == "posix" else []
        self.start([*niceness, *lasersph, *files, *names])

    def report(self, name):
        """What it says of a validation; None where it broke off before."""
        assert self.returncode in (0, 1), self.text[-6000:]
        return json.loads(self._json.read_text())["validations"].get(name)
