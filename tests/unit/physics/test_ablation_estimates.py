"""Estimates beside an ablation, against numbers worked by hand and those of the paper."""

import numpy as np
import pytest

from lasersph.case import load_case
from lasersph.materials import load_material
from lasersph.physics import ablation_estimates as estimate
from lasersph.physics.evaporation import mass_flux, saturation_pressure, vapor_constants

ALUMINIUM = {"p_b": 101325.0, "T_b": 2730.0, "L_b": 10.53e6, "T_c": 1e12, "R_s": 308.17}
ALPHA = 1.23e8


def test_light_in_the_metal():
    """5 % after three absorption lengths, 24.4 nm; 0.004 % at 82 nm, not at 250 nm."""
    assert estimate.light_left(3.0 / ALPHA, ALPHA) == pytest.approx(np.exp(-3.0))
    assert estimate.depth_of_light(np.exp(-3.0), ALPHA) == pytest.approx(24.4e-9, rel=1e-3)
    assert estimate.depth_of_light(4e-5, ALPHA) == pytest.approx(82.3e-9, rel=1e-3)


def test_vapor_takes_nothing():
    """2.4e-6 % of the light over 0.6 um, as [Alshaer2017] says."""
    assert 100.0 * estimate.absorbed_by_vapor(6e-7) == pytest.approx(2.4e-6, rel=1e-6)


def test_temperature_at_pressure():
    """The inverse of eq. (5): 30.05 bar at 3744 K, 35 bar at 3807.6 K."""
    assert estimate.temperature_at_pressure(30.05e5, **ALUMINIUM) == pytest.approx(3744.0, abs=0.1)
    assert estimate.temperature_at_pressure(35e5, **ALUMINIUM) == pytest.approx(3807.6, abs=0.1)
    assert estimate.temperature_at_pressure(1e30, **ALUMINIUM) == np.inf


STEADY_FRONTS = {
    # absorbed flux [W/m^2]: surface temperature [K], recession [m/s]; c, L_m, rho as shipped
    "steel-304-demuth": {
        1e10: (4408.93, 0.150583), 3e10: (5071.71, 0.444931), 1e11: (6202.23, 1.45876),
    },
    "aluminium-demuth": {
        1e10: (3783.52, 0.323652), 3e10: (4449.61, 0.984755), 6e10: (5119.42, 2.02655),
    },
}  # fmt: skip


@pytest.mark.parametrize("metal", STEADY_FRONTS)
def test_evaporation_carries_the_flux(metal):
    """Temperature and speed of a front that recedes steadily (Landau's balance, solved by another
    program with the closed form of the pressure)."""
    material = load_material(metal)
    cold = 298.15
    constants = vapor_constants(material.vaporization)
    heats = {"T_0": cold, "c_p": float(material.heat_capacity_at(cold)),
             "L_m": material.melting.latent_heat}  # fmt: skip
    for flux, (hot, speed) in STEADY_FRONTS[metal].items():
        T = estimate.evaporating_temperature(flux, **heats, **constants)
        assert pytest.approx(hot, abs=0.01) == T
        mass = mass_flux(T, saturation_pressure(T, **constants), constants["R_s"])
        density = float(material.density_at(cold))
        assert mass / density == pytest.approx(speed, rel=1e-5)
    assert estimate.evaporating_temperature(1.0, **heats, **constants) == constants["T_b"]
    assert estimate.evaporating_temperature(1e30, **heats, **constants) == constants["T_c"]


def test_flux_carried_near_the_critical_point():
    """It falls again there: 0.2 TW/m^2 leave aluminium at 6842 K, 0.15 at T_c = 8000 K."""
    near = ALUMINIUM | {"T_c": 8000.0}
    heats = {"T_0": 300.0, "c_p": 896.0, "L_m": 397e3}
    found = estimate.evaporating_temperature(2e11, **heats, **near)
    assert found == pytest.approx(6841.6, abs=0.1)
    assert estimate.evaporating_temperature(2.5e11, **heats, **near) == 8000.0


def test_estimates_of_a_case():
    """Penetration of eq. (34), velocities of eq. (6), loss of a disc to its sides."""
    from lasersph.simulation.recipes.ablation.estimates import ablation_estimates

    beam = 'laser.beam={kind="top-hat", radius="1 um"}'
    found = ablation_estimates(load_case("ablation-depth", [beam, "solver.dimensions=2"]))
    assert found["conduction"]["penetration_m"] == pytest.approx(np.sqrt(6.89e-5 * 1e-8), rel=1e-4)
    assert 0.0 < found["conduction"]["lateral_loss_relative"] < 1.0
    assert found["vapor"]["effusion_velocity_m_s"] == pytest.approx(365.8, abs=0.2)
    assert found["vapor"]["mean_normal_velocity_m_s"] == pytest.approx(731.7, abs=0.2)
    assert found["left_out"]["phase_explosion_from_K"] == pytest.approx(7200.0)
    assert found["left_out"]["recoil_from_K"] is None
    assert "surface_temperature_last_K" not in found["conduction"]
    assert ablation_estimates(load_case("stefan")) == {}


def test_last_pulse_of_a_train():
    """Under a wide beam 2 q / k sqrt(D / pi) [sqrt(t) - sqrt(t - t_p) + sqrt(t_p)] at the end of
    the second of two pulses; on the axis of a disc less."""
    from lasersph.simulation.recipes.ablation.estimates import conduction

    train = 'laser.pulse={kind="square", duration="10 ns", count=2, period="40 ns"}'
    wide = load_case("ablation-depth", [train])
    q = 0.25 * 1e5 / 1e-8
    roots = np.sqrt(5e-8) - np.sqrt(4e-8) + np.sqrt(1e-8)
    D = wide.material.diffusivity_reference
    expected = 300.0 + 2.0 * q / 167.0 * np.sqrt(D / np.pi) * roots
    assert wide.laser is not None
    found = conduction(wide, wide.laser, 0.75)["surface_temperature_last_K"]
    assert found == pytest.approx(expected, rel=1e-6)
    beam = 'laser.beam={kind="top-hat", radius="1 um"}'
    spot = load_case("ablation-depth", [train, beam, "solver.dimensions=2"])
    assert spot.laser is not None
    assert conduction(spot, spot.laser, 0.75)["surface_temperature_last_K"] < 0.95 * expected
