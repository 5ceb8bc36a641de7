"""Sweeps: sums over the neighbors that a sweep has passed already, with what it gave them.

    v_i = function(sum_j g_ij v_j, fields at i),    j before i

is what solving with a triangular matrix asks for; a sweep backward sums over the j after i. Blocks
of rows are colored so that blocks of one color see nothing of each other: they go side by side, a
color after the other, the rows of a block in their order. Which row is before which follows from
the list alone, and so do the bits of the result, for any number of threads.

Pairs are stored as tiles: four rows in a row share the particles that any of them sees, so that a
value is fetched once for four weights in place of one. That takes half as much time for a pair and
half as many weights again, most of which are zeros, as long as rows that follow each other lie
close to each other; for rows in any order, and in memory other than the processor's, there are no
sweeps.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from lasersph.compute.arguments import parameter_names
from lasersph.compute.array_function import array_function
from lasersph.compute.array_types import Array, PairList
from lasersph.compute.backend import Backend
from lasersph.compute.sweep_text import ROWS, TILES, sweep_text

BLOCK = 8192
"""Rows of a block: where blocks meet, sweeps pass on less, but few blocks leave threads idle."""
FILL = 3.0
"""Most weights stored, over pairs."""


class Tiles(NamedTuple):
    """Pairs of the chunks on one side, host arrays.

    Attributes:
        start: (chunks + 1,), of those after in reverse order of the chunks. column: (columns,)
            particles. value: (columns, rows of a chunk) weights.
    """

    start: np.ndarray
    column: np.ndarray
    value: np.ndarray


@dataclass(eq=False)
class OrderedPairs:
    """Weights of pairs, arranged for sweeps.

    Attributes:
        colors: numbers of the blocks of each color. sides: tiles before and after the chunks.
        inner: (chunks, 6) weights between the rows of a chunk.
        total, after: (n,) sums of all weights of a row but g_ii, and of those after it.
    """

    backend: Backend
    colors: list[np.ndarray]
    sides: list[Tiles]
    inner: np.ndarray
    total: Array
    after: Array

    @property
    def stored(self) -> int:
        """Bytes of weights and columns that a sweep forward and one backward read."""
        sides = sum(tiles.column.nbytes + tiles.value.nbytes for tiles in self.sides)
        return sides + 2 * self.inner.nbytes


class Sweep:
    """A sweep with its arrays; called with the numbers that have changed, it runs.

    Args:
        function: plain function of `total`, the sum, of fields at i and of constants, by name.
            Its first result is what neighbors read; it may also be a field, read before that.
        out: array of each result but of those that are summed over the rows, the last ones.
        reduces: how many are.

    Attributes:
        function: of a row, with so many `arguments`. places: of the constants by name. read, out:
            host arrays, (n,). tiles, inner: weights that it reads.
    """

    def __init__(
        self,
        pairs: OrderedPairs,
        function: Callable,
        fields: Mapping[str, Array],
        out: Sequence[Array],
        *,
        backward: bool = False,
        reduces: int = 0,
        **constants: float,
    ) -> None:
        # loop of this function, forward or backward
        backend, count = pairs.backend, pairs.total.shape[0]
        roles = _roles(function, fields, constants)
        text = sweep_text(function, roles, reduces, len(out), backward=backward)
        sweep = array_function(text, "sweep", backend.precision)
        self.function, self.arguments = function, len(roles)
        # arrays that it reads and writes, all of the rows' length
        self.read = [backend.unwrap(fields[name]) for name in roles if roles[name] == "field"]
        self.out = [backend.unwrap(array) for array in out]
        self.tiles, self.inner = pairs.sides[backward], pairs.inner
        arrays = [*self.out, *self.read]
        for array in arrays:
            if array.shape != (count,) or array.dtype != backend.real:
                raise ValueError(f"{array.dtype}{array.shape}; ({count},) is asked for")
        # colors in the order of the sweep, and what the rows are given
        colors = pairs.colors[::-1] if backward else pairs.colors
        names = [name for name in roles if roles[name] == "constant"]
        self.places = {name: k for k, name in enumerate(names)}
        self._numbers = np.array([constants[name] for name in names], backend.real)
        # a row of sums for each block, added up when all colors are done
        blocks = sum(blocks.size for blocks in colors)
        self._partial = np.zeros((blocks, reduces), backend.real)
        self._given = (BLOCK, count, self._partial, *self.tiles, self.inner, *arrays, self._numbers)
        self._parts = [
            (sweep.frame(one, *self._given, blocks=one.size, threads=backend.threads), one)
            for one in colors
        ]
        self._run = sweep.run

    def set(self, constants: Mapping[str, float]) -> None:
        """Take constants by name."""
        for name, value in constants.items():
            self._numbers[self.places[name]] = value

    def __call__(self, **constants: float) -> tuple[float, ...]:
        """Run; returns the sums over the rows."""
        self.set(constants)
        # a color waits for the one before; its blocks go side by side
        for frame, _ in self._parts:
            self._run(frame)
        return tuple(np.add.reduce(self._partial, dtype=np.float64).tolist())


def ordered_pairs(backend: Backend, neighbors: PairList, weights: Array) -> OrderedPairs | None:
    """Pairs arranged for sweeps; None where they would not pay.

    Args:
        neighbors: list whose neighbors all have rows; j in the row of i where i in that of j.
        weights: (pairs,) g_ij, stored in their precision. A pair that is listed twice is summed.
    """
    # tiles lie in the processor's memory only
    row_start, neighbor = backend.unwrap(neighbors.row_start), backend.unwrap(neighbors.neighbor)
    if not isinstance(neighbor, np.ndarray) or not neighbor.size:
        return None
    # color the blocks so that no two of a color have neighbors in each other
    count = row_start.size - 1
    touches = np.zeros((-(-count // BLOCK),) * 2, np.uint8)
    array_function(TILES, "touching")(BLOCK, row_start, neighbor, touches)
    color = _coloring(touches)
    # columns of each chunk; too many zeros among the weights do not pay
    chunks = -(-count // ROWS)
    columns = np.zeros((2, chunks), np.uint64)
    seen = np.zeros(count, np.uint32)
    array_function(TILES, "count_columns")(BLOCK, color, row_start, neighbor, seen, columns)
    if ROWS * int(columns.sum()) > FILL * neighbor.size:
        return None
    # fill the tiles before and after each chunk, and the weights within it
    host = backend.unwrap(weights)
    inner = np.zeros((chunks, ROWS * (ROWS - 1) // 2), host.dtype)
    total, after = (np.zeros(count, backend.real) for _ in range(2))
    sides = []
    for side, lengths in enumerate((columns[0], columns[1, ::-1])):
        # first column of each chunk: the exclusive sum of the lengths before it
        start = np.concatenate([np.zeros(1, np.uint64), np.cumsum(lengths, dtype=np.uint64)])
        stored = int(start[-1])
        tiles = Tiles(start, np.empty(stored, np.uint32), np.empty((stored, ROWS), host.dtype))
        slots, sums = np.zeros(count, np.uint64), (inner, total, after)
        pairs = (color, row_start, neighbor, host, slots)
        array_function(TILES, "fill")(side, BLOCK, *pairs, *tiles, *sums)
        sides.append(tiles)
    # numbers of the blocks of each color
    colors = [np.flatnonzero(color == k) for k in range(int(color.max()) + 1)]
    return OrderedPairs(backend, colors, sides, inner, backend.wrap(total), backend.wrap(after))


def _roles(function: Callable, fields: Mapping, constants: Mapping) -> dict[str, str]:
    """Where each argument comes from.

    Raises:
        ValueError: a missing field or constant.
    """
    roles = {}
    for name in parameter_names(function):
        if name != "total" and name not in fields and name not in constants:
            raise ValueError(f"{function.__name__}() needs {name}")
        roles[name] = "total" if name == "total" else "field" if name in fields else "constant"
    return roles


def _coloring(touches: np.ndarray) -> np.ndarray:
    """Smallest color of each block, in turn, that no block that it touches has."""
    # greedy coloring of the graph of blocks, in both directions of a pair
    joined = (touches | touches.T) > 0
    color = np.zeros(joined.shape[0], np.int64)
    for b in range(1, color.size):
        taken = set(color[:b][joined[b, :b]].tolist())
        color[b] = min(set(range(len(taken) + 1)) - taken)
    return color
