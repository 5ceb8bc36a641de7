"""The shortened form of validations, computed by a process of its own beside the other tests."""

import json
import sys

from side_process import SideProcess


class ShortValidations(SideProcess):
    """`lasersph validate NAMES --quick`."""

    def __init__(self, folder):
        super().__init__(folder / "validations")
        self._json = self.folder / "reports.json"

    def start_validations(self, names):
        """Start those of these names."""
        lasersph = [sys.executable, "-m", "lasersph", "validate", "--quick", "--threads", "1"]
        self.start([*lasersph, "--out", str(self.folder), "--json", str(self._json), *names])

    def report(self, name):
        """What it says of a validation; None where it broke off before."""
        assert self.returncode in (0, 1), self.text[-6000:]
        return json.loads(self._json.read_text())["validations"].get(name)
