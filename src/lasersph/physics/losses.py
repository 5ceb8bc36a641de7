"""Heat that leaves the surface: convection, radiation and evaporation.

q(T) = h_c (T - T_a) + eps sigma (T^4 - T_a^4) + L_v m(T)      [Alshaer2017, eq. (2)], [W/m^2]

the last term only where the solver lets the surface evaporate (`physics.evaporation`).
"""

from __future__ import annotations

from lasersph.physics.evaporation import (
    latent_heat,
    latent_heat_slope,
    saturation_pressure,
    saturation_pressure_slope,
)
from lasersph.physics.knudsen_layer import net_mass_flux

STEFAN_BOLTZMANN = 5.670374419e-8
"""Radiation constant [W/(m^2 K^4)]. Source: CODATA 2018."""


def surface_loss(T, surroundings):
    """Convection and radiation [W/m^2] and their slope in T [W/(m^2 K)].

    Args:
        surroundings: table of T_a [K], h_c [W/(m^2 K)] and eps, see
            `boundaries.settings.Surroundings`.
    """
    T_a, h_c = surroundings[0], surroundings[1]
    eps = surroundings[2]
    loss = h_c * (T - T_a) + eps * STEFAN_BOLTZMANN * (T**4 - T_a**4)
    slope = h_c + 4.0 * eps * STEFAN_BOLTZMANN * T**3
    return loss, slope


def evaporation_loss(T, p_b, T_b, L_b, T_c, R_s, p_e, ratio_nodes, flux_nodes):
    """Evaporative heat flux [W/m^2], its slope in T [W/(m^2 K)] and the mass flux [kg/(m^2 s)].

    Args:
        p_b, T_b, L_b, T_c, R_s: `evaporation.vapor_constants`. p_e, ratio_nodes, flux_nodes: see
            `knudsen_layer.net_mass_flux`.
    """
    # L_v m(T), and its slope by the product rule
    p, L = saturation_pressure(T, p_b, T_b, L_b, T_c, R_s), latent_heat(T, T_b, L_b, T_c)
    p_slope = saturation_pressure_slope(T, p, L, R_s)
    L_slope = latent_heat_slope(T, T_b, L_b, T_c)
    mass, mass_slope = net_mass_flux(T, p, p_slope, R_s, p_e, ratio_nodes, flux_nodes)
    return L * mass, L_slope * mass + L * mass_slope, mass
