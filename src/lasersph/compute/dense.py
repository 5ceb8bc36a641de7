"""Inverse of a small dense matrix, the same bits on any machine and for any number of threads."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.array_function import array_function

_TEXT = '''
@njit(fastmath=False, error_model="numpy")
def eliminate(_, A, kept, least):
    """Gauss and Jordan's elimination, without liberties in the order of operations."""
    n = np.uint64(A.shape[0])
    for k in range(n):
        # leave out the row of a pivot that vanishes
        pivot = A[k, k]
        if pivot <= least[0]:
            kept[k] = 0
            continue
        # divide the row by its pivot, and take it from all others
        A[k, k] = 1.0
        for j in range(n):
            A[k, j] /= pivot
        for i in range(n):
            if i != k:
                factor = A[i, k]
                A[i, k] = 0.0
                for j in range(n):
                    A[i, j] -= factor * A[k, j]
'''


def invert(A: NDArray[np.float64], least: float = 0.0) -> NDArray[np.float64]:
    """Inverse of a symmetric matrix that is not negative, which it overwrites.

    Gauss and Jordan's elimination, stable without exchange for such matrices. Rows and columns of
    pivots that are not above `least` are left out, and 0 in the inverse.
    """
    kept = np.ones(A.shape[0], np.uint8)
    array_function(_TEXT, "eliminate")(A, kept, np.array([least]))
    left_out = kept == 0
    A[left_out] = 0.0
    A[:, left_out] = 0.0
    return A
