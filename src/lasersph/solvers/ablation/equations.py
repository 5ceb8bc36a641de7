"""The equations of moving matter: one pass over the pairs, then what acts on each particle alone.

    d rho_i/dt = sum of `continuity.density_rate`                         [Alshaer2017, eq. (20)]
    dv_i/dt    = sum of `momentum.pair_acceleration` - g up               [Alshaer2017, eq. (22)]
    dh_i/dt    = (sum of `laplacian.conduction` + Q_i - A_i q(T_i)) / m_i [Alshaer2017, eq. (27)]

Q_i is the light that the particle absorbs and A_i q(T_i) what its open area loses. The first two
sums run over particles with an acting volume V_a: what leaves the surface is vapor, far thinner
than the particle that stands for it, and exerts no force and feels none. Leaving particles still
conduct. Viscous work is not turned into heat, as in the paper.
"""

from __future__ import annotations

from lasersph.compute.vectors import dot
from lasersph.particles.kinds import EJECTED, GONE, INTERIOR, LEAVING, WALL
from lasersph.physics.artificial_viscosity import alpha_between, closing_speed, viscous_term
from lasersph.physics.continuity import density_rate
from lasersph.physics.losses import surface_loss
from lasersph.physics.momentum import pair_acceleration
from lasersph.sph.laplacian import conduction, flow, weight


def motion_terms(
    v_i,
    v_j,
    rho_i,
    rho_j,
    P_i,
    P_j,
    V_a_j,
    f_m_i,
    f_m_j,
    x_ij,
    r_ij,
    dW_ij,
    h_s,
    c_0,
    alpha_solid,
    alpha_liquid,
):
    """Terms of d rho/dt [kg/(m^d s)] and dv/dt [m/s^2], and mu_ij^4 [m^4/s^4].

    The fourth root of the sum of the last bounds the largest |mu_ij| from above, with which
    [Alshaer2017, eq. (31)] limits the step; a maximum would keep the loop from being vectorized.
    Neighbors beyond the support count for nothing, so that steps do not depend on the skin.

    Args:
        v: velocity [m/s]. rho: density [kg/m^d]. P: pressure [Pa]. V_a: acting volume [m^d].
        f_m: melt fraction [1]. x_ij: x_i - x_j [m]. r_ij: distance [m]. dW_ij: dW/dr [1/m^(d+1)].
        h_s: smoothing length [m]. c_0: [m/s]. alpha_solid, alpha_liquid: artificial viscosity.
    """
    v_ij = v_i - v_j
    mu_ij = closing_speed(v_ij, x_ij, h_s)
    alpha = alpha_between(f_m_i, f_m_j, alpha_solid, alpha_liquid)
    Pi_ij = viscous_term(mu_ij, alpha, c_0, rho_i, rho_j)
    acts = 1.0 if V_a_j * dW_ij < 0.0 else 0.0
    return (
        density_rate(rho_i, V_a_j, v_ij, x_ij, r_ij, dW_ij),
        pair_acceleration(V_a_j, P_i, P_j, rho_i, rho_j, Pi_ij, x_ij, r_ij, dW_ij),
        acts * mu_ij**4,
    )


def pair_rates(
    v_i,
    v_j,
    rho_i,
    rho_j,
    P_i,
    P_j,
    V_a_j,
    V_i,
    V_j,
    T_i,
    T_j,
    k_i,
    k_j,
    f_m_i,
    f_m_j,
    x_ij,
    r_ij,
    dW_ij,
    h_s,
    c_0,
    alpha_solid,
    alpha_liquid,
    factor,
):
    """`motion_terms` with the heat [W] in the place before the last; arguments of both, and of
    `pair_heat`."""
    rho_rate, a, fourth = motion_terms(
        v_i, v_j, rho_i, rho_j, P_i, P_j, V_a_j, f_m_i, f_m_j, x_ij, r_ij, dW_ij,
        h_s, c_0, alpha_solid, alpha_liquid,
    )  # fmt: skip
    return rho_rate, a, pair_heat(T_i, T_j, k_i, k_j, V_i, V_j, r_ij, dW_ij, factor), fourth


def even_pair_rates(
    v_i,
    v_j,
    rho_i,
    rho_j,
    P_i,
    P_j,
    V_a_j,
    V_k_i,
    V_k_j,
    T_i,
    T_j,
    f_m_i,
    f_m_j,
    x_ij,
    r_ij,
    dW_ij,
    h_s,
    c_0,
    alpha_solid,
    alpha_liquid,
    factor,
):
    """`pair_rates` where the conductivity is one number, see `even_pair_heat`."""
    rho_rate, a, fourth = motion_terms(
        v_i, v_j, rho_i, rho_j, P_i, P_j, V_a_j, f_m_i, f_m_j, x_ij, r_ij, dW_ij,
        h_s, c_0, alpha_solid, alpha_liquid,
    )  # fmt: skip
    return rho_rate, a, even_pair_heat(T_i, T_j, V_k_i, V_k_j, r_ij, dW_ij, factor), fourth


