"""Evaporation of a liquid metal from its free surface, as pure scalar functions of temperature.

Saturation pressure (Clausius-Clapeyron, ideal vapor), latent heat, Hertz-Knudsen mass flux with
the back-flow of a Knudsen layer, recoil pressure, vapor velocity, and the slope in T of each:

    d(ln p)/dT = L_v(T) / (R_s T^2),    m = 0.82 p / sqrt(2 pi R_s T),    p_recoil = 0.54 p

Two forms of the pressure: constant L_v [Alshaer2017, eq. (5)], and L_v(T) that vanishes at the
critical temperature with Watson's exponent. Above T_c there is no saturation line: the second
form holds p at its value at T_c.

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


def _watson_integrand(w, T_c):
    """w^(2 * 0.38 + 1) / (T_c - w^2)^2: L_v(s) / s^2 ds with s = T_c - w^2, without factors."""
    s = T_c - w * w
    return w ** (2.0 * WATSON_EXPONENT + 1.0) / (s * s)


def saturation_pressure_watson(T, p_b, T_b, L_b, T_c, R_s):
    """Saturation pressure with the latent heat of ``latent_heat`` [Pa].

        ln(p / p_b) = int_{T_b}^{T} L_v(s) / (R_s s^2) ds

    The substitution s = T_c - w^2 removes the root at T_c; eight Gauss points then integrate it to
    a relative 2e-5 in p between 0.3 T_c and T_c (tested). Held at its value at T_c above T_c.
    """
    start = sqrt(max(T_c - T, 0.0))
    end = sqrt(T_c - T_b)
    middle = 0.5 * (start + end)
    half = 0.5 * (end - start)
    a = 0.1834346424956498 * half
    b = 0.5255324099163290 * half
    c = 0.7966664774136267 * half
    d = 0.9602898564975363 * half
    integral = half * (
        0.3626837833783620
        * (_watson_integrand(middle - a, T_c) + _watson_integrand(middle + a, T_c))
        + 0.3137066458778873
        * (_watson_integrand(middle - b, T_c) + _watson_integrand(middle + b, T_c))
        + 0.2223810344533745
        * (_watson_integrand(middle - c, T_c) + _watson_integrand(middle + c, T_c))
        + 0.1012285362903763
        * (_watson_integrand(middle - d, T_c) + _watson_integrand(middle + d, T_c))
    )
    return p_b * exp(2.0 * L_b / (R_s * (T_c - T_b) ** WATSON_EXPONENT) * integral)


def saturation_pressure_watson_slope(T, p_b, T_b, L_b, T_c, R_s):
    """dp/dT of ``saturation_pressure_watson`` [Pa/K]: p L_v(T) / (R_s T^2)."""
    return (
        saturation_pressure_watson(T, p_b, T_b, L_b, T_c, R_s)
        * latent_heat(T, T_b, L_b, T_c)
        / (R_s * T * T)
    )


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


def recoil_pressure_slope(p_slope):
    """d(p_recoil)/dT [Pa/K]: 0.54 dp/dT."""
    return RECOIL_FACTOR * p_slope


def mean_normal_velocity(T, R_s):
    """Mean normal velocity of the vapor [m/s], as [Alshaer2017, eq. (6)] is printed.

    v = sqrt(2 k T / (pi m)) = sqrt(2 R_s T / pi);    731.7 m/s for Al at 2730 K
    """
    return sqrt(2.0 * R_s * T / PI)


def mean_normal_velocity_slope(T, R_s):
    """dv/dT of ``mean_normal_velocity`` [m/(s K)]: v / (2 T)."""
    return 0.5 * mean_normal_velocity(T, R_s) / T


def effusion_velocity(T, R_s):
    """Effusion velocity of the vapor [m/s]: half of ``mean_normal_velocity``.

        v = sqrt(k T / (2 pi m)) = sqrt(R_s T / (2 pi));    365.8 m/s for Al at 2730 K

    The paper prints eq. (6), twice this value; the 380-450 m/s that it reports are these.
    """
    return sqrt(R_s * T / (2.0 * PI))


def effusion_velocity_slope(T, R_s):
    """dv/dT of ``effusion_velocity`` [m/(s K)]: v / (2 T)."""
    return 0.5 * effusion_velocity(T, R_s) / T
