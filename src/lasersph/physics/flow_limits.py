"""Limits of the time step of a flow, by name, as published and corrected.

    advection   0.25 l / v           force       0.25 sqrt(l / f)
    viscosity   0.125 l^2 / nu       heat        0.125 l^2 / a
    capillary   0.25 sqrt(rho l^3 / (2 pi gamma))               [Demuth2020, eqs. (59), (76)]

l is the support radius, v the largest speed, f the largest acceleration. Corrected: viscosity takes
0.05 l^2 / nu where it is explicit, since forward Euler with the SPH Laplacian diverges beyond
0.0575 l^2 / nu, and none where it is implicit; heat is implicit and has no limit; a flat lid has
neither capillary waves nor a surface that recoil pressure moves, so that both are infinite.
"""

from __future__ import annotations

from math import inf, pi, sqrt

ADVECTION, FORCE, PUBLISHED_DIFFUSION, CAPILLARY = 0.25, 0.25, 0.125, 0.25
DIFFUSION = 0.05
"""Share of l^2 / nu that explicit viscosity is allowed."""


def flow_limits(
    rule: str,
    *,
    support: float,
    speed: float,
    acceleration: float,
    viscosity: float,
    diffusivity: float,
    density: float = 0.0,
    surface_tension: float = 0.0,
    is_implicit: bool = True,
) -> dict[str, float]:
    """Named limits [s]; infinite where a quantity is zero or nothing can become unstable.

    Args:
        rule: "corrected" or "published". support: l [m]. speed: v [m/s]. acceleration: f [m/s^2].
        viscosity: nu [m^2/s]. diffusivity: a [m^2/s]. density: rho of the liquid [kg/m^3].
        surface_tension: gamma [N/m]; only for the published rule. is_implicit: the viscosity.
    """
    limits = {
        "advection": ADVECTION * support / speed if speed else inf,
        "force": FORCE * sqrt(support / acceleration) if acceleration else inf,
        "viscosity": inf,
        "capillary": inf,
        "recoil": inf,
    }
    if rule == "published":
        limits["viscosity"] = PUBLISHED_DIFFUSION * support**2 / viscosity
        limits["heat"] = PUBLISHED_DIFFUSION * support**2 / diffusivity
        if surface_tension:
            limits["capillary"] = CAPILLARY * sqrt(
                density * support**3 / (2.0 * pi * surface_tension)
            )
    elif not is_implicit:
        limits["viscosity"] = DIFFUSION * support**2 / viscosity
    return limits
