"""Rates of two and three particles by hand: formula, kinds, walls, light; weights at rest."""

import numpy as np
import pytest

from lasersph.particles.kinds import EJECTED, INTERIOR, LEAVING, WALL
from lasersph.solvers.ablation.equations import (
    advance,
    conducting_volume,
    even_pair_rates,
    heat_rates,
    pair_rates,
    pair_weight,
    particle_rates,
    speed_squares,
    trial_step,
)
from lasersph.solvers.ablation.particle_state import evaluate_state

UP = np.array([0.0, 1.0])
FLOW = {"h_s": 1.0, "c_0": 10.0, "alpha_solid": 5.0, "alpha_liquid": 0.1, "factor": 0.5}
PAIR = {
    "v_i": np.array([0.0, 1.0]), "v_j": np.array([0.0, 3.0]), "rho_i": 2.0, "rho_j": 3.0,
    "P_i": 10.0, "P_j": 20.0, "V_a_j": 2.0, "V_i": 2.0, "V_j": 2.0, "T_i": 300.0, "T_j": 400.0,
    "k_i": 5.0, "k_j": 20.0, "f_m_i": 0.0, "f_m_j": 1.0, "x_ij": np.array([0.0, -2.0]),
    "r_ij": 2.0, "dW_ij": -3.0,
}  # fmt: skip
SURROUNDINGS = {"surroundings": (300.0, 2.0, 0.0)}


def test_pair():
    """i lies below j, which moves away upward: v.x = 4, d rho < 0 and no viscosity.

    2 * 2 * 4 * (-3) / 2 = -24;  -2 * 30 / 2 * (-3) / 2 * (-2) = -90 downward;
    heat: 2 * 2 * 8 * 2 * (-100) * (-3) / 2 / 2 = 4800 W;  mu = 4 / 4.01.
    """
    drho, a, q, fourth = pair_rates(**PAIR, **FLOW)
    assert drho == -24.0
    assert a.tolist() == [0.0, -90.0]
    assert q == 0.5 * 2.0 * 2.0 * 16.0 * 100.0 * 1.5
    assert fourth == pytest.approx((4.0 / 4.01) ** 4)


def test_approaching_pair_feels_viscosity():
    """Pi = alpha c |mu| / 2.5 with alpha = (5 + 0.1) / 2 adds to the acceleration."""
    pair = PAIR | {"v_j": np.array([0.0, -1.0])}
    _, a, _, fourth = pair_rates(**pair, **FLOW)
    Pi = 2.55 * 10.0 * (4.0 / 4.01) / 2.5
    assert fourth == pytest.approx((4.0 / 4.01) ** 4)
    assert a[1] == pytest.approx(-6.0 * (30.0 / 6.0 + Pi) * 3.0)


def test_what_has_left_acts_on_nothing():
    """V_a = 0 of j takes j out of (20) and (22); with k_j = 0 it gives no heat."""
    drho, a, q, mu = pair_rates(**PAIR | {"V_a_j": 0.0, "k_j": 0.0}, **FLOW)
    assert (drho, q, mu) == (0.0, 0.0, 0.0)
    assert not a.any()


def test_listed_but_beyond_the_support():
    """Where the kernel has no slope a pair counts for nothing, not even for the next step."""
    drho, a, q, mu = pair_rates(**PAIR | {"dW_ij": 0.0}, **FLOW)
    assert (drho, q, mu) == (0.0, 0.0, 0.0)
    assert not a.any()


def test_two_things_that_conduct_nothing():
    """0 / 0 is no heat, not NaN."""
    assert pair_rates(**PAIR | {"k_i": 0.0, "k_j": 0.0}, **FLOW)[2] == 0.0


@pytest.mark.parametrize("k_j", [5.0, 0.0])
def test_one_conductivity(k_j):
    """The rates of a pair where all has one conductivity, or conducts nothing."""
    pair = PAIR | {"k_j": k_j}
    even = {name: value for name, value in pair.items() if name[:2] not in ("k_", "V_")}
    even |= {"V_a_j": pair["V_a_j"]}
    even |= {f"V_k_{one}": conducting_volume(pair[f"V_{one}"], pair[f"k_{one}"]) for one in "ij"}
    drho, a, q, fourth = even_pair_rates(**even, **FLOW)
    wanted = pair_rates(**pair, **FLOW)
    assert (drho, a.tolist(), fourth) == (wanted[0], wanted[1].tolist(), wanted[3])
    assert q == pytest.approx(wanted[2], rel=1e-14)
    assert (q == 0.0) == (k_j == 0.0)


def particle(kind, **changes):
    """Rates of a particle at 310 K of mass 2 with light of 8 J in 4 s and an open area of 3."""
    given = {
        "total_0": -24.0, "total_1": np.array([1.0, 2.0]), "total_2": 100.0, "total_3": 7.0,
        "kind": kind, "m": 2.0, "T": 310.0, "E": 8.0, "A": 3.0, "step": 4.0, "up": UP, "g": 9.0,
    }  # fmt: skip
    return particle_rates(**given | changes, **SURROUNDINGS)


def test_condensed():
    """(100 + 8/4 - 3 * 2 * 10) / 2 = 21 W/kg, 60 W lost; a = (1, 2 - 9)."""
    drho, a, dh, lost, square, mu = particle(INTERIOR)
    assert (drho, dh, lost, square, mu) == (-24.0, 21.0, 60.0, 50.0, 7.0)
    assert a.tolist() == [1.0, -7.0]


