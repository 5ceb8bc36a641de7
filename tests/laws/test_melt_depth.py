"""The melt depth of real runs grows with the fluence, also within one cell."""

import numpy as np
import pytest

from lasersph.case import load_case
from lasersph.observers import numerical_sd
from lasersph.simulation import run

COARSE = (
    "solver.kind=conduction",
    "particles.spacing=48 nm",
    "time.step=200 ps",
    "time.end=75 ns",
    "output.snapshots.interval=75 ns",
)


def test_depth_grows_where_whole_cells_stand_still(tmp_path):
    """At 0.60, 0.61 and 0.62 J/cm^2 the depth in whole cells is the same, that at f_m = 0.5
    rises by even steps; particles of 8 nm say 285.5 nm at 0.60 and 295.2 nm at 0.62 J/cm^2."""
    found = []
    for fluence in (0.60, 0.61, 0.62):
        case = load_case("dlip-steel", [*COARSE, f"laser.fluence={fluence} J/cm^2"])
        found.append(run(case, tmp_path / str(fluence), threads=1).summary)
    whole = {summary["melt"]["depth_max_m"] for summary in found}
    depth = np.array([summary["melt"]["depth_half_max_m"] for summary in found])
    assert len(whole) == 1
    first, second = np.diff(depth)
    assert first > 0.0
    assert second > 0.0
    assert 0.5 < second / first < 2.0
    sd = found[0]["numerical_sd"]["melt.depth_half_max_m"]
    assert sd == pytest.approx(0.5 * found[0]["spacing_m"] / np.sqrt(12.0))
    assert depth[0] == pytest.approx(285.5e-9, abs=2.0 * sd)
    assert numerical_sd(found[0]) == found[0]["numerical_sd"]
