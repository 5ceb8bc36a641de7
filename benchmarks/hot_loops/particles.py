"""Particles that are measured with: off a lattice, sorted by cell, with their neighbor list."""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.compute import search
from lasersph.compute.backend import Backend
from lasersph.compute.cell_grid import CellGrid
from lasersph.particles.neighbor_lists import NeighborList
from lasersph.particles.support import arithmetic


def shape_of(neighbors: NeighborList) -> tuple[int, int]:
    """Dimension and number of the particles of a list."""
    assert neighbors.position is not None
    dimension, count = neighbors.position.shape
    return dimension, count


def jittered(backend: Backend, edge: int, kernel: Any, support: float = 2.9) -> NeighborList:
    """edge^dim particles near a lattice of spacing 1 m, with all their pairs.

    Args:
        kernel: as `sph.kernels.kernel`; decides the dimension. support: radius [m].
    """
    axis, dimension = np.arange(edge, dtype=float), kernel.dimension
    lattice = np.meshgrid(*(axis,) * dimension, indexing="ij")
    position = np.array([x.ravel() for x in lattice[::-1]])
    position += 0.2 * np.random.default_rng(1).random(position.shape)
    grid = CellGrid.over(np.zeros(dimension), np.full(dimension, float(edge)), support)
    cell = grid.find_cells(backend, backend.asarray(position))
    order = backend.to_host(backend.sort_by_key(cell, grid.count))
    sorted_position = backend.asarray(position[:, order])
    support_radius = backend.asarray(np.full(edge**dimension, support))
    row_start, neighbor = search.neighbor_list(
        backend, sorted_position, support_radius, edge**dimension, mean=arithmetic
    )
    return NeighborList(
        row_start, neighbor, sorted_position, support_radius, kernel, arithmetic, (0.0,) * dimension
    )
