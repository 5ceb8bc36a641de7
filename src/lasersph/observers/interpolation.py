"""Fields between particles: moving least squares on host arrays, for lines, grids and walls.

At a place x the polynomial sum_k c_k p_k(x_j - x) is fitted to the closest particles,

    sum_j w_j [ f_j - sum_k c_k p_k(x_j - x) ]^2 -> min,   w_j = (1 - |x_j - x|^2 / R^2)^2,

so that c_0 is the value and c_1, c_2 (and c_3) are the slopes there. Fields of the polynomial's
degree are reproduced exactly, however disordered the particles, also at a wall or a surface half a
spacing beyond the last row, where the fit extrapolates (moving least squares: Lancaster and
Salkauskas, Math. Comp. 37 (1981) 141).
"""

from __future__ import annotations

from itertools import combinations_with_replacement

import numpy as np

NEIGHBORS = {(2, 1): 12, (2, 2): 21, (3, 1): 24, (3, 2): 50}
"""Particles taken for a fit, by dimension and degree: twice or more the unknowns, in all directions
also beside a wall."""
MARGIN = 1.01
"""Radius R over the distance of the farthest particle taken, whose weight thereby almost vanishes:
which of several equally far ones is taken does not matter."""
CONDITION = 1e-10
"""Directions in which the particles extend less than this part are left out of a fit."""


def local_fit(
    position: np.ndarray, values: np.ndarray, places: np.ndarray, *, degree: int = 1
) -> np.ndarray:
    """Value and slopes of fields at places.

    Args:
        position: (d, n) of the particles [m], d = 2 or 3.
        values: (n,) or (fields, n).
        places: (d, m) [m].
        degree: of the polynomial, 1 or 2.

    Returns:
        (1 + d, m) or (1 + d, fields, m): value, derivatives along x (and y) and z.
    """
    from scipy.spatial import KDTree

    fields = np.atleast_2d(values)
    # the closest particles of each place, by a tree
    dimension = position.shape[0]
    wanted = min(NEIGHBORS[dimension, degree], position.shape[1])
    distance, near = KDTree(position.T).query(places.T, k=wanted)
    distance, near = distance.reshape(-1, wanted), near.reshape(-1, wanted)

    # weights that vanish at the farthest one
    radius = MARGIN * np.maximum(distance[:, -1:], 1e-300)
    weight = (1.0 - (distance / radius) ** 2) ** 2

    # monomials of the offset over the radius, so that moments are of one size
    offset = (position[:, near] - places[:, :, None]) / radius
    basis = [np.ones_like(offset[0]), *offset]
    if degree == 2:
        basis += [a * b for a, b in combinations_with_replacement(offset, 2)]
    terms = np.stack(basis, axis=-1)

    # normal equations; what the particles do not span is left out by the pseudo-inverse
    weighted = terms * weight[:, :, None]
    moments = np.einsum("mka,mkb->mab", weighted, terms)
    sums = np.einsum("mka,fmk->maf", weighted, fields[:, near])
    found = np.linalg.pinv(moments, rcond=CONDITION, hermitian=True) @ sums
    # slopes in 1/m again
    slopes = found[:, 1 : 1 + dimension] / radius[:, :, None]
    result = np.concatenate([found[:, :1], slopes], axis=1).transpose(1, 2, 0)
    return result if np.ndim(values) == 2 else result[:, 0]


def interpolate(
    position: np.ndarray, values: np.ndarray, places: np.ndarray, *, degree: int = 1
) -> np.ndarray:
    """Fields at places: the first row of `local_fit`, (m,) or (fields, m)."""
    return local_fit(position, values, places, degree=degree)[0]
