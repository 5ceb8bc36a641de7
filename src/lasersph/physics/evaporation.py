"""Evaporation of a liquid metal from its free surface, as pure scalar functions of temperature.

Saturation pressure (Clausius-Clapeyron, ideal vapor), latent heat and Hertz-Knudsen mass flux with
the back-flow of a Knudsen layer, each with its slope in T, recoil pressure, and vapor velocity:

    d(ln p)/dT = L_v(T) / (R_s T^2),    m = 0.82 p / sqrt(2 pi R_s T),    p_recoil = 0.54 p

The pressure is that of a constant L_v [Alshaer2017, eq. (5)]; the heat that evaporation takes is
L_v(T), which vanishes at the critical temperature with Watson's exponent.

Plain functions of floats, so that the loop factory compiles them and a test can call them. Left
out: a non-ideal vapor, ambient pressure and subsonic outflow (0.82 and 0.54 are the values of a
sonic outflow into vacuum), plasma.

where: T temperature [K]; p_b pressure at the boiling point T_b [Pa, K] (1 atm); L_v latent heat
[J/kg], L_b its value at T_b; T_c critical temperature [K]; R_s = R / M specific gas constant
[J/(kg K)].

References: [Alshaer2017] Comput. Mater. Sci. 127, 161; [Anisimov1968] Sov. Phys. JETP 27, 182
(0.82 = 1 - 0.18 recondensed, 0.54-0.56); [Watson1943] Ind. Eng. Chem. 35, 398 (exponent 0.38).
"""

from __future__ import annotations

from math import exp, sqrt

PI = 3.141592653589793
GAS_CONSTANT = 8.314462618
"""Molar gas constant [J/(mol K)] (CODATA 2018)."""
STANDARD_ATMOSPHERE = 101325.0
"""Pressure at the normal boiling point [Pa]."""
NET_EVAPORATION = 0.82
"""Share of the Hertz-Knudsen flux that does not recondense [Anisimov1968]."""
RECOIL_FACTOR = 0.54
"""Recoil pressure over saturation pressure [Anisimov1968]."""
WATSON_EXPONENT = 0.38


def saturation_pressure(T, p_b, T_b, L_v, R_s):
    """Saturation pressure with constant latent heat [Pa] [Alshaer2017, eq. (5)].

    p = p_b exp( L_v / R_s (T - T_b) / (T T_b) )
    """
    return p_b * exp(L_v / R_s * (T - T_b) / (T * T_b))


def saturation_pressure_slope(T, p_b, T_b, L_v, R_s):
    """dp/dT of ``saturation_pressure`` [Pa/K]: p L_v / (R_s T^2)."""
    return saturation_pressure(T, p_b, T_b, L_v, R_s) * L_v / (R_s * T * T)


def latent_heat(T, T_b, L_b, T_c):
    """Latent heat of vaporization [J/kg], zero from T_c on [Watson1943].

    L_v = L_b ((T_c - T) / (T_c - T_b))^0.38
    """
    if T_c <= T:
        return 0.0 * L_b
    return L_b * ((T_c - T) / (T_c - T_b)) ** WATSON_EXPONENT


def latent_heat_slope(T, T_b, L_b, T_c):
    """dL_v/dT of ``latent_heat`` [J/(kg K)]: -0.38 L_v / (T_c - T); zero from T_c on."""
    if T_c <= T:
        return 0.0 * L_b
    return -WATSON_EXPONENT * latent_heat(T, T_b, L_b, T_c) / (T_c - T)


def mass_flux(T, p, R_s):
    """Net evaporating mass per area and time [kg/(m^2 s)] at saturation pressure p [Pa].

    m = 0.82 p / sqrt(2 pi R_s T)        (Hertz-Knudsen, [Anisimov1968])
    """
    return NET_EVAPORATION * p / sqrt(2.0 * PI * R_s * T)


def mass_flux_slope(T, p, p_slope, R_s):
    """dm/dT of ``mass_flux`` [kg/(m^2 s K)], p_slope = dp/dT [Pa/K]."""
    return NET_EVAPORATION * (p_slope - 0.5 * p / T) / sqrt(2.0 * PI * R_s * T)


def evaporative_heat_flux(T, p, L_v, R_s):
    """Heat that evaporation takes from the surface [W/m^2]: L_v m."""
    return L_v * mass_flux(T, p, R_s)


def evaporative_heat_flux_slope(T, p, p_slope, L_v, L_slope, R_s):
    """d(L_v m)/dT of ``evaporative_heat_flux`` [W/(m^2 K)], L_slope = dL_v/dT [J/(kg K)]."""
    return L_slope * mass_flux(T, p, R_s) + L_v * mass_flux_slope(T, p, p_slope, R_s)


def recoil_pressure(p):
    """Pressure of the leaving vapor on the surface [Pa]: 0.54 p [Anisimov1968]."""
    return RECOIL_FACTOR * p


def mean_normal_velocity(T, R_s):
    """Mean normal velocity of the vapor [m/s], as [Alshaer2017, eq. (6)] is printed.

    v = sqrt(2 k T / (pi m)) = sqrt(2 R_s T / pi);    731.7 m/s for Al at 2730 K
    """
    return sqrt(2.0 * R_s * T / PI)


def effusion_velocity(T, R_s):
    """Effusion velocity of the vapor [m/s]: half of ``mean_normal_velocity``.

        v = sqrt(k T / (2 pi m)) = sqrt(R_s T / (2 pi));    365.8 m/s for Al at 2730 K

    The paper prints eq. (6), twice this value; the 380-450 m/s that it reports are these.
    """
    return sqrt(R_s * T / (2.0 * PI))
