"""A dot whose melt flows in three dimensions, killed while it does and resumed from its folder."""

import numpy as np
import pytest
from reliability_runs import assert_same, kill_after, small_case

from lasersph.output.checkpoint import candidates, load
from lasersph.simulation import run

DOT = (
    "solver.kind=melt-pool",
    "solver.dimensions=3",
    "solver.flow.surface=moving",
    "solver.vaporization=flux",
    "material=steel-304",
    "laser.beam.beams=4",
    "laser.beam.period=2.5um",
    "laser.fluence=0.3 J/cm^2",
    "laser.pulse.center=25ns",
    "probes=[]",
    "domain.width=2.5um",
    "domain.depth=1.5um",
    "domain.extent=quarter",
    "particles.fine_depth=600nm",
    "time.end=50ns",
    "output.snapshots.interval=2ns",
)
"""A quarter of a dot of 13 columns along each axis, some 1500 particles."""


@pytest.mark.slow
def test_dot_killed_while_its_surface_moves(tmp_path):
    """Killed at step 105 of 157, resumed with two threads: the same bits as one run."""
    case, folder, whole = small_case(*DOT), tmp_path / "run", tmp_path / "whole"
    summary = run(case, whole, threads=1).summary
    assert summary["topography"]["peak_to_valley_m"] > 1e-9
    assert not summary["melt"]["molten_at_end"]
    kill_after(folder, 105, 0.005, *DOT)
    state = load(max(candidates(folder / "checkpoint")))
    heights = state.arrays["surface_height"]
    assert heights.size == 13 * 13
    assert np.ptp(heights) > 1e-10
    assert np.abs(state.arrays["velocity"]).max() > 0.1
    run(case, folder, resume=True, threads=2)
    assert_same(folder, whole, but=("threads",))
