"""Additions to the weights of rings with which they conduct along z as a plane does.

    w_ij = 2 pi r_ij g_ij (1 + b_i^m + b_j^-m)

with b_i^m of ring i toward the m-th layer below its own, such that for each of both

    sum over the rings j of that layer of w_ij = 2 pi r_i dr_i G_m

where G_m is what two layers of a plane give each other per area [`second_moment.layer_exchange`].
Then a temperature that depends on z alone changes as in a plane, from the axis to the side: there
the rings are missing whose mean with the inner ones would be r_i, and where layers of other columns
begin, columns see different numbers of them. Within a layer, where such a temperature is constant,
b = 0, so that along r alone nothing changes; w_ij = w_ji, and heat is kept.

The b of each two layers solve a symmetric system of their own, D b + W b' = 2 pi r dr G - D, with D
the sum of each row of W. Where all rings of one layer may give to those of the other it is singular
by b -> b + c, b' -> b' - c, which leaves w as it is; both sides have the same sum. Layers so far
apart that not all columns of one see the other have no solution, or none with weights that are
positive and not far from what they were; their pairs stay as they are. Dummies beyond faces of
given temperature and coarse columns beside the fine ones have no b.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lasersph.sph.rings import REACH, STEPS

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix

Array = NDArray[np.float64]
Numbers = NDArray[np.int64]
ACCURACY = 1e-12
"""Residual over the sum of a row, as a root mean square, at which additions are solved for.
Rounding: some thousand times that of a sum."""
LARGEST_COUNT = 500
"""Iterations, after which additions have no solution. Guard: twice those of layers graded by 0.5 to
0.95 that have one."""
LOST = 1e8
"""Squared residual over the first one from which a system has no solution. Guard: that of one with
a solution may rise by some hundreds before it falls."""
FLAT = 1e-13
"""Curvature along a direction over its square below which it is none. Rounding: some hundred times
that of a sum of positive and negative terms."""
LEAST = 1e-10
"""Smaller additions are none, so that rings far from the axis and from the side have none.
Accuracy: what a temperature that depends on z alone errs by."""
SMALLEST = 1e-300
"""Least divisor. Format: keeps 0 / 0 from systems without a residual."""
FACTORS = (0.1, 10.0)
"""Least and largest factor of a pair. Guard: a block of one column takes 2.2, the first two columns
beside the axis 0.93."""


@dataclass(frozen=True)
class RingPairs:
    """Pairs of rings on the host, each of shape (pairs,).

    Attributes:
        row, other: numbers of the rings i and j, -1 where j has no additions.
        steps, back: layers from i to j, and from j to i as j sees it. weight: 2 pi r_ij g_ij.
    """

    row: Numbers
    other: Numbers
    steps: Numbers
    back: Numbers
    weight: Array


def ring_additions(pairs: RingPairs, wanted: Array) -> Array:
    """(rings, STEPS) additions b [1] of rings toward the layers around their own, 0 in it.

    Args:
        wanted: (rings, STEPS) sums of the rows toward each layer, 0 where they stay as they are.
    """
    from scipy.sparse import csr_matrix  # only sections (r, z) need them
    from scipy.sparse.csgraph import connected_components

    # pairs within reach toward layers for which a sum is wanted, and D of each
    sums = wanted.ravel()
    near = np.flatnonzero((np.abs(pairs.steps) <= REACH) & (pairs.weight > 0.0))
    own = pairs.row[near] * STEPS + pairs.steps[near] + REACH
    near, own = near[sums[own] > 0.0], own[sums[own] > 0.0]
    weight = pairs.weight[near]
    total = np.bincount(own, weight, minlength=sums.size)
    unknown = np.flatnonzero(total > 0.0)

    # W between unknowns, scaled by the roots of D on both sides
    place = np.full(sums.size, -1)
    place[unknown] = np.arange(unknown.size)
    other = place[np.maximum(pairs.other[near], 0) * STEPS + pairs.back[near] + REACH]
    other = np.where(pairs.other[near] >= 0, other, -1)
    row, joins, root = place[own], other >= 0, np.sqrt(total[unknown])
    scaled = weight[joins] / (root[row[joins]] * root[other[joins]])
    shape = (unknown.size, unknown.size)
    matrix = csr_matrix((scaled, (row[joins], other[joins])), shape=shape)
    _, system = connected_components(matrix, directed=False)

    # (1 + W) x = (wanted - D) / root D,  b = x / root D
    load = (sums[unknown] - total[unknown]) / root
    scale = np.bincount(system, total[unknown]).astype(np.float64)
    x, is_solved = _solve(matrix, load, system, scale)
    b = x / root

    # systems without a solution, or with factors that are out of range
    factor = 1.0 + b[row] + np.where(joins, b[other], 0.0)
    is_far = (factor < FACTORS[0]) | (factor > FACTORS[1])
    is_solved[system[row[is_far]]] = False
    found = np.zeros(sums.size)
    found[unknown] = np.where(is_solved[system] & (np.abs(b) >= LEAST), b, 0.0)
    return found.reshape(wanted.shape)


def _solve(
    matrix: csr_matrix, load: Array, system: Numbers, scale: Array
) -> tuple[Array, NDArray[np.bool_]]:
    """Solution of (1 + W) x = load by conjugate gradients, of each system by itself, and which of
    them were solved.

    Sums are in the order of the unknowns, and so the same bits with any number of threads.

    Args:
        system: (n,) number of the system of each unknown. scale: of its squared residual.
    """

    def sums(a: Array, b: Array) -> Array:
        return np.bincount(system, a * b, minlength=scale.size).astype(np.float64)

    x, r, bound = np.zeros(load.size), load.copy(), ACCURACY**2 * scale
    p, square = r.copy(), sums(r, r)
    lost = LOST * square
    for _ in range(LARGEST_COUNT):
        # systems that are solved, and those without a solution, stay as they are
        goes_on = (square > bound) & (square <= lost)
        if not goes_on.any():
            break
        A_p = p + matrix @ p
        # along a direction that the matrix does not see there is nothing to be solved
        curvature = sums(p, A_p)
        is_flat = curvature <= FLAT * sums(p, p)
        goes_on, lost = goes_on & ~is_flat, np.where(goes_on & is_flat, 0.0, lost)
        step = np.where(goes_on, square / np.maximum(curvature, SMALLEST), 0.0)[system]
        x += step * p
        r -= step * A_p
        new = sums(r, r)
        share = np.where(goes_on, new / np.maximum(square, SMALLEST), 0.0)
        p, square = r + share[system] * p, new
    return x, square <= bound
