"""Neighbor list and renewal of rows on the graphics card; see `search` and `row_renewal`.

Levels and cells are those of the processor's search. Only what says how large the grid is goes to
the host: corners, largest supports and numbers of pairs. The walk over levels, periodic images and
rows of cells is that of `scan`, by a thread per target; it is made twice, first to count a row's
neighbors, then to store them, so that each row has its place and the order within it is that of the
processor's lists.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from lasersph.compute import cache, cuda_kernels, cuda_memory
from lasersph.compute.cell_grid import CellGrid
from lasersph.compute.cuda_array import CudaArray
from lasersph.compute.cuda_launch import HEAD, INNER, supported
from lasersph.compute.cuda_memory import start
from lasersph.compute.row_renewal import SPARE, PairRows
from lasersph.compute.scan import distance, images, indented
from lasersph.compute.search import (
    FINEST,
    grid,
    refuse_escape,
    refuse_short_period,
    refuse_support,
)
from lasersph.compute.source import SourceUnit
from lasersph.compute.vectors import element

_SCAN = '''{mean}

@cuda.jit
def scan(count, {targets}, support, {sorted_positions}, sorted_support, order, starts, first_cell,
         low, high, inverse, shape, largest, slack, period, row_start, counts, neighbor, stores):
    """Count the neighbors of each target, or store them from row_start on."""
    member = ZERO
    step = np.uint64(cuda.gridsize(1))
    i = np.uint64(cuda.grid(1))
    while i < count:
        place = row_start[i] if stores else ZERO
        li = support[i]
{load_targets}
        for level in range(largest.size):
            radius = f__mean_of(li, largest[level]) + slack
            size = real(1.0) / inverse[level]
            cells = first_cell[level]
{images}
        if not stores:
            counts[i] = np.uint32(place)
        i += step
'''


class _Level(NamedTuple):
    """Particles whose supports lie within a power of two."""

    low: np.ndarray
    high: np.ndarray
    largest: float
    count: int


def level_of(support, smallest):
    """How often a support can be halved before it is less than `FINEST` times the smallest."""
    # count the halvings until the support is in the finest level
    ratio, level = support / (FINEST * smallest), 0
    while ratio >= 1.0:
        ratio, level = 0.5 * ratio, level + 1
    return level


def cell_in_level(x, level, first_cell, inverse, low, shape):
    """Cell of a particle, the first axis fastest; those of a level follow those before it."""
    # Horner's rule from the last axis inward, so that the first one runs fastest
    number = 0 * level
    for k in range(len(x) - 1, -1, -1):
        c = min(int((x[k] - low[level][k]) * inverse[level]), shape[level][k] - 1)
        number = number * shape[level][k] + c
    return first_cell[level] + number


class CudaSearch:
    """Searching for one backend."""

    def __init__(self, backend: Any) -> None:
        self.backend = backend

    def neighbor_list(
        self,
        position: CudaArray,
        support: CudaArray,
        count: int,
        *,
        mean: Callable[[float, float], float],
        lower: Sequence[float] | None,
        upper: Sequence[float] | None,
        period: Sequence[float],
        wanted: CudaArray | None,
    ) -> tuple[CudaArray, CudaArray]:
        """Row pointers and neighbors; see `search.neighbor_list`."""
        # box of the particles; their positions stay on the card unless one has escaped
        backend, (dimension, total) = self.backend, position.shape
        if total == 0:
            return backend.zeros(1, "offset"), backend.zeros(0, "index")
        low, high = self._corners(position, None)
        self._refuse_escape(position, low, high, lower, upper)

        # refuse supports and periods that no cell could hold
        smallest, largest = self.backend.extremes(support, None)
        if not (smallest > 0.0 and np.isfinite(largest)):
            refuse_support(support.to_host())
        if count == 0:
            return backend.zeros(1, "offset"), backend.zeros(0, "index")
        widths = np.array(tuple(period) or (0.0,) * dimension, backend.real)
        refuse_short_period(high - low, widths, float(mean(largest, largest)))

        # levels of supports, and a grid of cells for each
        number, levels = self._levels(
            position, support, (smallest, largest), (low, high), (lower, upper)
        )
        grids = [
            grid(one.low, one.high, float(mean(one.largest, one.largest)), one.count)
            for one in levels
        ]

        # sort by cell: particles of a cell lie side by side in memory
        key = self._cells(position, number, [one.low for one in levels], grids)
        cells = sum(one.count for one in grids)
        starts, order = backend.rows_by_key(key, cells)
        x, l_j = backend.zeros(position.shape), backend.zeros(total)
        backend.gather(position, order, x)
        backend.gather(support, order, l_j)

        # the search radius is widened by what rounding of positions may take from a pair
        extent = max(*(np.abs([one.low, one.high]).max() for one in levels), widths.max())
        slack = backend.real.type(8.0 * np.finfo(backend.real).eps * (extent + largest))

        # parameters of the scan in the order of its kernel
        arguments = (
            *self._targets(position, wanted).parts,
            support.parts[0],
            *x.parts,
            l_j.parts[0],
            order.parts[0],
            starts.parts[0],
            cuda_memory.from_host(_first_cells(grids)),
            *self._tables(levels, grids),
            slack,
            cuda_memory.from_host(widths),
        )

        # the kernel for this dimension, mean and periodic axes
        periodic = tuple(bool(width) for width in widths)
        text = cuda_scan_text(backend.precision, dimension, mean, periodic)
        return self._scanned(cache.load(text).scan, count, arguments)

    def find_places(self, rows: CudaArray, begin: CudaArray, places: Sequence[CudaArray]) -> None:
        """Set room, begin and end of rows that take the lengths of those of another list."""
        backend, (room, row_start, end) = self.backend, places
        # rows that do not fit go behind all others, one after the other
        count, behind = rows.size, backend.empty(rows.size + 1, np.uint64)
        counts = backend.empty(count, np.uint32)
        lengths = rows.parts[0], begin.parts[0], room.parts[0], counts.parts[0]
        start(cuda_kernels.lengths_beyond_room, count, *lengths, np.uint64(SPARE))
        backend.exclusive_scan(counts, behind)
        free, last = np.uint64(row_start.last()), end.size
        ends = behind.parts[0], row_start.parts[0], end.parts[0]
        start(cuda_kernels.take_places, count, *lengths, *ends, free)
        end_of_all = row_start.parts[0].cut(last, last + 1)
        start(cuda_kernels.fill, 1, end_of_all, free + np.uint64(behind.last()))
        for one in places:
            one.changed()

    def copy_rows(self, rows: CudaArray, found: PairRows, kept: PairRows) -> None:
        """Copy the neighbors and values of rows to their places."""
        begin, *parts = map(self.backend.unwrap, found)
        row_start, *copies = map(self.backend.unwrap, kept)
        where = rows.parts[0], begin.parts[0], row_start.parts[0]
        for part, copy in zip(parts, copies, strict=True):
            start(cuda_kernels.copy_rows, rows.size, *where, part.parts[0], copy.parts[0])
            copy.changed()

    # --- parts of the search --------------------------------------------------------------------

    def _corners(
        self, position: CudaArray, rows: CudaArray | None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper corner of the box around particles [m]."""
        axes = range(position.shape[0])
        ends = [self.backend.extremes(position.component(k), rows) for k in axes]
        low, high = np.array(ends, self.backend.real).T
        return low, high

    def _refuse_escape(
        self,
        position: CudaArray,
        least: np.ndarray,
        most: np.ndarray,
        lower: Sequence[float] | None,
        upper: Sequence[float] | None,
    ) -> None:
        """Raise EscapedParticle; positions are only fetched to name the particle."""
        # extremes tell whether any particle is outside, but not which
        is_inside = np.isfinite(least).all() and np.isfinite(most).all()
        is_inside = is_inside and (lower is None or (least >= np.asarray(lower)).all())
        is_inside = is_inside and (upper is None or (most <= np.asarray(upper)).all())
        if not is_inside:
            refuse_escape(position.to_host(), lower, upper)

    def _levels(
        self,
        position: CudaArray,
        support: CudaArray,
        ends: tuple[float, float],
        corners: tuple[np.ndarray, np.ndarray],
        box: tuple[Sequence[float] | None, Sequence[float] | None],
    ) -> tuple[CudaArray, list[_Level]]:
        """Level of each particle, and the levels that have particles."""
        backend, real, total = self.backend, self.backend.real, support.size
        number = backend.zeros(total, "index")

        def level(low: np.ndarray, high: np.ndarray, largest: float, count: int) -> _Level:
            lower, upper = box
            low = low if lower is None else np.array(lower, real)
            return _Level(low, high if upper is None else np.array(upper, real), largest, count)

        # one level where all supports are nearly the same
        smallest, largest = ends
        if largest < FINEST * smallest:
            return number, [level(*corners, largest, total)]

        # level of each particle; the largest support bounds their number
        backend.pointwise(level_of, {"support": support}, number, smallest=smallest)
        most = int(np.frexp(largest / (FINEST * smallest))[1]) + 1
        counts = backend.to_host(backend.count_by_key(number, most))
        # box and largest support of each level that has particles
        used = np.flatnonzero(counts)
        levels = []
        for k in used:
            rows = backend.rows_where(number, float(k))
            highest = self.backend.extremes(support, rows)[1]
            levels.append(level(*self._corners(position, rows), highest, int(counts[k])))
        # number the levels that are left without gaps
        names = np.zeros(most, np.uint32)
        names[used] = np.arange(used.size)
        numbers = backend.asarray(names, "index")
        backend.pointwise(element, {"place": number}, number, table=numbers)
        return number, levels

    def _cells(
        self, position: CudaArray, number: CudaArray, low: list[np.ndarray], grids: list[CellGrid]
    ) -> CudaArray:
        """Cell of each particle; those of a level follow those of the level before."""
        backend = self.backend
        # tables of the levels: numbers, and vectors (dim, levels)
        tables = {
            "first_cell": backend.asarray(_first_cells(grids), "offset"),
            "inverse": backend.asarray([one.inverse[0] for one in grids]),
            "low": backend.asarray(np.array(low).T),
            "shape": backend.asarray(np.array([one.shape for one in grids]).T, "index"),
        }
        key = backend.zeros(position.shape[1], "index")
        backend.pointwise(cell_in_level, {"x": position, "level": number}, key, **tables)
        return key

    def _targets(self, position: CudaArray, wanted: CudaArray | None) -> CudaArray:
        """Positions of the wanted particles; the others lie where nothing is near."""
        if wanted is None:
            return position
        # infinity, where no cell is near, and the positions of those that are wanted
        targets = self.backend.zeros(position.shape)
        self.backend.fill(targets, np.inf)
        if wanted.size:
            some = self.backend.zeros((position.shape[0], wanted.size))
            self.backend.gather(position, wanted, some)
            self.backend.scatter(some, wanted, targets)
        return targets

    def _tables(self, levels: list[_Level], grids: list[CellGrid]) -> tuple:
        """low, high, inverse, shape and largest of the levels on the device."""
        real = self.backend.real
        columns = (
            np.array([one.low for one in levels], real),
            np.array([one.high for one in levels], real),
            np.array([one.inverse[0] for one in grids], real),
            np.array([one.shape for one in grids], np.int64),
            np.array([one.largest for one in levels], real),
        )
        return tuple(cuda_memory.from_host(column) for column in columns)

    def _scanned(self, scan: Any, count: int, arguments: tuple) -> tuple[CudaArray, CudaArray]:
        """Count the neighbors, then store them."""
        backend = self.backend
        counts, nothing = backend.zeros(count, "index"), backend.zeros(1, "index")
        row_start = backend.zeros(count + 1, "offset")
        places = (row_start.parts[0], counts.parts[0])
        # first pass: count the neighbors of each row
        start(scan, count, *arguments, *places, nothing.parts[0], np.False_)
        # place of each row: the exclusive sum of the counts before it
        backend.exclusive_scan(counts, row_start)
        neighbor = backend.empty(row_start.last(), np.uint32)
        # second pass: store them from there on
        start(scan, count, *arguments, *places, neighbor.parts[0], np.True_)
        return row_start, neighbor


