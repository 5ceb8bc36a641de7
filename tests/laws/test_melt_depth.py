"""The melt depth of real runs grows with the fluence, also within one cell."""

import numpy as np
import pytest

from lasersph.case import load_case
from lasersph.observers import numerical_sd
from lasersph.simulation import run
from lasersph.validation.comparison import number_at

COARSE = (
    "solver.kind=conduction",
    "particles.spacing=48 nm",
    "time.step=200 ps",
    "time.end=75 ns",
    "output.snapshots.interval=75 ns",
)


def test_depths_grow_within_a_cell(tmp_path):
    """At 0.60, 0.61 and 0.62 J/cm^2 the deepest cell is the same, and the depths at f_m = 1, 0.5
    and above 0 rise by even steps, in this order; particles of 8 nm say 285.5 nm at 0.60 and
    295.2 nm at 0.62 J/cm^2 for 0.5."""
    found = []
    for fluence in (0.60, 0.61, 0.62):
        case = load_case("dlip-steel", [*COARSE, f"laser.fluence={fluence} J/cm^2"])
        found.append(run(case, tmp_path / str(fluence), threads=1).summary)
    keys = ("melt.depth_max_m", "melt.depth_half_max_m", "melt.depth_any_max_m")
    depths = np.array([[number_at(summary, key) for summary in found] for key in keys])
    assert np.all(np.diff(depths, axis=0) > 0.0)
    first, second = np.diff(depths, axis=1).T
    assert np.all(first > 0.0)
    assert np.all((second > 0.5 * first) & (second < 2.0 * first))
    for key in keys:
        sd = found[0]["numerical_sd"][key]
        assert sd == pytest.approx(0.5 * found[0]["spacing_m"] / np.sqrt(12.0))
    assert depths[1, 0] == pytest.approx(285.5e-9, abs=2.0 * sd)
    assert numerical_sd(found[0]) == found[0]["numerical_sd"]
