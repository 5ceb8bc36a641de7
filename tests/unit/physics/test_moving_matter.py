"""Equation of state, continuity, momentum and viscosity on two particles, by hand."""

import numpy as np
import pytest

from lasersph.physics.artificial_viscosity import alpha_between, closing_speed, viscous_term
from lasersph.physics.continuity import density_rate
from lasersph.physics.equation_of_state import (
    condensed_pressure,
    density_under,
    pressure,
)
from lasersph.physics.momentum import pair_acceleration

RHO, C = 2705.0, 1000.0
X = np.array([0.0, 2.0])
"""x_i - x_j: i lies above j."""
R, SLOPE = 2.0, -3.0
TOWARD = np.array([0.0, -4.0])
"""v_i - v_j: they approach."""


def test_pressure():
    """B = 2705 * 1e6 / 7 Pa; a strain of 1 % gives B (1.01^7 - 1) = 0.0721 B, none gives 0."""
    B = 2705.0e6 / 7.0
    assert pressure(RHO, RHO, C) == 0.0
    assert pressure(1.01 * RHO, RHO, C) == pytest.approx(B * 0.07213535210701, rel=1e-11)
    assert pressure(0.99 * RHO, RHO, C) < 0.0


def test_slope_of_the_pressure_is_the_speed_of_sound_squared():
    """dP/drho = c_0^2 at rho_0."""
    rise = pressure(RHO * (1.0 + 1e-6), RHO, C) - pressure(RHO * (1.0 - 1e-6), RHO, C)
    assert rise / (2e-6 * RHO) == pytest.approx(C**2, rel=1e-6)


def test_condensed_matter_pulls_only_where_asked():
    """Below rho_0 the pressure is 0 without tension."""
    assert condensed_pressure(0.9 * RHO, RHO, C, 0.0) == 0.0
    assert condensed_pressure(0.9 * RHO, RHO, C, 1.0) == pressure(0.9 * RHO, RHO, C)
    assert condensed_pressure(1.1 * RHO, RHO, C, 0.0) == pressure(1.1 * RHO, RHO, C)


def test_density_under_a_pressure():
    """It is the inverse of the pressure."""
    for P in (0.0, 1e5, 1e9):
        assert pressure(density_under(P, RHO, C), RHO, C) == pytest.approx(P, rel=1e-9, abs=1e-3)


def test_approach_raises_the_density():
    """rho_i V_j v . x dW / r = 2 * 2 * (-8) * (-3) / 2 = 48."""
    assert density_rate(2.0, 2.0, TOWARD, X, R, SLOPE) == 48.0


def test_pressure_pushes_apart_with_equal_and_opposite_forces():
    """i is pushed up: -2 (10 + 20) / 2 (-3) / 2 * 2 = 90 m/s^2; m_i a_i + m_j a_j = 0."""
    up = pair_acceleration(2.0, 10.0, 20.0, 2.0, 3.0, 0.0, X, R, SLOPE)
    down = pair_acceleration(2.5, 20.0, 10.0, 3.0, 2.0, 0.0, -X, R, SLOPE)
    assert up.tolist() == [0.0, 90.0]
    assert (5.0 * up + 6.0 * down).tolist() == [0.0, 0.0]


def test_viscosity_resists_approach_only():
    """mu = h v . x / (r^2 + 0.01 h^2) = -8 / 4.01 for h = 1; Pi = -alpha c mu / rho, rho = 2.5."""
    mu = closing_speed(TOWARD, X, 1.0)
    assert mu == pytest.approx(-8.0 / 4.01)
    assert viscous_term(mu, 0.1, C, 2.0, 3.0) == pytest.approx(0.1 * C * 8.0 / 4.01 / 2.5)
    assert viscous_term(-mu, 0.1, C, 2.0, 3.0) == 0.0


def test_viscous_force_slows_the_approach():
    """The positive Pi of approaching particles pushes i away from j."""
    Pi = viscous_term(closing_speed(TOWARD, X, 1.0), 5.0, C, RHO, RHO)
    assert pair_acceleration(1.0, 0.0, 0.0, RHO, RHO, Pi, X, R, SLOPE)[1] > 0.0


def test_alpha_of_a_pair():
    """Solid and liquid, and the mean between them."""
    assert alpha_between(0.0, 0.0, 5.0, 0.1) == 5.0
    assert alpha_between(1.0, 1.0, 5.0, 0.1) == pytest.approx(0.1)
    assert alpha_between(1.0, 0.0, 5.0, 0.1) == pytest.approx(2.55)
