"""Viscous momentum exchange of the melt.

    V_i dv_i/dt = nu sum_j g_ij (v_j - v_i)                       [Demuth2020, eqs. (51), (68)]

with the weights g_ij of conduction, which discretize V_i times the Laplacian. Where the viscosity
varies, nu = nu_l m(T) with nu_l at the liquidus, g_ij counts times the harmonic mean of m_i and m_j
[Cleary1999], which gives what one particle gains to the other and does not change m = 1 by a bit.
That is div(nu grad v); the stress is 2 rho nu D, so that the transposed gradient adds

    div(nu (grad v)^T) = (grad v)^T grad nu

where div v = 0. Without it a melt that turns as a whole would feel its viscosity. The published
scheme is explicit; the implicit one is solved in `solvers.melt_pool.viscous_step`.

What rests is rigid, its m without end: the harmonic mean doubles the weight of a pair, as if the
wall lay halfway between both, where the melt ends on average. With the m of melt, as published, a
layer on a lattice slips on a wall 0.6 spacings behind its end; so it is within 0.1 of it.
"""

from __future__ import annotations

from lasersph.compute.vectors import interpolate, matmul, matvec, outer, transpose

RIGID = 1e9
"""Viscosity of what rests over that at the liquidus. Rounding: without end but for 1e-9."""


def relative_viscosity(T, T_nodes, m_nodes):
    """Viscosity of the melt at T over that at the liquidus [1]."""
    return interpolate(T, T_nodes, m_nodes)


def stiffness(m, fluid):
    """Relative viscosity of what flows, that of a rigid body where nothing does [1]."""
    return m if fluid > 0.0 else RIGID


def viscous_weight(g_ij, m_i, m_j):
    """g_ij [m^(d-2)] times the harmonic mean of the relative viscosities m."""
    return g_ij * (2.0 * m_i * m_j / (m_i + m_j))


def transposed_terms(v_i, v_j, m_i, m_j, G_ij):
    """Terms of the gradients of v [1/s], (grad v)_ab = d v_a/d x_b, and of m [1/m], uncorrected."""
    return outer(v_j - v_i, G_ij), (m_j - m_i) * G_ij


def transposed_force(total_0, total_1, C, b, nu):
    """Body force b [m/s^2] with (grad v)^T grad nu; C corrects both gradients."""
    # (grad v)^T grad nu with corrected gradients; nu scales the relative viscosity
    gradient = matmul(total_0, transpose(C))
    return b + nu * matvec(transpose(gradient), matvec(C, total_1))


def momentum(g_ij, v_i, v_j):
    """Viscous force on i over eta [m^(d-1)/s]: g_ij (v_j - v_i)."""
    return g_ij * (v_j - v_i)


def predict(total, v, V, nu, b, step):
    """Velocity after viscous force and body force b [m/s], explicit.

    Args:
        total: sum of `momentum`. v: [m/s]. V: volume [m^d]. nu: [m^2/s]. b: [m/s^2]. step: [s].
    """
    return v + step * (nu / V * total + b)


def forced(v, b, step):
    """Velocity after the body force alone [m/s]."""
    return v + step * b
