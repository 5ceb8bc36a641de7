"""`RelativeMotion`: how much further particles have moved than others near them.

What is near mostly moves along. The box is cut into tiles; with the ways d of the particles since
their pairs were found, for each tile c and the tiles U up to `REACH` away from it,

    bound^2 = max over c of sum_k max(max_U d_k - min_c d_k, max_c d_k - min_U d_k)^2

No two particles of tiles up to `REACH` away have moved further from or to each other than that. In
a flow that changes over many spacings it is less than half of twice the longest way, which bounds
all pairs.
"""

from __future__ import annotations

from math import sqrt
from typing import Any

import numpy as np

from lasersph.particles.cell_grid import CellGrid
from lasersph.particles.neighbors import NeighborList
from lasersph.particles.support import common
from lasersph.physics.ejection import CONDENSED
from lasersph.solvers.ablation.particle_state import ParticleState

REACH = 2
"""Tiles to either side whose particles are compared with those of a tile."""
WIDTH = 0.6
"""Least width of a tile over the longest distance of listed pairs: what is more than `REACH` tiles
away must be out of reach for some steps. Narrower tiles bound closer and take longer."""
WIDER = 1.25
"""Factor of the width as long as there are more tiles than particles."""


def way_ahead(x, x_listed, v, kind, dt):
    """Way since the pairs were found and for `dt` [s] more, of what is condensed [m]."""
    return (1.0 if kind == CONDENSED else 0.0) * (x + dt * v - x_listed)


def of_particles(way_j):
    """Way of a particle [m], for the largest and the smallest of each component in a tile."""
    return way_j, way_j


def of_tiles(high_j, low_j):
    """Largest and smallest components of a tile [m], for those of tiles along an axis."""
    return high_j, low_j


def apart_square(most, least, total_0, total_1):
    """Square of the bound for one tile [m^2]: its largest and smallest, and those around it."""
    square = between_square(most[0], least[0], total_0[0], total_1[0])
    if len(most) > 1:
        square = square + between_square(most[1], least[1], total_0[1], total_1[1])
    if len(most) > 2:
        square = square + between_square(most[2], least[2], total_0[2], total_1[2])
    return square


def between_square(most, least, most_around, least_around):
    """Square of the largest difference of a component [m^2]; 0 of a tile without particles."""
    difference = max(max(most_around - least, most - least_around), 0.0)
    return difference * difference


class RelativeMotion:
    """Bound of the ways that particles have moved relative to each other.

    Args:
        listed: (dim, N) places where the pairs were found, kept up to date [m]. reach: longest
            distance of listed pairs [m].

    Attributes:
        clear: distance [m] beyond which particles may be in tiles that are not compared.
    """

    def __init__(self, particles: ParticleState, listed: Any, reach: float) -> None:
        backend, geometry = particles.backend, particles.geometry
        self.particles, self.listed = particles, listed
        self._members: NeighborList | None = None
        low, high = np.array(geometry.box).T
        width = WIDTH * reach
        self._tiles = CellGrid(backend, low, high - low, width)
        while self._tiles.count > particles.total:
            width *= WIDER
            self._tiles = CellGrid(backend, low, high - low, width)
        self.clear = REACH * float(self._tiles.width.min())
        self._way = backend.zeros((geometry.dimension, particles.total))
        size = (geometry.dimension, self._tiles.count)
        self._ends, *self._around = (
            (backend.zeros(size), backend.zeros(size)) for _ in range(geometry.dimension)
        )
        self._lines = [self._along(axis) for axis in range(geometry.dimension)]

    def _along(self, axis: int) -> NeighborList:
        """The tiles up to `REACH` away along an axis from each, as rows of a list."""
        shape, backend = self._tiles.shape, self.particles.backend
        own = np.arange(shape[axis])
        near = own[:, None] + np.arange(-REACH, REACH + 1)
        if self.particles.geometry.period[axis] > 0.0:
            near %= shape[axis]
        near = np.clip(near, 0, shape[axis] - 1)
        stride = int(np.prod(shape[axis + 1 :]))
        place = np.arange(self._tiles.count)
        number = place // stride % shape[axis]
        neighbor = (place[:, None] + (near[number] - number[:, None]) * stride).ravel()
        start = np.arange(0, neighbor.size + 1, 2 * REACH + 1)
        return NeighborList(
            backend.asarray(start, "offset"), backend.asarray(neighbor, "index"),
            None, None, None, common, (),
        )  # fmt: skip

    def forget(self) -> None:
        """Pairs are found anew: particles will be in other tiles."""
        self._members = None

    def bound(self, step: float) -> float:
        """The bound [m] after `step` [s] at the velocities that particles have now."""
        particles, backend = self.particles, self.particles.backend
        if self._members is None:
            self._members = self._found()
        level = particles.now
        fields = {"x": level.x, "x_listed": self.listed, "v": level.v, "kind": particles.kind}
        backend.pointwise(way_ahead, fields, self._way, dt=step)
        how = ("max", "min")
        backend.pair_sum(of_particles, self._members, {"way": self._way}, self._ends, combine=how)
        *lines, last = self._lines
        high, low = self._ends
        for line, out in zip(lines, self._around, strict=False):
            backend.pair_sum(of_tiles, line, {"high": high, "low": low}, out, combine=how)
            high, low = out
        most, least = self._ends
        fields = {"high": high, "low": low, "most": most, "least": least}
        (square,) = backend.pair_sum(
            of_tiles, last, fields, (None,), combine=how, finish=apart_square, reduce=("max",)
        )
        return sqrt(max(square, 0.0))

    def _found(self) -> NeighborList:
        """The particles of each tile, as rows of a list."""
        backend, total = self.particles.backend, self.particles.total
        tile, start = backend.zeros(total, "index"), backend.zeros(self._tiles.count + 1, "offset")
        self._tiles.find(self.listed, tile)
        backend.exclusive_scan(backend.count_by_key(tile, self._tiles.count), start)
        order = backend.sort_by_key(tile, self._tiles.count)
        return NeighborList(start, order, None, self.particles.support, None, common, ())
