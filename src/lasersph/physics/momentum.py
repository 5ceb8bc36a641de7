"""Acceleration by pressure and viscous stress between particles.

    dv_i/dt = - sum_j m_j ((P_i + P_j) / (rho_i rho_j) + Pi_ij) grad W_ij + g
            = - sum_j V_j ((P_i + P_j) / rho_i + rho_j Pi_ij) grad W_ij + g,    V_j = m_j / rho_j

[Alshaer2017, eqs. (21), (22)], written in volumes since divisions cost much of a sum. The forces
of a pair are equal and opposite along the line between its particles, so that momentum and
angular momentum are conserved. Pi_ij is that of `artificial_viscosity`.
"""

from __future__ import annotations


def pair_acceleration(V_j, P_i, P_j, rho_i, rho_j, Pi_ij, x_ij, r_ij, dW_ij):
    """Term of dv_i/dt [m/s^2]: -V_j ((P_i + P_j) / rho_i + rho_j Pi_ij) grad W_ij.

    Args:
        V_j: volume [m^d]. P: pressure [Pa]. rho: density [kg/m^d]. Pi_ij: viscous term
        [m^5/(kg s^2) in 3-D]. x_ij: x_i - x_j [m]. r_ij: distance [m]. dW_ij: dW/dr [1/m^(d+1)].
    """
    return -V_j * ((P_i + P_j) / rho_i + rho_j * Pi_ij) * dW_ij / r_ij * x_ij
