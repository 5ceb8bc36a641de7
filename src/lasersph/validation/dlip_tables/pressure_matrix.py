"""The published pressure matrix of a small pool, as assembled and as Table 1 prints it."""

from __future__ import annotations

import numpy as np

from lasersph.compute.backend import Backend
from lasersph.particles.kinds import DUMMY, EDGE, FLUID
from lasersph.solvers.melt_pool.published.pressure_equation import (
    REINFORCEMENT,
    PublishedPressure,
)
from lasersph.sph.kernels import kernel
from lasersph.sph.laplacian import weight
from lasersph.validation.lattices import Array, all_pairs, cubic_lattice

SUPPORT = 3.75
SIDE = 15
"""Particles of a side."""
POOL = 2.5
"""Radius in spacings within which they are fluid."""
RIM = 4.0
"""Radius in spacings within which those beyond are edge."""


def pool() -> tuple[Array, Array]:
    """Positions (2, n) at distance 1, and kinds (n,): fluid, two rows of edge, dummies."""
    # Kinds by the distance from the middle.
    position = cubic_lattice(2, SIDE)
    radius = np.hypot(*(position - 0.5 * (SIDE - 1)))
    return position, np.select([radius < POOL, radius < RIM], [FLUID, EDGE], DUMMY)


def assembled(backend: Backend) -> Array:
    """Matrix that the published pressure equation solves, without its reinforced diagonal, (n, n).

    With the sign of Table 1; rows of dummies are zero.
    """
    position, kind = pool()
    # Weights of all pairs, volumes of 1.
    count = kind.size
    neighbors = all_pairs(backend, position, SUPPORT, kernel("quintic-spline", 2))
    weights = backend.zeros(backend.to_host(neighbors.neighbor).size)
    volume = backend.asarray(np.ones(count))
    backend.pair_values(weight, neighbors, {"V": volume}, weights)
    # The operator as the solver assembles it, without its reinforcement.
    equation = PublishedPressure(backend, count)
    source = backend.asarray(np.arange(count), "index")
    equation.set_operator(neighbors, source, weights, backend.asarray(kind, "flag"), volume)
    matrix = equation.matrix
    found = np.diag(backend.to_host(matrix.diagonal) / (1.0 + REINFORCEMENT))
    # Rows of the neighbor list into a full matrix.
    start = backend.to_host(matrix.neighbors.row_start).astype(np.int64)
    row = np.repeat(np.arange(count), np.diff(start))
    column = backend.to_host(matrix.neighbors.neighbor)
    np.add.at(found, (row, column), backend.to_host(matrix.entries))
    found[kind == DUMMY] = 0.0
    return -found


def printed() -> Array:
    """Table 1: sums over pairs, dummies with the nearest edge particle, of these the first."""
    position, kind = pool()
    shape, edges = kernel("quintic-spline", 2), np.flatnonzero(kind == EDGE)
    distance = np.hypot(*(position[:, :, None] - position[:, None, :]))
    # Each dummy belongs to the nearest edge particle within its support.
    owner = np.arange(kind.size)
    dummies = np.flatnonzero(kind == DUMMY)
    near = np.argmin(distance[np.ix_(dummies, edges)], axis=1)
    owner[dummies] = edges[near]
    has_owner = np.ones(kind.size, dtype=bool)
    has_owner[dummies] = np.min(distance[np.ix_(dummies, edges)], axis=1) < SUPPORT
    # Sums over pairs, 2 W'/r each: a dummy counts as its owner.
    matrix = np.zeros_like(distance)
    for i in np.flatnonzero(kind != DUMMY):
        for j in np.flatnonzero((distance[i] < SUPPORT) & has_owner & (owner != i)):
            r = float(distance[i, j])
            e = 2.0 * float(shape.derivative(r, SUPPORT)) / r
            matrix[i, i] += e
            matrix[i, owner[j]] -= e
    return matrix
