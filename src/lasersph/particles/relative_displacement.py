"""`RelativeDisplacement`: how much further particles have moved than others near them.

What is near mostly moves along. The box is cut into cells; with the displacements d of the
particles since their pairs were found, for each cell c and the cells U up to `RANGE` away from it,

    bound^2 = max over c of sum_k max(max_U d_k - min_c d_k, max_c d_k - min_U d_k)^2

No two particles of cells up to `RANGE` away have moved further from or to each other than that. In
a flow that changes over many spacings it is less than half of twice the largest displacement, which
bounds all pairs.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import sqrt

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.cell_grid import CellGrid
from lasersph.particles.kinds import INTERIOR
from lasersph.particles.neighbor_lists import Box, NeighborList, members_of

RANGE = 2
"""Cells to either side whose particles are compared with those of a cell."""
WIDTH = 0.6
"""Least width of a cell over the longest distance of listed pairs: what is more than `RANGE` cells
away must be out of reach for some steps. Narrower cells bound closer and take longer."""
WIDER = 1.25
"""Factor of the width as long as there are more cells than particles."""


def predicted_displacement(x, x_listed, v, kind, dt):
    """Displacement since the pairs were found and for `dt` [s] more, of the interior [m]."""
    return (1.0 if kind == INTERIOR else 0.0) * (x + dt * v - x_listed)


def particle_extremes(d_j):
    """Displacement of a particle [m], for the largest and smallest of each component in a cell."""
    return d_j, d_j


def cell_extremes(high_j, low_j):
    """Largest and smallest components of a cell [m], for those of cells along an axis."""
    return high_j, low_j


def difference_square(most, least, most_around, least_around):
    """Square of the largest difference of a component [m^2]; 0 of a cell without particles."""
    # a cell without particles has -inf and inf as its extremes
    difference = max(max(most_around - least, most - least_around), 0.0)
    return difference * difference


def bound_square(most, least, total_0, total_1):
    """Square of the bound for one cell [m^2]: its largest and smallest, and those around it."""
    square = difference_square(most[0], least[0], total_0[0], total_1[0])
    if len(most) > 1:
        square = square + difference_square(most[1], least[1], total_0[1], total_1[1])
    if len(most) > 2:
        square = square + difference_square(most[2], least[2], total_0[2], total_1[2])
    return square


class RelativeDisplacement:
    """Bound of the displacements of particles relative to others near them.

    Args:
        fields: by symbol: positions x, velocities v, kinds, and positions x_listed where the pairs
            were found, all kept up to date.
        box: around all particles. distance: longest distance of listed pairs [m].

    Attributes:
        clear: distance [m] beyond which particles may be in cells that are not compared.
    """

    def __init__(
        self,
        backend: Backend,
        fields: Mapping[str, Array],
        box: Box,
        distance: float,
    ) -> None:
        self.backend, self.period = backend, box.period
        self._fields = dict(fields)
        dimension, total = fields["x"].shape
        self._members: NeighborList | None = None
        low, high = np.array(box.low), np.array(box.high)
        width = WIDTH * distance
        self._grid = CellGrid.over(low, high - low, width)
        # no more cells than particles, so that looking costs less than pairs
        while self._grid.count > total:
            width *= WIDER
            self._grid = CellGrid.over(low, high - low, width)
        self.clear = RANGE * min(self._grid.width)
        self._displacement = backend.zeros((dimension, total))
        size = (dimension, self._grid.count)
        self._extremes, *self._around = (
            (backend.zeros(size), backend.zeros(size)) for _ in range(dimension)
        )
        self._lines = [self._cells_along(axis) for axis in range(dimension)]

    def _cells_along(self, axis: int) -> NeighborList:
        """The cells up to `RANGE` away along an axis from each, as rows of a list."""
        shape, backend = self._grid.shape, self.backend
        # numbers of the cells on the line through each, folded or cut off at the ends
        near = np.arange(shape[axis])[:, None] + np.arange(-RANGE, RANGE + 1)
        if self.period[axis] > 0.0:
            near %= shape[axis]
        near = np.clip(near, 0, shape[axis] - 1)
        # an end counts twice where the line is cut off, which changes no extreme
        stride = int(np.prod(shape[axis + 1 :]))
        cell = np.arange(self._grid.count)
        number = cell // stride % shape[axis]
        neighbor = (cell[:, None] + (near[number] - number[:, None]) * stride).ravel()
        start = np.arange(0, neighbor.size + 1, 2 * RANGE + 1)
        return NeighborList(backend.asarray(start, "offset"), backend.asarray(neighbor, "index"))

    def reset(self) -> None:
        """Pairs are found anew: particles will be in other cells."""
        self._members = None

    def bound(self, step: float) -> float:
        """The bound [m] after `step` [s] at the velocities that particles have now."""
        backend = self.backend
        if self._members is None:
            # cells of the particles when their pairs were found
            cell = self._grid.find_cells(backend, self._fields["x_listed"])
            self._members = members_of(backend, cell, self._grid.count)
        backend.pointwise(predicted_displacement, self._fields, self._displacement, dt=step)
        how = ("max", "min")
        fields = {"d": self._displacement}
        backend.pair_sum(particle_extremes, self._members, fields, self._extremes, combine=how)
        # one axis after the other: extremes of the cells around those of the axes before
        *lines, last = self._lines
        high, low = self._extremes
        for line, out in zip(lines, self._around, strict=False):
            backend.pair_sum(cell_extremes, line, {"high": high, "low": low}, out, combine=how)
            high, low = out
        most, least = self._extremes
        fields = {"high": high, "low": low, "most": most, "least": least}
        (square,) = backend.pair_sum(
            cell_extremes, last, fields, (None,), combine=how, finish=bound_square, reduce=("max",)
        )
        return sqrt(max(square, 0.0))
