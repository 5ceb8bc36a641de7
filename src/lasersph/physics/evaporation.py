"""Evaporation of a liquid metal from its free surface, as pure scalar functions of temperature.

One curve of saturation pressure for everything that evaporates, from the same latent heat that the
vapor takes along (Clausius-Clapeyron, ideal vapor of density rho_v = p / (R_s T)), and the mass
flux of Hertz and Knudsen with the back-flow of a Knudsen layer; its recoil is in `recoil`:

    dp/dT = L_v(T) rho_v / T,    m = 0.82 p / sqrt(2 pi R_s T)

L_v(T) vanishes at the critical temperature with Watson's exponent. A metal without one has a
constant L_v, and then the pressure is eq. (5) of [Alshaer2017]; so has the published rule of
ejection, which prints that equation.

Plain functions of floats, so that the loop factory compiles them and a test can call them. Left
out: a non-ideal vapor, ambient pressure and subsonic outflow (0.82 is the value of a sonic outflow
into vacuum), plasma.

where: T temperature [K]; p_b pressure at the boiling point T_b [Pa, K] (1 atm); L_v latent heat
[J/kg], L_b its value at T_b; T_c critical temperature [K]; R_s = R / M specific gas constant
[J/(kg K)].

References: [Alshaer2017] Comput. Mater. Sci. 127, 161; [Anisimov1968] Sov. Phys. JETP 27, 182
(0.82 = 1 - 0.18 recondensed); [Knight1979] AIAA J. 17, 519 (0.816 for the same sonic
outflow); [Watson1943] Ind. Eng. Chem. 35, 398 (exponent 0.38).
"""

from __future__ import annotations

from math import exp, sqrt

from lasersph.materials.sections import Vaporization

PI = 3.141592653589793
"""Circumference of a circle over its diameter. Exact: for loops."""
STANDARD_ATMOSPHERE = 101325.0
"""Pressure at the normal boiling point [Pa]. Exact: by its definition."""
NET_EVAPORATION = 0.82
"""Share of the Hertz-Knudsen flux that does not recondense. Source: [Anisimov1968]; [Knight1979]
gives 0.816 (tested)."""
WATSON_EXPONENT = 0.38
"""Exponent of the latent heat over the distance from the critical point. Source: [Watson1943]."""
NO_CRITICAL_POINT = 1e12
"""T_c of a metal that has none in its file [K]. Format: so far away that the latent heat changes by
1e-9 (tested)."""


def vapor_constants(metal: Vaporization) -> dict[str, float]:
    """p_b, T_b, L_b, T_c and R_s of a metal for the functions below; ValueError without M."""
    return {
        "p_b": STANDARD_ATMOSPHERE,
        "T_b": metal.temperature,
        "L_b": metal.latent_heat,
        "T_c": metal.critical_temperature or NO_CRITICAL_POINT,
        "R_s": metal.specific_gas_constant,
    }


def saturation_pressure(T, p_b, T_b, L_b, T_c, R_s):
    """Saturation pressure [Pa], consistent with `latent_heat`; from T_c on that at T_c.

        ln(p / p_b) = int L_v / (R_s T^2) dT from T_b to T

    With y = ((T_c - T) / (T_c - T_b))^0.69 the integrand is y / T(y)^2 but for constants, which is
    smooth up to T_c: ten points of Gauss give its value to 1e-6 from T_c / 10 to 0.97 T_c.
    """
    if T_c >= NO_CRITICAL_POINT:
        return p_b * exp(L_b / R_s * (T - T_b) / (T * T_b))  # [Alshaer2017, eq. (5)]
    # Watson's exponent; substitution y, in which the integrand is smooth up to T_c
    span, power = T_c - T_b, 0.5 * (1.0 + WATSON_EXPONENT)
    y = (max(T_c - T, 0.0) / span) ** power
    # ten points of Gauss from y to 1, the boiling point
    middle, half = 0.5 * (1.0 + y), 0.5 * (1.0 - y)
    total = (
        0.2955242247147529 * gauss_pair(middle, 0.1488743389816312 * half, span, T_c)
        + 0.2692667193099963 * gauss_pair(middle, 0.4333953941292472 * half, span, T_c)
        + 0.2190863625159820 * gauss_pair(middle, 0.6794095682990244 * half, span, T_c)
        + 0.1494513491505806 * gauss_pair(middle, 0.8650633666889845 * half, span, T_c)
        + 0.0666713443086881 * gauss_pair(middle, 0.9739065285171717 * half, span, T_c)
    )
    return p_b * exp(L_b * span / (power * R_s) * half * total)


def gauss_pair(middle, offset, span, T_c):
    """Sum of y / T(y)^2 [1/K^2] at y = middle - offset and middle + offset."""
    inverse = 2.0 / (1.0 + WATSON_EXPONENT)
    lower = T_c - span * (middle - offset) ** inverse
    upper = T_c - span * (middle + offset) ** inverse
    return (middle - offset) / (lower * lower) + (middle + offset) / (upper * upper)


def saturation_pressure_slope(T, p, L_v, R_s):
    """dp/dT of `saturation_pressure` [Pa/K]: p L_v(T) / (R_s T^2), Clausius-Clapeyron."""
    return p * L_v / (R_s * T * T)


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
