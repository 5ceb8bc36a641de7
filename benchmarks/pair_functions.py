"""Pair functions that the benchmarks time."""

from lasersph.compute.vectors import dot


def arithmetic_mean(l_i, l_j):
    """Mean support radius [m]."""
    return 0.5 * (l_i + l_j)


def wendland_shape(s):
    """Wendland C2 kernel in 3-D, (1 - s)^4 (1 + 4 s)."""
    return (1 - s) ** 4 * (1 + 4 * s)


def wendland_slope(s):
    """Its derivative, -20 s (1 - s)^3."""
    return -20 * s * (1 - s) ** 3


def right_hand_side(x_ij, r_ij, dW_ij, v_i, v_j, rho_i, rho_j, p_i, p_j, m_j, mu):
    """Acceleration [m/s^2] and density rate [kg/(m^3 s)] of weakly compressible SPH."""
    factor = m_j * dW_ij / r_ij
    pressure = factor * (p_i / rho_i**2 + p_j / rho_j**2)
    viscous = 2 * mu * factor / (rho_i * rho_j)
    v_ij = v_i - v_j
    return viscous * v_ij - pressure * x_ij, factor * dot(v_ij, x_ij)


def flow(g_ij, T_i, T_j):
    """Heat flow [W] from j to i through the conductance g_ij [W/K]."""
    return g_ij * (T_j - T_i)


def same(a):
    """The argument."""
    return a
