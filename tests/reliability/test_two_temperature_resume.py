"""A run with two temperatures, stopped in any stage and resumed, ends with the same bits."""

import pytest
from reliability_runs import assert_same, stop_and_resume
from short_pulses import GOLD, case_of

from lasersph.simulation import run

TRAIN = (
    "laser.pulse={ kind = 'square', duration = '1 ps', count = 2, period = '0.2 ns' }",
    "material.electrons.coupling=1e18 W/(m^3 K)", "time.end=0.25ns", "particles.spacing=20nm",
    "output.checkpoint_every=7",
)  # fmt: skip


@pytest.mark.parametrize("steps", [3, 60])
def test_stopped_and_resumed(tmp_path, steps):
    """Stopped under the light and after the hand-over, with a pulse still to come."""
    case = case_of(tmp_path, *GOLD, *TRAIN)
    run(case, tmp_path / "whole", threads=2, warn=None)
    stop_and_resume(case, tmp_path / "run", steps)
    assert_same(tmp_path / "run", tmp_path / "whole")
