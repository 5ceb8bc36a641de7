"""Density that changes as particles approach or part.

    d rho_i/dt = rho_i sum_j V_j (v_i - v_j) . grad W_ij,    V_j = m_j / rho_j

[Alshaer2017, eq. (20); the paper prints rho_j inside the sum and the opposite sign, with which a
compressed body thins]. With `momentum.pair_acceleration` the sum of kinetic and elastic energy
is conserved exactly in continuous time.
"""

from __future__ import annotations

from lasersph.compute.vectors import dot


def density_rate(rho_i, V_j, v_ij, x_ij, r_ij, dW_ij):
    """Term of d rho_i/dt [kg/(m^d s)]: rho_i V_j v_ij . grad W_ij.

    Args:
        rho_i: density [kg/m^d]. V_j: volume [m^d]. v_ij: v_i - v_j [m/s]. x_ij: x_i - x_j [m].
        r_ij: distance [m]. dW_ij: dW/dr [1/m^(d+1)].
    """
    return rho_i * V_j * dot(v_ij, x_ij) * dW_ij / r_ij
