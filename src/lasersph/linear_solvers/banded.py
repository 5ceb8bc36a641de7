"""Cholesky factors of a sparse symmetric matrix that is positive, in a narrow band.

Unknowns are numbered anew so that those that share an entry stand near each other [Cuthill1969].
On a grid of m columns some sqrt(m) wide, with differences that reach four columns far, the band is
some 4 sqrt(m) wide, and its factors take 16 m^2 products in dense blocks: less time than a sparse
factorization needs up to more columns than pools have (`benchmarks/test_surface_factors.py`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:  # SciPy's matrices take a tenth of a second to load, and few runs need them
    from scipy.sparse import csr_matrix

Array = NDArray[np.float64]
SHIFT = 1e-14
"""Added to the diagonal over its largest entry. Rounding: so that no pivot becomes negative; what
that changes, refinement takes back."""


class BandedFactors(NamedTuple):
    """L of A = L L^T.

    Attributes:
        order: (n,) numbers of the unknowns in the band. lower: (width + 1, n) diagonals of L.
    """

    order: NDArray[np.int64]
    lower: Array

    def solve(self, b: Array) -> Array:
        """x (n,) with A x = b."""
        from scipy.linalg import cho_solve_banded

        x = np.empty_like(b)
        x[self.order] = cho_solve_banded((self.lower, True), b[self.order], check_finite=False)
        return x


def factorize(A: csr_matrix) -> BandedFactors:
    """Factors of a symmetric matrix (n, n), but for `SHIFT` on its diagonal."""
    from scipy.linalg import cholesky_banded
    from scipy.sparse.csgraph import reverse_cuthill_mckee

    # places of the unknowns in the band
    order = reverse_cuthill_mckee(A, symmetric_mode=True)
    place = np.empty(order.size, np.int64)
    place[order] = np.arange(order.size)

    # diagonals of the lower triangle, one below the other
    entries = A.tocoo()
    row, column = place[entries.row], place[entries.col]
    is_lower = row >= column
    below, column = (row - column)[is_lower], column[is_lower]
    diagonals = np.zeros((order.size, below.max() + 1)).T  # columns one after the other, for LAPACK
    diagonals[below, column] = entries.data[is_lower]
    diagonals[0] += SHIFT * diagonals[0].max()
    factors = cholesky_banded(diagonals, overwrite_ab=True, lower=True, check_finite=False)
    return BandedFactors(order, factors)
