"""Evaporation: one vapor-pressure curve and its latent heat, kinetics, slopes against differences.

Numbers beside ours: [Alshaer2017] for a constant latent heat; for Watson's the closed form with the
hypergeometric function, ln(p / p_b) = L_b / (R_s T_c x_b^n) [J(x_b) - J(x)], x = 1 - T / T_c,
J(x) = x^(n+1) / (n+1) F(2, n+1; n+2; x), n = 0.38, evaluated in double precision; Knight, AIAA J.
17 (1979) 519, for the Knudsen layer.
"""

from __future__ import annotations

from math import erfc, exp, log, pi, sqrt

import pytest

from lasersph.materials import load_material
from lasersph.materials.sections import Vaporization
from lasersph.physics import evaporation as e
from lasersph.physics.knudsen_layer import outflow_tables
from lasersph.physics.losses import evaporation_loss
from lasersph.physics.recoil import RECOIL_FACTOR, recoil_pressure

R_S = 308.17  # J/(kg K), as AlShaer, Rogers & Li (2017) print it
T_B, L_V, T_C = 2730.0, 10.53e6, 6700.0
P_B = e.STANDARD_ATMOSPHERE
BOLTZMANN = 1.38e-23  # J/K, as the paper rounds it
ATOM = 26.9815 * 1.66053907e-27  # kg


CONSTANT_HEAT = {"p_b": P_B, "T_b": T_B, "L_b": L_V, "T_c": e.NO_CRITICAL_POINT, "R_s": R_S}
WATSON = CONSTANT_HEAT | {"T_c": T_C}
CLOSED_FORM = {
    # T [K]: p_sat [Pa], mass flux [kg/(m^2 s)], recoil [Pa], heat flux [W/m^2]
    "steel-304-demuth": {
        2500.0: (1529.1923, 0.81624118, 825.76384, 5556529.9),
        3273.0: (101325.0, 47.268303, 54715.5, 3.0724397e8),
        4000.0: (1061676.4, 448.01091, 573305.28, 2.7720359e9),
        5000.0: (7745915.4, 2923.5744, 4182794.3, 1.6693664e10),
        6000.0: (25998304.0, 8957.6851, 14039084.0, 4.6191407e10),
        8000.0: (91091886.0, 27180.729, 49189619.0, 9.7484738e10),
    },
    "aluminium-demuth": {
        2000.0: (556.96035, 0.23208611, 300.75859, 2703544.0),
        3500.0: (1196611.8, 376.92862, 646170.35, 3.7940513e9),
    },
}


def test_pressure_of_the_published_ablation_case() -> None:
    """Eq. (5) gives 30.05 bar at 3744 K and 35 bar at 3807.6 K (worked by hand)."""
    assert e.saturation_pressure(3744.0, **CONSTANT_HEAT) == pytest.approx(30.05e5, rel=2e-4)
    assert e.saturation_pressure(3807.6, **CONSTANT_HEAT) == pytest.approx(35.0e5, rel=2e-4)


@pytest.mark.parametrize("metal", CLOSED_FORM)
def test_curve_of_a_metal_against_the_closed_form(metal: str) -> None:
    """Pressure, mass flux, recoil and heat flux of the shipped metals."""
    vapor = load_material(metal).vaporization
    assert vapor is not None
    constants = e.vapor_constants(vapor)
    for T, (pressure, mass, recoil, heat) in CLOSED_FORM[metal].items():
        p = e.saturation_pressure(T, **constants)
        assert p == pytest.approx(pressure, rel=1e-7)
        assert e.mass_flux(T, p, constants["R_s"]) == pytest.approx(mass, rel=1e-7)
        assert recoil_pressure(p) == pytest.approx(recoil, rel=1e-7)
        L = e.latent_heat(T, constants["T_b"], constants["L_b"], constants["T_c"])
        assert L * e.mass_flux(T, p, constants["R_s"]) == pytest.approx(heat, rel=1e-7)


@pytest.mark.parametrize("T", [900.0, 1500.0, 2730.0, 4000.0, 6000.0, 6300.0])
@pytest.mark.parametrize("constants", [WATSON, CONSTANT_HEAT])
def test_pressure_is_consistent_with_the_latent_heat(T: float, constants: dict[str, float]) -> None:
    """d(ln p)/dT = L_v(T) / (R_s T^2) to 1e-6, by an extrapolated difference."""
    L = e.latent_heat(T, T_B, L_V, constants["T_c"])

    def difference(step: float) -> float:
        above = e.saturation_pressure(T + step, **constants)
        return log(above / e.saturation_pressure(T - step, **constants)) / (2.0 * step)

    h = 2e-3 * T
    coarse, fine, finest = difference(h), difference(0.5 * h), difference(0.25 * h)
    first, second = (4.0 * fine - coarse) / 3.0, (4.0 * finest - fine) / 3.0
    slope = (16.0 * second - first) / 15.0
    assert slope == pytest.approx(L / (R_S * T * T), rel=1e-6)


