"""Splicing of lists of pairs: chosen rows of one list, all other rows of another.

Where only some particles move, the rows that they touch are searched anew and the others kept.
Values per pair go with the rows. A row's place follows from the lengths of the rows before it, so
that the result does not depend on the number of threads.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from lasersph.compute.array_function import array_function
from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.generate import BLOCK

_TEXT = f'''
ONE = np.uint64(1)
BLOCK = np.uint64({BLOCK})


def lengths(_, count, chosen, start, kept, row_start):
    """Row pointers of the joined list."""
    row_start[np.uint64(0)] = np.uint64(0)
    for k in range(count):
        i = np.uint64(k)
        if chosen[i]:
            length = start[i + ONE] - start[i]
        else:
            length = kept[i + ONE] - kept[i]
        row_start[i + ONE] = row_start[i] + length


def copy_rows(block, count, chosen, start, neighbor, values, kept, kept_neighbor, kept_values,
              row_start, joined, joined_values):
    """Copy the rows of a block to their places."""
    for i in range(block * BLOCK, min((block + ONE) * BLOCK, count)):
        base = row_start[i]
        if chosen[i]:
            first = start[i]
            for p in range(start[i + ONE] - first):
                q = np.uint64(p)
                joined[base + q] = neighbor[first + q]
                joined_values[base + q] = values[first + q]
        else:
            first = kept[i]
            for p in range(kept[i + ONE] - first):
                q = np.uint64(p)
                joined[base + q] = kept_neighbor[first + q]
                joined_values[base + q] = kept_values[first + q]
'''


class PairRows(NamedTuple):
    """Rows of a list: row_start (n + 1,) offsets, neighbor (pairs,) indices, values (pairs,)."""

    row_start: Array
    neighbor: Rows
    values: Array


def splice(backend: Backend, first: PairRows, chosen: Array, others: PairRows) -> PairRows:
    """Rows of `first` where `chosen`, those of `others` elsewhere.

    Args:
        chosen: (n,) of kind flag, n the rows of `others`; 0 beyond the rows of `first`.

    Raises:
        ValueError: `chosen` is not of that kind and length, or the lists hold different reals.
    """
    start, neighbor, values = (backend.unwrap(part) for part in first)
    kept, kept_neighbor, kept_values = (backend.unwrap(part) for part in others)
    mark = backend.unwrap(chosen)
    count = kept.size - 1
    if mark.dtype != np.uint8 or mark.size != count or values.dtype != kept_values.dtype:
        raise ValueError(f"{mark.size} {mark.dtype} marks for {count} rows of {kept_values.dtype}")
    if backend.search is not None:
        return backend.search.splice(first, mark, others)
    if start.size - 1 < count and mark[start.size - 1 :].any():
        raise ValueError(f"a row is chosen beyond the {start.size - 1} of the first list")
    # places of the rows follow from their lengths
    row_start = np.empty(count + 1, np.uint64)
    array_function(_TEXT, "lengths")(count, mark, start, kept, row_start)
    pairs = int(row_start[-1])
    joined, joined_values = np.empty(pairs, np.uint32), np.empty(pairs, kept_values.dtype)
    array_function(_TEXT, "copy_rows")(
        count,
        mark,
        start,
        neighbor,
        values,
        kept,
        kept_neighbor,
        kept_values,
        row_start,
        joined,
        joined_values,
        blocks=-(-count // BLOCK),
        threads=backend.threads,
    )
    return PairRows(*(backend.wrap(part) for part in (row_start, joined, joined_values)))
