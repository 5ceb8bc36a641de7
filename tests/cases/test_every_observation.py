"""Every key of what is observed and stored changes the files of a run."""

from __future__ import annotations

from functools import cache

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


SHORT = ("time.end=0.06 ns", "output.snapshots.interval=0.03 ns")
"""Few steps and snapshots of each small case."""


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    """Function that runs a small case once, and tells what it has stored: names and numbers of the
    history, times of snapshots, number of checkpoints."""
    file = tmp_path_factory.mktemp("case") / "case.toml"
    file.write_text(LIT, encoding="utf-8")
    saved = []
    save = checkpoint.save

    def count(*arguments, **settings):
        saved.append(arguments)
        return save(*arguments, **settings)

    @cache
    def run_once(label, settings):
        saved.clear()
        folder = tmp_path_factory.mktemp("run") / "run"
        run(load_case(file, (*BASES[label], *SHORT, *settings)), folder, threads=1)
        rows = (folder / "history.csv").read_text(encoding="utf-8")
        return rows, open_run(folder).snapshots.times.tolist(), len(saved)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(checkpoint, "save", count)
        yield run_once


@pytest.mark.parametrize("key", TRIALS)
def test_a_key_changes_what_is_stored(key, stored):
    """With another value, beside the same settings."""
    label, value, beside = TRIALS[key]
    assert stored(label, beside) != stored(label, (*beside, f"{key}={value}"))
