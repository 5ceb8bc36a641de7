"""Rates of density, velocity and enthalpy: one pass over the pairs, then what acts on each alone.

    d rho_i/dt = sum of `continuity.density_rate`                         [Alshaer2017, eq. (20)]
    dv_i/dt    = sum of `momentum.pair_acceleration` - g up               [Alshaer2017, eq. (22)]
    dh_i/dt    = (sum of `laplacian.conduction` + Q_i - A_i q(T_i)) / m_i [Alshaer2017, eq. (27)]

Q_i is the light that the particle absorbs and A_i q(T_i) what its open area loses. The first two
sums run over particles with an acting volume V_a: what leaves the surface is vapor, far thinner
than the particle that stands for it, and neither pulls nor is pulled. Leaving particles still
conduct. Viscous work is not turned into heat, as in the paper.
"""

from __future__ import annotations

from lasersph.compute.vectors import dot, interpolate
from lasersph.physics.artificial_viscosity import alpha_between, closing_speed, viscous_term
from lasersph.physics.continuity import density_rate
from lasersph.physics.ejection import CONDENSED, LEAVING, WALL
from lasersph.physics.equation_of_state import condensed_pressure
from lasersph.physics.losses import surface_loss
from lasersph.physics.momentum import pair_acceleration
from lasersph.physics.phase_change import state
from lasersph.sph.laplacian import conduction, weight


def pair_rates(
    v_i, v_j, rho_i, rho_j, P_i, P_j, V_a_j, V_i, V_j, T_i, T_j, k_i, k_j, f_m_i, f_m_j,
    x_ij, r_ij, dW_ij, h_s, c_0, alpha_solid, alpha_liquid, factor,
):  # fmt: skip
    """Terms of d rho/dt [kg/(m^d s)], dv/dt [m/s^2], heat [W], and mu_ij^4 [m^4/s^4].

    The fourth root of the sum of the last bounds the largest |mu_ij| from above, with which
    [Alshaer2017, eq. (31)] limits the step; a maximum would keep the loop from being vectorized.
    Neighbors beyond the support count for nothing, so that steps do not depend on the skin.

    Args:
        v: velocity [m/s]. rho: density [kg/m^d]. P: pressure [Pa]. V: volume [m^d].
        V_a: acting volume [m^d]. T: temperature [K]. k: conductivity [W/(m K)], 0 of what
        conducts nothing. f_m: melt fraction [1]. x_ij: x_i - x_j [m]. r_ij: distance [m].
        dW_ij: dW/dr [1/m^(d+1)]. h_s: smoothing length [m]. c_0: [m/s]. alpha_solid,
        alpha_liquid: artificial viscosity. factor: of the conduction weights [1].
    """
    v_ij = v_i - v_j
    mu_ij = closing_speed(v_ij, x_ij, h_s)
    alpha = alpha_between(f_m_i, f_m_j, alpha_solid, alpha_liquid)
    Pi_ij = viscous_term(mu_ij, alpha, c_0, rho_i, rho_j)
    acts = 1.0 if V_a_j * dW_ij < 0.0 else 0.0
    return (
        density_rate(rho_i, V_a_j, v_ij, x_ij, r_ij, dW_ij),
        pair_acceleration(V_a_j, P_i, P_j, rho_i, rho_j, Pi_ij, x_ij, r_ij, dW_ij),
        factor * conduction(T_i, T_j, k_i, k_j, V_i, V_j, r_ij, dW_ij),
        acts * mu_ij**4,
    )


def rates(total_0, total_1, total_2, total_3, kind, m, T, E, A, step, up, g, T_a, h_c, eps):
    """Rates of one particle from its sums.

    Returns d rho/dt [kg/(m^d s)], dv/dt [m/s^2], dh/dt [W/kg], heat lost by the surface and to
    walls [W], |dv/dt|^2 [m^2/s^4], and the sum of mu^4 of what is condensed [m^4/s^4].

    Args:
        kind: of its life. up: unit vector against gravity. g: [m/s^2]. Others of `heat_rates`.
    """
    moves = 1.0 if kind == CONDENSED else 0.0
    is_wall = 1.0 if kind == WALL else 0.0
    dh, lost = heat_rates(total_2, kind, m, T, E, A, step, T_a, h_c, eps)
    a = moves * (total_1 - g * up)
    return (moves + is_wall) * total_0, a, dh, lost, dot(a, a), moves * total_3


