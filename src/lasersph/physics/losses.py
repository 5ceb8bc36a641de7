"""Heat that leaves the surface: convection, radiation and evaporation.

q(T) = h_c (T - T_a) + eps sigma (T^4 - T_a^4) + L_v m(T)      [Alshaer2017, eq. (2)], [W/m^2]

the last term only where the solver lets the surface evaporate (`physics.evaporation`).
"""

from __future__ import annotations

from lasersph.physics.evaporation import (
    evaporative_heat_flux,
    evaporative_heat_flux_slope,
    latent_heat,
    latent_heat_slope,
    mass_flux,
    saturation_pressure,
    saturation_pressure_slope,
)

STEFAN_BOLTZMANN = 5.670374419e-8
"""[W/(m^2 K^4)] (CODATA 2018)."""


def surface_loss(T, T_a, h_c, eps):
    """Convection and radiation [W/m^2] and their slope in T [W/(m^2 K)]."""
    loss = h_c * (T - T_a) + eps * STEFAN_BOLTZMANN * (T**4 - T_a**4)
    slope = h_c + 4.0 * eps * STEFAN_BOLTZMANN * T**3
    return loss, slope


def evaporation_loss(T, p_b, T_b, L_b, T_c, R_s):
    """Evaporative heat flux [W/m^2], its slope in T [W/(m^2 K)] and the mass flux [kg/(m^2 s)]."""
    p, L = saturation_pressure(T, p_b, T_b, L_b, T_c, R_s), latent_heat(T, T_b, L_b, T_c)
    p_slope = saturation_pressure_slope(T, p, L, R_s)
    L_slope = latent_heat_slope(T, T_b, L_b, T_c)
    return (
        evaporative_heat_flux(T, p, L, R_s),
        evaporative_heat_flux_slope(T, p, p_slope, L, L_slope, R_s),
        mass_flux(T, p, R_s),
    )
