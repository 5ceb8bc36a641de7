"""Factors of the smoothed surface of a round pool in 3-D: banded ones beside those of a sparse LU.

They are made anew, four times, whenever the rim of a pool moves. Columns of 48 nm, a quarter of the
pool. Run: OPENBLAS_NUM_THREADS=1 pytest benchmarks/test_surface_factors.py -s
"""

import numpy as np
import pytest
from scipy.sparse.linalg import splu
from setting import fastest

from lasersph.linear_solvers.banded import factorize
from lasersph.surface.height_field import HeightField, cutoff_of
from lasersph.surface.pool_field import EVEN_PARITIES, PoolField

WIDTH = 48e-9
MIRROR = ("mirror", "mirror")


@pytest.mark.parametrize("radius", [21, 45, 140])
def test_banded_factors_are_faster(radius):
    """Pools of some 350, 1600 and 15 400 columns."""
    shape = (radius + 20, radius + 20)
    grid = HeightField((0.0, 0.0), (WIDTH, WIDTH), shape, (MIRROR, MIRROR), cutoff_of(WIDTH))
    x, y = grid.places
    pool = PoolField(grid, np.flatnonzero((np.hypot(x, y) < radius * WIDTH).ravel()))
    A = pool._matrices(EVEN_PARITIES, passes_pins=True).A
    columns = A.tocsc()

    def sparse():
        options = {"SymmetricMode": True}
        return splu(columns, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)

    banded, other = fastest(lambda: factorize(A), sparse, rounds=5)
    print(
        f"{A.indptr.size - 1} columns: {1e3 * banded:.2f} ms banded, {1e3 * other:.2f} ms sparse, "
        f"{other / banded:.1f} times"
    )
    assert banded < other
