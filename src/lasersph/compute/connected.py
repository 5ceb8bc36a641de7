"""Connected cells of a grid, on the host: which touch, by sides or corners, also around ends."""

from __future__ import annotations

import ctypes
from array import array
from collections.abc import Callable
from functools import cache

import numpy as np

from lasersph.compute import cache as folder
from lasersph.compute.arguments import address
from lasersph.compute.generate import NATIVE

_TEXT = """
@njit
def around(k, count, wraps):
    if 0 <= k < count:
        return k
    if not wraps:
        return -1
    return k + count if k < 0 else k - count


def loop(frame):
    words = at_uint64(frame)
    first, filled = at_uint32(words[0]), at_uint32(words[1])
    columns, lines = np.int64(words[2]), np.int64(words[3])
    x_wraps, z_wraps = words[4] > 0, words[5] > 0
    for n in range(columns * lines):
        first[n] = np.uint32(n)
    turn, changed = 0, True
    while changed:
        changed = False
        for n in range(columns * lines):
            k = n if turn % 2 == 0 else columns * lines - 1 - n
            if filled[k] > 0:
                c, m, least = k // lines, k % lines, first[k]
                for i in range(c - 1, c + 2):
                    column = around(i, columns, x_wraps)
                    if column < 0:
                        continue
                    for j in range(m - 1, m + 2):
                        line = around(j, lines, z_wraps)
                        other = column * lines + line
                        if line >= 0 and filled[other] > 0:
                            least = min(least, first[other])
                if least < first[k]:
                    first[k], changed = least, True
        turn += 1
"""
"""Each cell takes the smallest number around it, forward and backward in turn, until none does."""


def first_connected(
    filled: np.ndarray, columns: int, lines: int, wraps: tuple[bool, bool]
) -> np.ndarray:
    """Smallest number of a cell connected with each one, its own where that is empty, (cells,).

    Args:
        filled: (columns lines,) uint32, not 0 where a cell is filled; cells are numbered line
            after line within a column.
        wraps: whether the last column touches the first, and the last line the first.
    """
    first = np.empty(columns * lines, np.uint32)
    frame = array("Q", [address(first), address(filled), columns, lines, *wraps])
    _connect()(frame.buffer_info()[0])
    return first


@cache
def _connect() -> Callable[[int], None]:
    """Foreign function of the address of a frame."""
    text = NATIVE.format(precision="float64") + _TEXT
    return ctypes.PYFUNCTYPE(None, ctypes.c_uint64)(folder.entry(text, is_fast=False))
