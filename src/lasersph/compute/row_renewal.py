"""Renewal of rows of a list of pairs, each in a place of its own.

Where only some particles move, the rows that they touch are searched anew and the others kept. A
row that is renewed first gets a place behind all others, with room for some pairs more, and stays
there as long as it fits; values per pair go with it. What the list began with is left as it was.
Places follow from the lengths of the rows before, so that they do not depend on the number of
threads.
"""

from __future__ import annotations

from typing import NamedTuple

from lasersph.compute.array_function import array_function
from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import Backend
from lasersph.compute.generate import BLOCK

SPARE = 8
"""Forecast: a row is given room for one pair in so many more than it has."""
RESERVE = 1
"""Guard: pairs that there is room for behind those of the first list, over their number. Memory of
the processor is not taken before it is written; a list that outgrows this is copied."""
_TEXT = f'''
ONE = np.uint64(1)
BLOCK, SPARE = np.uint64({BLOCK}), np.uint64({SPARE})


def find_places(_, count, rows, start, room, row_start, row_end, last):
    """Begin and end of rows that take the lengths of others; those that do not fit go behind."""
    free = row_start[last]
    for k in range(count):
        i = np.uint64(rows[k])
        length = start[i + ONE] - start[i]
        if length > np.uint64(room[i]):
            row_start[i] = free
            room[i] = np.uint32(length + length // SPARE)
            free += np.uint64(room[i])
        row_end[i] = row_start[i] + length
    row_start[last] = free


def copy_rows(block, count, rows, start, neighbor, values, row_start, kept, kept_values):
    """Copy a block of rows to their places."""
    for k in range(block * BLOCK, min((block + ONE) * BLOCK, count)):
        i = np.uint64(rows[k])
        first, base = start[i], row_start[i]
        for p in range(start[i + ONE] - first):
            q = np.uint64(p)
            kept[base + q] = neighbor[first + q]
            kept_values[base + q] = values[first + q]
'''


class PairRows(NamedTuple):
    """Rows of a list: row_start (n + 1,) offsets, neighbor (pairs,) indices, values (pairs,)."""

    row_start: Array
    neighbor: Rows
    values: Array


class RenewedRows:
    """A list of pairs with rows that are renewed, and a value for each pair.

    Args:
        first: rows that stay until they are renewed. Its arrays are copied.

    Attributes:
        row_start: (n + 1,) where rows begin, and how many pairs are stored. row_end: (n,) where
            they end. neighbor, values: of the pairs and of some places more: arrays that stay
            while the number of pairs changes a little.
    """

    def __init__(self, backend: Backend, first: PairRows) -> None:
        count, self._launcher = first.row_start.shape[0] - 1, backend.loops.launcher
        self.backend, self._first, self._start = backend, first.neighbor.shape[0], first.row_start
        self.row_start = backend.zeros(count + 1, "offset")
        self.row_end = backend.zeros(count, "offset")
        backend.copy(first.row_start, self.row_start)
        behind = self._launcher.behind_first(backend.unwrap(first.row_start))
        backend.copy(backend.wrap(behind), self.row_end)
        # rows of the first list have no room: they stay as they are
        self._room = backend.zeros(count, "index")
        self._memory = self.neighbor, self.values = first.neighbor, first.values
        self._move((1 + RESERVE) * self._first)

    @property
    def first(self) -> PairRows:
        """The rows of the first list."""
        return PairRows(self._start, *self._head(self._first))

    def update(self, rows: Rows, found: PairRows) -> None:
        """Put rows of another list in the place of those that there are.

        Args:
            rows: numbers of rows, kind "index", each once. found: a list that has them.

        Raises:
            ValueError: a row is in one list only, or the lists hold different reals.
        """
        backend, numbers = self.backend, self.backend.unwrap(rows)
        least = min(found.row_start.shape[0] - 1, self.row_end.shape[0])
        if numbers.size and (largest := self._launcher.largest(numbers)) >= least:
            raise ValueError(f"row {largest} is renewed, a list has {least}")
        if found.values.dtype != self.values.dtype:
            raise ValueError(f"{found.values.dtype} in a list of {self.values.dtype}")
        if not numbers.size:
            return

        # places of the rows, and memory where they need more
        _find_places(backend, rows, found.row_start, (self._room, self.row_start, self.row_end))
        pairs = self._launcher.last(backend.unwrap(self.row_start))
        if pairs > self.neighbor.shape[0]:
            self._lengthen(pairs + pairs // (2 * SPARE))
        _copy_rows(backend, rows, found, PairRows(self.row_start, self.neighbor, self.values))

    def _lengthen(self, places: int) -> None:
        """Take so many places of the memory; more memory where it has fewer."""
        if places > self._memory[0].shape[0]:
            self._move(places + RESERVE * self._first)
        self.neighbor, self.values = self._head(places)

    def _move(self, capacity: int) -> None:
        """Move neighbors and values to memory for so many."""
        backend, places = self.backend, self.neighbor.shape[0]
        self._memory = backend.zeros(capacity, "index"), backend.zeros(capacity)
        before, (self.neighbor, self.values) = (self.neighbor, self.values), self._head(places)
        backend.copy(before[0], self.neighbor)
        backend.copy(before[1], self.values)

    def _head(self, places: int) -> tuple[Rows, Array]:
        """The first places of the memory."""
        neighbor, values = self._memory
        return self.backend.head(neighbor, places), self.backend.head(values, places)


def _find_places(
    backend: Backend, rows: Rows, start: Array, places: tuple[Array, Array, Array]
) -> None:
    """Set room, begin and end of rows that take the lengths of those of another list."""
    numbers, begin, *parts = map(backend.unwrap, (rows, start, *places))
    if backend.search is not None:
        backend.search.find_places(numbers, begin, parts)
        return
    array_function(_TEXT, "find_places")(numbers.size, numbers, begin, *parts, parts[2].size)


def _copy_rows(backend: Backend, rows: Rows, found: PairRows, kept: PairRows) -> None:
    """Copy the neighbors and values of rows to their places."""
    if backend.search is not None:
        backend.search.copy_rows(backend.unwrap(rows), found, kept)
        return
    count = rows.shape[0]
    array_function(_TEXT, "copy_rows")(
        count,
        *(backend.unwrap(part) for part in (rows, *found, *kept)),
        blocks=-(-count // BLOCK),
        threads=backend.threads,
    )
