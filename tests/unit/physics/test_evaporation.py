"""Evaporation: hand numbers for aluminum, continuity, and every slope against differences."""

from __future__ import annotations

import pytest

from lasersph.physics import evaporation as e

R_S = 308.17  # J/(kg K), as AlShaer, Rogers & Li (2017) print it
T_B, L_V, T_C = 2730.0, 10.53e6, 6700.0
P_B = e.STANDARD_ATMOSPHERE
BOLTZMANN = 1.38e-23  # J/K, as the paper rounds it
ATOM = 26.9815 * 1.66053907e-27  # kg


def test_pressure_of_the_published_ablation_case() -> None:
    """Eq. (5) gives 30.05 bar at 3744 K and 35 bar at 3807.6 K (worked by hand)."""
    assert e.saturation_pressure(3744.0, P_B, T_B, L_V, R_S) == pytest.approx(30.05e5, rel=2e-4)
    assert e.saturation_pressure(3807.6, P_B, T_B, L_V, R_S) == pytest.approx(35.0e5, rel=2e-4)


def test_vapor_velocities_of_aluminum_at_its_boiling_point() -> None:
    """Printed eq. (6) gives 731.7 m/s at 2730 K, the effusion velocity half of it, 365.8 m/s."""
    assert e.mean_normal_velocity(T_B, BOLTZMANN / ATOM) == pytest.approx(731.7, abs=0.1)
    assert e.effusion_velocity(T_B, BOLTZMANN / ATOM) == pytest.approx(365.8, abs=0.1)
    assert e.mean_normal_velocity(3000.0, R_S) == 2.0 * e.effusion_velocity(3000.0, R_S)


def test_effusion_velocity_is_what_the_paper_reports() -> None:
    """The reported 425 m/s at 3690 K is the effusion velocity."""
    assert e.effusion_velocity(3690.0, R_S) == pytest.approx(425.0, abs=1.0)


def test_pressure_is_one_atmosphere_at_the_boiling_point() -> None:
    """By definition."""
    assert e.saturation_pressure(T_B, P_B, T_B, L_V, R_S) == P_B


def test_latent_heat_vanishes_at_the_critical_temperature() -> None:
    """L_v = L_b at T_b, falls, is zero from T_c on and so is its slope beyond."""
    assert e.latent_heat(T_B, T_B, L_V, T_C) == L_V
    assert e.latent_heat(T_C, T_B, L_V, T_C) == 0.0
    assert e.latent_heat(T_C + 500.0, T_B, L_V, T_C) == 0.0
    assert e.latent_heat_slope(T_C + 500.0, T_B, L_V, T_C) == 0.0
    halfway = 0.5 * (T_B + T_C)
    assert e.latent_heat(halfway, T_B, L_V, T_C) == pytest.approx(L_V * 0.5**0.38)


def test_mass_flux_and_recoil_by_hand() -> None:
    """At 1 atm and 2730 K: 0.82 * 101325 / sqrt(2 pi 308.17 * 2730) = 36.14 kg/(m^2 s)."""
    assert e.mass_flux(T_B, P_B, R_S) == pytest.approx(36.14, abs=0.01)
    assert e.evaporative_heat_flux(T_B, P_B, L_V, R_S) == pytest.approx(3.805e8, rel=1e-3)
    assert e.recoil_pressure(P_B) == pytest.approx(54715.5)


def _pressure(T: float) -> float:
    return e.saturation_pressure(T, P_B, T_B, L_V, R_S)


def _pressure_slope(T: float) -> float:
    return e.saturation_pressure_slope(T, P_B, T_B, L_V, R_S)


def _heat(T: float) -> float:
    return e.evaporative_heat_flux(T, _pressure(T), e.latent_heat(T, T_B, L_V, T_C), R_S)


def _heat_slope(T: float) -> float:
    return e.evaporative_heat_flux_slope(
        T,
        _pressure(T),
        _pressure_slope(T),
        e.latent_heat(T, T_B, L_V, T_C),
        e.latent_heat_slope(T, T_B, L_V, T_C),
        R_S,
    )


SLOPES = {
    "pressure": (_pressure, _pressure_slope),
    "latent": (
        lambda T: e.latent_heat(T, T_B, L_V, T_C),
        lambda T: e.latent_heat_slope(T, T_B, L_V, T_C),
    ),
    "flux": (
        lambda T: e.mass_flux(T, _pressure(T), R_S),
        lambda T: e.mass_flux_slope(T, _pressure(T), _pressure_slope(T), R_S),
    ),
    "heat": (_heat, _heat_slope),
}


@pytest.mark.parametrize("name", SLOPES)
@pytest.mark.parametrize("T", [1500.0, 2730.0, 4000.0, 6000.0])
def test_slopes_against_central_differences(name: str, T: float) -> None:
    """Each slope equals a central difference of its function to 1e-5."""
    function, slope = SLOPES[name]
    step = 1e-3 * T
    fine = (function(T + step / 2) - function(T - step / 2)) / step
    coarse = (function(T + step) - function(T - step)) / (2 * step)
    assert slope(T) == pytest.approx((4.0 * fine - coarse) / 3.0, rel=1e-5)


def _surface_loss(T, p_b, T_b, L_b, T_c, R_s):
    """Heat flux of evaporation and its slope, as a solver composes them from the pure functions."""
    p = e.saturation_pressure(T, p_b, T_b, L_b, R_s)
    p_slope = e.saturation_pressure_slope(T, p_b, T_b, L_b, R_s)
    L = e.latent_heat(T, T_b, L_b, T_c)
    L_slope = e.latent_heat_slope(T, T_b, L_b, T_c)
    flux = e.evaporative_heat_flux(T, p, L, R_s)
    return flux, e.evaporative_heat_flux_slope(T, p, p_slope, L, L_slope, R_s)


def test_the_loop_factory_compiles_the_functions() -> None:
    """Compiled over an array they give what plain Python gives."""
    import numpy as np

    from lasersph import compute

    backend = compute.cpu(threads=1)
    constants = {"p_b": P_B, "T_b": T_B, "L_b": L_V, "T_c": T_C, "R_s": R_S}
    T = np.array([500.0, 2000.0, 2730.0, 5000.0, 6600.0, 6700.0, 8000.0])
    flux, slope = backend.zeros(T.size), backend.zeros(T.size)
    backend.pointwise(_surface_loss, {"T": backend.asarray(T)}, (flux, slope), **constants)
    expected = np.array([_surface_loss(float(value), **constants) for value in T])
    np.testing.assert_allclose(backend.to_host(flux), expected[:, 0], rtol=1e-12)
    np.testing.assert_allclose(backend.to_host(slope), expected[:, 1], rtol=1e-12)
