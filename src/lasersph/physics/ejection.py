"""Ejection of particles from a surface that a laser heats: two rules, as pure functions.

A particle is interior, leaving or ejected (`particles.kinds`). Ejected ones fly on at constant
velocity, transparent to the beam and without any exchange.

    enthalpy    leaves at once when all of  c_p (T_v - T_0) + L_m + L_v  is in, and carries it away
    published   leaves from T_v on, without latent heats; moves with the vapor along the normal and
                keeps absorbing until it has left [Alshaer2017, Sections 3.3 and 4.4]

"Has left" is not defined in the paper: either it has moved a distance, or the particles that it
covered have become exposed (which a layer does that has moved 0.677 spacings, in 3-D). The depth
that the published rule gives depends first on this and does not converge with the spacing; the
enthalpy rule converges to the Stefan solution of an ablating front.

Vapor velocity: `evaporation.effusion_velocity`, or `evaporation.mean_normal_velocity`, which is
the paper's eq. (6) as printed and twice the velocities that it reports.

Left out: expulsion of melt by recoil, plasma, superheating above T_v and explosive boiling.
"""

from __future__ import annotations

from lasersph.compute.vectors import dot, norm
from lasersph.particles.kinds import EJECTED, INTERIOR, LEAVING
from lasersph.physics.evaporation import (
    effusion_velocity,
    mean_normal_velocity,
    saturation_pressure,
)

NEXT_LAYER = 1.5
"""Distance over the spacing within which particles count as covered: the next layer only. Geometry:
in a cubic lattice it and its diagonals are 1 to 1.41 spacings away, the one after is at 2."""
ALIGNMENT = 0.85
"""Cosine between the path and the direction to a covered particle. Geometry: between 1, right
behind, and 0.71, the diagonal."""


def vapor_speed(T, R_s, is_effusion):
    """Speed of the vapor at surface temperature T [m/s].

    Args:
        T: [K]. R_s: gas constant of the vapor [J/(kg K)]. is_effusion: 1 for sqrt(R_s T / (2 pi)),
            0 for the mean normal velocity sqrt(2 R_s T / pi) [Alshaer2017, eq. (6)].
    """
    if is_effusion > 0.0:
        return effusion_velocity(T, R_s)
    return mean_normal_velocity(T, R_s)


def covers_neighbor(x_ij, r_ij, v_i, lift_i, kind_j, exposed_j, distance, alignment):
    """1 for a neighbor that a leaving particle still covers, else 0.

    That is an interior particle behind it in the direction of its path, in the layer next to its
    former place, which is not exposed.

    Args:
        x_ij: x_i - x_j [m]. v: velocity [m/s]. lift, distance: moved, and to the next layer [m].
    """
    # distance along the path to the neighbor, and that from the former place of i
    behind = dot(x_ij, v_i) / max(norm(v_i), 1e-30)
    is_near = behind > alignment * r_ij and behind - lift_i < distance
    if is_near and kind_j == INTERIOR and exposed_j == 0.0:
        return 1.0
    return 0.0


def advance_lift(lift, kind, v, step):
    """Distance that a leaving particle has moved after a step [m]; others keep theirs."""
    return lift + norm(v) * step if kind == LEAVING else lift


def published_departure(
    kind, lift, covered, exposed, T, normal, v, T_v, R_s, is_effusion, distance
):
    """Kind and velocity [m/s] after a step, by the published rule.

    An exposed particle above T_v starts to leave along the normal; the speed of a leaving one
    follows its temperature until it has left, and stays from then on.

    Args:
        lift: distance moved [m]. covered: how many particles it covers. exposed: 1 at the surface.
        distance: at which it has left [m]; negative where it has left when it covers none.
    """
    # starts to leave
    if kind == INTERIOR and exposed > 0.0 and T_v <= T:
        return LEAVING, vapor_speed(T, R_s, is_effusion) * normal
    if kind != LEAVING:
        return kind, v
    # goes on in its direction with the speed of its temperature
    velocity = vapor_speed(T, R_s, is_effusion) / max(norm(v), 1e-30) * v
    # has left: either nothing is covered any more, or the distance is passed
    if (distance < 0.0 and covered == 0.0) or (distance >= 0.0 and lift >= distance):
        return EJECTED, velocity
    return LEAVING, velocity


def enthalpy_departure(kind, h, m, light, exposed, T, normal, v, h_v, R_s, is_effusion, up):
    """Kind, velocity [m/s], enthalpy [J/kg] and excess [J] after a step, by the enthalpy rule.

    A particle that lies at the surface, or in the light, leaves when its enthalpy has reached h_v.
    What a step has brought beyond that, m (h - h_v), is the excess: it belongs to what lies below.
    It takes h_v along, v^2 / 2 of it as kinetic energy.

    Args:
        h: specific enthalpy [J/kg]. m: mass [kg]. light: that it absorbed in the step [J]. h_v:
            enthalpy of the vapor [J/kg]. up: where it goes if it lies in the light without being
            exposed, at the bottom of a hole, and so has no normal.
    """
    if kind == INTERIOR and h >= h_v and (exposed > 0.0 or light > 0.0):
        # leaves along its normal; m (h - h_v) stays with what lies below
        direction = normal if dot(normal, normal) > 0.0 else up + 0.0 * normal
        velocity = vapor_speed(T, R_s, is_effusion) * direction
        return EJECTED, velocity, h_v - 0.5 * dot(velocity, velocity), m * (h - h_v)
    return kind, v, h, 0.0


def ejected_quantities(kind, left_at, p_v, T, m, h, v, time, p_b, T_b, L_b, T_c, R_s):
    """Quantities that a particle takes along in the step in which it leaves.

    Returns the time of leaving [s], the saturation pressure [Pa], and, zero for the others,
    1, its mass [kg], enthalpy m h and kinetic energy m v^2 / 2 [J].

    Args:
        left_at: 0 as long as it has not been written [s]. m: mass [kg]. h: [J/kg]. v: [m/s].
            time: end of the step [s]. p_b, T_b, L_b, T_c, R_s: `evaporation.vapor_constants`.
    """
    # written once, in the step in which it left
    if kind == EJECTED and left_at == 0.0:
        p = saturation_pressure(T, p_b, T_b, L_b, T_c, R_s)
        return time, p, 1.0, m, m * h, 0.5 * m * dot(v, v)
    return left_at, p_v, 0.0, 0.0, 0.0, 0.0


def ejection_step_limit(share, density, spacing, h_v, flux):
    """Time step [s] in which a surface particle takes up a share of the enthalpy of the vapor.

    Longer steps would carry away more energy than evaporation takes:  share rho dx h_v / q.

    Args:
        density: [kg/m^3]. spacing: [m]. h_v: [J/kg]. flux: largest absorbed flux [W/m^2].
    """
    return share * density * spacing * h_v / flux