def heat_rates(total, kind, m, T, E, A, step, T_a, h_c, eps):
    """dh/dt [W/kg], and heat lost by the surface and to walls [W], of one particle.

    Args:
        total: heat from its neighbors [W]. m: mass [kg]. T: [K]. E: light absorbed in the step [J].
        A: open area [m^(d-1)]. step: [s]. T_a, h_c, eps: of `losses.surface_loss`.
    """
    takes_heat = 1.0 if kind <= LEAVING else 0.0
    is_wall = 1.0 if kind == WALL else 0.0
    loss, _slope = surface_loss(T, T_a, h_c, eps)
    gain = takes_heat * (total + E / step - A * loss)
    return gain / m, takes_heat * A * loss + is_wall * total


def conducted(T_i, T_j, k_i, k_j, V_i, V_j, r_ij, dW_ij, factor):
    """Heat from a neighbor alone [W], see `laplacian.conduction`; factor: of the weights [1]."""
    return factor * conduction(T_i, T_j, k_i, k_j, V_i, V_j, r_ij, dW_ij)


def pair_weight(V_i, V_j, r_ij, dW_ij, factor):
    """Conduction weight of a pair that stays where it is [m^(d-2)], see `laplacian.weight`."""
    return factor * weight(V_i, V_j, r_ij, dW_ij)


def derived(
    h, rho, m, kind, conducts,
    h_nodes, T_nodes, P_nodes, m_nodes, v_nodes, k_T, k_nodes, melts_at, rho_0, c_0, has_tension,
):  # fmt: skip
    """What follows from enthalpy, density and kind.

    Returns temperature [K], melt and vapor fraction [1], conductivity [W/(m K)], pressure [Pa],
    volume and acting volume [m^d], and 1 for what has not been ejected.

    Args:
        conducts: 1, or 0 for walls that let no heat pass. h_nodes ... v_nodes: of
        `phase_change.state`. k_T, k_nodes: table of the conductivity. melts_at: where matter
        without latent heat counts as molten [K]. Others as in `equation_of_state`.
    """
    T, _potential, f_m, f_v = state(h, h_nodes, T_nodes, P_nodes, m_nodes, v_nodes)
    is_wall = kind == WALL
    acts = 1.0 if kind == CONDENSED or is_wall else 0.0
    opaque = 1.0 if kind <= LEAVING or is_wall else 0.0
    melted = max(f_m, 1.0 if melts_at <= T else 0.0)
    k = opaque * conducts * interpolate(T, k_T, k_nodes)
    P = acts * condensed_pressure(rho, rho_0, c_0, has_tension)
    V = m / rho
    return T, melted, f_v, k, P, V, acts * V, opaque


def moved(x, v, rho, h, kind, v_then, a, drho, dh, dt):
    """Position, velocity, density and enthalpy after `dt` [s] at constant rates.

    Half steps and whole steps alike [Alshaer2017, eqs. (29), (30)]; `v_then` is the velocity that
    goes with the rates. What has been ejected flies on elsewhere.
    """
    follows = 1.0 if kind <= LEAVING else 0.0
    return x + follows * dt * v_then, v + dt * a, rho + dt * drho, h + dt * dh


def warmed(h, dh, dt):
    """Enthalpy after `dt` [s] at a constant rate [J/kg]."""
    return h + dt * dh


def foreseen(m, rho, a, drho, dh, dt):
    """What a step would bring: energy taken up [J], density [kg/m^d], |dv/dt|^2 [m^2/s^4]."""
    return taken_up(m, dh, dt), rho + dt * drho, dot(a, a)


def taken_up(m, dh, dt):
    """Energy taken up in `dt` [s], [J]."""
    return m * dt * dh


def lifting(x, v, h, kind, dh, dt):
    """Position [m] of what leaves and enthalpy [J/kg] after `dt` [s]; the rest stays in place."""
    return (x + dt * v if kind == LEAVING else x), h + dt * dh


def speed_squares(v, kind):
    """|v|^2 [m^2/s^2] of what is condensed, and of what leaves."""
    square = dot(v, v)
    is_condensed = 1.0 if kind == CONDENSED else 0.0
    is_leaving = 1.0 if kind == LEAVING else 0.0
    return is_condensed * square, is_leaving * square


def condensed_extremes(P, v, kind):
    """Pressure [Pa] and |v|^2 [m^2/s^2] of what is condensed."""
    is_condensed = 1.0 if kind == CONDENSED else 0.0
    return is_condensed * P, is_condensed * dot(v, v)
