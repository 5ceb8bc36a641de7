"""Rate of heating of a particle: what neighbors, walls, light and losses bring per second.

rho dh/dt = div(k grad T) + Q        [Demuth2020, eq. (3); Alshaer2017, eq. (1)]
"""

from __future__ import annotations


def enthalpy_rate(total, T, k, E, q, m, a, b, w, step):
    """dh/dt [W/kg] from the summed flow `total` [W], and the heat from the faces [W].

    Args:
        T: [K]. k: [W/(m K)]. E: light absorbed in the step [J]. q: loss of the surface [W].
        m: mass [kg]. a, b: sums over Dirichlet faces of A_i and A_i T_w. w: power of prescribed
        fluxes [W]. step: [s].
    """
    walls = k * (b - a * T) + w
    return (total + walls + E / step - q) / m, walls
