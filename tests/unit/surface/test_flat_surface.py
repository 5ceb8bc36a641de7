"""The flat surface: which particles lie at it, and the stress of surface tension by hand."""

from math import cos, exp, pi, sin

import numpy as np
import pytest
from flow_boxes import MATERIAL, block_of, box, box_case, place_of

from lasersph.surface.flat_surface import (
    imposed_bump,
    imposed_wave,
    mark_surface,
    surface_tension_table,
    velocity_jump,
)
from lasersph.surface.surface import PressureCondition

FREE = {"left": "symmetry", "right": "symmetry", "surface": "free-surface"}
SLOPE = {"surface_tension_slope": "-0.5 N/(m K)"}
UP, ALONG = np.array([0.0, 1.0]), np.array([1.0, 0.0])


def surface_box(rise, **settings):
    """Box below a surface with temperatures 300 K + rise(x), surface found and driven."""
    settings = {"flow": FREE, "material": SLOPE} | settings
    solver = box(**settings)
    x, _ = place_of(solver)
    solver.particles.set("enthalpy", np.asarray(rise(x), float))  # c = 1 J/(kg K)
    solver.body.update_temperature()
    block_of(solver)
    return solver, solver.domain.surface


def host(surface, name):
    """An array of the surface."""
    return surface.backend.to_host(getattr(surface, name))


def along(surface, name):
    """Component along x of a vector of the surface, that across it is 0."""
    vectors = host(surface, name)
    assert not vectors[-1].any()
    return vectors[0]


def test_marks():
    """At the surface within a spacing, near it within the support; the depth."""
    for z, expected in ((-0.05, (1.0, 1.0)), (-0.15, (0.0, 1.0)), (-0.4, (0.0, 0.0))):
        *marks, depth = mark_surface(np.array([3.0, z]), UP, 0.0, 0.1, 0.375)
        assert tuple(marks) == expected
        assert depth == -z


def test_surface_of_a_box():
    """The ten particles of the first row lie at the surface, those of four rows near it."""
    _, surface = surface_box(lambda x: 0.0 * x)
    assert np.flatnonzero(host(surface, "at_surface")).tolist() == list(range(10))
    assert np.flatnonzero(host(surface, "near_surface")).tolist() == list(range(40))
    assert host(surface, "depth")[[0, 10]] == pytest.approx([0.05, 0.15])


def test_stress_of_a_slope():
    """dT/dx = 4 K/m with dgamma/dT = -0.5 N/(m K): tau = -2 Pa, eta = 0.01 Pa s.

    The ghost above a particle of depth 0.05 is faster by 2 * 0.05 * (-2) / 0.01 = -20 m/s. Ends
    mirror the temperature, so that only the middle sees the slope.
    """
    _, surface = surface_box(lambda x: 4.0 * x, width=2.0)
    middle = np.abs(np.arange(20) - 9.5) < 5.0
    assert along(surface, "gradient")[:20][middle] == pytest.approx(4.0, rel=1e-9)
    assert along(surface, "stress")[:20][middle] == pytest.approx(-2.0, rel=1e-9)
    assert along(surface, "ghost_velocity_jump")[:20][middle] == pytest.approx(-20.0, rel=1e-9)


def test_stress_below_the_surface():
    """Deeper rows take the stress of the surface above them, with their own depth."""
    _, surface = surface_box(lambda x: 4.0 * x, width=2.0)
    row = slice(20, 40)
    middle = np.abs(np.arange(20) - 9.5) < 3.0
    assert along(surface, "stress")[row][middle] == pytest.approx(-2.0, rel=1e-9)
    assert along(surface, "ghost_velocity_jump")[row][middle] == pytest.approx(-60.0, rel=1e-9)
    assert np.all(along(surface, "gradient")[row] == 0.0)
    assert np.all(along(surface, "stress")[100:] == 0.0)


def test_uniform_temperature():
    """Exactly no stress."""
    _, surface = surface_box(lambda x: 0.0 * x + 5.0)
    for name in ("gradient", "stress", "ghost_velocity_jump"):
        assert np.all(host(surface, name) == 0.0)


def test_even_temperature():
    """The ends mirror the temperature: a wave that is even there keeps its gradient up to them."""
    _, surface = surface_box(lambda x: np.cos(2.0 * pi * x), cells=20)
    x = (np.arange(20) + 0.5) / 20 - 0.5
    expected = -2.0 * pi * np.sin(2.0 * pi * x)
    assert along(surface, "gradient")[:20] == pytest.approx(expected, abs=0.05 * 2.0 * pi)


def test_without_marangoni():
    """Temperatures differ, nothing pulls."""
    solver, surface = surface_box(lambda x: 4.0 * x, marangoni=False, material=None)
    assert np.all(along(surface, "ghost_velocity_jump") == 0.0)
    assert np.abs(along(surface, "gradient")).max() > 1.0
    assert solver.domain.surface.has_stress is False


