"""Neumann's solution: textbook constants, interface conditions, limits."""

import numpy as np
import pytest
from scipy.special import erf

from lasersph.analytic.stefan import Melting, PhaseProperties

LIQUID = PhaseProperties(conductivity=90.0, specific_heat=1100.0)
SOLID = PhaseProperties(conductivity=230.0, specific_heat=950.0)


def melting(**changes):
    """Aluminium-like melting from 1500 K at the surface."""
    given = {
        "surface_temperature": 1500.0, "melting_temperature": 933.0, "initial_temperature": 300.0,
        "latent_heat": 397e3, "density": 2500.0, "liquid": LIQUID, "solid": SOLID,
    }  # fmt: skip
    return Melting(**(given | changes))


def test_one_phase_constant_solves_the_textbook_equation():
    """lambda exp(lambda^2) erf(lambda) = St/sqrt(pi); St = 1 gives 0.6200626."""
    one = melting(initial_temperature=933.0, latent_heat=1100.0 * 567.0)
    assert one.stefan_number == pytest.approx(1.0)
    assert one.front_constant == pytest.approx(0.6200626, abs=1e-6)


def test_small_stefan_number_is_the_quasi_stationary_front():
    """s = sqrt(2 k (T_s - T_m) t/(rho L)) for St -> 0."""
    slow = melting(initial_temperature=933.0, latent_heat=1e9)
    quasi = np.sqrt(2 * 90.0 * 567.0 * 1e-6 / (2500.0 * 1e9))
    assert slow.front(1e-6) == pytest.approx(quasi, rel=2e-4)


def test_two_phases_meet_at_the_melting_point_with_the_stefan_condition():
    """T(s) = T_m from both sides, and the jump of the flux melts rho L ds/dt."""
    case, t = melting(), 2e-7
    s, d = float(case.front(t)), 1e-12
    assert case.temperature(s - d, t) == pytest.approx(933.0, abs=0.01)
    assert case.temperature(s + d, t) == pytest.approx(933.0, abs=0.01)
    slope_liquid = (933.0 - case.temperature(s * (1 - 1e-5), t)) / (s * 1e-5)
    slope_solid = (case.temperature(s * (1 + 1e-5), t) - 933.0) / (s * 1e-5)
    melted = 2500.0 * 397e3 * 0.5 * s / t
    assert -90.0 * slope_liquid + 230.0 * slope_solid == pytest.approx(melted, rel=1e-4)


def test_temperature_obeys_the_heat_equation_in_each_phase():
    """dT/dt = D d2T/dz2 by central differences, in the liquid and in the solid."""
    case, t = melting(), 2e-7
    for share, phase in ((0.5, LIQUID), (2.0, SOLID)):
        z = share * float(case.front(t))
        rate = (case.temperature(z, t * 1.001) - case.temperature(z, t * 0.999)) / (0.002 * t)
        h = 0.01 * z
        bend = case.temperature([z - h, z, z + h], t) @ [1.0, -2.0, 1.0] / h**2
        assert rate == pytest.approx(case.diffusivity(phase) * bend, rel=1e-3)


def test_surface_and_far_field():
    """T_s at the surface, T_0 far away, one-phase profile linear in erf."""
    case = melting()
    assert case.temperature([0.0, 1.0], 1e-7) == pytest.approx([1500.0, 300.0])
    one = melting(initial_temperature=933.0)
    z = 0.3 * one.front(1e-7)
    x = one.front_constant
    assert one.temperature(z, 1e-7) == pytest.approx(1500.0 - 567.0 * erf(0.3 * x) / erf(x))


def test_cold_solid_slows_the_front():
    """The colder the solid, the slower the front."""
    fronts = [float(melting(initial_temperature=T).front(1e-7)) for T in (933.0, 600.0, 300.0)]
    assert fronts == sorted(fronts, reverse=True)


@pytest.mark.parametrize("changes", [{"surface_temperature": 900.0}, {"latent_heat": 0.0}])
def test_impossible_melting_is_refused(changes):
    """A surface below the melting point or no latent heat raises."""
    with pytest.raises(ValueError, match=r"melting|latent"):
        melting(**changes)
