"""Every key of what is observed and stored changes the files of a run."""

from __future__ import annotations

import pytest
from key_trials import BASES, LIT

from lasersph.case import load_case
from lasersph.output import checkpoint
from lasersph.output.reader import open_run
from lasersph.simulation import run

PROBE = "probes=[{ name = 'a', depth = '0.3 um' }]"
TRACE = "traces=[{ name = 'a', depth = '0.3 um' }]"
SOLID = ("solver.dimensions=3", "particles.spacing=0.5 um")
DOTS = (*SOLID, "laser.beam.beams=4", "domain.breadth=2.4 um")
TRIALS = {
    "probes[1].name": ("section", "b", (PROBE,)),
    "probes[1].depth": ("section", "1 um", (PROBE,)),
    "probes[1].method": ("section", "linear", (PROBE,)),
    "probes[1].x": ("section", "1.2 um", (PROBE,)),
    "probes[1].y": ("section", "1.2 um", (PROBE, *DOTS)),
    "traces[1].name": ("matter", "b", (TRACE,)),
    "traces[1].depth": ("matter", "1 um", (TRACE,)),
    "traces[1].x": ("matter", "1.2 um", (TRACE,)),
    "traces[1].y": ("matter", "1.2 um", (TRACE, *SOLID)),
    "output.history_every": ("section", "2", ()),
    "output.checkpoint_every": ("section", "1", ()),
    "output.snapshots.interval": ("section", "0.02 ns", ()),
    "output.snapshots.times": ("section", "['0.031 ns']", ()),
}
"""A small case, another value of the key, and settings beside it."""


@pytest.mark.parametrize("key", TRIALS)
def test_a_key_changes_what_is_stored(key, tmp_path, monkeypatch):
    """Names and numbers of the history, times of snapshots, number of checkpoints."""
    file = tmp_path / "case.toml"
    file.write_text(LIT, encoding="utf-8")
    label, value, beside = TRIALS[key]
    saved = []
    save = checkpoint.save

    def count(*arguments, **settings):
        saved[-1] += 1
        return save(*arguments, **settings)

    monkeypatch.setattr(checkpoint, "save", count)

    def stored(*changes: str):
        saved.append(0)
        case = load_case(file, (*BASES[label], *beside, "time.end=0.06 ns", *changes))
        folder = tmp_path / str(len(saved))
        run(case, folder, threads=1)
        rows = (folder / "history.csv").read_text(encoding="utf-8")
        return rows, open_run(folder).snapshots.times.tolist(), saved[-1]

    assert stored() != stored(f"{key}={value}")
