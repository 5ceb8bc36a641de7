"""Connected parts of a set of particles: pools and remnants that exchange nothing.

Particles are connected where they lie in the same or in touching cells (corners included) of width
`CELL` times the support radius: always where closer than that, never where farther than
2 sqrt(2) times as much, which for particles one spacing apart is contact. Left out: one and three
dimensions.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.linear_solvers.cells import Cells
from lasersph.particles.neighbor_lists import members_of

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


def share_of(k, boundary_coefficient, order, start):
    """1 / members of a component that has no boundary coefficient; 0 for others and for none."""
    if k == 0 or start[k] == start[k + 1] or total_of(k, boundary_coefficient, order, start) > 0.0:
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


def part_of(cell, first):
    """First cell of a particle's part; the number of cells where it has none."""
    return first[cell] if cell < len(first) else cell


def large(members):
    """1 for the first cell of a part with enough particles."""
    return 1 if members >= FEWEST else 0 * members


def component_of(part, members, before):
    """Component of a particle, 0 for none; and 1 where it belongs to one.

    Args:
        members: table of the parts' sizes. before: how many components come before each part.
    """
    if part + 1 < len(members) and members[part] >= FEWEST:
        return before[part] + 1, 1.0
    return 0 * part, 0.0


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
        self._share, self._members = backend.zeros(0), None

    def find(self, position: Array, mask: Array, boundary_coefficient: Array) -> None:
        """Label the particles with mask 1.

        Args:
            position: (2, n) [m]. mask: (n,). boundary_coefficient: (n,) a_i >= 0 toward given
                values; a component without any floats.
        """
        backend, cells = self.backend, self._cells
        cells.place(position, mask)
        total, head = cells.count, backend.head
        filled = head(backend.count_by_key(cells.number, total + 1), total)
        first = backend.first_connected(
            filled, cells.x.cells, cells.z.cells, (cells.x.wraps, cells.z.wraps)
        )
        backend.pointwise(part_of, {"cell": cells.number}, self.number, first=first)
        members = backend.count_by_key(self.number, total + 1)
        marks, before = backend.zeros(total, "index"), backend.zeros(total + 1, "offset")
        backend.pointwise(large, {"members": head(members, total)}, marks)
        backend.exclusive_scan(marks, before)
        self.count = int(backend.look(before)[-1])
        fields, out = {"part": self.number}, (self.number, self.mask)
        backend.pointwise(component_of, fields, out, members=members, before=before)
        kept = self._members if self._share.shape[0] == self.count + 1 else None
        self._members = members_of(backend, self.number, self.count + 1, into=kept)
        if kept is None:
            self._places = {"k": backend.asarray(np.arange(self.count + 1), "index")}
            self._share, self._means = (backend.zeros(self.count + 1) for _ in range(2))
        self._sum(share_of, self._share, boundary_coefficient=boundary_coefficient)

    @property
    def arrays(self) -> tuple[Array, ...]:
        """Those that are replaced where the number of components changes."""
        return self._share, self._members.neighbor

    def remove_means(self, values: Array) -> tuple[float, ...]:
        """Subtract from each floating component's values their mean; reduces the sum of squares."""
        fields = {"p": values, "component": self.number}
        self._sum(mean_of, self._means, share=self._share, values=values)
        out, reduce = (values, None), (None, "sum")
        return self.backend.pointwise(without_mean, fields, out, reduce=reduce, means=self._means)

    def _sum(
        self, function: Callable, out: Array, share: Array | None = None, **arrays: Array
    ) -> None:
        fields = self._places if share is None else self._places | {"share": share}
        order, start = self._members.neighbor, self._members.row_start
        self.backend.pointwise(function, fields, out, order=order, start=start, **arrays)
