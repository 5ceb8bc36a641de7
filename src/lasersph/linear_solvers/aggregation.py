"""Aggregates of particles, and the weights between them: what multigrid keeps for a whole run.

Particles in one cell form an aggregate. Cells are cubes, `CELL` support radii wide where the
support is smallest and twice, four times ... as wide where it is larger, so that aggregates grow
with the layers. With the functions P that are constant on aggregates, the pair operator G becomes

    P^T G P,    g_IJ = sum_{i in I, j in J} g_ij

[Vanek1996]. Constant functions are too stiff between narrow stencils: from the second
coarsening on the weights are divided by a number such that the linear functions of position keep
their energy sum g_ij (x_i - x_j)^2, which is the over-correction of [Braess1995]. The first one
needs none, since the stencils of particles are as wide as aggregates. Positions enter only here.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

CELL = 0.8
"""Cell width over the support radius: some three particles."""
FACTOR = 2.0
"""Cell width over that of the level below."""
COARSEST = 64
"""Levels end with at most as many aggregates."""


@dataclass(frozen=True)
class Aggregates:
    """One level, host arrays.

    Attributes:
        parent: (finer,) aggregate of each member. size: (n,) number of members.
        member_start: (n + 1,), member: (finer,) members of each aggregate.
        row_start, neighbor, weight: pairs of aggregates and their g_IJ, each pair twice.
    """

    parent: NDArray[np.int64]
    size: NDArray[np.int64]
    member_start: NDArray[np.int64]
    member: NDArray[np.int64]
    row_start: NDArray[np.int64]
    neighbor: NDArray[np.int64]
    weight: NDArray[np.float64]

    @property
    def count(self) -> int:
        """Number of aggregates."""
        return self.size.size


def coarsen(
    position: NDArray, support: NDArray, row_start: NDArray, neighbor: NDArray, weight: NDArray
) -> list[Aggregates]:
    """Levels of aggregates, the finest first; none where there are few particles.

    Args:
        position: (dim, n). support: (n,) [m]. row_start: (n + 1,), neighbor, weight: (pairs,).
    """
    from scipy import sparse  # many runs need no multigrid, and it takes half a second to load

    graph: Any = sparse.csr_array(
        (
            weight.astype(np.float64, copy=False),
            neighbor.astype(np.int32),
            row_start.astype(np.int64),
        ),
        shape=(support.size, support.size),
    )
    levels: list[Aggregates] = []
    width = CELL * support
    while width.size > COARSEST:
        # members of each cell, and the mean of their places
        parent, cell = _cells(position, width)
        count = cell.size
        size = np.bincount(parent, minlength=count)
        below = position
        position = np.array([np.bincount(parent, x, count) / size for x in below])
        onto = sparse.csr_array(
            (np.ones(parent.size), parent, np.arange(parent.size + 1)), shape=(parent.size, count)
        )

        # weights between aggregates: sums over the pairs of their members
        coarse: Any = sparse.csr_array((onto.T @ graph) @ onto)
        coarse.setdiag(0.0)
        coarse.eliminate_zeros()
        coarse.sort_indices()

        # aggregates of aggregates are too stiff: scaled to the energy of a linear field
        if levels:
            coarse = coarse * (_energy(graph, below) / _energy(coarse, position))
        levels.append(
            Aggregates(
                parent=parent,
                size=size,
                member_start=np.concatenate([[0], np.cumsum(size)]),
                member=np.argsort(parent, kind="stable"),
                row_start=coarse.indptr.astype(np.int64),
                neighbor=coarse.indices.astype(np.int64),
                weight=coarse.data,
            )
        )
        graph, width = coarse, FACTOR * cell
    return levels


def _cells(position: NDArray, width: NDArray) -> tuple[NDArray, NDArray]:
    """Number of each particle's cell, and the width of each cell [m].

    Cells are numbered in the order in which particles come upon them, so that sums over members and
    values of aggregates are read from memory in the order of the particles.
    """
    # cells as wide as the width, in steps of two
    smallest = width.min()
    octave = np.floor(np.log2(width / smallest) + 1e-9).astype(np.int64)
    cell = smallest * 2.0**octave
    lower = position.min(axis=1, keepdims=True)
    place = np.floor((position - lower) / cell + 1e-9).astype(np.int64)
    _, first, parent = np.unique(
        np.vstack([octave, place]), axis=1, return_index=True, return_inverse=True
    )
    order = np.argsort(first)
    number = np.empty_like(order)
    number[order] = np.arange(order.size)
    return number[parent.ravel()], cell[first[order]]


def _energy(graph: Any, position: NDArray) -> float:
    """sum over pairs of g_ij |x_i - x_j|^2 (1 where nothing is coupled)."""
    row = np.repeat(np.arange(graph.shape[0]), np.diff(graph.indptr))
    step = position[:, row] - position[:, graph.indices]
    return float(np.sum(graph.data * np.sum(step * step, axis=0))) or 1.0
