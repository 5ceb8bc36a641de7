"""Neighbor list: all pairs with r_ij < mean(l_i, l_j), j != i.

Particles are binned into levels by their support l, the finest and then powers of two, each level
with its own bounding box and cells, so that a set whose supports span any ratio costs in proportion
to its particles and pairs. `mean` must grow with both arguments, and l > 0. Lists are one-sided:
the row of i holds all its neighbors, in the order of levels, cells and particle numbers, which does
not depend on the number of threads. On a periodic axis the nearest image counts.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf, isfinite
from typing import Any, NamedTuple

import numpy as np

from lasersph.compute import source
from lasersph.compute.array_function import ArrayFunction, array_function
from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.cell_grid import CellGrid
from lasersph.compute.generate import BLOCK
from lasersph.compute.key_order import rows_where
from lasersph.compute.scan import ScanText, scan_text, sort_text, store_text

FINEST = 1.1
"""Largest support of the first level over the smallest; in the following levels twice as much."""
_CELLS_PER_PARTICLE = 4
_PLACES_PER_ROW = 256
"""At first; a list with more neighbors per particle is begun anew. Memory not written is free."""
SPARE = 4
"""Part of a list that is kept free for a longer one to come; unwritten, it costs nothing."""
_scans: dict[tuple, ScanText] = {}


class EscapedParticle(ValueError):
    """A particle is not finite or left the box."""


class Room:
    """Memory that lists take one after the other: untouched pages cost as much as finding pairs.

    A list that was found in a room is lost when the next one is found in it.

    Attributes:
        row_start: of the list. neighbor: neighbors of the list, and room for more. scratch:
            (blocks, places) of a group.
    """

    def __init__(self) -> None:
        self.row_start = np.zeros(0, dtype=np.uint64)
        self.neighbor = self._given = np.empty(0, dtype=np.uint32)
        self.scratch = np.empty((0, 0), dtype=np.uint32)

    def for_rows(self, count: int) -> np.ndarray:
        """Row pointers of so many rows; the first is 0."""
        if self.row_start.size != count + 1:
            self.row_start = np.zeros(count + 1, dtype=np.uint64)
        return self.row_start

    def listed(self, pairs: int) -> np.ndarray:
        """The neighbors of so many pairs and a few places more, which name particle 0: an array
        that stays while the number of pairs changes a little."""
        given = self._given
        if given.base is not self.neighbor or not pairs <= given.size <= 2 * pairs:
            self._given = self.neighbor[: pairs + pairs // (2 * SPARE)]
        self._given[pairs:] = 0
        return self._given

    def for_group(self, blocks: int, places: int) -> np.ndarray:
        """Scratch for at least so many blocks of rows and places for the neighbors of each."""
        if self.scratch.shape[0] < blocks or self.scratch.shape[1] < places:
            self.scratch = np.empty((blocks, places), dtype=np.uint32)
        return self.scratch

    def lengthen(self, kept: int, length: int) -> np.ndarray:
        """Room for a list of a length and for the next one, with the first entries kept."""
        if length > self.neighbor.size:
            before, self.neighbor = (
                self.neighbor,
                np.empty(length + length // SPARE, dtype=np.uint32),
            )
            self.neighbor[:kept] = before[:kept]
        return self.neighbor


class _Cells(NamedTuple):
    """Levels of cells: one row or entry per level; cells and members are concatenated."""

    position: np.ndarray
    support: np.ndarray
    order: np.ndarray
    starts: np.ndarray
    first_cell: np.ndarray
    first_member: np.ndarray
    low: np.ndarray
    high: np.ndarray
    inverse: np.ndarray
    shape: np.ndarray
    largest: np.ndarray
    smallest: np.ndarray


def neighbor_list(
    backend: Backend,
    position: Array,
    support: Array,
    count: int,
    *,
    mean: Callable[[float, float], float],
    lower: Sequence[float] | None = None,
    upper: Sequence[float] | None = None,
    period: Sequence[float] = (),
    wanted: Rows | None = None,
    room: Room | None = None,
) -> tuple[Array, Rows]:
    """Neighbors of the first `count` particles among all.

    Cells are counted from the corners of the box where they are given, so that the order within a
    row follows from the positions of its own particles alone.

    Args:
        position: [m], shape (dim, N). support: l per particle [m], shape (N,).
        mean: plain function (l_i, l_j) -> l_ij, growing with both.
        lower, upper: box [m] that no particle may leave; None for no limit.
        period: width of the box per axis [m], 0.0 where not periodic; () for no periodic axis.
        wanted: rows that are to be found, kind "index"; the others stay empty. None for all.
        room: where the list is put, in place of the last one there; None for memory of its own.

    Returns:
        row_start, kind "offset", shape (count + 1,), and neighbor, kind "index": both in the room
        where there is one, in which neighbor has a few places more than there are pairs.

    Raises:
        EscapedParticle: a position is not finite or outside the box; number and position are named.
        ValueError: a support is not positive, a period is not longer than twice the largest search
            radius or shorter than the particles' extent, or more than 2^32 - 1 particles.
    """
    # shapes, before anything is computed from them
    host, supports = backend.unwrap(position), backend.unwrap(support)
    dimension, total = host.shape
    widths = np.array(tuple(period) or (0.0,) * dimension, dtype=backend.real)
    if not 0 <= count <= total or supports.shape != (total,) or widths.shape != (dimension,):
        raise ValueError(f"{count} rows, {total} particles, {supports.shape[0]} supports")
    if total >= 2**32 - 1:
        raise ValueError(f"{total} particles; a list holds fewer than 2^32 - 1")

    # a graphics card has a search of its own, which gives the same lists
    if backend.search is not None:
        return backend.search.neighbor_list(
            host,
            supports,
            count,
            mean=mean,
            lower=lower,
            upper=upper,
            period=period,
            wanted=None if wanted is None else backend.unwrap(wanted),
        )

    # refuse positions and supports that no cell could hold
    host, supports = np.ascontiguousarray(host), np.ascontiguousarray(supports)
    refuse_escape(host, lower, upper)
    smallest, largest = (supports.min(), supports.max()) if total else (1.0, 1.0)
    if not (smallest > 0.0 and isfinite(largest)):  # not a number is neither
        refuse_support(supports)
    used = room or Room()
    row_start = used.for_rows(count)

    # a list without rows needs no cells
    if count == 0:
        return backend.wrap(row_start), backend.wrap(np.zeros(0, dtype=np.uint32))

    # only the nearest image of a neighbor counts: a period holds two search radii
    if widths.any():
        refuse_short_period(np.ptp(host, axis=1), widths, float(mean(largest, largest)))
    periodic = tuple(bool(width) for width in widths)

    # loops for this dimension and mean, and the particles sorted by cell
    scan = array_function(_scan(dimension, mean, periodic).text, "scan", backend.precision)
    sort = array_function(sort_text(dimension), "sort", backend.precision)
    cells = _levels(sort, host, supports, mean, lower, upper, (smallest, largest))

    # the search radius is widened by what rounding of positions may take from a pair
    extent = float(max(*map(abs, (*cells.low.flat, *cells.high.flat)), *widths))
    slack = 8.0 * np.finfo(backend.real).eps * (extent + float(largest))
    targets = host
    if wanted is not None:  # the others lie where nothing is near
        rows = backend.unwrap(wanted)
        targets = np.full_like(host, np.inf)
        targets[:, rows] = host[:, rows]

    # find the pairs of each row and join them to one list
    widening = np.array([slack], backend.real)
    arguments = (count, targets, supports, *cells, widening, widths)
    pairs = _scanned(scan, backend, arguments, count, row_start, used)
    neighbor = used.neighbor[:pairs] if room is None else room.listed(pairs)
    return backend.wrap(row_start), backend.wrap(neighbor)


def _scan(dimension: int, mean: Callable, periodic: tuple[bool, ...]) -> ScanText:
    """Text of the scan, written anew only where something that it was made from has changed."""
    key = (dimension, mean, periodic)
    if key not in _scans or not source.is_current(_scans[key].watched):
        _scans[key] = scan_text(*key)
    return _scans[key]


def _scanned(
    scan: ArrayFunction,
    backend: Backend,
    arguments: tuple,
    count: int,
    row_start: np.ndarray,
    room: Room,
) -> int:
    """Scan groups of blocks into scratch, growing it where it is too short, and join them in the
    room; returns the number of pairs."""
    store = array_function(store_text(), "store", backend.precision)

    # scratch for a group of blocks; each block lists its own rows there
    blocks, group = -(-count // BLOCK), 32 * backend.threads
    scratch = room.for_group(min(group, blocks), _PLACES_PER_ROW * min(BLOCK, count))
    ends = np.empty(count, dtype=np.uint64)
    used = np.empty(group, dtype=np.uint64)
    neighbor = room.neighbor
    filled = begin = 0
    while begin < blocks:
        end = min(begin + group, blocks)
        share = {"blocks": end - begin, "threads": backend.threads}
        # scan: neighbors of each block, each into its own row of scratch
        scan(begin, used, *arguments, scratch, ends, **share)
        # where a block has run out of scratch, the group begins anew with twice as much
        counts = used[: end - begin]
        if counts.max() > scratch.shape[1]:
            scratch = room.for_group(scratch.shape[0], 2 * scratch.shape[1])
            continue
        # place of each block in the list: the exclusive sum of the pairs before it
        bases = np.uint64(filled) + np.cumsum(counts, dtype=np.uint64) - counts
        before, filled = filled, filled + int(counts.sum())
        if filled > neighbor.size:  # memory that is never written costs nothing
            neighbor = room.lengthen(before, filled + (blocks - end) * int(counts.max()))
        # store: copy the blocks to their places and set the row pointers
        store(begin, count, bases, scratch, ends, row_start, neighbor, **share)
        begin = end
    return filled


def _levels(
    sort: ArrayFunction,
    position: np.ndarray,
    support: np.ndarray,
    mean: Callable,
    lower: Sequence[float] | None,
    upper: Sequence[float] | None,
    ends: tuple[Any, Any],
) -> _Cells:
    """Sort the particles into levels and cells; `ends` are the least and the largest support."""
    # level of a particle: how often its support doubles from that of the finest level
    dimension, total = position.shape
    smallest = ends[0]
    if ends[1] < FINEST * smallest:
        groups = [np.arange(total, dtype=np.uint32)]
    else:
        level = np.frexp(support / (FINEST * smallest))[1]
        level = (level - level.min()).astype(np.uint32)
        groups = [rows_where(level, k) for k in range(level.max() + 1)]
        groups = [group for group in groups if group.size]

    # columns of all levels, filled level after level
    order = np.empty(total, dtype=np.uint32)
    real = position.dtype
    low, high = (np.empty((len(groups), dimension), real) for _ in range(2))
    inverse, largest, least = (np.empty(len(groups), real) for _ in range(3))
    shape = np.empty((len(groups), dimension), np.int64)
    first_cell, first_member = (np.zeros(len(groups), np.uint64) for _ in range(2))
    starts, cells, members = [], 0, 0
    for k, group in enumerate(groups):
        # box of the level, and its least and largest support
        single = group.size == total
        if lower is None or upper is None:
            part = position if single else np.ascontiguousarray(position[:, group])
        low[k] = part.min(axis=1) if lower is None else lower
        high[k] = part.max(axis=1) if upper is None else upper
        least[k], largest[k] = ends
        if not single:
            supports = support[group]
            least[k], largest[k] = supports.min(), supports.max()
        # counting sort into cells as wide as the longest search radius in the level
        size = float(mean(largest[k], largest[k]))
        place = order[members : members + group.size]
        start, shape[k], inverse[k] = _sorted(sort, position, group, low[k], high[k], size, place)
        # cells and members of a level follow those of the level before
        first_cell[k], first_member[k] = cells, members
        starts.append(start)
        cells, members = cells + start.size, members + group.size

    # positions and supports in the order of the cells, so that a scan reads them in a row
    return _Cells(
        np.take(position, order, axis=1),
        support[order],
        order,
        starts[0] if len(starts) == 1 else np.concatenate(starts),
        first_cell,
        first_member,
        low,
        high,
        inverse,
        shape,
        largest,
        least,
    )


def _sorted(
    sort: ArrayFunction,
    position: np.ndarray,
    members: np.ndarray,
    low: np.ndarray,
    high: np.ndarray,
    size: float,
    order: np.ndarray,
) -> tuple[np.ndarray, np.ndarray, Any]:
    """Sort members by cell into `order`; first member per cell, cells per axis, 1 / size."""
    found = grid(low, high, size, members.size)
    shape, inverse = np.array(found.shape, np.int64), np.array(found.inverse[:1], position.dtype)
    start = np.empty(found.count + 1, dtype=np.uint32)
    cell = np.empty(members.size, dtype=np.uint32)
    sort(position, members, low, inverse, shape, cell, start, order)
    return start, shape, inverse[0]


def grid(low: np.ndarray, high: np.ndarray, size: float, members: int) -> CellGrid:
    """Cells of an edge of `size` [m] in a box, or larger where there are few members."""
    return CellGrid.of_width(low, high, size, _CELLS_PER_PARTICLE * members + 64)


def refuse_escape(
    position: np.ndarray, lower: Sequence[float] | None, upper: Sequence[float] | None
) -> None:
    """Raise EscapedParticle where a position, host array (dim, n) [m], is not finite or outside."""
    if not position.size:
        return
    # quick test by the extremes; comparisons with NaN are false, so NaN fails as well
    dimension = position.shape[0]
    low = (-inf,) * dimension if lower is None else lower
    high = (inf,) * dimension if upper is None else upper
    ends = zip(position.min(axis=1), position.max(axis=1), low, high, strict=True)
    if all(-inf < least >= bottom and inf > most <= top for least, most, bottom, top in ends):
        return
    # something is outside: find the first particle and name it
    corners = np.asarray(low, float), np.asarray(high, float)
    inside = np.isfinite(position)
    inside &= (position >= corners[0][:, None]) & (position <= corners[1][:, None])
    outside = np.flatnonzero(~inside.all(axis=0))
    number = int(outside[0])
    place = ", ".join(f"{x:.6g}" for x in position[:, number])
    box = "" if lower is None and upper is None else f"; the box is {_box(low)} to {_box(high)} m"
    others = f" and {outside.size - 1} more" if outside.size > 1 else ""
    raise EscapedParticle(f"particle {number} escaped: position ({place}) m{box}{others}")


def _box(corner: Sequence[float]) -> str:
    return "(" + ", ".join(f"{x:.6g}" for x in corner) + ")"


def refuse_support(support: np.ndarray) -> None:
    """Raise ValueError for the first support, host array (n,) [m], that is not positive."""
    bad = int(np.flatnonzero(~(np.isfinite(support) & (support > 0.0)))[0])
    raise ValueError(f"support of particle {bad} is {support[bad]} m; it must be positive")


def refuse_short_period(extent: np.ndarray, widths: np.ndarray, radius: float) -> None:
    """Raise ValueError where the period `widths` [m] of an axis is too short.

    Args:
        extent: of the particles along each axis [m]. radius: longest distance of a pair [m].
    """
    # one image of a neighbor is in reach where L > 2 r, at most one period away where all lie in L
    for k, width in enumerate(widths):
        if width == 0.0:
            continue
        if not width > 2.0 * radius:
            raise ValueError(
                f"period {width:.6g} m of axis {k} must be longer than twice the search"
                f" radius {radius:.6g} m of a particle; use more particles per period"
            )
        if extent[k] > width:
            raise ValueError(
                f"particles span {extent[k]:.6g} m along axis {k},"
                f" more than its period {width:.6g} m"
            )
