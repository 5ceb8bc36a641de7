"""Connected parts of a set of particles: pools and remnants that exchange nothing.

Particles are connected where they lie in the same or in touching cells (corners included) of width
`CELL` times the support radius: always where closer than that, never where farther than
2 sqrt(2) times as much, which for particles one spacing apart is contact. Cells are labeled on the
host. Left out: one and three dimensions.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from lasersph.compute.backend import Backend
from lasersph.linear_solvers.cells import Bins, Cells

CELL = 0.35
"""Width of a cell over the support radius; 1.3 spacings where the support is 3.75."""
FEWEST = 4
"""Parts with fewer particles belong to no component."""


def total_of(k, values, order, start):
    """Sum of the values of component k's members."""
    total = 0.0
    for p in range(start[k], start[k + 1]):
        total += values[order[p]]
    return total


def share_of(k, pull, order, start):
    """1 / members of a component that nothing pulls toward a value; 0 for others and for none."""
    if k == 0 or start[k] == start[k + 1] or total_of(k, pull, order, start) > 0.0:
        return 0.0
    return 1.0 / (start[k + 1] - start[k])


def mean_of(k, share, values, order, start):
    """Mean of the values of component k's members, 0 where the share is 0."""
    if share <= 0.0:
        return 0.0
    return share * total_of(k, values, order, start)


def without_mean(p, component, means):
    """Value less the mean of its component, and its square."""
    rest = p - means[component]
    return rest, rest * rest


def is_member(component):
    """1 where a particle belongs to a component."""
    if component > 0:
        return 1.0
    return 0.0


class Components:
    """Components of `count` particles.

    Args:
        support: radius [m]. period: per axis [m], 0.0 where there is none.

    Attributes:
        number: (n,) kind "index", component of each particle from 1 on, 0 for none.
        mask: (n,) 1 where a particle belongs to a component, else 0. count: their number.
    """

    def __init__(
        self, backend: Backend, count: int, support: float, period: Sequence[float] = (0.0, 0.0)
    ) -> None:
        self.backend, self.count = backend, 0
        self.number, self.mask = backend.zeros(count, "index"), backend.zeros(count)
        self._cells = Cells(backend, count, CELL * support, period)

    def find(self, position: Any, mask: Any, pull: Any) -> None:
        """Label the particles with mask 1.

        Args:
            position: (2, n) [m]. mask: (n,). pull: (n,) a_i >= 0 toward given values; a component
                without any floats.
        """
        backend, cells = self.backend, self._cells
        cells.place(position, mask)
        cell = backend.to_host(cells.number)
        members = np.bincount(cell, minlength=cells.count + 1)[:-1]
        label = _labels(members.reshape(cells.x.cells, cells.z.cells) > 0, cells)
        size = np.bincount(label, members)
        size[0] = 0
        is_large = size >= FEWEST
        self.count = int(is_large.sum())
        new = np.where(is_large, np.cumsum(is_large), 0)
        number = np.append(new[label], 0)[cell]
        backend.copy(backend.asarray(number, "index"), self.number)
        backend.pointwise(is_member, {"component": self.number}, self.mask)
        self._bins = Bins(backend, self.number, self.count + 1)
        self._places = {"k": backend.asarray(np.arange(self.count + 1), "index")}
        self._share, self._means = (backend.zeros(self.count + 1) for _ in range(2))
        self._sum(share_of, self._share, pull=pull)

    def remove_means(self, values: Any) -> float:
        """Subtract from each floating component's values their mean; returns the sum of squares."""
        fields = {"p": values, "component": self.number}
        self._sum(mean_of, self._means, share=self._share, values=values)
        out = (values, None)
        (square,) = self.backend.pointwise(
            without_mean, fields, out, reduce=(None, "sum"), means=self._means
        )
        return square

    def _sum(self, function: Any, out: Any, share: Any = None, **arrays: Any) -> None:
        fields = self._places if share is None else self._places | {"share": share}
        order, start = self._bins.order, self._bins.start
        self.backend.pointwise(function, fields, out, order=order, start=start, **arrays)


def _labels(is_filled: np.ndarray, cells: Cells) -> np.ndarray:
    """(cells,) label of each cell from 1 on, 0 where it is empty."""
    from scipy import ndimage, sparse

    labeled: Any = ndimage.label(is_filled, np.ones((3, 3)))
    label = labeled[0]
    for axis, wraps in ((0, cells.x.wraps), (1, cells.z.wraps)):
        if not wraps:
            continue
        count = int(label.max(initial=0)) + 1
        first, last = np.take(label, 0, axis), np.take(label, -1, axis)
        touching = [(first, last), (first[1:], last[:-1]), (first[:-1], last[1:])]
        pairs = np.hstack([np.stack(sides) for sides in touching])
        pairs = pairs[:, (pairs > 0).all(axis=0)]
        graph = sparse.coo_array((np.ones(pairs.shape[1]), pairs), shape=(count, count))
        _, joined = sparse.csgraph.connected_components(graph, directed=False)
        label = np.where(label > 0, joined[label] + 1, 0)
    return label.ravel()
