"""Limits of the time step of a weakly compressible flow with heat, by name.

    sound        courant h / (c_0 + max |mu_ij|)
    force        courant sqrt(h / max |dv/dt|)               [Alshaer2017, eq. (31)]
    viscosity    2 / (N alpha c_0 / dx)
    conduction   2 / (L D / dx^2)

The paper's third limit is dx^2 / D (its eq. (32)), which lies above what the midpoint rule bears:
with the largest eigenvalue L of the discrete Laplacian it is 0.741 dx^2 / D in 3-D and
0.844 dx^2 / D in 1-D for the cubic spline with h = 1.5 dx. Its viscosity has a limit of its own,
which the paper does not state: N is the rate at which layers that move against each other stop;
in 3-D with alpha = 5, dx = 0.2 um and c_0 = 5000 m/s it is 0.016 ns. Both L and N come from
`sph.lattice_sums`.
"""

from __future__ import annotations

from math import inf, sqrt

MIDPOINT = 2.0
"""Largest step times rate of decay. Exact: the midpoint rule is stable for real eigenvalues up to
2."""


def compressible_limits(
    *,
    is_still: bool,
    courant: float,
    smoothing: float,
    sound_speed: float,
    closing_speed: float,
    acceleration: float,
    viscous_rate: float,
    diffusive_rate: float,
) -> dict[str, float]:
    """Named limits [s]; those of what cannot happen are left out.

    Args:
        is_still: nothing moves and no force acts, so that heat alone limits the step.
        smoothing: h [m]. sound_speed: c_0 [m/s]. closing_speed: max |mu_ij| [m/s].
        acceleration: largest [m/s^2]. viscous_rate: N alpha c_0 / dx [1/s].
        diffusive_rate: L D / dx^2 [1/s].
    """
    heat = MIDPOINT / diffusive_rate if diffusive_rate > 0.0 else inf
    if is_still:
        return {"conduction": heat}
    # eq. (31) of [Alshaer2017], then viscosity and conduction by the rates of the lattice
    limits = {
        "sound": courant * smoothing / (sound_speed + closing_speed),
        "force": courant * sqrt(smoothing / acceleration) if acceleration > 0.0 else inf,
        "viscosity": MIDPOINT / viscous_rate if viscous_rate > 0.0 else inf,
        "conduction": heat,
    }
    return {name: limit for name, limit in limits.items() if limit < inf}
