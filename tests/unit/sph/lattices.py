"""Lattices and neighbor lists for tests of operators."""

import numpy as np

from lasersph.particles.neighbor_lists import find_neighbors
from lasersph.particles.support import arithmetic
from lasersph.sph.kernels import kernel


def with_neighbors(backend, position, support, name="cubic-spline"):
    """Neighbor list of all particles at `position`, shape (dim, n), with equal support radii."""
    dimension, count = position.shape
    return find_neighbors(
        backend,
        backend.asarray(position),
        backend.asarray(np.full(count, support)),
        count,
        kernel=kernel(name, dimension),
        mean=arithmetic,
    )


def lattice(dimension, side, spacing=1.0):
    """Cubic lattice of side^dimension particles, shape (dim, n); the last axis varies fastest."""
    axes = np.meshgrid(*[spacing * np.arange(side)] * dimension, indexing="ij")
    return np.array([axis.ravel() for axis in axes])
