"""Connected parts of a set of particles: pools and remnants that exchange nothing.

Particles are connected where they lie in the same or in touching cells (corners included) of width
`CELL` spacings: always where closer than that, never where farther than 2 sqrt(d) times as much in
d dimensions, which for particles one spacing apart is contact, whatever their support. The cells
are some hundreds, so that the host labels them, as parts of an image.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.linear_solvers.cells import Cells
from lasersph.particles.neighbor_lists import members_of

CELL = 0.35 * 3.75
"""Width of a cell over the spacing. Geometry: a lattice fills every cell, as long as that is more
than 1."""
FEWEST = 4
"""Parts with fewer particles belong to no component."""
SLICE, SLICES = 4096, 256
"""Members of a slice at least, and slices of a component: one row of a loop adds up a slice, so
that all processors, and the threads of a card, share a large pool."""


def slice_total(place, values, order, start):
    """Sum of the values of one slice of a component's members; `place` counts all slices."""
    k = place // SLICES
    first, last = start[k], start[k + 1]
    length = max(SLICE, (last - first + SLICES - 1) // SLICES)
    begin = first + (place - k * SLICES) * length
    total = 0.0
    for p in range(begin, min(begin + length, last)):
        total += values[order[p]]
    return total


def total_of(k, totals):
    """Sum of what the slices of component k have."""
    total = 0.0
    for p in range(k * SLICES, (k + 1) * SLICES):
        total += totals[p]
    return total


def share_of(k, totals, start):
    """1 / members of a component that has no boundary coefficient; 0 for others and for none.

    Args:
        totals: of the boundary coefficient.
    """
    if k == 0 or start[k] == start[k + 1] or total_of(k, totals) > 0.0:
        return 0.0
    return 1.0 / (start[k + 1] - start[k])


def mean_of(k, share, totals):
    """Mean of the values of component k's members, 0 where the share is 0."""
    if share <= 0.0:
        return 0.0
    return share * total_of(k, totals)


def ratio_of(k, share, totals, volumes):
    """Sum of the values of component k's members over that of their volumes, 0 where the share is
    0."""
    if share <= 0.0:
        return 0.0
    return total_of(k, totals) / total_of(k, volumes)


def without_share(p, component, volume, means):
    """Value less a volume's share of what its component has too much, and its square."""
    deviation = p - volume * means[component]
    return deviation, deviation * deviation


def without_mean(p, component, means):
    """Value less the mean of its component, and its square."""
    deviation = p - means[component]
    return deviation, deviation * deviation


def component_of(cell, components):
    """Component of a particle in a cell, 0 for none; and 1 where it belongs to one."""
    if cell < len(components) and components[cell] > 0:
        return components[cell], 1.0
    return 0 * cell, 0.0


class Components:
    """Components of `count` particles.

    Args:
        spacing: of the particles [m]. period: per axis [m], 0.0 where there is none.

    Attributes:
        number: (n,) kind "index", component of each particle from 1 on, 0 for none.
        mask: (n,) 1 where a particle belongs to a component, else 0. count: their number.
    """

    def __init__(
        self, backend: Backend, count: int, spacing: float, period: Sequence[float] = (0.0, 0.0)
    ) -> None:
        self.backend, self.count = backend, 0
        self.number, self.mask = backend.zeros(count, "index"), backend.zeros(count)
        self._cells = Cells(backend, count, CELL * spacing, period)
        self._share, self._members = backend.zeros(0), members_of(backend, self.number, 1)

    def find(self, position: Array, mask: Array) -> None:
        """Label the particles with mask 1 (n,); position (d, n) [m]."""
        backend, cells = self.backend, self._cells
        # parts of the cells that hold particles
        cells.update(position, mask)
        grid = cells.grid
        members = backend.host_view(backend.count_by_key(cells.number, grid.count + 1))[
            : grid.count
        ]
        part = connected_parts(members.reshape(grid.shape) > 0, grid.repeats).ravel()

        # components are the parts with enough particles, in the order of their first cells
        sizes = np.bincount(part, members)
        is_large = sizes >= FEWEST
        is_large[0] = False
        number = np.cumsum(is_large)
        self.count = int(number[-1])
        components = backend.asarray((number * is_large)[part], "index")
        fields, out = {"cell": cells.number}, (self.number, self.mask)
        backend.pointwise(component_of, fields, out, components=components)

        # members of each component
        kept = self._members if self._share.shape[0] == self.count + 1 else None
        self._members = members_of(backend, self.number, self.count + 1, into=kept)
        if kept is None:
            slices = (self.count + 1) * SLICES
            self._places = {"k": backend.asarray(np.arange(self.count + 1), "index")}
            self._slices = {"place": backend.asarray(np.arange(slices), "index")}
            self._totals = tuple([backend.zeros(slices) for _ in range(2)])
            self._share, self._means = (backend.zeros(self.count + 1) for _ in range(2))

    def find_floating(self, boundary_coefficient: Array) -> None:
        """Find which float: those without any boundary coefficient (n,) a_i >= 0 toward given
        values."""
        # what share of its component each of the members is
        totals, start = self._sum(boundary_coefficient), self._members.row_start
        self.backend.pointwise(share_of, self._places, self._share, totals=totals, start=start)

    def remove_means(self, values: Array) -> tuple[float, ...]:
        """Subtract from each floating component's values their mean; reduces the sum of squares."""
        fields = {"p": values, "component": self.number}
        shares = self._places | {"share": self._share}
        self.backend.pointwise(mean_of, shares, self._means, totals=self._sum(values))
        out, reduce = (values, None), (None, "sum")
        return self.backend.pointwise(without_mean, fields, out, reduce=reduce, means=self._means)

    def remove_shares(self, values: Array, volume: Array) -> tuple[float, ...]:
        """Subtract from each floating component's values their sum, by the volumes (n,) of its
        members; reduces the sum of squares."""
        fields = {"p": values, "component": self.number, "volume": volume}
        shares = self._places | {"share": self._share}
        totals = {"totals": self._sum(values), "volumes": self._sum(volume, 1)}
        self.backend.pointwise(ratio_of, shares, self._means, **totals)
        out, reduce = (values, None), (None, "sum")
        return self.backend.pointwise(without_share, fields, out, reduce=reduce, means=self._means)

    def _sum(self, values: Array, which: int = 0) -> Array:
        """Sums of the values of each slice of each component, in one of two arrays."""
        order, start = self._members.neighbor, self._members.row_start
        tables = {"values": values, "order": order, "start": start}
        self.backend.pointwise(slice_total, self._slices, self._totals[which], **tables)
        return self._totals[which]


def connected_parts(is_filled: NDArray[np.bool_], repeats: Sequence[bool]) -> NDArray[np.int64]:
    """Part of each cell from 1 on, 0 of empty ones, shaped as the grid of d axes.

    Parts are numbered by their first cells. Cells touch by sides, edges and corners, and the last
    of an axis that repeats touches the first.
    """
    if is_filled.all():
        return np.ones(is_filled.shape, np.int64)
    from scipy.ndimage import label  # loads as long as all else that builds a pool

    # axes that repeat begin with a copy of their last cells
    with_copies, inner = is_filled, [slice(None)] * is_filled.ndim
    for axis, around in enumerate(repeats):
        if around:
            places = np.arange(-1, is_filled.shape[axis])
            with_copies, inner[axis] = with_copies.take(places, axis), slice(1, None)
    found: Any = label(with_copies, np.ones((3,) * is_filled.ndim, bool))
    labels, count = found
    parts = labels[tuple(inner)]
    if count < 2:
        return parts

    # a copy and its cell are one part, that of the lower label
    lowest, copies = np.arange(count + 1), parts
    for axis, around in enumerate(repeats):
        if around:
            copies = copies.take(np.arange(-1, is_filled.shape[axis]), axis)
    differ = labels != copies
    for one, other in {*zip(labels[differ], copies[differ], strict=True)}:
        pair = lowest[[one, other]]
        lowest[lowest == pair.max()] = pair.min()

    # numbers in the order of first cells, empty ones aside: the first one is written last
    flat = lowest[parts].ravel()
    first = np.full(count + 1, flat.size)
    first[flat[::-1]] = np.arange(flat.size)[::-1]
    first[0] = -1
    return np.argsort(np.argsort(first))[lowest[parts]]
