"""Monaghan's artificial viscosity, which resists approach.

    Pi_ij = - alpha c_0 mu_ij / rho_ij   where v_ij . x_ij < 0, else 0
    mu_ij = h v_ij . x_ij / (r_ij^2 + 0.01 h^2),    rho_ij = (rho_i + rho_j) / 2

[Alshaer2017, eqs. (23)-(25)] with the smoothing length h, half the support of a cubic spline; the
paper prints the condition reversed, with which it would draw parting particles together. alpha = 5
holds a solid stiff, alpha = 0.1 lets a liquid flow; between them a pair takes the mean of its
particles, each weighed by its melt fraction.
"""

from __future__ import annotations

from lasersph.compute.vectors import dot

SOFTENING = 0.01
"""Share of h^2 added to r_ij^2. Source: [Monaghan1992], as in [Alshaer2017, eq. (24)]."""


def closing_speed(v_ij, x_ij, h):
    """mu_ij [m/s], negative where the particles approach.

    Args:
        v_ij: v_i - v_j [m/s]. x_ij: x_i - x_j [m]. h: smoothing length [m].
    """
    return h * dot(v_ij, x_ij) / (dot(x_ij, x_ij) + SOFTENING * h * h)


def alpha_between(f_i, f_j, alpha_solid, alpha_liquid):
    """alpha of a pair: the mean of its particles, by their melt fractions f [1]."""
    return alpha_solid + 0.5 * (f_i + f_j) * (alpha_liquid - alpha_solid)


def viscous_term(mu_ij, alpha, c_0, rho_i, rho_j):
    """Pi_ij [m^5/(kg s^2) in 3-D]: -alpha c_0 mu_ij / rho_ij for approaching particles, else 0."""
    # eq. (23) with rho_ij = (rho_i + rho_j) / 2; parting particles, mu_ij > 0, feel nothing
    return -2.0 * alpha * c_0 * min(mu_ij, 0.0) / (rho_i + rho_j)
