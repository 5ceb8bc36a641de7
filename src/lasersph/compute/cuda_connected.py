"""Kernels of the graphics card that find connected cells of a grid; see `connected`.

Every filled cell points to one with a smaller number, or to itself; cells that touch are joined by
letting the larger of their roots point to the smaller one, until nothing is left to join. Whatever
the order in which threads do so, the root is the smallest number of the part. [Komura2015]
"""

# pyright: reportAttributeAccessIssue=false, reportCallIssue=false, reportArgumentType=false
# Numba's package says little about the types of what kernels may call.

from __future__ import annotations

import numpy as np
from numba import cuda


@cuda.jit(device=True)
def root(parent, k):
    """Where the way from cell k ends."""
    while np.uint64(parent[k]) != k:
        k = np.uint64(parent[k])
    return k


@cuda.jit(device=True)
def join(parent, k, other):
    """Give two cells one root, the smaller of theirs."""
    small, large = root(parent, k), root(parent, other)
    while small != large:
        if small > large:
            small, large = large, small
        seen = np.uint64(cuda.atomic.cas(parent, large, np.uint32(large), np.uint32(small)))
        if seen == large:
            return
        # another thread has given it a parent meanwhile
        small, large = root(parent, small), root(parent, seen)


@cuda.jit(cache=True)
def join_touching(count, filled, columns, lines, x_wraps, z_wraps, parent):
    """Join each filled cell with those of the next line and of the next column."""
    k, step = np.uint64(cuda.grid(1)), np.uint64(cuda.gridsize(1))
    while k < count:
        if filled[k]:
            number = np.int64(k)
            for n in range(4):
                c = number // lines + (0 if n == 0 else 1)
                m = number % lines + (1 if n == 0 else n - 2)
                is_around = 0
                if x_wraps and c == columns:
                    c = 0
                    is_around += 1
                if z_wraps and (m == lines or m < 0):
                    m = m % lines
                    is_around += 1
                if is_around < 2 and c < columns and m >= 0 and m < lines:
                    other = np.uint64(c * lines + m)
                    if filled[other]:
                        join(parent, k, other)
        k += step


@cuda.jit(cache=True)
def shorten(count, parent):
    """Let every cell point to its root."""
    k, step = np.uint64(cuda.grid(1)), np.uint64(cuda.gridsize(1))
    while k < count:
        parent[k] = np.uint32(root(parent, k))
        k += step
