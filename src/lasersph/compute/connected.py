"""Connected cells of a grid, on the host: which touch, by sides or corners, also around ends."""

from __future__ import annotations

from typing import Any

import numpy as np


def first_connected(is_filled: np.ndarray, wraps: tuple[bool, bool]) -> np.ndarray:
    """Smallest number of a cell connected with each one, its own where that is empty, (cells,).

    Args:
        is_filled: (columns, lines) bool; cells are numbered line after line within a column.
        wraps: whether the last column touches the first, and the last line the first.
    """
    label = _labels(is_filled, wraps).ravel()
    number = np.arange(label.size)
    first = np.zeros(int(label.max(initial=0)) + 1, np.int64)
    first[label[::-1]] = number[::-1]
    return np.where(label > 0, first[label], number)


def _labels(is_filled: np.ndarray, wraps: tuple[bool, bool]) -> np.ndarray:
    """Label of each cell from 1 on, 0 where it is empty."""
    from scipy import ndimage, sparse

    labeled: Any = ndimage.label(is_filled, np.ones((3, 3)))
    label = labeled[0]
    for axis in np.flatnonzero(wraps):
        count = int(label.max(initial=0)) + 1
        first, last = np.take(label, 0, axis), np.take(label, -1, axis)
        touching = [(first, last), (first[1:], last[:-1]), (first[:-1], last[1:])]
        pairs = np.hstack([np.stack(sides) for sides in touching])
        pairs = pairs[:, (pairs > 0).all(axis=0)]
        graph = sparse.coo_array((np.ones(pairs.shape[1]), pairs), shape=(count, count))
        _, joined = sparse.csgraph.connected_components(graph, directed=False)
        label = np.where(label > 0, joined[label] + 1, 0)
    return label
