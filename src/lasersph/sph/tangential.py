"""Gradient along a surface, from the particles that lie at it.

    g_i = (P M P + n n)^-1 P sum_j s_j V_j (f_j - f_i) grad W_ij,    P = 1 - n n,
    M   = sum_j s_j V_j grad W_ij (x) (x_j - x_i)

n is the surface's normal at i and s marks the particles at the surface. Exact for fields that are
linear along the surface, however it is tilted, and without a part along n. It is the corrected
gradient of `correction` in the tangential plane.
"""

from __future__ import annotations

from lasersph.compute.vectors import dot, identity, inverse, matmul, matvec, outer


def tangential_terms(f_i, f_j, s_j, V_j, x_ij, r_ij, dW_ij):
    """Terms s_j V_j (f_j - f_i) grad W_ij [unit of f / m] and of M [1].

    Args:
        f: the field. s: 1 at the surface, else 0. V: volume [m^d]. x_ij: x_i - x_j [m].
    """
    scale = s_j * V_j * dW_ij / r_ij
    return scale * (f_j - f_i) * x_ij, -scale * outer(x_ij, x_ij)


def tangential_gradient(total_0, total_1, n, s):
    """The gradient along the surface at a particle of the surface [unit of f / m], else zero.

    Args:
        total_0, total_1: sums of `tangential_terms`. n: unit normal. s: 1 at the surface, else 0.
    """
    if s <= 0.0:
        return 0.0 * n
    # P M P has no inverse along n; + n n gives it one and leaves the plane as it is
    normal = outer(n, n)
    P = identity(len(n)) - normal
    M = matmul(P, matmul(total_1, P)) + normal
    # P applied to the sum, then the inverse in the plane
    slope = total_0 - dot(total_0, n) * n
    return matvec(inverse(M), slope)


def extension_terms(f_j, s_j, W_ij):
    """Terms s_j f_j W_ij and s_j W_ij of the Shepard mean over surface particles in the support."""
    return s_j * f_j * W_ij, s_j * W_ij


def extend_from_surface(total_0, total_1, f, s):
    """Value of the surface for a particle near it: its own at the surface, else their mean.

    Zero where no particle of the surface is within the support.
    """
    if s > 0.0:
        return f
    return total_0 / max(total_1, 1e-300)