def test_leaving():
    """It takes up heat, but neither gravity nor pressure moves it."""
    drho, a, dh, lost, square, _ = particle(LEAVING)
    assert (drho, dh, lost, square) == (0.0, 21.0, 60.0, 0.0)
    assert not a.any()


def test_ejected():
    """Nothing at all."""
    drho, a, dh, lost, _, mu = particle(EJECTED)
    assert (drho, dh, lost, mu) == (0.0, 0.0, 0.0, 0.0)
    assert not a.any()


def test_wall():
    """Its density changes, it does not move, and the heat that reaches it is lost."""
    drho, a, dh, lost, _, _ = particle(WALL, E=0.0, A=0.0)
    assert (drho, dh, lost) == (-24.0, 0.0, 100.0)
    assert not a.any()


def test_heat_alone_is_the_same():
    """At rest the same heat follows from weights that were found once."""
    g = pair_weight(PAIR["V_i"], PAIR["V_j"], 2.0, -3.0, 0.5)
    assert g * 8.0 * 100.0 == pair_rates(**PAIR, **FLOW)[2]
    found = heat_rates(100.0, INTERIOR, 2.0, 310.0, 8.0, 3.0, 4.0, **SURROUNDINGS)
    assert found == (21.0, 60.0)


def test_three_particles_in_a_row():
    """The middle one between equal neighbors is not pushed; its density grows as they close in."""
    total, acceleration = 0.0, np.zeros(1)
    for x, v in ((np.array([1.0]), np.array([2.0])), (np.array([-1.0]), np.array([-2.0]))):
        pair = PAIR | {"v_i": np.zeros(1), "v_j": v, "x_ij": x, "r_ij": 1.0, "P_j": 10.0}
        drho, a, _, _ = pair_rates(**pair, **FLOW)
        total, acceleration = total + drho, acceleration + a
    assert acceleration[0] == 0.0
    assert total == 2.0 * (2.0 * 6.0 / 3.0 * 2.0 * 3.0)


CURVE = {
    "h_nodes": np.array([0.0, 100.0, 150.0, 250.0]),
    "T_nodes": np.array([300.0, 400.0, 400.0, 500.0]),
    "P_nodes": np.zeros(4), "m_nodes": np.array([0.0, 0.0, 1.0, 1.0]), "v_nodes": np.zeros(4),
    "k_T": np.array([0.0, 1000.0]), "k_nodes": np.array([10.0, 20.0]),
    "rho_0": 1.0, "c_0": 7.0, "has_tension": 0.0,
}  # fmt: skip


def test_state_of_a_particle():
    """Half molten at 400 K: k = 14; compressed by 10 %: P = 7 (1.1^7 - 1); V = m / rho."""
    found = evaluate_state(125.0, 1.1, 2.2, INTERIOR, 1.0, melts_at=1e9, **CURVE)
    T, f_m, f_v, k, P, V, V_a, opaque = found
    assert (T, f_m, f_v, k) == (400.0, 0.5, 0.0, 14.0)
    assert pytest.approx(7.0 * (1.1**7 - 1.0)) == P
    assert (V, V_a, opaque) == (2.0, 2.0, 1.0)


@pytest.mark.parametrize(
    ("kind", "conducts", "expected"),
    [(LEAVING, 1.0, (14.0, 0.0, 0.0, 1.0)), (EJECTED, 1.0, (0.0, 0.0, 0.0, 0.0)),
     (WALL, 0.0, (0.0, 7.0 * (1.1**7 - 1.0), 2.0, 1.0))],
)  # fmt: skip
def test_state_by_kind(kind, conducts, expected):
    """Conductivity, pressure, acting volume and opacity of what leaves, has left, or is a wall."""
    found = evaluate_state(125.0, 1.1, 2.2, kind, conducts, melts_at=1e9, **CURVE)
    assert (found[3], found[4], found[6], found[7]) == pytest.approx(expected)


def test_matter_without_latent_heat_counts_as_molten_by_its_temperature():
    """From `melts_at` on."""
    assert evaluate_state(50.0, 1.0, 1.0, INTERIOR, 1.0, melts_at=350.0, **CURVE)[1] == 1.0
    assert evaluate_state(49.0, 1.0, 1.0, INTERIOR, 1.0, melts_at=350.0, **CURVE)[1] == 0.0


def test_advance():
    """x + dt v', v + dt a, rho + dt drho, h + dt dh; what has been ejected keeps its place."""
    x, v, a = np.array([1.0]), np.array([2.0]), np.array([4.0])
    there = advance(x, v, 1.0, 5.0, INTERIOR, np.array([3.0]), a, 0.5, 2.0, 0.5)
    assert [float(np.squeeze(one)) for one in there] == [2.5, 4.0, 1.25, 6.0]
    assert advance(x, v, 1.0, 5.0, EJECTED, v, 0.0 * a, 0.0, 0.0, 0.5)[0] == 1.0


def test_what_a_step_would_bring():
    """m dt dh, rho + dt drho and a . a; speeds of condensed and of leaving matter apart."""
    assert trial_step(2.0, 1.0, np.array([3.0, 4.0]), -0.5, 10.0, 0.5) == (10.0, 0.75, 25.0)
    v = np.array([3.0, 4.0])
    assert speed_squares(v, INTERIOR) == (25.0, 0.0)
    assert speed_squares(v, LEAVING) == (0.0, 25.0)
    assert speed_squares(v, EJECTED) == (0.0, 0.0)
