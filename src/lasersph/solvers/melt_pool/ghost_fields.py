"""Fields of the particles of a block and of their ghosts, from those of the particles.

A ghost has a source and a type (`particles.ghosts`). Arguments of the particles are tables that are
read at the source, those that say what ghosts carry are tables that are read at the type; a
particle of the block is its own source and of type 0. So one loop fills a field with ghosts.
"""

from __future__ import annotations

from lasersph.boundaries.surface_loops import reflected
from lasersph.compute.vectors import dot, identity, matmul, outer, vector


def ghost_position(source, ghost_type, x, z, sign_x, sign_z, offset_x, offset_z):
    """Place [m]: sign times that of the source, and an offset."""
    return vector(
        sign_x[ghost_type] * x[source] + offset_x[ghost_type],
        sign_z[ghost_type] * z[source] + offset_z[ghost_type],
    )


def position_across(
    source, ghost_type, x, z, shift_x, shift_z, sign_x, sign_z, offset_x, offset_z, across
):
    """`ghost_position` of the source, shifted across the tangent of the surface if so."""
    a = across[ghost_type]
    return vector(
        sign_x[ghost_type] * (x[source] + a * shift_x[source]) + offset_x[ghost_type],
        sign_z[ghost_type] * (z[source] + a * shift_z[source]) + offset_z[ghost_type],
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


def ghost_faces(ghost_type, wall_x, wall_z, heat_face):
    """Faces across x and across z beyond which a ghost lies, and that across which heat flows."""
    return wall_x[ghost_type], wall_z[ghost_type], heat_face[ghost_type]


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


def velocity_across(
    source,
    ghost_type,
    v_x,
    v_z,
    jump_x,
    jump_z,
    factor_x,
    factor_z,
    added_x,
    added_z,
    across,
):
    """`ghost_velocity` where a jump (jump_x, jump_z) carries it on across a tangent [m/s]."""
    a = across[ghost_type]
    return vector(
        factor_x[ghost_type] * (v_x[source] + a * jump_x[source]) + added_x[ghost_type],
        factor_z[ghost_type] * (v_z[source] + a * jump_z[source]) + added_z[ghost_type],
    )


def velocity_at_wall(source, ghost_type, v, x, m, a_x, a_z, along_x, along_z, plane, step, nu):
    """Velocity of a ghost [m/s], with what the pressure does along a wall (`wall_pressure`).

    Args:
        x: place of the ghost [m]. m: relative viscosity of the source [1], nu: what that counts
            from [m^2/s]. a_x, a_z: grad p/rho [m/s^2]. along_x, along_z: 1 beyond a wall along that
            axis. plane: its place [m]. step: [s].
    """
    viscosity = nu * m[source]
    d_x, d_z = x[0] - plane[ghost_type], x[1] - plane[ghost_type]
    return vector(
        v[0] + along_x[ghost_type] * (2.0 * step + d_z * d_z / viscosity) * a_x[source],
        v[1] + along_z[ghost_type] * (2.0 * step + d_x * d_x / viscosity) * a_z[source],
    )


def mirrored_vector(source, ghost_type, v_x, v_z, sign_x, sign_z):
    """A vector of the source as the faces between mirror it."""
    return vector(sign_x[ghost_type] * v_x[source], sign_z[ghost_type] * v_z[source])


def vector_across(source, ghost_type, v_x, v_z, n_x, n_z, sign_x, sign_z, across):
    """`mirrored_vector` where the surface's tangent is one of the mirrors."""
    n = vector(n_x[source], n_z[source])
    v = reflected(vector(v_x[source], v_z[source]), n, across[ghost_type])
    return vector(sign_x[ghost_type] * v[0], sign_z[ghost_type] * v[1])


def tangent_plane(
    source, ghost_type, x, normal, plane, n_x, n_z, distance, sign_x, across, heat_face, surface
):
    """Normal and place of the face between a ghost and its source for heat: of the surface where
    that is what lies between, else as they were."""
    if across[ghost_type] <= 0.0 or heat_face[ghost_type] != surface:
        return 1.0 * normal, plane
    n = vector(sign_x[ghost_type] * n_x[source], n_z[source])
    return n, dot(x, n) - distance[source]


def pressure_across(source, ghost_type, p, p_b, across):
    """Pressure [Pa]: that of the source, beyond the surface carried on through p_b there."""
    return p[source] + 2.0 * across[ghost_type] * (p_b[source] - p[source])


def velocity_change(source, ghost_type, d_x, d_z, factor_x, factor_z):
    """S d of the source: what remains of its velocity where walls rest and no stress acts [m/s]."""
    return vector(factor_x[ghost_type] * d_x[source], factor_z[ghost_type] * d_z[source])


def ghost_tensor(M, sign):
    """Tensor of a ghost, S M S with the signs on the diagonal of S."""
    return outer(sign, sign) * M


def tensor_across(source, ghost_type, M_xx, M_xz, M_zx, M_zz, n_x, n_z, sign_x, sign_z, across):
    """`extended_tensor` where the surface's tangent is one of the mirrors."""
    M = outer(vector(1.0, 0.0), vector(M_xx[source], M_xz[source])) + outer(
        vector(0.0, 1.0), vector(M_zx[source], M_zz[source])
    )
    n = vector(n_x[source], n_z[source])
    mirror = identity(2) - 2.0 * across[ghost_type] * outer(n, n)
    seen = matmul(mirror, matmul(M, mirror))
    return ghost_tensor(seen, vector(sign_x[ghost_type], sign_z[ghost_type]))


def extended_tensor(source, ghost_type, M_xx, M_xz, M_zx, M_zz, sign_x, sign_z):
    """`ghost_tensor` of the source's tensor."""
    M = outer(vector(1.0, 0.0), vector(M_xx[source], M_xz[source])) + outer(
        vector(0.0, 1.0), vector(M_zx[source], M_zz[source])
    )
    return ghost_tensor(M, vector(sign_x[ghost_type], sign_z[ghost_type]))
