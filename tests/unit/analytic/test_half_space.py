"""Half-space under square pulses: published numbers, numerical derivatives, energy."""

import numpy as np
import pytest
from scipy.integrate import quad

from lasersph.analytic import half_space

ALUMINIUM = {"conductivity": 167.0, "diffusivity": 6.89e-5}


def train(time, reflectivity, depth=0.0, **more):
    """Temperature under three pulses of 9.6e11 W/m^2, 100 ns on, 100 ns off."""
    return half_space.pulse_train_temperature(
        depth, time, flux=9.6e11 * (1 - reflectivity), pulse_duration=1e-7, off_time=1e-7,
        count=3, initial_temperature=300.0, **ALUMINIUM, **more,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("reflectivity", "expected"),
    [
        (0.75, [4556.57, 2063.13, 5909.46, 3203.67, 6914.30, 4112.12]),
        (0.95, [1151.31, 652.63, 1421.89, 880.73, 1622.86, 1062.42]),
    ],
)
def test_three_pulses_give_the_reference_surface_temperatures(reflectivity, expected):
    """T at 100 ... 600 ns of Alshaer's case, to 0.01 K."""
    assert train(np.arange(1, 7) * 1e-7, reflectivity) == pytest.approx(expected, abs=0.01)


def test_surface_rise_is_the_textbook_square_root():
    """At z = 0: 2 q sqrt(D t / pi) / k."""
    rise = half_space.step_rise(0.0, 1e-7, flux=2.4e11, **ALUMINIUM)
    assert rise == pytest.approx(2 * 2.4e11 * np.sqrt(6.89e-12 / np.pi) / 167.0, rel=1e-14)


@pytest.mark.parametrize("radius", [None, 3e-6])
def test_rate_is_the_derivative_of_the_temperature(radius):
    """Central difference in time at 2 um, while heating and while cooling."""
    for time in (5e-8, 1.5e-7, 4.7e-7):
        step = 1e-11
        high, low = (train(t, 0.75, 2e-6, disc_radius=radius) for t in (time + step, time - step))
        rate = half_space.pulse_train_rate(
            2e-6, time, flux=2.4e11, pulse_duration=1e-7, off_time=1e-7, count=3,
            disc_radius=radius, **ALUMINIUM,
        )  # fmt: skip
        assert rate == pytest.approx((high - low) / (2 * step), rel=1e-6)


def test_heat_in_the_half_space_is_the_absorbed_heat():
    """rho c times the integral of the rise over depth is q t_p, during the pause."""
    heat, _ = quad(lambda z: float(train(1.7e-7, 0.75, z)) - 300.0, 0.0, 6e-5)
    assert heat * 167.0 / 6.89e-5 == pytest.approx(2.4e11 * 1e-7, rel=1e-9)


def test_disc_stays_cooler_and_ends_at_its_steady_state():
    """On the axis of a disc the rise tends to q a / k; early it is that of the whole surface."""
    late = half_space.step_rise(0.0, 1.0, flux=1e9, disc_radius=1e-5, **ALUMINIUM)
    early = half_space.step_rise(0.0, 1e-9, flux=1e9, disc_radius=1e-5, **ALUMINIUM)
    assert late == pytest.approx(1e9 * 1e-5 / 167.0, rel=1e-3)
    assert early == pytest.approx(half_space.step_rise(0, 1e-9, flux=1e9, **ALUMINIUM), rel=1e-12)


def test_nothing_before_the_light():
    """No rise and no rate at t <= 0."""
    assert half_space.step_rise([0.0, 1e-6], 0.0, flux=1e9, **ALUMINIUM).tolist() == [0.0, 0.0]
    assert half_space.step_rate(0.0, -1.0, flux=1e9, **ALUMINIUM) == 0.0


def test_thermal_penetration_of_the_paper():
    """Eq. 34: 5 ns in aluminium is about 0.6 um."""
    assert half_space.thermal_penetration(6.89e-5, 5e-9) == pytest.approx(0.587e-6, abs=1e-9)
