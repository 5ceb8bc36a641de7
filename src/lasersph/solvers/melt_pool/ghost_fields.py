"""Fields of the particles of a block and of their ghosts, from those of the particles.

A ghost has a source s and a type (`particles.ghosts`), and is its image in the planes between them:
in those of the faces, whose product is S = diag(sign) with the offset o, and, where the type
crosses a surface that moves (c = 1), before in the tangent with the normal n of the source,
H = I - 2 c n n^T. So

    position   S (x_s + c d_s) + o                  vector     S H a_s
    velocity   F (v_s + t j_s) + v_0                tensor     S H M_s H S
    pressure   p_s + 2 c (p_b - p_s)

with F = S but for the components that a wall turns around. Arguments of the particles are tables
that are read at the source, those that say what ghosts carry are tables that are read at the type;
a particle of the block is its own source and of type 0, where S = I and c = t = 0. So one loop
fills a field with ghosts, in any number of dimensions.
"""

from __future__ import annotations

from lasersph.compute.vectors import dot, outer
from lasersph.particles.reflection import reflected, reflected_tensor


def ghost_position(source, ghost_type, x, shift, crosses_surface, sign, offset):
    """Place [m]: that of the source, shifted across the tangent by d_s, then S x + o."""
    image = x[source] + crosses_surface[ghost_type] * shift[source]
    return sign[ghost_type] * image + offset[ghost_type]


def unfolded_place(source, ghost_type, place, x, sign):
    """Place [m] with that of the source along the axes that are mirrored: where what crosses planes
    comes back."""
    far, near = place, x[source]
    return 0.5 * (far + near + sign[ghost_type] * (far - near))


def ghost_vector(source, ghost_type, a, normal, crosses_surface, sign):
    """Vector of the source as the planes between mirror it, S H a."""
    return sign[ghost_type] * reflected(a[source], normal[source], crosses_surface[ghost_type])


def ghost_tensor(source, ghost_type, M, normal, crosses_surface, sign):
    """Tensor of the source as the planes between mirror it, S H M H S with S diagonal."""
    S = sign[ghost_type]
    return outer(S, S) * reflected_tensor(M[source], normal[source], crosses_surface[ghost_type])


def ghost_velocity(source, ghost_type, v, jump, stressed, factor, added):
    """Velocity [m/s]: that of the source, carried on beyond a stressed surface, then F v + v_0.

    Args:
        jump: what the surface makes a ghost faster than its source [m/s], a vector. stressed: 1
            where the surface lies between. factor: diagonal of F. added: v_0 of a wall that moves
            [m/s].
    """
    carried_on = v[source] + stressed[ghost_type] * jump[source]
    return factor[ghost_type] * carried_on + added[ghost_type]


def velocity_change(source, ghost_type, d, factor):
    """F d of the source: what remains of its velocity where walls rest and no stress acts [m/s]."""
    return factor[ghost_type] * d[source]


def ghost_pressure(source, ghost_type, p, p_b, crosses_surface):
    """Pressure [Pa]: that of the source, beyond the surface carried on through p_b there."""
    return p[source] + 2.0 * crosses_surface[ghost_type] * (p_b[source] - p[source])


def velocity_at_wall(source, ghost_type, place, v, m, b, along, normal, plane, nu):
    """Velocity of a ghost beyond a wall [m/s], bent by the force there: v - d^2/nu b (`flow`).

    Args:
        place: of the ghost [m]. m: relative viscosity of the source [1], nu: what that counts
            from [m^2/s]. b: [m/s^2]. along: 1 for the components along a wall, -1 for those that a
            plane of symmetry beside it turns around. normal, plane: of that, and its place along
            the normal [m].
    """
    d = dot(place, normal[ghost_type]) - plane[ghost_type]
    return v - along[ghost_type] * (d * d / (nu * m[source])) * b[source]


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


def ghost_walls(ghost_type, dirichlet, flux, plane, T_w, P_w, wall_enthalpy, normal):
    """Rules of the face that lies between, for `wall_terms` and `range_enthalpy`."""
    return (
        dirichlet[ghost_type],
        flux[ghost_type],
        plane[ghost_type],
        T_w[ghost_type],
        P_w[ghost_type],
        wall_enthalpy[ghost_type],
        1.0 * normal[ghost_type],
    )


def tangent_plane(
    source,
    ghost_type,
    place,
    normal,
    plane,
    surface_normal,
    distance,
    sign,
    crosses_surface,
    heat_face,
    surface,
):
    """Normal and place of the face between a ghost and its source for heat: of the surface where
    that is what lies between, else as they were."""
    if crosses_surface[ghost_type] <= 0.0 or heat_face[ghost_type] != surface:
        return 1.0 * normal, plane
    n = sign[ghost_type] * surface_normal[source]
    return n, dot(place, n) - distance[source]
