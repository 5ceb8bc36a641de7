"""Splicing of lists of pairs: the first rows of one list, all further rows of another.

Where only some particles move, and these have the first numbers, their rows are searched anew and
the others kept. Values per pair go with the rows.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from lasersph.compute.backend import Backend


class PairRows(NamedTuple):
    """Rows of a list: row_start (n + 1,) offsets, neighbor (pairs,) indices, values (pairs,)."""

    row_start: Any
    neighbor: Any
    values: Any


def splice(backend: Backend, first: PairRows, count: int, rest: PairRows) -> PairRows:
    """Rows 0 ... count - 1 of `first`, and the rows from `count` on of `rest`.

    Raises:
        ValueError: one of the lists has fewer rows than `count`.
    """
    start, kept = backend.unwrap(first.row_start), backend.unwrap(rest.row_start)
    if count > start.size - 1 or count > kept.size - 1:
        raise ValueError(f"{count} rows of lists with {start.size - 1} and {kept.size - 1}")
    pairs, begin = int(start[count]), int(kept[count])
    row_start = np.concatenate([start[:count], kept[count:] - np.uint64(begin) + np.uint64(pairs)])
    joined = (
        backend.wrap(np.concatenate([backend.unwrap(one)[:pairs], backend.unwrap(other)[begin:]]))
        for one, other in ((first.neighbor, rest.neighbor), (first.values, rest.values))
    )
    return PairRows(backend.wrap(row_start), *joined)
