"""Fields of the surface in snapshots of real runs, where it flows and where it is solid."""

import numpy as np
import pytest

from lasersph.case import load_case
from lasersph.output import open_run
from lasersph.simulation import run

DOT = ("particles.spacing=200 nm", "time.end=31 ns", "output.snapshots.interval=31 ns")
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


def test_columns_of_a_dot_below_a_flat_surface(tmp_path):
    """In 3-D the melt has a map of its speed: outward, the same along x and y, as fast as its
    history says; nothing moves where it is solid."""
    settings = [*DOT, "solver.flow.surface=flat", "solver.vaporization=plateau"]
    run(load_case("texture-dots-steel", settings), tmp_path / "run", threads=1)
    found = open_run(tmp_path / "run")
    step, shape = found.surface[-1], found.surface.shape
    x, y, z = (values.reshape(shape) for values in step["position"])
    u, v, _ = (values.reshape(shape) for values in step["velocity"])
    T = step["temperature"].reshape(shape)
    assert np.all(z == 0.0) and x[0, 0] == pytest.approx(0.5 * (x[1, 0] - x[0, 0]))
    assert u == pytest.approx(v.T, rel=1e-6, abs=1e-6) and np.allclose(T, T.T)
    outward = u * x + v * y
    assert np.max(step["speed"]) == pytest.approx(
        found.history["flow_surface_speed_max_m_s"][-1], rel=0.01
    )
    assert np.max(outward) > 1e-7 and np.min(outward) > -0.05 * np.max(outward)
    assert np.all(step["speed"].reshape(shape)[T < 1600.0] == 0.0)
    assert "height" not in step
