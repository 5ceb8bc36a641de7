"""Closed forms of two temperatures against their equations, and against each other."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from lasersph.analytic.pulsed_source import gaussian_pulse_rise
from lasersph.analytic.two_temperatures import (
    HalfSpace,
    constant_exchange,
    folded_rise,
    linear_exchange,
    pulse_rise,
)

GOLD = HalfSpace(2.1e4, 2.49e6, 2.1e16, 318.0, 8e6, 10.0, 150e-15, 0.5e-12)
TIMES = np.array([0.5e-12, 1e-12, 5e-12, 20e-12])


@pytest.mark.parametrize("linear", [False, True])
def test_exchange_solves_its_equations(linear):
    """Both closed forms are what the equations give, integrated to 1e-11."""
    form, capacity = (linear_exchange, 71.0) if linear else (constant_exchange, 2.1e4)
    found = form(TIMES, 5000.0, 300.0, capacity, 2.5e6, 2e16)

    def rates(_t, T):
        flow = 2e16 * (T[0] - T[1])
        return [-flow / (capacity * (T[0] if linear else 1.0)), flow / 2.5e6]

    how = {"rtol": 1e-11, "atol": 1e-9, "t_eval": TIMES, "method": "LSODA"}
    expected = solve_ivp(rates, (0.0, TIMES[-1]), [5000.0, 300.0], **how)
    assert np.array(found) == pytest.approx(expected.y, rel=1e-9)


@pytest.mark.parametrize("depth", [0.0, 50e-9, 400e-9])
def test_two_ways_of_inversion_agree(depth):
    """Along the imaginary axis, and along Talbot's contour with a folding: to 1e-6."""
    first, second = pulse_rise(depth, TIMES, GOLD), folded_rise(depth, TIMES, GOLD)
    for one, other in zip(first, second, strict=True):
        assert other == pytest.approx(one, rel=1e-6)


@pytest.mark.slow
def test_energy_of_the_half_space():
    """The integral of both heats over depth is what was absorbed."""
    depth = np.linspace(0.0, 6e-6, 3001)
    heat = [
        GOLD.C_e * T_e + GOLD.C_l * T_l
        for T_e, T_l in (pulse_rise(z, 2e-12, GOLD, 8001) for z in depth)
    ]
    assert np.trapezoid(np.ravel(heat), depth) == pytest.approx(10.0, rel=1e-3)


def test_strong_coupling_is_one_temperature():
    """G to infinity: the half space of one temperature, with both heat capacities."""
    strong = replace(GOLD, coupling=1e24)
    found, _ = pulse_rise(0.0, TIMES, strong)
    expected = gaussian_pulse_rise(
        0.0, TIMES, fluence=10.0, fwhm=150e-15, center=0.5e-12, conductivity=318.0,
        volumetric_heat_capacity=2.511e6, absorption_coefficient=8e6,
    )  # fmt: skip
    assert found == pytest.approx(np.ravel(expected), rel=1e-4)
