"""Dimensionless numbers against Table 4 of Demuth & Lasagni (2020).

Steel holds to all printed digits but those of Ma's last and Pr's rounding. For aluminum four
numbers cannot come from the printed Table 3: La 152.657 needs alpha = 4 pi 4.30 / 355 nm =
1.5221e8 1/m (printed 1.52e8) and a c_p of 1076.7; Ph needs that c_p (printed 1077); Ra and Ma need
nu and eta with more digits (0.04 %). Table 3 is rounded, Table 4 is not computed from it.
"""

from __future__ import annotations

import pytest

from lasersph.materials import Material, load_material
from lasersph.physics import dimensionless as d

FLUENCE, PULSE, END, GRAVITY, T_0 = 6000.0, 10e-9, 200e-9, 9.81, 298.15


def table(material: Material) -> dict[str, float]:
    """Table 4 computed from a material with constant properties."""
    assert material.melting and material.vaporization and material.optics
    T_l, T_v = material.melting.liquidus, material.vaporization.temperature
    c, rho = float(material.heat_capacity_at(T_0)), material.density_reference
    a = material.diffusivity_reference
    nu, eta = float(material.kinematic_viscosity_at(T_l)), float(material.viscosity_at(T_l))
    L = d.thermal_diffusion_length(a, PULSE)
    alpha = material.optics.absorption_coefficient
    assert alpha is not None
    beta = float(material.at("expansion", T_l))
    slope = float(material.surface_tension_slope_at(T_l))
    return {
        "L": L,
        "La": d.laser_number(FLUENCE, alpha, rho, c, T_v - T_0),
        "Ph_sl": d.phase_change_number(material.melting.latent_heat, c, T_v - T_0),
        "Ph_lv": d.phase_change_number(material.vaporization.latent_heat, c, T_v - T_0),
        "Pr": d.prandtl_number(nu, a),
        "Ra": d.rayleigh_number(beta, T_v - T_l, GRAVITY, L, nu, a),
        "Ma": d.marangoni_number(slope, T_v - T_l, L, eta, a),
        "Fo": d.fourier_number(END, PULSE),
    }


def test_steel_gives_table_4() -> None:
    """Every number of the steel column, to its printed digits."""
    ours = table(load_material("steel-304-demuth"))
    assert ours["L"] == pytest.approx(457.8e-9, abs=0.05e-9)
    assert ours["La"] == pytest.approx(37.7151, abs=1e-4)
    assert ours["Ph_sl"] == pytest.approx(0.119849, abs=1e-6)
    assert ours["Ph_lv"] == pytest.approx(3.10367, abs=1e-5)
    assert ours["Pr"] == pytest.approx(0.1947, abs=5e-5)
    assert ours["Ra"] == pytest.approx(2.31448e-8, rel=1e-5)
    assert ours["Ma"] == pytest.approx(-8.29744, abs=2e-5)
    assert ours["Fo"] == pytest.approx(5.0)


def test_aluminum_gives_table_4_within_its_rounding() -> None:
    """The aluminum column, to the digits that the rounded Table 3 allows."""
    ours = table(load_material("aluminium-demuth"))
    assert ours["L"] == pytest.approx(1.517e-6, abs=0.0005e-6)
    assert ours["La"] == pytest.approx(152.657, rel=2e-3)
    assert ours["Ph_sl"] == pytest.approx(0.147849, rel=5e-4)
    assert ours["Ph_lv"] == pytest.approx(4.04443, rel=5e-4)
    assert ours["Pr"] == pytest.approx(0.0101, abs=5e-5)
    assert ours["Ra"] == pytest.approx(1.86969e-7, rel=5e-4)
    assert ours["Ma"] == pytest.approx(-9.76488, rel=5e-4)


def test_aluminum_laser_number_with_the_unrounded_absorption() -> None:
    """alpha = 4 pi k / lambda with k = 4.30 at 355 nm and c_p = 1076.72 explain La = 152.657."""
    alpha = 4.0 * 3.141592653589793 * 4.30 / 355e-9
    assert d.laser_number(6000.0, alpha, 2228.0, 1076.72, 2493.85) == pytest.approx(
        152.657, rel=1e-4
    )


def test_laser_number_is_proportional_to_the_fluence() -> None:
    """Table 5: La = 25.1434 at 0.4 and 62.8585 at 1.0 J/cm^2 for steel."""
    steel = (9.56e7, 7262.0, 704.0, 3273.0 - T_0)
    assert d.laser_number(4000.0, *steel) == pytest.approx(25.1434, abs=1e-4)
    assert d.laser_number(10000.0, *steel) == pytest.approx(62.8585, abs=2e-4)