def test_pressure_ends_at_the_critical_point() -> None:
    """It grows up to T_c and stays there; the closed form at T_c is p_b exp(J(x_b) L_b / ...)."""
    at_the_end = e.saturation_pressure(T_C, **WATSON)
    assert e.saturation_pressure(T_C - 1.0, **WATSON) < at_the_end
    assert e.saturation_pressure(T_C + 500.0, **WATSON) == at_the_end
    assert log(at_the_end / P_B) == pytest.approx(6.0707773, abs=2e-6)


def test_metal_without_a_critical_temperature() -> None:
    """Its latent heat is constant."""
    boiling = {"temperature": "2730 K", "latent_heat": "10.53 MJ/kg", "molar_mass": "26.98 g/mol"}
    bare = Vaporization.model_validate(boiling | {"source": dict.fromkeys(boiling, "a test")})
    assert e.vapor_constants(bare)["T_c"] == e.NO_CRITICAL_POINT
    assert e.latent_heat(4000.0, T_B, L_V, e.NO_CRITICAL_POINT) == pytest.approx(L_V, rel=1e-6)


def sonic_knudsen_layer() -> tuple[float, float, float]:
    """T_v / T_s, recoil / p_sat and flux / Hertz-Knudsen behind a Knudsen layer at Mach 1.

    Knight's jump conditions for a monatomic vapor, m = M sqrt(5/6), h = m / 8.
    """
    mach = 1.0
    m = mach * sqrt(5.0 / 6.0)
    root = sqrt(1.0 + pi * (m / 8.0) ** 2) - sqrt(pi) * m / 8.0
    tail = exp(m * m) * erfc(m)
    density = ((m * m + 0.5) * tail - m / sqrt(pi)) / root
    density += (1.0 - sqrt(pi) * m * tail) / (2.0 * root * root)
    pressure = density * root * root
    flux = density * root * mach * sqrt(5.0 / 3.0) * sqrt(2.0 * pi)
    return root * root, pressure * (1.0 + 5.0 / 3.0 * mach**2), flux


def test_factors_of_flux_and_recoil_are_those_of_a_sonic_knudsen_layer() -> None:
    """Knight: T_v 0.66912, recoil 0.54983, flux 0.81568; ours are within 2 and 1 % of them."""
    temperature, recoil, flux = sonic_knudsen_layer()
    assert temperature == pytest.approx(0.66911645, rel=1e-7)
    assert recoil == pytest.approx(0.5498262, rel=1e-6)
    assert flux == pytest.approx(0.81568064, rel=1e-6)
    assert pytest.approx(recoil, rel=0.02) == RECOIL_FACTOR
    assert pytest.approx(flux, rel=0.01) == e.NET_EVAPORATION


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
    assert e.saturation_pressure(T_B, **CONSTANT_HEAT) == P_B
    assert e.saturation_pressure(T_B, **WATSON) == P_B


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
    assert _losses(T_B)[0] == pytest.approx(3.805e8, rel=1e-3)
    assert recoil_pressure(P_B) == pytest.approx(54715.5)


def _pressure(T: float) -> float:
    return e.saturation_pressure(T, **WATSON)


def _pressure_slope(T: float) -> float:
    return e.saturation_pressure_slope(T, _pressure(T), e.latent_heat(T, T_B, L_V, T_C), R_S)


def _losses(T: float) -> tuple[float, float, float]:
    """Heat flux, its slope and mass flux into vacuum."""
    ratio, share, _ = outflow_tables()
    return evaporation_loss(T, **WATSON, p_e=0.0, ratio_nodes=ratio, flux_nodes=share)


SLOPES = {
    "pressure": (_pressure, _pressure_slope),
    "latent": (
        lambda T: e.latent_heat(T, T_B, L_V, T_C),
        lambda T: e.latent_heat_slope(T, T_B, L_V, T_C),
    ),
    "heat": (lambda T: _losses(T)[0], lambda T: _losses(T)[1]),
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


def test_the_loop_factory_compiles_the_functions() -> None:
    """Compiled over an array they give what plain Python gives."""
    import numpy as np

    from lasersph import compute

    backend = compute.cpu(threads=1)
    T = np.array([500.0, 2000.0, 2730.0, 5000.0, 6600.0, 6700.0, 8000.0])
    flux, slope, mass = (backend.zeros(T.size) for _ in range(3))
    fields = {"T": backend.asarray(T)}
    ratio, share, _ = outflow_tables()
    tables = {"ratio_nodes": backend.asarray(ratio), "flux_nodes": backend.asarray(share)}
    vacuum = WATSON | {"p_e": 0.0}
    backend.pointwise(evaporation_loss, fields, (flux, slope, mass), **vacuum, **tables)
    expected = np.array(
        [evaporation_loss(float(t), **vacuum, ratio_nodes=ratio, flux_nodes=share) for t in T]
    )
    np.testing.assert_allclose(backend.to_host(flux), expected[:, 0], rtol=1e-12)
    np.testing.assert_allclose(backend.to_host(slope), expected[:, 1], rtol=1e-12)
    np.testing.assert_allclose(backend.to_host(mass), expected[:, 2], rtol=1e-12)
