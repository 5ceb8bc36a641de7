"""Particles that the benchmarks share."""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pair_functions as functions

from lasersph.compute import search


@dataclass(frozen=True)
class Wendland:
    """Wendland C2 kernel in 3-D."""

    dimension: int = 3
    sigma: float = 21 / (2 * np.pi)
    shape: object = functions.wendland_shape
    slope: object = functions.wendland_slope


def jittered_cube(backend, edge, support=2.9):
    """edge^3 particles near a lattice of spacing 1 m, sorted by cell, with their neighbor list."""
    axis = np.arange(edge, dtype=float)
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
    position = np.array([x.ravel(), y.ravel(), z.ravel()])
    position += 0.2 * np.random.default_rng(1).random(position.shape)
    order = search.cell_order(backend, position, support)
    position = np.ascontiguousarray(position[:, order])
    reach = np.full(edge**3, support)
    row_start, neighbor = search.neighbor_list(
        backend, position, reach, edge**3, mean=functions.arithmetic_mean
    )
    return SimpleNamespace(
        row_start=row_start, neighbor=neighbor, position=position, support=reach,
        kernel=Wendland(), mean=functions.arithmetic_mean, period=(0.0, 0.0, 0.0),
    )  # fmt: skip


def fastest(first, second, rounds=15):
    """Shortest times [s] of two calls, timed in turn so that both meet the same machine."""
    from time import perf_counter

    times = ([], [])
    for _ in range(rounds):
        for call, record in zip((first, second), times, strict=True):
            start = perf_counter()
            call()
            record.append(perf_counter() - start)
    return min(times[0]), min(times[1])
