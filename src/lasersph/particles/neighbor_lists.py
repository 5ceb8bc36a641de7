"""Neighbor lists: pairs of particles in compressed rows.

Three ways lead to a list, which loops over pairs take alike:

    find_neighbors    of particles that stay (static), or of chosen rows among all (partial)
    search_pairs      of chosen rows among chosen particles of one support, or of all
    `VerletList`      of particles that move (`verlet_list`), kept until near ones have moved apart
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from lasersph.compute import search
from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import element
from lasersph.particles.support import common

Mean = Callable[[float, float], float]
"""Support radius of a pair from those of its particles."""


class Box(NamedTuple):
    """Corners of a box [m], and the length of its period along each axis [m], 0 where none is."""

    low: tuple[float, ...]
    high: tuple[float, ...]
    period: tuple[float, ...]


@dataclass(frozen=True)
class NeighborList:
    """Pairs in compressed rows.

    Attributes:
        row_start: (n + 1,) kind "offset". neighbor: (pairs,) kind "index". row_end: (n,) kind
            "offset", None where each row ends with the next one.
        position: (dim, N) [m]; N >= n. support: (N,) [m]. Both None where loops read neither.
        kernel: sph.kernels.Kernel. mean: see above. period: as of `Box`.
    """

    row_start: Array
    neighbor: Array
    position: Array | None = None
    support: Array | None = None
    kernel: Any = None
    mean: Mean = common
    period: tuple[float, ...] = ()
    row_end: Array | None = None

    def without_ghosts(self, backend: Backend, source: Array) -> NeighborList:
        """The same pairs with every dummy replaced by the particle that it stands for.

        Fit for sums with per-pair weights: positions of real particles only remain.
        """
        neighbor = backend.zeros(self.neighbor.shape[0], "index")
        backend.gather(source, self.neighbor, neighbor)
        return self.with_neighbors(backend, neighbor)

    def with_neighbors(self, backend: Backend, neighbor: Rows) -> NeighborList:
        """The same rows with other neighbors, all among the particles that have rows."""
        # loops take as many particles as the list has positions
        count, position, support = self.row_start.shape[0] - 1, self.position, self.support
        assert position is not None and support is not None
        ends = (backend.head(position, count), backend.head(support, count))
        return replace(self, neighbor=neighbor, position=ends[0], support=ends[1])


@dataclass(frozen=True)
class Subset:
    """Particles of which some rows are searched.

    Attributes:
        members: numbers of all that may be neighbors. wanted: places among them of those whose
            rows are to be found. places: 0, 1, ... of all members.
    """

    members: Rows
    wanted: Rows
    places: Rows


def find_neighbors(
    backend: Backend,
    position: Array,
    support: Array,
    count: int,
    *,
    kernel: Any,
    mean: Mean,
    box: Box | None = None,
    radius: Array | None = None,
    wanted: Rows | None = None,
    total: int | None = None,
    room: search.Room | None = None,
) -> NeighborList:
    """All pairs closer than their support radius, of the first `count` particles with any.

    Args:
        total: how many of the particles there are, the first ones; None for all.
        box: that no particle may leave; default: around them all, as they are. radius: (N,) to
            search within [m], where it is more than the support. wanted: rows that are to be
            found, the others stay empty; None for all. room: where the list is put, in place of
            the last one there; None for memory of its own.

    Raises:
        EscapedParticle: a position that is not finite, or not in the box.
    """
    # around all particles, with room for a support on each side
    if box is None:
        host, margin = backend.to_host(position), float(np.max(backend.to_host(support)))
        ends = host.min(axis=1) - margin, host.max(axis=1) + margin
        low, high = (tuple(float(v) for v in end) for end in ends)
        box = Box(low, high, (0.0,) * host.shape[0])
    # what lies behind the first `total` is spare
    reach, there = support if radius is None else radius, position.shape[1]
    row_start, neighbor = search.neighbor_list(
        backend,
        backend.head(position, total or there),
        backend.head(reach, total or there),
        count,
        mean=mean,
        lower=box.low,
        upper=box.high,
        period=box.period,
        wanted=wanted,
        room=room,
    )
    return NeighborList(row_start, neighbor, position, support, kernel, mean, box.period)


def row_length(place, start):
    """Number of neighbors in a row of a list."""
    return start[place + 1] - start[place]


def search_pairs(
    backend: Backend,
    position: Array,
    radius: Array,
    period: tuple[float, ...],
    subset: Subset | None = None,
    room: search.Room | None = None,
) -> tuple[Array, Array]:
    """row_start (N + 1,) and neighbor of particles whose search radius (N,) is the same [m].

    Args:
        position: (dim, N) [m]. subset: who is searched, None for all; other rows stay empty.
            room: where a list of all is put, in place of the last one there.
    """
    total = position.shape[1]
    if subset is None:
        return search.neighbor_list(
            backend, position, radius, total, mean=common, period=period, room=room
        )
    # members alone, in arrays of their own
    size = subset.members.shape[0]
    x, radii = backend.zeros((position.shape[0], size)), backend.zeros(size)
    backend.gather(position, subset.members, x)
    backend.gather(radius, subset.members, radii)
    start, local = search.neighbor_list(
        backend, x, radii, size, mean=common, period=period, wanted=subset.wanted
    )
    # from places among the members to numbers of particles
    neighbor = backend.zeros(local.shape[0], "index")
    backend.pointwise(element, {"place": local}, neighbor, table=subset.members)

    # rows of all particles: those of no member are empty
    counts, lengths = backend.zeros(total, "index"), backend.zeros(size, "index")
    backend.pointwise(row_length, {"place": subset.places}, lengths, start=start)
    backend.scatter(lengths, subset.members, counts)
    row_start = backend.zeros(total + 1, "offset")
    backend.exclusive_scan(counts, row_start)
    return row_start, neighbor


def members_of(
    backend: Backend,
    key: Array,
    count: int,
    position: Array | None = None,
    into: NeighborList | None = None,
) -> NeighborList:
    """The particles of each of `count` keys, in order, as rows of a list.

    Args:
        key: (n,) of kind "index"; `count` stands for none. position: (dim, n) [m], where loops
            read it. into: an earlier list of as many, whose arrays are written; None for new ones.
    """
    # particles sorted by their key; what has no key comes last
    start, order = backend.rows_by_key(key, count + 1)
    if into is not None:
        backend.copy(backend.head(start, count + 1), into.row_start)
        backend.copy(order, into.neighbor)
        return into
    # loops take the number of particles from the length of the supports
    return NeighborList(backend.head(start, count + 1), order, position, key)
