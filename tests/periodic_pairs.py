"""Particles near a lattice in a box of 1 m that repeats along 1, 2 or 3 axes, with their pairs."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from lasersph.particles.neighbor_lists import Box, NeighborList, find_neighbors
from lasersph.particles.support import arithmetic
from lasersph.sph.kernels import kernel
from lasersph.sph.laplacian import weight
from lasersph.sph.lattice_sums import second_moment

RATIO = 3.75


@dataclass(frozen=True)
class PeriodicPairs:
    """Pairs with weights g_ij [m^(d-2)] that are exact on a lattice for straight lines.

    position: (d, n) [m]. neighbors, weights: on the backend. support: radius, spacing: of the
    lattice [m].
    """

    position: np.ndarray
    neighbors: NeighborList
    weights: Any
    support: float
    spacing: float

    @property
    def period(self):
        return (1.0,) * self.position.shape[0]

    @property
    def count(self):
        return self.position.shape[1]

    @property
    def volume(self):
        return np.full(self.count, 1.0 / self.count)

    def dense_product(self, backend, p):
        """sum_j g_ij (p_i - p_j) on the host."""
        i, j, g = self.pairs(backend)
        return np.bincount(i, g * (p[i] - p[j]), minlength=self.count)

    def pairs(self, backend):
        """i, j and g of all pairs on the host."""
        length = np.diff(backend.to_host(self.neighbors.row_start).astype(np.int64))
        j = backend.to_host(self.neighbors.neighbor)[: length.sum()]
        g = backend.to_host(self.weights)[: length.sum()]
        return np.repeat(np.arange(self.count), length), j, g


def periodic_pairs(backend, dimension, side, *, jitter=0.0, seed=2):
    """Pairs of side^dimension particles, displaced by up to `jitter` spacings along each axis."""
    place = np.indices((side,) * dimension).reshape(dimension, -1) + 0.5
    place = place + np.random.default_rng(seed).uniform(-jitter, jitter, place.shape)
    position, support = (place / side) % 1.0, RATIO / side
    shape, count = kernel("quintic-spline", dimension), position.shape[1]
    zero, one = (0.0,) * dimension, (1.0,) * dimension
    neighbors = find_neighbors(
        backend, backend.asarray(position), backend.asarray(np.full(count, support)), count,
        kernel=shape, mean=arithmetic, box=Box(zero, one, one),
    )  # fmt: skip
    weights = backend.zeros(neighbors.neighbor.shape[0])
    V = np.full(count, 1.0 / np.sqrt(second_moment(shape, RATIO)) / count)
    backend.pair_values(weight, neighbors, {"V": backend.asarray(V)}, weights)
    return PeriodicPairs(position, neighbors, weights, support, 1.0 / side)