def particle_rates(total_0, total_1, total_2, total_3, kind, m, T, E, A, step, up, g, surroundings):
    """Rates of one particle from its sums.

    Returns d rho/dt [kg/(m^d s)], dv/dt [m/s^2], dh/dt [W/kg], heat lost by the surface and to
    walls [W], |dv/dt|^2 [m^2/s^4], and the sum of mu^4 of the interior [m^4/s^4].

    Args:
        kind: see `particles.kinds`. up: unit vector against gravity. g: [m/s^2]. Others as of
        `heat_rates`.
    """
    moves = 1.0 if kind == INTERIOR else 0.0
    is_wall = 1.0 if kind == WALL else 0.0
    dh, lost = heat_rates(total_2, kind, m, T, E, A, step, surroundings)
    a = moves * (total_1 - g * up)
    return (moves + is_wall) * total_0, a, dh, lost, dot(a, a), moves * total_3


def heat_rates(total, kind, m, T, E, A, step, surroundings):
    """dh/dt [W/kg], and heat lost by the surface and to walls [W], of one particle.

    Args:
        total: heat from its neighbors [W]. m: mass [kg]. T: [K]. E: light absorbed in the step [J].
        A: open area [m^(d-1)]. step: [s]. surroundings: of `losses.surface_loss`.
    """
    takes_heat = 1.0 if kind <= LEAVING else 0.0
    is_wall = 1.0 if kind == WALL else 0.0
    loss, _slope = surface_loss(T, surroundings)
    gain = takes_heat * (total + E / step - A * loss)
    return gain / m, takes_heat * A * loss + is_wall * total


def pair_heat(T_i, T_j, k_i, k_j, V_i, V_j, r_ij, dW_ij, factor):
    """Heat from a neighbor [W], see `laplacian.conduction`.

    Args:
        V: volume [m^d]. T: temperature [K]. k: conductivity [W/(m K)], 0 of what conducts nothing.
        factor: of the conduction weights [1].
    """
    return factor * conduction(T_i, T_j, k_i, k_j, V_i, V_j, r_ij, dW_ij)


def even_pair_heat(T_i, T_j, V_k_i, V_k_j, r_ij, dW_ij, factor):
    """`pair_heat` where the conductivity is one number, which is the mean of any two: less is read
    of a neighbor. V_k: `conducting_volume`."""
    return flow(pair_weight(V_k_i, V_k_j, r_ij, dW_ij, factor), T_i, T_j)


def conducting_volume(V, k):
    """k^(1/2) V [m^d (W/(m K))^(1/2)]: two of them times each other have the conductivity of a
    pair, none where one conducts nothing."""
    return k**0.5 * V


def pair_weight(V_i, V_j, r_ij, dW_ij, factor):
    """Conduction weight of a pair that stays where it is [m^(d-2)], see `laplacian.weight`; of
    conducting volumes with the conductivity [W/K]."""
    return factor * weight(V_i, V_j, r_ij, dW_ij)


def advance(x, v, rho, h, kind, v_rate, a, drho, dh, dt):
    """Position, velocity, density and enthalpy after `dt` [s] at constant rates.

    Half steps and whole steps alike [Alshaer2017, eqs. (29), (30)]; `v_rate` is the velocity that
    goes with the rates. What has been ejected flies on elsewhere.
    """
    follows = 1.0 if kind <= LEAVING else 0.0
    return x + follows * dt * v_rate, v + dt * a, rho + dt * drho, h + dt * dh


def advance_vapor(x, v, h, kind, dh, dt):
    """Position [m] of what leaves and enthalpy [J/kg] after `dt` [s]; the rest stays in place."""
    return (x + dt * v if kind == LEAVING else x), h + dt * dh


def advance_enthalpy(h, dh, dt):
    """Enthalpy after `dt` [s] at a constant rate [J/kg]."""
    return h + dt * dh


def trial_step(m, rho, a, drho, dh, dt):
    """Changes by a trial step: energy taken up [J], density [kg/m^d], |dv/dt|^2 [m^2/s^4]."""
    return energy_gain(m, dh, dt), rho + dt * drho, dot(a, a)


def energy_gain(m, dh, dt):
    """Energy taken up in `dt` [s], [J]."""
    return m * dt * dh


def fly(x, v, kind, step, low, high):
    """Position [m] and kind of what has been ejected after a step [s], and 1 if it is gone now.

    Args:
        low, high: corners of the box in which ejecta are followed [m].
    """
    if kind != EJECTED:
        return x, kind, 0.0
    new = x + step * v
    if distance_outside(new, low, high) > 0.0:
        return new, GONE, 1.0
    return new, EJECTED, 0.0


def distance_outside(x, low, high):
    """Sum over the axes of how far a position lies outside a box [m], 0 inside."""
    distance = max(low[0] - x[0], 0.0) + max(x[0] - high[0], 0.0)
    if len(x) > 1:
        distance = distance + max(low[1] - x[1], 0.0) + max(x[1] - high[1], 0.0)
    if len(x) > 2:
        distance = distance + max(low[2] - x[2], 0.0) + max(x[2] - high[2], 0.0)
    return distance


def speed_squares(v, kind):
    """|v|^2 [m^2/s^2] of the interior, and of what leaves."""
    square = dot(v, v)
    is_interior = 1.0 if kind == INTERIOR else 0.0
    is_leaving = 1.0 if kind == LEAVING else 0.0
    return is_interior * square, is_leaving * square


def interior_extremes(P, v, kind):
    """Pressure [Pa] and |v|^2 [m^2/s^2] of the interior."""
    is_interior = 1.0 if kind == INTERIOR else 0.0
    return is_interior * P, is_interior * dot(v, v)
