"""Inverse of a small dense matrix, the same bits on any machine and for any number of threads."""

from __future__ import annotations

import ctypes
from array import array
from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.typing import NDArray

from lasersph.compute import cache as folder
from lasersph.compute.arguments import address
from lasersph.compute.generate import NATIVE

_TEXT = """
def loop(frame):
    words = at_uint64(frame)
    n, A, kept = words[0], at_float64(words[1]), at_uint8(words[2])
    least = at_float64(words[3])[np.uint64(0)]
    for k in range(n):
        row = k * n
        pivot = A[row + k]
        if pivot <= least:
            kept[k] = 0
            continue
        A[row + k] = 1.0
        for j in range(n):
            A[row + j] /= pivot
        for i in range(n):
            if i != k:
                factor = A[i * n + k]
                A[i * n + k] = 0.0
                for j in range(n):
                    A[i * n + j] -= factor * A[row + j]
"""


def invert(A: NDArray[np.float64], least: float = 0.0) -> NDArray[np.float64]:
    """Inverse of a symmetric matrix that is not negative, which it overwrites.

    Gauss and Jordan's elimination, stable without exchange for such matrices. Rows and columns of
    pivots that are not above `least` are left out, and 0 in the inverse.
    """
    kept, limit = np.ones(A.shape[0], np.uint8), array("d", [least])
    frame = array("Q", [A.shape[0], address(A), address(kept), limit.buffer_info()[0]])
    _elimination()(frame.buffer_info()[0])
    left_out = kept == 0
    A[left_out] = 0.0
    A[:, left_out] = 0.0
    return A


@cache
def _elimination() -> Callable[[int], None]:
    """Foreign function of the address of a frame."""
    text = NATIVE.format(precision="float64") + _TEXT
    return ctypes.PYFUNCTYPE(None, ctypes.c_uint64)(folder.entry(text, is_fast=False))
