"""Terms of `Block` and of those who read it, of one particle or one pair."""

from __future__ import annotations

from lasersph.compute.vectors import dot


def wall_terms(g_ij, dirichlet_j, P_w_j, T_w_j, flux_j, normal_j, plane_j, x_i, x_j, min_distance):
    """Share of a pair in the boundary coefficient A [m^(d-2)], A P_w, A T_w and the power b.

    Beyond a Dirichlet face c_ij = n_ij / n_i times the weight, n normal to the face; beyond a
    Neumann face 2 q n_j times the weight. Below a surface that bends a particle may lie beyond the
    plane of its neighbor's ghost: `min_distance` is the least n_i that counts [m].
    """
    n_i = max(plane_j - dot(x_i, normal_j), min_distance)
    n_j = dot(x_j, normal_j) - plane_j
    A = dirichlet_j * g_ij * (n_i + n_j) / n_i
    return A, A * P_w_j, A * T_w_j, 2.0 * (1.0 - dirichlet_j) * g_ij * flux_j * n_j


def inner_weight(g_ij, dirichlet_j):
    """Weight of a pair that conducts between particles: 0 toward ghosts beyond a Dirichlet face."""
    return g_ij * (1.0 - dirichlet_j)


def either(a, b):
    """1 where one of two marks is 1."""
    return max(a, b)


def weight_of(g_ij):
    """Weight of a pair, for its sum over the neighbors."""
    return g_ij
