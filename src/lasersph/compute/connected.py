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
def loop(frame):
    words = at_uint64(frame)
    first, is_filled = at_int64(words[0]), at_uint8(words[1])
    columns, lines = np.int64(words[2]), np.int64(words[3])
    x_wraps, z_wraps = words[4] > 0, words[5] > 0
    turn, changed = 0, True
    while changed:
        changed = False
        for n in range(columns * lines):
            k = n if turn % 2 == 0 else columns * lines - 1 - n
            if is_filled[k]:
                c, m, least = k // lines, k % lines, first[k]
                for i in range(c - 1, c + 2):
                    if not x_wraps and (i < 0 or i >= columns):
                        continue
                    for j in range(m - 1, m + 2):
                        if not z_wraps and (j < 0 or j >= lines):
                            continue
                        other = (i + columns) % columns * lines + (j + lines) % lines
                        if is_filled[other]:
                            least = min(least, first[other])
                if least < first[k]:
                    first[k], changed = least, True
        turn += 1
"""
"""Each cell takes the smallest number around it, forward and backward in turn, until none does."""


def first_connected(is_filled: np.ndarray, wraps: tuple[bool, bool]) -> np.ndarray:
    """Smallest number of a cell connected with each one, its own where that is empty, (cells,).

    Args:
        is_filled: (columns, lines) bool; cells are numbered line after line within a column.
        wraps: whether the last column touches the first, and the last line the first.
    """
    first, marks = np.arange(is_filled.size), is_filled.ravel().astype(np.uint8)
    frame = array("Q", [address(first), address(marks), *is_filled.shape, *wraps])
    _connect()(frame.buffer_info()[0])
    return first


@cache
def _connect() -> Callable[[int], None]:
    """Foreign function of the address of a frame."""
    text = NATIVE.format(precision="float64") + _TEXT
    return ctypes.PYFUNCTYPE(None, ctypes.c_uint64)(folder.entry(text, is_fast=False))
