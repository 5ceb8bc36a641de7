"""Small sweeps for tests: a coarse case, and an engine that computes nothing."""

import json
from pathlib import Path

from lasersph.input.schema import as_toml
from lasersph.sweeps import Event

SETTINGS = {
    "solver.kind": "conduction",
    "particles.spacing": "100 nm",
    "time.step": "1 ns",
    "time.end": "60 ns",
    "output.snapshots.interval": "30 ns",
    "output.checkpoint_every": 5,
}
"""Of dlip-steel: 130 steps, a second."""


def plan_text(fluences, settings=SETTINGS):
    """A plan file of runs with these settings."""
    settings = "".join(f'"{key}" = {as_toml(value)}\n' for key, value in settings.items())
    vary = f'"laser.fluence" = {as_toml(list(fluences))}\n'
    return f'case = "dlip-steel"\n[set]\n{settings}[vary]\n{vary}'


class PretendingEngine:
    """Writes a summary that depends on the case, and notes which runs it was given.

    Args:
        fails: fluences [J/m^2] whose runs fail.
        depth: of the melt [m] over the fluence.
    """

    def __init__(self, fails=(), depth=lambda fluence: fluence * 1e-11):
        self.fails, self.depth, self.made = fails, depth, []

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
                "melt": {"depth_max_m": self.depth(fluence)},
                "wall_time_s": 2.5,
                "is_steady": True,
            }
            (task.folder / "summary.json").write_text(json.dumps(summary))
            report(Event(task.run, "complete", exit_code=0))


def contents(folder, table):
    """What each run gave: histories as bytes, and summaries without the clock."""
    found = []
    for row in table.rows:
        run = folder / "runs" / row.run
        summary = json.loads((run / "summary.json").read_text())
        summary.pop("wall_time_s")
        found.append((row.run, summary, (run / "history.csv").read_bytes()))
    return found


def children(pid):
    """Processes that a process, or one of its threads, started."""
    files = Path(f"/proc/{pid}/task").glob("*/children")
    return [int(child) for file in files for child in file.read_text().split()]


def parent(pid):
    """The process that started a process."""
    return int(Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[1])


def is_alive(pid):
    """Whether a process computes still; one that nobody waits for does not."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False
