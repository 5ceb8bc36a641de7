"""Rules of ejection, by hand."""

from math import exp, pi, sqrt

import numpy as np
import pytest

from lasersph.particles.kinds import EJECTED, INTERIOR, LEAVING, WALL
from lasersph.physics import ejection

R_S = 308.17
UP = np.array([0.0, 0.0, 1.0])
REST = np.zeros(3)


def test_vapor_speed():
    """365.8 m/s of effusion and 731.7 m/s as printed, for aluminium at 2730 K."""
    assert ejection.vapor_speed(2730.0, R_S, 1.0) == pytest.approx(365.8, abs=0.3)
    assert ejection.vapor_speed(2730.0, R_S, 0.0) == pytest.approx(731.7, abs=0.3)
    assert ejection.vapor_speed(2730.0, R_S, 1.0) == sqrt(R_S * 2730.0 / (2 * pi))


@pytest.mark.parametrize(
    ("offset", "lift", "kind", "exposed", "counts"),
    [
        ([0, 0, 1.0], 0.0, INTERIOR, 0.0, 1.0),  # the one below
        ([0, 0, 1.6], 0.6, INTERIOR, 0.0, 1.0),  # still, 0.6 higher
        ([0, 0, 2.0], 0.0, INTERIOR, 0.0, 0.0),  # two layers below
        ([1, 0, 1.0], 0.0, INTERIOR, 0.0, 0.0),  # diagonally below
        ([0, 0, -1.0], 0.0, INTERIOR, 0.0, 0.0),  # in front
        ([0, 0, 1.0], 0.0, INTERIOR, 1.0, 0.0),  # exposed
        ([0, 0, 1.0], 0.0, LEAVING, 0.0, 0.0),
        ([0, 0, 1.0], 0.0, WALL, 0.0, 0.0),
    ],
)
def test_covered_neighbors(offset, lift, kind, exposed, counts):
    """Only condensed, hidden particles of the next layer behind the path count."""
    x_ij = np.array(offset, float)
    found = ejection.covers_neighbor(
        x_ij, np.linalg.norm(x_ij), 400.0 * UP, lift, kind, exposed, 1.5, 0.85
    )
    assert found == counts


def test_lift():
    """Leaving particles add |v| dt to their way, others do not."""
    v = np.array([3.0, 0.0, 4.0])
    assert ejection.advance_lift(0.1, LEAVING, v, 0.02) == pytest.approx(0.2)
    assert ejection.advance_lift(0.1, INTERIOR, v, 0.02) == 0.1
    assert ejection.advance_lift(0.1, EJECTED, v, 0.02) == 0.1


def published(kind, *, T=3000.0, exposed=1.0, v=REST, lift=0.0, covered=1.0, distance=-1.0):
    """The published rule for aluminium."""
    return ejection.published_departure(
        kind, lift, covered, exposed, T, UP, v, 2730.0, R_S, 1.0, distance
    )


def test_published_rule_begins_at_the_boiling_point():
    """Exposed and at 2730 K or above: leaves along the normal with the vapor's velocity."""
    kind, v = published(INTERIOR, T=2730.0)
    assert kind == LEAVING
    np.testing.assert_allclose(v, [0.0, 0.0, sqrt(R_S * 2730.0 / (2 * pi))])
    for held in (published(INTERIOR, T=2729.9), published(INTERIOR, exposed=0.0)):
        assert held[0] == INTERIOR and not held[1].any()


def test_published_rule_follows_the_temperature_until_it_has_left():
    """The direction stays, the speed grows with T, then both stay."""
    tilted = np.array([0.6, 0.0, 0.8])
    kind, v = published(LEAVING, T=3690.0, v=366.0 * tilted)
    assert kind == LEAVING
    np.testing.assert_allclose(v, sqrt(R_S * 3690.0 / (2 * pi)) * tilted)
    kind, v = published(EJECTED, T=300.0, v=425.0 * tilted)
    assert kind == EJECTED
    np.testing.assert_array_equal(v, 425.0 * tilted)


def test_published_rule_ends_by_cover_or_by_distance():
    """It has left when it covers nothing, or when it has moved far enough."""
    v = 400.0 * UP
    assert published(LEAVING, v=v, covered=0.0)[0] == EJECTED
    assert published(LEAVING, v=v, covered=1.0, lift=5.0)[0] == LEAVING
    assert published(LEAVING, v=v, covered=0.0, lift=0.6, distance=0.677)[0] == LEAVING
    assert published(LEAVING, v=v, covered=1.0, lift=0.7, distance=0.677)[0] == EJECTED


def test_enthalpy_rule():
    """All of the enthalpy must be in, and the particle at the surface or in the light."""

    def rule(kind=INTERIOR, h=13.2e6, light=0.0, exposed=1.0, normal=UP):
        return ejection.enthalpy_departure(
            kind, h, 2.0, light, exposed, 2730.0, normal, REST, 13.1e6, R_S, 1.0, UP
        )

    kind, v, h, excess = rule()
    assert kind == EJECTED and v[2] == pytest.approx(365.8, abs=0.3)
    assert h == pytest.approx(13.1e6 - 0.5 * v[2] ** 2, rel=1e-12)
    assert excess == pytest.approx(2e5)
    kind, v, _, _ = rule(exposed=0.0, light=1e-12, normal=0.0 * UP)
    assert kind == EJECTED and v[2] == pytest.approx(365.8, abs=0.3)
    for kind, v, _, excess in (rule(h=13.0e6), rule(exposed=0.0), rule(kind=WALL)):
        assert kind != EJECTED and not v.any() and excess == 0.0


def test_what_leaves_takes_along():
    """Count, mass, enthalpy and kinetic energy once, with time and vapor pressure."""
    boiling = {"p_b": 101325.0, "T_b": 2730.0, "L_b": 10.53e6, "T_c": 1e12, "R_s": R_S}
    v = np.array([0.0, 300.0, 400.0])

    def account(kind, left_at):
        return ejection.ejected_quantities(kind, left_at, 0.0, 3744.0, 2.0, 1e7, v, 5e-9, **boiling)

    time, pressure, *taken = account(EJECTED, 0.0)
    assert time == 5e-9 and pressure == pytest.approx(30.05e5, rel=1e-3)
    expected = 101325.0 * exp(10.53e6 / R_S * (3744.0 - 2730.0) / (3744.0 * 2730.0))
    assert pressure == pytest.approx(expected)
    assert taken == [1.0, 2.0, 2e7, 0.5 * 2.0 * 500.0**2]
    assert account(EJECTED, 4e-9) == (4e-9, 0.0, 0.0, 0.0, 0.0, 0.0)
    assert account(LEAVING, 0.0) == (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def test_longest_step():
    """0.1 rho dx h_v / q: 2705 kg/m^3, 0.2 um, 13.1 MJ/kg and 2.5e12 W/m^2 give 0.283 ns."""
    found = ejection.ejection_step_limit(0.1, 2705.0, 2e-7, 13.1e6, 2.5e12)
    assert found == pytest.approx(2.835e-10, rel=1e-3)
