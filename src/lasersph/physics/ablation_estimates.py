"""Estimates beside an ablation: how deep light and heat go, what the model leaves out matters from.

All arguments and results are floats in SI units.

Phase explosion is taken to set in at 0.9 T_c [Kelly1996], shielding of the light by the vapor at
T_c, where [Alshaer2017, Section 4.4] lets the vapor break down and absorb. A surface pinned at the
boiling point never gets there; the temperature to compare is the one at which evaporation alone,
with the latent heat, the pressure and the kinetics of `evaporation`, carries the absorbed flux
away, as it does from a front that recedes steadily (Landau):

    0.82 p(T) / sqrt(2 pi R_s T) [c_p (T - T_0) + L_m + L_v(T)] = q

References: [Alshaer2017] Comput. Mater. Sci. 127, 161; [Kelly1996] Kelly & Miotello, Appl. Surf.
Sci. 96-98, 205; [Tam1992] Tam et al., J. Appl. Phys. 71, 3515, as cited by [Alshaer2017];
[Hoffman2002] Hoffman & Szymanski, Optica Applicata 32, 129, as cited there.
"""

from __future__ import annotations

from collections.abc import Callable
from math import exp, inf, log

from lasersph.physics.evaporation import (
    latent_heat,
    mass_flux,
    saturation_pressure,
)

PHASE_EXPLOSION = 0.9
"""Temperature of phase explosion over the critical temperature. Source: [Kelly1996]."""
EJECTION_ACCELERATION = 1e8
"""Acceleration that ejects a particle without melting [m/s^2]. Source: [Tam1992], as [Alshaer2017]
cites it."""
VAPOR_ABSORPTION = 4e-2
"""Absorption coefficient of aluminum vapor below 4000 K [1/m]. Source: [Hoffman2002], as
[Alshaer2017] cites it."""
HOTTEST = 1e6
"""Where the search for a temperature ends [K]. Format: in a metal without critical point."""
INTERVALS, HALVINGS = 200, 60
"""Parts of the range in which a temperature is sought, and halvings of the bisection. Accuracy: a
flux that falls again near the critical point is seen in steps of 0.5 % of the range; 60 halvings
end at rounding."""


def skin_fluence(depth: float, heat: float, absorptivity: float) -> float:
    """Incident fluence that brings a skin of metal the energy of vaporization [J/m^2].

    F = rho h_v d / A: as much as it takes, were all of the light to stay in the skin.

    Args:
        depth: of the skin d [m]. heat: rho h_v, from the initial temperature to vapor [J/m^3].
            absorptivity: share of the light that is absorbed A.
    """
    return heat * depth / absorptivity


def light_left(depth: float, absorption_coefficient: float) -> float:
    """Share of the light that is left at a depth, exp(-alpha z) [Alshaer2017, eqs. (3), (4)]."""
    return exp(-absorption_coefficient * depth)


def depth_of_light(share: float, absorption_coefficient: float) -> float:
    """Depth at which a share of the light is left [m]: -ln(share) / alpha, from eq. (3).

    [Alshaer2017] finds 0.004 % at 250 nm; with its alpha = 1.23e8 1/m that is the share at 82 nm.
    """
    return -log(share) / absorption_coefficient


def absorbed_by_vapor(height: float, absorption_coefficient: float = VAPOR_ABSORPTION) -> float:
    """Share of the light that vapor takes over a height [m]: 1 - exp(-a h)."""
    return 1.0 - exp(-absorption_coefficient * height)


def temperature_at_pressure(
    p: float, *, p_b: float, T_b: float, L_b: float, T_c: float, R_s: float
) -> float:
    """Temperature at which the saturation pressure is p [K]; inf where it never gets so high."""

    def pressure(T: float) -> float:
        return saturation_pressure(T, p_b, T_b, L_b, T_c, R_s)

    return first_crossing(pressure, p, 0.2 * T_b, min(T_c, HOTTEST))


def evaporating_temperature(
    flux: float,
    *,
    T_0: float,
    c_p: float,
    L_m: float,
    p_b: float,
    T_b: float,
    L_b: float,
    T_c: float,
    R_s: float,
) -> float:
    """Temperature at which evaporation alone carries a flux [W/m^2] away [K]; see above.

    T_b where that much evaporates below the boiling point; T_c where not even then it does.
    """

    def carried_flux(T: float) -> float:
        pressure = saturation_pressure(T, p_b, T_b, L_b, T_c, R_s)
        heat = c_p * (T - T_0) + L_m + latent_heat(T, T_b, L_b, T_c)
        return mass_flux(T, pressure, R_s) * heat

    # Landau's balance, see above: the flux that evaporation carries at T equals q
    hottest = min(T_c, HOTTEST)
    return min(first_crossing(carried_flux, flux, T_b, hottest), hottest)


def first_crossing(
    function: Callable[[float], float], wanted: float, low: float, high: float
) -> float:
    """Lowest argument at which a function has risen to a value; low or inf where there is none.

    The flux that evaporation carries falls again near T_c, as the latent heat does.
    """
    if function(low) >= wanted:
        return low
    # first part of the range in which the function rises to the value
    width = (high - low) / INTERVALS
    ends = (low + (k + 1) * width for k in range(INTERVALS))
    upper = next((T for T in ends if function(T) >= wanted), inf)
    if upper == inf:
        return inf

    # bisection in that part
    lower = upper - width
    for _ in range(HALVINGS):
        middle = 0.5 * (lower + upper)
        lower, upper = (middle, upper) if function(middle) < wanted else (lower, middle)
    return 0.5 * (lower + upper)
