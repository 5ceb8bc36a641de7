"""The fastest wave of a surface whose line is smoothed, and the limits of the step that it sets."""

from __future__ import annotations

from math import pi, sqrt

from lasersph.surface.smoothing import ORDER

CAPILLARY = 0.5
"""omega dt of the fastest wave. Stability: waves are stable below 2; films of 28 nm spacing give
the same 0.1 % at half of it."""
VISCOUS = 0.5
"""Rate at which the normal stress slows the shortest wave, 4 nu k^2, times dt. Stability: the
stress is explicit, 1 would undo a wave within a step."""


def fastest_wave(tension: float, density: float, cutoff: float) -> float:
    """omega of the fastest wave that a smoothed line shows [1/s].

    omega^2 = gamma k^3 F(k)/rho, F = 1/(1 + (k/k_c)^(2n)): largest at (k/k_c)^(2n) = 3/(2n - 3).
    """
    share = 3.0 / (2.0 * ORDER - 3.0)
    # k of the maximum of omega^2 over all waves
    k = 2.0 * pi / cutoff * share ** (1.0 / (2.0 * ORDER))
    return sqrt(tension * k**3 / (1.0 + share) / density)


def surface_limits(
    tension: float, density: float, viscosity: float, cutoff: float
) -> dict[str, float]:
    """Limits of the step by capillary waves and by the viscous stress on the shortest [s].

    Args:
        tension: gamma [N/m]. density: [kg/m^3]. viscosity: kinematic [m^2/s]. cutoff: lambda_c [m].
    """
    k = 2.0 * pi / cutoff
    return {
        "capillary": CAPILLARY / fastest_wave(tension, density, cutoff),
        "surface-stress": VISCOUS / (4.0 * viscosity * k**2),
    }
