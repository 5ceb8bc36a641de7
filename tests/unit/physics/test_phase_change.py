"""State from enthalpy, and the balance of one particle, on a curve with a plateau."""

import numpy as np
import pytest

from lasersph.compute.vectors import segment
from lasersph.physics.conduction import enthalpy_rate
from lasersph.physics.phase_change import (
    balanced_enthalpy,
    follow_potential,
    potential_slope,
    state,
    state_near,
    thermal_state,
)

# c = 1000 J/(kg K), k = 20 W/(m K), melting at 500 K with 2e5 J/kg, T_0 = 300 K
H = np.array([0.0, 2e5, 4e5, 6e5])
T = np.array([300.0, 500.0, 500.0, 700.0])
P = np.array([0.0, 4000.0, 4000.0, 8000.0])
M = np.array([0.0, 0.0, 1.0, 1.0])
V = np.zeros(4)


@pytest.mark.parametrize(
    ("h", "expected"),
    [
        (1e5, (400.0, 2000.0, 0.0)),
        (3e5, (500.0, 4000.0, 0.5)),
        (5e5, (600.0, 6000.0, 1.0)),
        (8e5, (900.0, 12000.0, 1.0)),
        (-1e5, (200.0, -2000.0, 0.0)),
    ],
)
def test_state(h, expected):
    """Below, on, above the plateau, and beyond both ends, where the end segments continue."""
    found = state(h, H, T, P, M, V)
    assert found == pytest.approx((*expected, 0.0))
    # the same with its segment, wherever that is looked for first
    for guess in range(3):
        assert state_near(h, guess, H, T, P, M, V) == (*found, segment(h, H))
    assert thermal_state(h, H, T, P) == pytest.approx(expected[:2])


def test_fractions_stay_within_zero_and_one():
    """A curve that ends on a sloping fraction does not lead beyond 1."""
    fractions = np.array([0.0, 0.0, 0.5, 1.0])
    assert state(9e5, H, T, P, fractions, fractions)[2:] == (1.0, 1.0)
    assert state(-9e5, H, T, P, 1.0 - fractions, fractions)[2:] == (1.0, 0.0)


def test_potential_slope():
    """k / c = 0.02 off the plateau, 0 on it."""
    assert potential_slope(1e5, H, P) == pytest.approx(0.02)
    assert potential_slope(3e5, H, P) == 0.0
    assert potential_slope(7e5, H, P) == pytest.approx(0.02)


@pytest.mark.parametrize("h", [-2e5, 0.0, 1e5, 2e5, 2.7e5, 4e5, 5e5, 9e5])
@pytest.mark.parametrize(("m", "S"), [(2.0, 30.0), (1e-9, 1e-7), (1.0, 0.0), (1e-3, 1e6)])
def test_balanced_enthalpy_inverts_the_balance(h, m, S):
    """m h + S P(h) = energy gives h back, on and off the plateau."""
    energy = m * h + S * np.interp(h, H, P)
    if h < 0.0:
        energy = m * h + S * 0.02 * h
    if h > 6e5:
        energy = m * h + S * (8000.0 + 0.02 * (h - 6e5))
    found = balanced_enthalpy(energy, m, S, H, P)
    assert found == pytest.approx(h, rel=1e-6, abs=1e-3)


def test_balanced_enthalpy_by_hand():
    """m = 2, S = 30, energy 5e5 + 30 * 4000: on the plateau, h = 2.5e5."""
    assert balanced_enthalpy(6.2e5, 2.0, 30.0, H, P) == pytest.approx(2.5e5)


@pytest.mark.parametrize(
    ("h", "dP", "dh", "expected"),
    [
        (1e5, 1000.0, 9.0, (1.5e5, 3000.0, 0.02)),  # dP / slope, dh is not read
        (1.5e5, 3000.0, 0.0, (3e5, 4000.0, 0.0)),  # 1000 to the plateau, 2000 / 0.02 on it
        (1.5e5, 9000.0, 0.0, (4e5, 4000.0, 0.02)),  # all there is
        (5e5, -3000.0, 0.0, (3.5e5, 4000.0, 0.0)),  # the same from above
        (5e5, -9000.0, 0.0, (2e5, 4000.0, 0.0)),
        (3e5, 9000.0, 5e4, (3.5e5, 4000.0, 0.0)),  # on the plateau dh counts, up to its ends
        (3e5, 0.0, 5e5, (4e5, 4000.0, 0.02)),
        (3e5, 0.0, -5e5, (2e5, 4000.0, 0.0)),
        (5e5, 4000.0, 0.0, (7e5, 10000.0, 0.02)),  # beyond the last node
    ],
)
def test_followed(h, dP, dh, expected):
    """A change of the potential, off and on the plateau from 2e5 to 4e5 J/kg, wherever the segment
    is looked for first."""
    found = [follow_potential(h, dP, dh, guess, H, P) for guess in range(3)]
    assert found[0] == pytest.approx(expected)
    assert found == 3 * [found[0]]


def test_followed_across_corners():
    """Slopes 0.02, 0.002, 0.01: 1000 W/m to the corner, 2000 W/m to the next, 1000 W/m beyond."""
    H_range, P_range = np.array([0.0, 2e5, 1.2e6, 1.4e6]), np.array([0.0, 4e3, 6e3, 8e3])
    there = follow_potential(1.5e5, 4000.0, 0.0, 0, H_range, P_range)
    assert there == pytest.approx((1.3e6, 7000.0, 0.01))
    back = follow_potential(there[0], -4000.0, 0.0, 2, H_range, P_range)
    assert back == pytest.approx((1.5e5, 3e3, 0.02))


def test_followed_on_the_last_plateau():
    """A plateau without end, as at the vaporization temperature, takes up any rest."""
    assert follow_potential(1e5, 9000.0, 0.0, 0, H[:3], P[:3]) == pytest.approx(
        (5.5e5, 4000.0, 0.0)
    )
    assert follow_potential(3e5, 0.0, 9e5, 1, H[:3], P[:3]) == pytest.approx((1.2e6, 4000.0, 0.0))


def test_enthalpy_rate():
    """(6 + k (b - a T) + w + E/step - q) / m = (6 + 20 (4 - 1) + 5 + 8/2 - 10) / 5 = 13."""
    rate, walls = enthalpy_rate(6.0, 100.0, 20.0, 8.0, 10.0, 5.0, 0.01, 4.0, 5.0, 2.0)
    assert (rate, walls) == pytest.approx((13.0, 65.0))
