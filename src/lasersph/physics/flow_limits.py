"""Limits of the time step of a flow, by name, as published and corrected.

    advection   0.25 l / v           force       0.25 sqrt(l / f)
    viscosity   0.125 l^2 / nu       heat        0.125 l^2 / a
    capillary   0.25 sqrt(rho l^3 / (2 pi gamma))               [Demuth2020, eqs. (59), (76)]

l is the support radius, v the largest speed, f the largest acceleration by all forces together:
pressure, viscosity with the stress of the surface in it, and buoyancy. Corrected: advection takes
0.06 l / v, 0.23 spacings, since a pressure that acts for a whole step of 0.94 spacings loses 1 % of
the energy of a vortex within a tenth of its turn; where melt passes between particles that keep
their columns, with fluxes of the middle of a step, 0.12 l / v as far as that is no more than
0.024 l^2 / nu. Viscosity takes
0.05 l^2 / nu where it is explicit, since forward Euler with the SPH Laplacian diverges beyond
0.0575 l^2 / nu, and 0.2 l^2 / nu where it is implicit: in boxes whose surface does not move the
split of viscous forces from pressure errs within sqrt(nu dt) of the walls. Heat is implicit and has
no limit. What a surface that moves asks for is said by itself.
"""

from __future__ import annotations

from math import inf, pi, sqrt

PUBLISHED_ADVECTION, FORCE, PUBLISHED_DIFFUSION, CAPILLARY = 0.25, 0.25, 0.125, 0.25
"""Shares of l / v, sqrt(l / f), l^2 / nu and sqrt(rho l^3 / (2 pi gamma)). Source: [Demuth2020,
eqs. (59), (76)], after [Monaghan1992]."""
ADVECTION = 0.06
"""Share of l / v. Study: a pressure that acts for a whole step of 0.94 spacings takes 1 % of a
vortex's energy within a tenth of its turn (`benchmarks/flow_numbers.py --only vortices`)."""
PASSING, SLOW_PASSING = 0.12, 0.024
"""Shares of l / v and l^2 / nu where melt passes between particles that keep their columns. Study:
half of the first changes depth and volume of the pool of `spot-weld` by less than half a percent;
the energy of a steady flow was off by 1.3 % with it where v l / nu is 46, by 2.3 % where it is 1.9,
which the second one keeps at 0.06 l / v and 1.0 % (`benchmarks/flow_numbers.py --only spots`,
before the gradients of the fluxes saw the stress of the surface)."""
DIFFUSION, SPLIT = 0.05, 0.2
"""Shares of l^2 / nu that explicit and implicit viscosity are allowed. Stability: forward Euler
with this Laplacian diverges beyond 0.0575 (von Neumann); in boxes whose surface does not move the
split of viscosity from pressure errs within (nu dt)^1/2 of walls, which is 0.45 of a support, 1.7
spacings, at 0.2. Elsewhere the pressure of the step before acts with viscosity."""


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
    is_passing: bool = False,
) -> dict[str, float]:
    """Named limits [s]; infinite where a quantity is zero or nothing can become unstable.

    Args:
        rule: "corrected" or "published". support: l [m]. speed: v [m/s]. acceleration: f [m/s^2].
        viscosity: nu [m^2/s]. diffusivity: a [m^2/s]. density: rho of the liquid [kg/m^3].
        surface_tension: gamma [N/m]; only for the published rule. is_implicit: the viscosity.
        is_passing: whether particles keep their columns and the melt passes between them.
    """
    is_published = rule == "published"
    advection = PUBLISHED_ADVECTION if is_published else ADVECTION
    # common to both rules: advection and force
    limits = {
        "advection": advection * support / speed if speed else inf,
        "force": FORCE * sqrt(support / acceleration) if acceleration else inf,
        "viscosity": inf,
    }
    # eqs. (59), (76): diffusion of momentum and heat, and capillary waves
    if is_published:
        limits["viscosity"] = PUBLISHED_DIFFUSION * support**2 / viscosity
        limits["heat"] = PUBLISHED_DIFFUSION * support**2 / diffusivity
        if surface_tension:
            limits["capillary"] = CAPILLARY * sqrt(
                density * support**3 / (2.0 * pi * surface_tension)
            )
    else:
        # corrected: a longer step of fluxes in its middle, unless viscosity reaches far within it
        if is_passing and speed:
            longer = min(PASSING * support / speed, SLOW_PASSING * support**2 / viscosity)
            limits["advection"] = max(limits["advection"], longer)
        # viscosity alone, by how it is solved
        limits["viscosity"] = (SPLIT if is_implicit else DIFFUSION) * support**2 / viscosity
    return limits