def _first_cells(grids: list[CellGrid]) -> np.ndarray:
    """Number of the first cell of each level."""
    cells = np.cumsum([0, *(one.count for one in grids)])
    return cells[:-1].astype(np.uint64)


def cuda_scan_text(
    precision: str, dimension: int, mean: Callable, periodic: tuple[bool, ...]
) -> str:
    """Text of the module with `scan`."""
    unit = SourceUnit()
    name, _ = unit.add(mean, (("real", ()), ("real", ())))
    # the walk over images and rows of cells is the processor's
    loops, depth = images(dimension, periodic)
    # inside it, test r_ij < mean(l_i, l_j) for each candidate and count or store it
    candidates = [f"sorted_{k}[k]" for k in range(dimension)]
    loops += [
        "    " * depth + line
        for line in (
            "for k in range(first, last):",
            *("    " + line for line in distance(candidates, periodic)),
            "    if square < limit * limit and np.uint64(order[k]) != i:",
            "        if stores:",
            "            neighbor[place] = order[k]",
            "        place += ONE",
        )
    ]
    text = (HEAD + _SCAN).format(
        precision=precision,
        mean="\n".join(f"{INNER}{text}\n" for text in unit.texts),
        targets=", ".join(f"target_{k}" for k in range(dimension)),
        sorted_positions=", ".join(f"sorted_{k}" for k in range(dimension)),
        load_targets=indented(2, [f"x{k} = target_{k}[i]" for k in range(dimension)]),
        images=indented(3, loops),
    )
    return supported(text.replace("f__mean_of(", f"{name}("))
