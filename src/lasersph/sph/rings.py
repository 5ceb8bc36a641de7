"""Pairs of rings in a section (r, z): operators of a body of revolution, summed over its plane.

    div(k grad T)       2 pi r_ij g_ij (T_j - T_i)
    (div grad v)_r      2 pi r_ij g_ij r_ij^2/r_i (u_j/r_j - u_i/r_i),      r_ij = (r_i + r_j)/2
    div v               sum_j r_ij/r_i (v_i + v_j) . C G_ij

The radial one is (1/r^2) d/dr (r^3 d(u/r)/dr), the Laplacian and the hoop stress -u/r^2 in one:
0 for u = a r whatever the particles do, and symmetric. Taken apart they leave 0.1 to 0.4 of u/r^2
beside the axis. So that no pair divides, r_ij^2/(r_i r_j) (u_j - u_i) is summed in every iteration,
and what that leaves of u_i once in a step. No pair reaches across the axis, through which nothing
flows. The divergence is the flow through the mean rings of pairs, as conduction is: so beside the
axis both are off by the same 5 and 2 % of the first columns, and a pressure undoes what it should.
With u_i/r_i beside the divergence of the plane, which no kernel smooths, pressure and u/r in the
first four columns differ from those beside them by several times.
"""

from __future__ import annotations

from math import pi

from lasersph.compute.vectors import dot, matvec, vector
from lasersph.particles.extended_lattice import GHOSTS

TURN = 2.0 * pi
"""Length of a ring over its distance from the axis. Geometry: a whole turn."""
REACH = GHOSTS
"""Layers above and below one with which its rings are evened. Geometry: supports reach no
further."""
STEPS = 2 * REACH + 1
"""Additions of a ring. Geometry: one for each of these layers, and its own."""


def ring_weight(g_ij, measure_i, measure_j):
    """Weight of two rings, g_ij times their mean length [m^(d-1)], symmetric and not negative.

    2 pi r of the flow (1/r) d(r dT/dr)/dr is that of the middle between both: of second order in
    the spacing over r, so that the first columns beside the axis are the least exact.
    """
    return 0.5 * (measure_i + measure_j) * g_ij


def ring_weight_off_axis(g_ij, r_i, r_j):
    """`ring_weight`, and 0 toward the image of a particle beyond the axis, whose r counts as less
    than 0.

    Its place does not tell: across a steep surface the ghost of a particle near the axis may lie
    beyond that, and the particle itself sees the ghosts of others from where it is.
    """
    return ring_weight(g_ij, TURN * r_i, TURN * r_j) if r_j > 0.0 else 0.0 * g_ij


def evened_ring_weight(g_ij, layer_i, layer_j, ring_i, ring_j, has_none_j, additions, layers):
    """Weight of heat between two rings, g_ij (1 + b_i + b_j) with g_ij by `ring_weight`, see
    `even_rings`: symmetric, and not negative.

    Args:
        layer: number of the layer, negative above the surface. ring: number of the ring, of a dummy
            that of its source. has_none: 1 for dummies without b. additions: table of b, ring after
            ring. layers: how many there are.
    """
    steps = int(layer_j - layer_i)
    if steps < -REACH or steps > REACH:
        return 1.0 * g_ij
    b_i = additions[int(ring_i) * STEPS + REACH + steps]
    # seen from a mirrored layer up is down
    back = steps if layer_j < 0.0 or layer_j >= layers else -steps
    b_j = additions[int(ring_j) * STEPS + REACH + back]
    return g_ij * max(1.0 + b_i + (1.0 - has_none_j) * b_j, 0.0)


def ring_pair(g_ij, r_i, r_j, c_i, c_j):
    """Values of a pair of rings: its weight twice, of flow and of heat, `mean_share`, which is 0
    toward the image of a particle beyond the axis, and `hoop_share`."""
    g = ring_weight_off_axis(g_ij, r_i, r_j)
    share = mean_share(r_i, r_j, c_i) if r_j > 0.0 else 0.0 * g
    return g, g, share, hoop_share(r_i, r_j, c_i, c_j)


def mean_share(r_i, r_j, c_i):
    """r_ij/r_i: the mean ring over that of i [1].

    Args:
        r: distance from the axis [m]. c: 1/r, so that no pair divides [1/m].
    """
    return 0.5 * (r_i + r_j) * c_i


def hoop_share(r_i, r_j, c_i, c_j):
    """r_ij^2/(r_i r_j): what u_j/r_j counts for times r_i [1]; arguments of `mean_share`."""
    middle = 0.5 * (r_i + r_j)
    return middle * middle * (c_i * c_j)


def ring_momentum(g_ij, v_i, v_j, hoop_ij):
    """Viscous force over eta that a pair of rings passes on [m^2/s]; `ring_resistance` has what the
    hoop stress takes beside it.

    Args:
        g: by `ring_weight`. v: velocity, radial first [m/s]. hoop: `hoop_share`.
    """
    return g_ij * vector(hoop_ij * (v_j[0] - v_i[0]), v_j[1] - v_i[1])


def ring_resistance(g_ij, mean_ij, hoop_ij):
    """K: share of u_i that the hoop stress takes beside `ring_momentum` [m],
    r_ij^2 (1/r_i^2 - 1/(r_i r_j)), by `mean_share` and `hoop_share`."""
    return g_ij * (mean_ij * mean_ij - hoop_ij)


def ring_diagonal(g_ij, mean_ij):
    """Share of v_i that both take, by component: diagonal of their matrix [m]."""
    return g_ij * vector(mean_ij * mean_ij, 1.0)


def ring_divergence_term(v_i, v_j, C_i, G_ij, mean_ij):
    """Term of the divergence of a velocity [1/s]: r_ij/r_i (v_i + v_j) . C G_ij, 0 across the axis.

    Its part v_i . C G_ij counts along r alone: across it sums up to nothing where particles are
    even, and to an error where they are not.
    """
    gradient = matvec(C_i, G_ij)
    return mean_ij * (dot(v_j - v_i, gradient) + 2.0 * v_i[0] * gradient[0])
