"""Laplacian of Brookshaw, Cleary-Monaghan and Morris, as a pairwise flow that conserves.

    div(k grad T)_i = sum_j V_j (k_i + k_j) (T_i - T_j) / r_ij * dW_ij        [Demuth2020, eq. (48)]

Summed over a body the pair functions below, multiplied by V_i, cancel pair by pair. The mean of the
conductivities is arithmetic (as printed), harmonic (continuous flux where k jumps) or the integral
mean, which is the difference of the heat potential P = int k dT over that of T and comes from the
weights g_ij alone:  q_ij = g_ij (P_j - P_i).

References: [Brookshaw1985], [Cleary1999], [Morris1997], [Demuth2020], [Alshaer2017].
"""

from __future__ import annotations

from lasersph.compute.vectors import dot

SMALLEST_CONDUCTIVITY = 1e-30
"""Least divisor of a sum of two conductivities [W/(m K)]. Format: keeps 0 / 0 from two particles
that do not conduct."""


def diffusion(G_i, G_j, f_i, f_j, V_j, r_ij, dW_ij):
    """div(G grad f) at particle i with the arithmetic mean of G [unit of G f / m^2].

    V_j (G_i + G_j) (f_i - f_j) / r_ij * dW_ij       [Demuth2020, eq. (48)]

    Args:
        G: diffusion coefficient. f: the field. V: volume [m^d]. r_ij: distance [m].
        dW_ij: dW/dr [1/m^(d+1)].
    """
    return V_j * (G_i + G_j) * (f_i - f_j) / r_ij * dW_ij


def conduction(T_i, T_j, k_i, k_j, V_i, V_j, r_ij, dW_ij):
    """Heat flowing from particle j into particle i [W], with the harmonic mean of k.

    V_i V_j 4 k_i k_j / (k_i + k_j) (T_i - T_j) dW_ij / r_ij   [Alshaer2017, eq. (27) times m_i]

    Args:
        T: temperature [K]. k: conductivity [W/(m K)]. V: volume [m^d]. r_ij: distance [m].
        dW_ij: dW/dr [1/m^(d+1)]. Two particles that conduct nothing exchange nothing.
    """
    mean = 4.0 * k_i * k_j / max(k_i + k_j, SMALLEST_CONDUCTIVITY)
    return V_i * V_j * mean * (T_i - T_j) * dW_ij / r_ij


def weight(V_i, V_j, r_ij, dW_ij):
    """Weight g_ij = -2 V_i V_j dW_ij / r_ij of a pair [m^(d-2)], symmetric and not negative.

    With it the heat flowing from j into i is g_ij (P_j - P_i).
    """
    return -2.0 * V_i * V_j * dW_ij / r_ij


def layered_weight(
    V_i, V_j, layer_i, layer_j, normal_i, normal_j, lateral_i, lateral_j, x_ij, r_ij, dW_ij, up
):
    """`weight` corrected to conduct exactly on a lattice of layers [m^(d-2)].

    g_ij (e_n^2 c_n + (1 - e_n^2) c_l),   c_n = (N_i - N_j) / (layer_i - layer_j),
    c_l = (a_i + a_j) / 2

    with the factors of `second_moment`; symmetric like `weight`.

    Args:
        layer: number of the layer. normal (N), lateral (a): factors of the layer [1].
        x_ij: x_i - x_j [m]. up: unit vector normal to the layers.
    """
    along = dot(x_ij, up) / r_ij  # every division by r_ij: the compiler takes one reciprocal
    share = along * along
    # c_n: mean factor of the planes that the pair crosses, from the running sums N
    steps = layer_i - layer_j
    across = (normal_i - normal_j) / steps if steps != 0.0 else 1.0
    # along the normal c_n, along the layer c_l, by the squares of the direction
    factor = share * across + (1.0 - share) * 0.5 * (lateral_i + lateral_j)
    return -2.0 * V_i * V_j * dW_ij / r_ij * factor


def flow(g_ij, P_i, P_j):
    """Heat flowing from j into i [W]: g_ij (P_j - P_i)."""
    return g_ij * (P_j - P_i)


def harmonic_flow(g_ij, T_i, T_j, k_i, k_j):
    """Heat flowing from j into i [W] with the harmonic mean of k, from assembled weights."""
    return g_ij * 2.0 * k_i * k_j / max(k_i + k_j, SMALLEST_CONDUCTIVITY) * (T_j - T_i)
