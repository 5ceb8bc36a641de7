"""The return flow under a stressed flat surface, against its own equations."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

FILE = Path(__file__).parents[3] / "benchmarks" / "lid_pressure.py"


@pytest.fixture(scope="module")
def lid_pressure():
    """The script as a module."""
    found = importlib.util.spec_from_file_location("lid_pressure", FILE)
    module = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    return module


def test_gradient_of_the_return_flow(lid_pressure):
    """u = tau / (4 eta h) (3 z^2 - 2 h z) sticks to the wall, carries no volume, has the stress at
    the surface and needs eta u'' as gradient of the pressure, 1.5 * 8e5 / 40e-9 = 3e13 Pa/m."""
    stress, depth, viscosity = 8e5, 40e-9, 7e-3
    u = np.polynomial.Polynomial([0.0, -2.0 * depth, 3.0]) * (stress / (4.0 * viscosity * depth))
    flux = u.integ()
    assert u(0.0) == 0.0
    assert flux(depth) - flux(0.0) == pytest.approx(0.0, abs=1e-12 * depth * u(depth))
    assert viscosity * u.deriv()(depth) == pytest.approx(stress)
    gradient = lid_pressure.return_flow_gradient(stress, depth)
    assert gradient == pytest.approx(viscosity * u.deriv(2)(0.0))
    assert gradient == pytest.approx(3e13)


def test_rise_in_a_wedge(lid_pressure):
    """In h = s (L - x) the pressure grows as a logarithm: 3 tau / (2 s) ln 2 with each halving of
    the depth at which the wedge ends, and between the same bounds tau / h gives two thirds."""
    stress, slope = 8e5, 0.3
    depth = np.geomspace(100e-9, 25e-9, 4001)
    wedge = lid_pressure.Wedge(-depth / slope, depth, np.full(depth.size, stress), 0.0 * depth)
    rise = wedge.rise(lid_pressure.return_flow_gradient(wedge.stress, depth))
    assert rise == pytest.approx(1.5 * stress / slope * np.log(4.0), rel=1e-6)
    least = wedge.rise(lid_pressure.least_gradient(wedge.stress, depth))
    assert least == pytest.approx(2.0 / 3.0 * rise)
