"""Pair and pointwise functions that only measurements need."""

from lasersph.compute.vectors import dot


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


def is_neighbor(x_ij, r_ij, l_ij):
    """Whether j is a neighbor of i: what a search computes for a pair at least."""
    return r_ij < l_ij


def same(a):
    """The argument."""
    return a


def triad(b, c, s):
    """b + s c, the loop by which the bandwidth of a memory is usually given."""
    return b + s * c


def chain(p, b, c):
    """Four multiplications and additions, written out: a loop would not become vectors."""
    p = (p * b + c) * b + c
    return (p * b + c) * b + c


def chains(a, b, c):
    """Eight chains side by side, since a processor waits some four cycles for a link of one.

    The largest comes back: of a sum the compiler would do several chains at once. Longer ones
    would not be put into the loop, and not become vectors either.
    """
    p, q, r, s = chain(a, b, c), chain(b, b, c), chain(c, b, c), chain(a - b, b, c)
    t, u, v, w = chain(a - c, b, c), chain(b - c, b, c), chain(a + b, b, c), chain(a + c, b, c)
    return max(p, q, r, s, t, u, v, w)


def quotients(a, b, c):
    """Six divisions, by different numbers: of one number the compiler would take the inverse."""
    return a / b + b / c + c / a + a / (b + c) + b / (a + c) + c / (a + b)
