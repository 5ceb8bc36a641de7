"""Neighbor lists: rows of the real particles, neighbors among real and dummy particles."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from lasersph.compute import search
from lasersph.compute.backend import Backend


@dataclass(frozen=True)
class NeighborList:
    """Pairs in compressed rows.

    Attributes:
        row_start: (n + 1,) uint64. neighbor: (pairs,) uint32.
        position: (dim, N) [m]; N >= n. support: (N,) [m].
        kernel: sph.kernels.Kernel. mean: support radius of a pair from those of its particles.
        period: length of the period along each axis [m], 0 where there is none.
    """

    row_start: Any
    neighbor: Any
    position: Any
    support: Any
    kernel: Any
    mean: Callable[[float, float], float]
    period: tuple[float, ...]

    def folded(self, backend: Backend, source: Any) -> NeighborList:
        """The same pairs with every dummy replaced by the particle that it stands for.

        Fit for sums with per-pair weights: positions of real particles only remain.
        """
        neighbor = backend.zeros(backend.to_host(self.neighbor).size, "index")
        backend.gather(source, self.neighbor, neighbor)
        count = backend.to_host(self.row_start).size - 1
        return replace(
            self,
            neighbor=neighbor,
            position=backend.head(self.position, count),
            support=backend.head(self.support, count),
        )


def find_neighbors(
    backend: Backend,
    position: Any,
    support: Any,
    count: int,
    *,
    kernel: Any,
    mean: Callable[[float, float], float],
) -> NeighborList:
    """All pairs closer than their support radius, of the first `count` particles with any.

    Raises:
        ValueError: a position that is not finite.
    """
    host = backend.to_host(position)
    reach = float(np.max(backend.to_host(support)))
    lower = tuple(float(v) for v in host.min(axis=1) - reach)
    upper = tuple(float(v) for v in host.max(axis=1) + reach)
    period = (0.0,) * host.shape[0]
    row_start, neighbor = search.neighbor_list(
        backend, position, support, count, mean=mean, lower=lower, upper=upper, period=period
    )
    return NeighborList(row_start, neighbor, position, support, kernel, mean, period)
