"""The layer obeys Stokes' equations and its boundary conditions, and the tabulated solution."""

from pathlib import Path

import numpy as np
import pytest

from lasersph.analytic.plane_flows import return_flow
from lasersph.analytic.thermocapillary_layer import ThermocapillaryLayer
from lasersph.validation.tables import read_table

HERE = Path(__file__).parent
LAYER = ThermocapillaryLayer(
    depth=2e-6, period=5e-6, amplitude=10.0, surface_tension_slope=-3e-4, viscosity=5e-3
)


def layer_of(B):
    """Layer with k b = B whose -gamma' dT/eta is 1 m/s, 1 m deep."""
    return ThermocapillaryLayer(1.0, 2.0 * np.pi / B, 1.0, -1.0, 1.0)


def test_surface_speeds_of_the_table():
    """Surface speeds from shallow to deep, to the eight digits stored."""
    table = read_table(HERE / "thermocapillary_surface_speed.csv")
    for B, speed in zip(table["B"], table["speed"], strict=True):
        assert layer_of(B).surface_speed == pytest.approx(speed, abs=6e-9)


def test_profiles_of_the_table():
    """u(z) and w(z) over the surface speed, to the eight digits stored."""
    table = read_table(HERE / "thermocapillary_profiles.csv")
    for B in np.unique(table["B"]):
        layer = layer_of(B)
        of_B = table["B"] == B
        z = table["z_over_b"][of_B]
        crest, node = np.full(z.shape, 0.25 * layer.period), np.zeros(z.shape)
        u = layer.velocity(np.stack([crest, z]))[0] / layer.surface_speed
        w = layer.velocity(np.stack([node, z]))[1] / layer.surface_speed
        assert u == pytest.approx(table["U"][of_B], abs=6e-9)
        assert w == pytest.approx(table["V"][of_B], abs=6e-9)


def test_momentum_and_continuity():
    """grad p = eta laplace v and div v = 0, by differences of 1/2000 of the depth."""
    place = np.array([[0.3e-6, 1.1e-6, -1.9e-6], [-0.4e-6, -1.2e-6, -1.7e-6]])
    step = LAYER.depth / 2000

    def shift(axis):
        return step * np.eye(2)[:, [axis]]

    divergence, curvature, slope = 0.0, 0.0, []
    for axis in (0, 1):
        after, before = (LAYER.velocity(place + s * shift(axis)) for s in (1, -1))
        divergence = divergence + (after - before)[axis] / (2.0 * step)
        curvature = curvature + (after + before - 2.0 * LAYER.velocity(place)) / step**2
        p = [LAYER.pressure(place + s * shift(axis)) for s in (1, -1)]
        slope.append((p[0] - p[1]) / (2.0 * step))
    scale = LAYER.surface_speed / LAYER.depth
    assert divergence == pytest.approx(0.0, abs=1e-5 * scale)
    assert LAYER.viscosity * curvature == pytest.approx(
        np.stack(slope), abs=1e-4 * LAYER.viscosity * scale / LAYER.depth
    )


def test_surface_stress_and_wall():
    """eta du/dz = gamma' dT_s/dx at the surface; at rest at the wall; w = 0 at both."""
    x = np.array([0.2e-6, 1.25e-6, -0.7e-6])
    step = LAYER.depth * 1e-6
    u = [LAYER.velocity(np.stack([x, np.full(3, z)]))[0] for z in (0.0, -step)]
    slope = -LAYER.amplitude * LAYER.wave_number * np.sin(LAYER.wave_number * x)
    stress = LAYER.viscosity * (u[0] - u[1]) / step
    assert stress == pytest.approx(LAYER.surface_tension_slope * slope, rel=1e-5)
    wall = LAYER.velocity(np.stack([x, np.full(3, -LAYER.depth)]))
    assert wall == pytest.approx(0.0, abs=1e-12 * LAYER.surface_speed)
    assert LAYER.velocity(np.stack([x, np.zeros(3)]))[1] == pytest.approx(0.0, abs=1e-30)


def test_limits():
    """Deep: -gamma' dT/(2 eta). Shallow: the flow of a closed channel, surface and profile."""
    deep = ThermocapillaryLayer(50.0, 2.0 * np.pi, 2.0, -3.0, 1.5)
    assert deep.surface_speed == pytest.approx(2.0, rel=1e-12)
    shallow = ThermocapillaryLayer(1e-3, 2.0 * np.pi, 2.0, -3.0, 1.5)
    y = np.linspace(0.0, 1e-3, 6)
    u = shallow.velocity(np.stack([np.full(6, np.pi / 2), y - 1e-3]))[0]
    channel = return_flow(y, gap=1e-3, stress=6.0, viscosity=1.5)
    assert u == pytest.approx(channel, abs=1e-6 * channel[-1])


def test_bounds():
    """A layer without depth is refused."""
    with pytest.raises(ValueError, match="depth"):
        ThermocapillaryLayer(0.0, 1.0, 1.0, -1.0, 1.0)
