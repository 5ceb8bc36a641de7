"""Blocks of rows side by side: what a compiled loop calls to be run by several threads.

A loop that Numba parallelizes itself is compiled some four times over: as a function, as the body
of its parallel region, in the wrapper of that region and in the caller. Here it is compiled once,
for one block of rows. Called for several, it hands itself to Numba's threads, block by block, with
the arguments that it has been given (`dispatch_blocks`). Where the entry of Numba's threads is not
known, who calls it shares the blocks by Numba's own parallel loop (`invoke`, `cache.shared_text`).

Importing this starts Numba's threads, which also makes their entry known to the compiler.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import get_num_threads, njit, prange, types
from numba.extending import intrinsic

from lasersph.compute import native, numba_internals

get_num_threads()


@intrinsic
def dispatch_blocks(_context: Any) -> tuple:
    """Run the loop that calls this once for each of its blocks.

    For functions loop(begin, end, threads, ...) of three unsigned integers and anything else, with
    no result: for each b from `begin` to `end` loop(b, b + 1, threads, ...) runs on one of so many
    threads. An error that a block raises is raised when all are done.
    """
    return types.none(), numba_internals.hand_over


_ONE = np.uint64(1)
_invoke_block: Any = native.invoke


@njit(parallel=True)
def _invoke_blocks(address, begin, end, threads, count, frame):
    """Call the loop at an address for each of its blocks, a share of them on each thread."""
    for k in prange(np.int64(threads)):
        share = np.uint64(k)
        first = begin + (end - begin) * share // threads
        last = begin + (end - begin) * (share + _ONE) // threads
        for block in range(first, last):
            _invoke_block(address, block, block + _ONE, _ONE, count, frame)


@njit
def invoke(address, begin, end, threads, count, frame):
    """`native.invoke` for loops of one block, by `prange` where there are several."""
    if end - begin > _ONE:
        _invoke_blocks(address, begin, end, threads, count, frame)
    else:
        _invoke_block(address, begin, end, threads, count, frame)
