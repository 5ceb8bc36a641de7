"""Shifting of particles off their streamlines, so that they neither cluster nor align.

    x~_i = x_i + C a R_i,    a = dt max|v|
    R_i = sum_j (r_i / r_ij)^2 n_ij,    r_i = 1/N_i sum_j r_ij         [Demuth2020, eq. (73)]

after [Xu2009]; n_ij points from j to i. On a lattice R is zero. C lies between 0.01 and 0.1.

No particle in the first row at a face is moved along its normal: at a flat surface, and at a wall
along which nothing slips. Its own image pushes it away; the flow brings it back, each time with the
velocity from farther out, so that less of a lid is felt. In the cavity at Re 400 with 50 a side the
extrema of the speeds are 4.5 to 6.4 % too small with such shifts, 2.3 to 4.1 % without (1.4 to 3.7
where none is made within a support of a wall, but particles lie less evenly there, and the heat
that a box carries errs more). Only a particle with another close to it is moved all the same, so
that no two meet.
"""

from __future__ import annotations

from lasersph.compute.vectors import dot, norm, vector


def repulsion_terms(x_ij, r_ij, G_ij):
    """Terms of R: n_ij / r_ij^2 [1/m^2], the distance [m] and 1; nothing beyond the support.

    Args:
        G_ij: `correction.kernel_gradient`, which is 0 beyond the support alone.
    """
    inside = 1.0 if dot(G_ij, G_ij) > 0.0 else 0.0
    return inside / (r_ij * r_ij * r_ij) * x_ij, inside * r_ij, inside


def shift(
    total_0, total_1, total_2, is_fluid, at_surface, position, low, high, close_push, scale, limit
):
    """Displacement C a R [m] of a fluid particle; at a face without the part along the normal.

    Args:
        total_0: sum of n_ij / r_ij^2 [1/m^2]. total_1, total_2: sum of the distances [m], count.
        is_fluid, at_surface: 1 or 0. low, high: places between which a particle is at no wall [m].
            close_push: size of total_0 from which a particle at a wall is moved nonetheless
            [1/m^2]. scale: C a [m]. limit: largest displacement [m].
    """
    # (73): R_i = r_i^2 sum_j n_ij / r_ij^2, r_i the mean distance
    mean = total_1 / max(total_2, 1.0)
    moved = is_fluid * scale * mean * mean * total_0
    # no displacement across a face: a wall, unless others are close, and a flat surface
    kept = moved
    if norm(total_0) < close_push:
        kept = vector(
            *(moved[k] if low[k] < position[k] < high[k] else 0.0 for k in range(len(moved)))
        )
    if at_surface > 0.0:
        kept = vector(*(kept[k] if k + 1 < len(kept) else 0.0 for k in range(len(kept))))
    size = norm(kept)
    if size > limit:
        return limit / size * kept
    return 1.0 * kept
