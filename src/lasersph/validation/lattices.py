"""Particles on lattices with their neighbor lists, for validations of operators."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.backend import Backend
from lasersph.particles.neighbor_lists import NeighborList, find_neighbors
from lasersph.particles.support import arithmetic
from lasersph.sph.kernels import Kernel

Array = NDArray[np.float64]


def cubic_lattice(dimension: int, side: int, spacing: float = 1.0) -> Array:
    """Positions of side^dimension particles, shape (dimension, n)."""
    # The axes in the order of the index.
    axes = np.meshgrid(*[spacing * np.arange(float(side))] * dimension, indexing="ij")
    return np.array([axis.ravel() for axis in axes], dtype=np.float64)


def all_pairs(backend: Backend, position: Array, support: float, kernel: Kernel) -> NeighborList:
    """Neighbor list of all particles with equal support radii [m]."""
    count = position.shape[1]
    return find_neighbors(
        backend,
        backend.asarray(position),
        backend.asarray(np.full(count, support)),
        count,
        kernel=kernel,
        mean=arithmetic,
    )
