"""Coarse columns beside the fine ones: cells of a grid that rest, and what lies beside them.

All layers have the same coarse columns, as wide as they have grown outward; along an axis on which
a column is not beside the fine ones it is as wide as those of the first layer. A cell is as high as
its layer, so far out it is flat. Such cells exchange heat with the next ones through the faces
between them alone (`sph.face_weights`), which no kernel does: its support would reach over many
layers. Fine particles beside them see dummies of their own size, each of which stands for the cells
that lie where it lies.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from lasersph.particles.layers import Layers

Array = NDArray[np.float64]
NONE = -1
"""Number of a cell that fine particles fill."""


@dataclass(frozen=True)
class CoarseColumns:
    """Grid of the block in which the coarse columns are cells.

    Attributes:
        layers: of the block. first: number of the first coarse particle; they are numbered layer
            after layer, the last axis fastest.
    """

    layers: Layers
    first: int

    @cached_property
    def sizes(self) -> tuple[Array, ...]:
        """Widths of the cells along each axis [m], thicknesses from the surface down last."""
        layers, fine = self.layers, self.layers.column_width()[:, 0]
        across = tuple(
            np.concatenate([low[::-1], np.full(count, width), high])
            for (low, high), count, width in zip(
                layers.beside, layers.columns[:, 0], fine, strict=True
            )
        )
        return (*across, layers.thickness)

    @cached_property
    def fine(self) -> tuple[slice, ...]:
        """The columns along each lateral axis that fine particles fill."""
        return tuple(
            slice(low.size, low.size + int(count))
            for (low, _), count in zip(self.layers.beside, self.layers.columns[:, 0], strict=True)
        )

    @cached_property
    def edges(self) -> tuple[Array, ...]:
        """Where cells begin and end along each axis [m], the last one as depth below z = 0."""
        starts = (*(lower for lower, _ in self.layers.bounds), 0.0)
        return tuple(
            start + np.concatenate([[0.0], np.cumsum(size)])
            for start, size in zip(starts, self.sizes, strict=True)
        )

    @cached_property
    def centers(self) -> tuple[Array, ...]:
        """Middles of the cells along each axis [m], the last one as depth."""
        return tuple(0.5 * (edges[1:] + edges[:-1]) for edges in self.edges)

    @cached_property
    def number(self) -> NDArray[np.int64]:
        """(layers, columns along x (and y)) particle in each cell; NONE where those are fine."""
        shape = tuple(size.size for size in self.sizes)
        is_coarse = np.ones(shape[:-1], bool)
        is_coarse[self.fine] = False
        rank = np.where(is_coarse, np.cumsum(is_coarse).reshape(is_coarse.shape) - 1, NONE)
        layer = np.arange(shape[-1]).reshape(-1, *(1 for _ in shape[:-1]))
        total = int(is_coarse.sum())
        return np.where(rank < 0, NONE, self.first + layer * total + rank)

    @cached_property
    def cells(self) -> tuple[NDArray[np.int64], ...]:
        """Place of each coarse particle in the grid: (n,) along each axis, the layer last."""
        layer, *across = np.nonzero(self.number != NONE)
        return (*across, layer)

    @property
    def count(self) -> int:
        """Number of coarse particles."""
        return self.cells[0].size

    def positions(self) -> Array:
        """(dim, n) middles of the coarse particles [m]."""
        *across, depth = (
            center[place] for center, place in zip(self.centers, self.cells, strict=True)
        )
        return np.array([*across, -depth])

    def widths(self) -> Array:
        """(dim, n) edges of the coarse particles [m]."""
        return np.array([size[place] for size, place in zip(self.sizes, self.cells, strict=True)])

    def area(self, axis: int) -> Array:
        """Areas of the cells' faces normal to an axis [m^(d-1)], of rings [m^2].

        Returns:
            One for each cell and, along the axis, one more: (layers, columns along x (and y)).
        """
        last = len(self.sizes) - 1
        area = np.ones(())
        # products of the other edges, as in the array of the numbers: the layer first
        for other in (last, *range(last)):
            size = np.ones(self.sizes[axis].size + 1) if other == axis else self.sizes[other]
            area = area[..., None] * size
        if self.layers.geometry.is_axisymmetric:
            r = self.edges[0] if axis == 0 else self.centers[0]
            area = area * (2.0 * np.pi * r)
        return area

    @staticmethod
    def array_axis(axis: int, dimension: int) -> int:
        """Axis of the array of the numbers for one of the block, whose last one comes first."""
        return 0 if axis == dimension - 1 else axis + 1


def linear_means(
    nodes: Array, lower: Array, upper: Array
) -> tuple[NDArray[np.int64], NDArray[np.int64], Array]:
    """Mean over intervals of the line through values at nodes, straight on beyond the ends.

    Args:
        nodes: (k,) rising [m]. lower, upper: (n,) ends of the intervals [m].

    Returns:
        Interval, node and weight of each term; those of an interval add up to 1.
    """
    if nodes.size == 1:
        each = np.arange(lower.size)
        return each, 0 * each, np.ones(lower.size)
    # intervals are cut at the nodes within them
    first = np.searchsorted(nodes, lower, side="right")
    pieces = np.searchsorted(nodes, upper, side="left") - first + 1
    interval = np.repeat(np.arange(lower.size), pieces)
    piece = np.arange(interval.size) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    node = first[interval] + piece
    begin = np.where(piece == 0, lower[interval], nodes[np.maximum(node - 1, 0)])
    is_last = piece == pieces[interval] - 1
    end = np.where(is_last, upper[interval], nodes[np.minimum(node, nodes.size - 1)])

    # the mean over a piece is the value in its middle, between two nodes
    left = np.clip(node - 1, 0, nodes.size - 2)
    share = (0.5 * (begin + end) - nodes[left]) / (nodes[left + 1] - nodes[left])
    length = (end - begin) / (upper - lower)[interval]
    terms = np.concatenate([length * (1.0 - share), length * share])
    # terms of one interval and node together
    key = np.concatenate([interval, interval]) * nodes.size + np.concatenate([left, left + 1])
    found, place = np.unique(key, return_inverse=True)
    weight = np.bincount(place, terms).astype(np.float64)
    return found // nodes.size, found % nodes.size, weight
