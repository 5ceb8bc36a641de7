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


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The case, and the folder of its run from begin to end."""
    folder = tmp_path_factory.mktemp("train")
    case = case_of(folder, *GOLD, *TRAIN)
    run(case, folder / "whole", threads=2, warn=False)
    return case, folder / "whole"


@pytest.mark.parametrize("steps", [3, 60])
def test_stopped_and_resumed(whole, tmp_path, steps):
    """Stopped under the light and after the hand-over, with a pulse still to come."""
    case, folder = whole
    stop_and_resume(case, tmp_path / "run", steps)
    assert_same(tmp_path / "run", folder)
