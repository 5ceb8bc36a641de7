"""Fields of the particles of a block and of their ghosts, from those of the particles.

A ghost has a source and a type (`particles.ghosts`). Arguments of the particles are tables that are
read at the source, those that say what ghosts carry are tables that are read at the type; a
particle of the block is its own source and of type 0. So one loop fills a field with ghosts.
"""

from __future__ import annotations

from lasersph.compute.vectors import outer, vector


def ghost_position(source, ghost_type, x, z, sign_x, sign_z, offset_x, offset_z):
    """Place [m]: sign times that of the source, and an offset."""
    return vector(
        sign_x[ghost_type] * x[source] + offset_x[ghost_type],
        sign_z[ghost_type] * z[source] + offset_z[ghost_type],
    )


def ghost_layers(
    source, ghost_type, V, support, radius, layer, normal, lateral, sign, layer_base, normal_base
):
    """Volume, support radius, search radius, number of the layer, and its factors N and a.

    Ghosts have base + sign * value of the number of a layer and of its running sum N.
    """
    flip = sign[ghost_type]
    return (
        V[source],
        support[source],
        radius[source],
        layer_base[ghost_type] + flip * layer[source],
        normal_base[ghost_type] + flip * normal[source],
        lateral[source],
    )


def ghost_walls(ghost_type, dirichlet, flux, plane, T_w, P_w, wall_enthalpy, normal_x, normal_z):
    """What `wall_terms` and `range_enthalpy` want to know of the face that lies between."""
    return (
        dirichlet[ghost_type],
        flux[ghost_type],
        plane[ghost_type],
        T_w[ghost_type],
        P_w[ghost_type],
        wall_enthalpy[ghost_type],
        vector(normal_x[ghost_type], normal_z[ghost_type]),
    )


def ghost_velocity(v, factor, added, slope, jump, along):
    """Velocity of a ghost [m/s]: S v + c, and the slope of a stressed surface.

    Args:
        jump: 2 d tau / eta of the source [m/s]. along: tangent of the surface.
    """
    return factor * v + added + slope * jump * along


def extended_velocity(
    source, ghost_type, v_x, v_z, jump, factor_x, factor_z, added_x, added_z, slope, along
):
    """`ghost_velocity` of the source's velocity (v_x, v_z)."""
    return ghost_velocity(
        vector(v_x[source], v_z[source]),
        vector(factor_x[ghost_type], factor_z[ghost_type]),
        vector(added_x[ghost_type], added_z[ghost_type]),
        slope[ghost_type],
        jump[source],
        along,
    )


def velocity_change(source, ghost_type, d_x, d_z, factor_x, factor_z):
    """S d of the source: what remains of its velocity where walls rest and no stress acts [m/s]."""
    return vector(factor_x[ghost_type] * d_x[source], factor_z[ghost_type] * d_z[source])


def ghost_tensor(M, sign):
    """Tensor of a ghost, S M S with the signs on the diagonal of S."""
    return outer(sign, sign) * M


def extended_tensor(source, ghost_type, M_xx, M_xz, M_zx, M_zz, sign_x, sign_z):
    """`ghost_tensor` of the source's tensor."""
    M = outer(vector(1.0, 0.0), vector(M_xx[source], M_xz[source])) + outer(
        vector(0.0, 1.0), vector(M_zx[source], M_zz[source])
    )
    return ghost_tensor(M, vector(sign_x[ghost_type], sign_z[ghost_type]))
