"""A folder read while a run writes it: what comes back is what the run wrote, whole."""

import subprocess
import sys

import numpy as np
from reliability_runs import LONGEST_WAIT, wait_until

from lasersph.output import open_run

READS = 120
WRITER = """
import sys
from pathlib import Path
import numpy as np
from lasersph.output import RunFolder
from lasersph.output.run_folder import Origin

folder, stop = Path(sys.argv[1]), Path(sys.argv[2])
while not stop.exists():
    run, found = RunFolder.resume(folder, Origin("", {"of": "a test"}, {}))
    first = 0 if found is None else found.step
    for step in range(first + 1, first + 31):
        values = np.random.default_rng(step).random(3000)
        run.history.append({"time_s": step * 0.1, "sum": float(values.sum())})
        run.particles.append(step * 0.1, np.full((2, 3000), float(step)), {"values": values})
        run.events.append("step", time=step * 0.1, step=step, sum=float(values.sum()))
        if step - first == 20:
            run.save_checkpoint(step=step, time=step * 0.1, arrays={}, scalars={})
    run.close()
"""
"""A run without physics that does nothing but write; every 30 steps it is cut back by 10."""


def assert_whole(folder):
    """Every file agrees with the numbers that the step in it stands for."""
    run = open_run(folder)
    history, events, snapshots = run.history, run.events, run.snapshots
    for time, total in zip(history.get("time_s", ()), history.get("sum", ()), strict=True):
        step = round(time * 10)
        assert total == np.random.default_rng(step).random(3000).sum()
    assert [event["step"] for event in events] == list(range(1, len(events) + 1))
    for snapshot in (snapshots[0], snapshots[-1]):
        step = round(snapshot["time"] * 10)
        assert np.array_equal(snapshot["values"], np.random.default_rng(step).random(3000))
        assert np.all(snapshot["position"] == step)


def test_readers_never_meet_half_a_commit(tmp_path):
    """A hundred reads beside a writer that commits, dies and is cut back all the time."""
    folder, stop = tmp_path / "run", tmp_path / "stop"
    command = [sys.executable, "-c", WRITER, str(folder), str(stop)]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    wait_until(process, (folder / "checkpoint").is_dir)
    failures = []
    for _ in range(READS):
        try:
            assert_whole(folder)
        except Exception as error:
            failures.append(f"{type(error).__name__}: {error}"[:150])
    assert process.poll() is None, process.communicate()[1]
    stop.touch()
    _, said = process.communicate(timeout=LONGEST_WAIT)
    assert process.returncode == 0, said
    assert not failures, f"{len(failures)} of {READS}: " + "\n".join(sorted(set(failures)))
