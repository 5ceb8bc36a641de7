"""Runs whose matter moves and leaves, stopped or killed anywhere: resumed, the same bits."""

import numpy as np
import pytest
from moving_matter import HEATED_BLOCK
from reliability_runs import assert_same

from lasersph.case import load_case
from lasersph.output.checkpoint import candidates, load
from lasersph.simulation import run
from lasersph.simulation.time_loop import Stopped

COLUMN = (
    *HEATED_BLOCK, "laser.fluence=20 J/cm^2", "domain.depth=6 um", "particles.spacing=0.1 um",
    "time.end=6 ns", "output.checkpoint_every=7", "solver.ejecta_height=1 um",
)  # fmt: skip
WATER = ("particles.spacing=9.525 mm", "time.end=60 ms", "output.checkpoint_every=20",
         "output.snapshots.interval=10 ms")  # fmt: skip


def stop_at(case, folder, steps):
    """Start or resume a run and stop it after so many further steps, with a checkpoint."""
    left = iter(range(steps, -1, -1))
    next(left)
    with pytest.raises(Stopped):
        run(case, folder, resume=True, threads=1, should_stop=lambda: next(left) == 0)
    return load(max(candidates(folder / "checkpoint")))


def assert_same_end(folder, reference):
    """Results, and arrays and numbers of the last checkpoints."""
    assert_same(folder, reference, but=("threads",))
    last, expected = (load(max(candidates(one / "checkpoint"))) for one in (folder, reference))
    assert last.scalars["solver"] == expected.scalars["solver"]
    for name, values in expected.arrays.items():
        assert np.array_equal(last.arrays[name], values), name


@pytest.mark.parametrize("model", ["enthalpy", "published"])
def test_stopped_in_the_middle_of_ejection(tmp_path, model):
    """Between two layers that leave, while others fly and some have passed the edge."""
    case = load_case("sound-wave", [*COLUMN, f"ejection={{model='{model}'}}"])
    whole, parts = tmp_path / "whole", tmp_path / "parts"
    steps = run(case, whole, threads=1).summary["steps"]
    first = stop_at(case, parts, steps // 2)
    assert (first.arrays["kind"] == 2.0).any()
    second = stop_at(case, parts, steps // 4)
    assert (second.arrays["kind"] == 3.0).any()
    run(case, parts, resume=True, threads=2)
    assert_same_end(parts, whole)


def test_water_stopped_while_it_runs(tmp_path):
    """The list of pairs goes on from where it was found."""
    case = load_case("dam-break", WATER)
    whole, parts = tmp_path / "whole", tmp_path / "parts"
    run(case, whole, threads=1)
    for steps in (33, 54):
        stop_at(case, parts, steps)
    run(case, parts, resume=True, threads=2)
    assert_same_end(parts, whole)
