"""Fields of the surface in snapshots of real runs, where it flows and where it is solid."""

import numpy as np
import pytest

from lasersph.case import load_case
from lasersph.output import open_run
from lasersph.simulation import run

SHORT = ("particles.spacing=64 nm", "time.end=38 ns", "output.snapshots.interval=38 ns")


@pytest.mark.parametrize("surface", ["moving", "flat"])
def test_solid_surface_has_the_temperature_of_the_solid(tmp_path, surface):
    """Beside the pool the surface is as warm as its particles within what lies between both, and
    gets colder outward; it does not move there."""
    settings = [*SHORT, f'solver.flow.surface="{surface}"']
    if surface == "flat":
        settings.append('solver.vaporization="plateau"')
    run(load_case("texture-steel", settings), tmp_path / "run", threads=1)
    step = open_run(tmp_path / "run").snapshots[-1]
    at = np.flatnonzero(step["surface"])
    at = at[np.argsort(step["position"][0, at])]
    solid = at[step["flows"][at] == 0]
    assert 5 < solid.size < at.size - 5
    between = np.abs(step["surface_gradient"][solid]) * step["width"][0, solid]
    difference = np.abs(step["surface_temperature"][solid] - step["temperature"][solid])
    assert np.all(difference <= 0.6 * between + 1.0)
    assert np.all(np.diff(step["surface_temperature"][solid]) < 0.0)
    assert np.all(step["surface_gradient"][solid[:-1]] < 0.0)
    assert np.all(step["surface_velocity"][solid] == 0.0)
