"""Small sweeps for tests: a coarse case, and an engine that computes nothing."""

import json

from lasersph.sweeps import Event

SETTINGS = {
    "solver.kind": "conduction",
    "particles.spacing": "100 nm",
    "time.step": "1 ns",
    "time.end": "60 ns",
    "output.checkpoint_every": 5,
}
"""Of dlip-steel: 200 steps, a second."""


class PretendingEngine:
    """Writes a summary that depends on the case, and notes which runs it was given.

    Args:
        fails: fluences [J/m^2] whose runs fail.
    """

    def __init__(self, fails=()):
        self.fails, self.made = fails, []

    def make(self, tasks, report, should_stop):
        """Make the folders of all tasks exist."""
        for task in tasks:
            if should_stop():
                report(Event(task.run, "stopped", exit_code=143))
                continue
            self.made.append(task.run)
            fluence = task.case.laser.fluence
            if fluence in self.fails:
                report(Event(task.run, "failed", message="no step converges", exit_code=1))
                continue
            task.folder.mkdir(parents=True)
            summary = {
                "melt": {"depth_max_m": fluence * 1e-11},
                "wall_time_s": 2.5,
                "is_steady": True,
            }
            (task.folder / "summary.json").write_text(json.dumps(summary))
            report(Event(task.run, "complete", exit_code=0))
