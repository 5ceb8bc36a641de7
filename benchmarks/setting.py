"""Particles that the benchmarks share."""

from dataclasses import dataclass

import numpy as np
import pair_functions as functions
from hot_loops.particles import jittered


@dataclass(frozen=True)
class Wendland:
    """Wendland C2 kernel in 3-D."""

    dimension: int = 3
    sigma: float = 21 / (2 * np.pi)
    shape: object = functions.wendland_shape
    slope: object = functions.wendland_slope


def jittered_cube(backend, edge):
    """edge^3 particles near a lattice of spacing 1 m, sorted by cell, with their neighbor list."""
    return jittered(backend, edge, Wendland())


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
