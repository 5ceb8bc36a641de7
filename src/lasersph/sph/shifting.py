"""Shifting of particles off their streamlines, so that they neither cluster nor align.

    x~_i = x_i + C a R_i,    a = dt max|v|
    R_i = sum_j (r_i / r_ij)^2 n_ij,    r_i = 1/N_i sum_j r_ij         [Demuth2020, eq. (73)]

after [Xu2009]; n_ij points from j to i. On a lattice R is zero. A particle at a face is not moved
along its normal, whatever its neighbors are. C lies between 0.01 and 0.1.
"""

from __future__ import annotations

from lasersph.compute.vectors import dot, norm


def repulsion_terms(x_ij, r_ij, G_ij):
    """Terms of R: n_ij / r_ij^2 [1/m^2], the distance [m] and 1; nothing beyond the support.

    Args:
        G_ij: `correction.kernel_gradient`, which is 0 beyond the support alone.
    """
    inside = 1.0 if dot(G_ij, G_ij) > 0.0 else 0.0
    return inside / (r_ij * r_ij * r_ij) * x_ij, inside * r_ij, inside


def shift(total_0, total_1, total_2, is_fluid, at_face, normal, scale, limit):
    """Displacement C a R [m] of a fluid particle; at a face without the part along the normal.

    Args:
        total_0: sum of n_ij / r_ij^2 [1/m^2]. total_1, total_2: sum of the distances [m], count.
        is_fluid, at_face: 1 or 0. normal: of the face [1]. scale: C a [m]. limit: largest
            displacement [m].
    """
    # (73): R_i = r_i^2 sum_j n_ij / r_ij^2, r_i the mean distance
    mean = total_1 / max(total_2, 1.0)
    moved = is_fluid * scale * mean * mean * total_0
    # no displacement through a face
    along = at_face * dot(moved, normal)
    kept = moved - along * normal
    size = norm(kept)
    if size > limit:
        return limit / size * kept
    return 1.0 * kept