def test_imposed_wave():
    """mean + amplitude cos(k x), whatever the particles' own temperature."""
    found = imposed_wave(np.array([0.25, -3.0]), 300.0, 2.0, (pi,))
    assert found == 300.0 + 2.0 * cos(0.25 * pi)
    # along y as well, and along x alone
    dots = imposed_wave(np.array([0.25, 0.5, -3.0]), 300.0, 2.0, (pi, 0.5 * pi))
    assert dots == pytest.approx(300.0 + 2.0 * cos(0.25 * pi) ** 2)
    assert imposed_wave(np.array([0.25, 0.5, -3.0]), 300.0, 2.0, (pi, 0.0)) == found
    wave = {"amplitude": 2.0, "period": 1.0}
    heat = {"surface": "fixed-temperature", "surface_temperature": 300.0,
            "surface_temperature_wave": wave}  # fmt: skip
    _, surface = surface_box(lambda x: 100.0 * x, heat=heat, cells=20)
    x = (np.arange(20) + 0.5) / 20 - 0.5
    assert host(surface, "temperature")[:20] == pytest.approx(300.0 + 2.0 * np.cos(2.0 * pi * x))
    expected = -4.0 * pi * np.array([sin(2.0 * pi * v) for v in x])
    assert along(surface, "gradient")[:20] == pytest.approx(expected, abs=0.05 * 4.0 * pi)


def test_imposed_bump():
    """mean + amplitude exp(-x^2/R^2) in the middle, whatever the particles' own temperature."""
    found = imposed_bump(np.array([0.25, -3.0]), (0.0,), 300.0, 2.0, 0.5)
    assert found == pytest.approx(300.0 + 2.0 * exp(-0.25))
    heat = {"surface": "fixed-temperature", "surface_temperature": 300.0,
            "surface_temperature_bump": {"amplitude": 2.0, "radius": 0.25}}  # fmt: skip
    _, surface = surface_box(lambda x: 100.0 * x, heat=heat, cells=20)
    x = (np.arange(20) + 0.5) / 20 - 0.5
    bump = 2.0 * np.exp(-((4.0 * x) ** 2))
    assert host(surface, "temperature")[:20] == pytest.approx(300.0 + bump)
    slope = along(surface, "gradient")[1:19]
    assert slope == pytest.approx((-32.0 * x * bump)[1:19], abs=0.5)


def test_velocity_jump():
    """2 d tau / eta: 2 * 3 * 5 / 10, and four times that in melt four times as fluid."""
    assert velocity_jump(5.0, 3.0, 1.0, 10.0) == 3.0
    assert velocity_jump(5.0, 3.0, 4.0, 10.0) == 12.0


def test_what_a_flat_surface_gives():
    """No pressure, no capillary waves and no recoil."""
    _, surface = surface_box(lambda x: 0.0 * x)
    assert surface.pressure == PressureCondition()
    assert surface.time_step_limits() == {}


def test_tension_from_a_slope():
    """gamma falls by 0.5 N/m per kelvin."""
    T, gamma = surface_tension_table(box_case(flow=FREE, material=SLOPE).material)
    assert np.interp([300.0, 310.0], T, gamma) @ [-1.0, 1.0] == pytest.approx(-5.0)


def test_tension_from_a_varying_slope():
    """A slope that falls linearly from -1 at 500 K to -3 at 1500 K: gamma is its integral."""
    table = {"table": [["500 K", "-1 N/(m K)"], ["1500 K", "-3 N/(m K)"]]}
    T, gamma = surface_tension_table(
        box_case(flow=FREE, material={"surface_tension_slope": table}).material
    )
    found = np.interp([500.0, 1000.0, 1500.0], T, gamma)
    assert np.diff(found) == pytest.approx([-750.0, -1250.0], rel=0.01)


def test_tension_from_a_table():
    """gamma(T) as given, with its own slope."""
    law = {"table": [["200 K", "2 N/m"], ["400 K", "1 N/m"]]}
    assert "surface_tension" not in MATERIAL
    T, gamma = surface_tension_table(
        box_case(flow=FREE, material={"surface_tension": law}).material
    )
    assert np.interp([250.0, 350.0], T, gamma) == pytest.approx([1.75, 1.25])


def test_stress_in_space():
    """T = 300 K + 4 K/m x - 2 K/m y with dgamma/dT = -0.5 N/(m K): tau = (-2, 1, 0) Pa.

    The ghost above a particle of depth 0.05 is faster by 2 * 0.05 tau / eta, eta = 0.01 Pa s.
    """
    solver = box(flow=FREE, material=SLOPE, dimensions=3)
    x, y, _ = place_of(solver)
    solver.particles.set("enthalpy", 4.0 * x - 2.0 * y)  # c = 1 J/(kg K)
    solver.body.update_temperature()
    block_of(solver)
    surface = solver.domain.surface
    middle = (np.abs(x[:100]) < 0.1) & (np.abs(y[:100]) < 0.1)
    for name, expected in (
        ("gradient", [4.0, -2.0, 0.0]),
        ("stress", [-2.0, 1.0, 0.0]),
        ("ghost_velocity_jump", [-20.0, 10.0, 0.0]),
    ):
        found = host(surface, name)[:, :100][:, middle]
        assert found == pytest.approx(np.tile(np.array(expected)[:, None], middle.sum()), abs=1e-9)
    # the third row has the mean stress of the first one, whose ends mirror T, and its own depth
    below = host(surface, "ghost_velocity_jump")[:, 200:300][:, middle]
    assert below[:, 0] == pytest.approx([-100.0, 50.0, 0.0], rel=1e-3, abs=0.0)
