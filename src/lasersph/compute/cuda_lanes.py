"""Threads of a graphics card that share a row, so that they read what lies side by side together.

A row of a pair list is some tens or hundred pairs, whose values lie one after the other. A thread
that goes through a row alone reads them from another line of memory than each of its neighbors;
`LANES` threads that take every so-many-th pair read one line at a time. Their sums are then added
in a fixed tree: each gets the same bits as the others.
"""

# pyright: reportAttributeAccessIssue=false, reportCallIssue=false, reportArgumentType=false
# Numba's package says little about what it holds.

from __future__ import annotations

import numpy as np
from numba import cuda

from lasersph.compute.cuda_device import IS_SIMULATED, THREADS

LANES = 2 if IS_SIMULATED else 8
"""Threads of a row, a power of two that divides the 32 of a warp: with eight double numbers, half a
line of memory, and few of them idle at the end of a row of some thirty pairs."""

if IS_SIMULATED:

    @cuda.jit(device=True)
    def other_lane(value, distance, lanes):
        """Value of the thread so far away in a row; the threads of a group are those of a row."""
        shared = cuda.shared.array(THREADS, np.float64)
        thread = cuda.threadIdx.x
        shared[thread] = value
        cuda.syncthreads()
        found = type(value)(shared[thread ^ distance])
        cuda.syncthreads()
        return found

else:

    @cuda.jit(device=True)
    def other_lane(value, distance, lanes):
        """Value of the thread so far away in a row, which this one waits for."""
        first = np.uint32(cuda.laneid) // np.uint32(lanes) * np.uint32(lanes)
        row = (np.uint32(1) << np.uint32(lanes)) - np.uint32(1)
        return cuda.shfl_xor_sync(row << first, value, distance)
