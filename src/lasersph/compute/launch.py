"""A loop bound to its arrays, and what runs it: once, or again with other numbers.

A launch is a frame of 64-bit words: address of the loop, number of its blocks, threads, rows,
number of reductions, addresses of how to reduce, of what the blocks have reduced and of the
results, and what it visits; and from there on what the loop itself reads. Blocks are added up in
their order, so that no result depends on the number of threads.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable, Sequence
from functools import cache
from operator import itemgetter, methodcaller
from typing import Any, NamedTuple

import numpy as np

from lasersph.compute import cache as folder
from lasersph.compute.arguments import address, addresses
from lasersph.compute.generate import NATIVE, LoopText

SHARED = 50_000
"""Rows or pairs from which on several threads take part: below that, waking a thread that sleeps
takes longer than it saves."""
_CODES = {"float64": "d", "float32": "f"}
HOWS = ("sum", "max", "min")
EMPTY = {"sum": 0.0, "max": float("-inf"), "min": float("inf")}
"""Reductions of no rows."""
ANYTHING, ROWS, PAIRS, PAIRS_OF_ROWS = range(4)
"""Items that a launch visits: anything, for which all its threads are woken, rows, all pairs of a
list, or those of the rows that are run, which in a pool are few and hold nearly all pairs."""
HEAD_WORDS, LIST_WORDS = 9, 3
"""Words of a frame before those of arrays, and of a list of pairs: begins, ends, neighbors."""
RUN = f'''ZERO, ONE, TWO, SHARED = np.uint64(0), np.uint64(1), np.uint64(2), np.uint64({SHARED})


def is_long(words):
    """Whether a launch visits so much that threads are woken for it."""
    visits, count, first = words[8], words[3], words[{HEAD_WORDS}]
    if visits == np.uint64({ANYTHING}):
        return True
    if visits == np.uint64({ROWS}):
        return count >= SHARED
    if visits == np.uint64({PAIRS}):
        return at_uint64(first)[count] >= SHARED
    numbers = at_uint32(first)
    begins, ends = at_uint64(words[{HEAD_WORDS + 1}]), at_uint64(words[{HEAD_WORDS + 2}])
    pairs = ZERO
    for k in range(count):
        pairs += ends[numbers[k]] - begins[numbers[k]]
        if pairs >= SHARED:
            return True
    return False


def run(launch):
    """Run the launch at an address; its reductions go to its results."""
    words = at_uint64(launch)
    blocks, threads, count, reduced = words[1], words[2], words[3], words[4]
    frame = launch + np.uint64({8 * HEAD_WORDS})
    if threads == ONE or not is_long(words):
        for block in range(blocks):
            invoke(words[0], block, count, frame)
    elif blocks > ZERO:
        share(words[0], blocks, threads, count, frame)
    hows, partial, results = at_uint8(words[5]), at_{{precision}}(words[6]), at_float64(words[7])
    for k in range(reduced):
        total = 0.0 if hows[k] == 0 else (-np.inf if hows[k] == 1 else np.inf)
        for block in range(blocks):
            part = np.float64(partial[k * blocks + block])
            if hows[k] == 0:
                total += part
            elif part != part or (part > total if hows[k] == 1 else part < total):
                total = part
        results[k] = total
'''


LIST = """

def loop(first, count):
    launches = at_uint64(first)
    for k in range(count):
        run(launches[k])
"""


class Compiled(NamedTuple):
    """A compiled loop, with the order of its arguments.

    Attributes:
        entry: address of the machine code, or the kernel of a graphics card.
        arrays, tables: symbols and names. places: for each constant (0 among `reals` or 1 among
            `whole`, place there, component, -1 of a number). numbers: how many of both.
        reductions: "sum", "max", "min" in order. hows: the same as bytes for compiled code.
        real: precision. block: rows of a block. watched: see `source.is_current`.
    """

    entry: Any
    arrays: tuple[str, ...]
    tables: tuple[str, ...]
    places: dict[str, list[tuple[int, int, int]]]
    numbers: tuple[int, int]
    reductions: tuple[str, ...]
    hows: array
    real: np.dtype
    block: int
    watched: tuple


class Bound(NamedTuple):
    """A loop with its arguments.

    Attributes:
        listed, rows: rows that there are, and that are run.
        lists: row numbers, begins and ends of rows, neighbors, as far as there are any.
        fields, outs, tables: arrays as wholes; an output is None where it is not stored.
        constants: by name, numbers or tuples of numbers.
    """

    compiled: Compiled
    listed: int
    rows: int
    lists: list[np.ndarray]
    fields: list[np.ndarray]
    outs: list[np.ndarray | None]
    tables: list[np.ndarray]
    constants: dict[str, Any]


class Launcher:
    """All that loops need to know of where they run: here the processor, on NumPy's arrays.

    Attributes:
        text: writes the loops. last: the last element of an array.
        behind_first: a view of all but the first. rebinds: whether a launch can
            take other arrays of the same kinds.
    """

    text: type[LoopText] = LoopText
    last: Callable = staticmethod(methodcaller("item", -1))
    behind_first: Callable = staticmethod(itemgetter(slice(1, None)))
    rebinds = True

    def __init__(self, threads: int, precision: str) -> None:
        self.threads = threads
        start_function(precision)

    def compile(self, text: str) -> Any:
        """Address of the machine code of a text's loop."""
        return folder.entry(text)

    def largest(self, rows: np.ndarray) -> int:
        """The largest of some row numbers."""
        return int(np.maximum.reduce(rows))

    def launch(self, bound: Bound, *, holds: bool = True) -> Launch:
        """A loop ready to run; it keeps its arrays unless the caller does, who then says so."""
        return Launch(bound, self.threads, holds=holds)

    def list_of(self, launches: Sequence[Launch], precision: str) -> Callable[[], None]:
        """Function that runs launches one after the other, in compiled code."""
        addresses = array("Q", [launch.address for launch in launches])
        first, count = addresses.buffer_info()
        start = list_function(precision)

        def run(_held: array = addresses) -> None:
            start(first, count)

        return run


class Launch:
    """A loop with its arrays; called with the numbers that have changed, it runs.

    Attributes:
        address: of its frame. reductions: "sum", "max" or "min" for each result.
        rebound: what binds it to other arrays, where it can take them.
        results: what the last run has reduced. numbers: the constants as `places` counts them.
    """

    def __init__(self, bound: Bound, threads: int, *, holds: bool) -> None:
        compiled, listed, rows, lists, fields, outs, tables, constants = bound
        self.reductions, self.places = compiled.reductions, compiled.places
        self._block = compiled.block
        # memory of the constants, of what blocks reduce and of the results
        real = _CODES[compiled.real.name]
        reals, whole = compiled.numbers
        self.numbers = (
            array(real, bytes(compiled.real.itemsize * reals)),
            array("q", bytes(8 * whole)),
        )
        reduced, blocks = len(compiled.reductions), -(-listed // compiled.block)
        self._most_blocks = blocks
        self.results = array("d", bytes(8 * reduced))
        self._partial = array(real, bytes(compiled.real.itemsize * reduced * blocks))
        # head of the frame, in the order that `RUN` reads; what it visits follows from its lists,
        # none or row numbers, those of pairs, or both
        words = [
            compiled.entry,
            -(-rows // compiled.block),
            threads,
            rows,
            reduced,
            _address(compiled.hows),
            _address(self._partial),
            _address(self.results),
            (ROWS, ROWS, ROWS, PAIRS, PAIRS_OF_ROWS)[len(lists)],
        ]
        # addresses of lists, fields, outputs and tables, in the order that the loop reads
        for one in lists:
            words += addresses(one)
        for one in fields:
            words += addresses(one)
        for one in outs:
            if one is not None:
                words += addresses(one)
        for one in tables:
            words += (*addresses(one), one.shape[-1])
        self._arrays = slice(HEAD_WORDS + len(lists) % LIST_WORDS, len(words))
        # last the numbers and what the blocks reduce
        words += [_address(numbers) for numbers in self.numbers if numbers]
        if reduced:
            words.append(words[6])
        self._frame = array("Q", words)
        self.address = _address(self._frame)
        self._bound: Any = bound if holds else None
        self.rebound: Any = None
        self._start = start_function(compiled.real.name)
        self.set(constants)

    @property
    def reduces(self) -> bool:
        """Whether a run returns numbers."""
        return bool(self.reductions)

    @property
    def bound_to(self) -> tuple[int, ...]:
        """Addresses of the loop and of its arrays but the rows."""
        return (self._frame[0], *self._frame[self._arrays])

    @property
    def precision(self) -> str:
        """Of its real numbers."""
        return "float64" if self.numbers[0].typecode == "d" else "float32"

    @property
    def results_address(self) -> int:
        """Where the reductions of a run go."""
        return self._frame[7]

    def holds(self, arrays: Any) -> None:
        """Keep what holds the arrays, as long as it is bound to them."""
        self._bound = arrays

    def take_rows(self, rows: np.ndarray) -> None:
        """Run other rows from now on: (k,) numbers among those that there are, kind "index".

        Raises:
            ValueError: they are more than there is room for.
        """
        frame, count = self._frame, rows.size
        blocks = -(-count // self._block)
        if self.reductions and blocks > self._most_blocks:
            raise ValueError(f"{blocks} blocks of rows, room for {self._most_blocks}")
        frame[1], frame[3] = blocks, count
        frame[HEAD_WORDS] = address(rows)

    def number_places(self, name: str) -> list[int]:
        """Addresses of a constant, none where the loop does not have it."""
        return [_address(memory) + memory.itemsize * k for memory, k in self.memory_of(name)]

    def memory_of(self, name: str) -> list[tuple[array, int]]:
        """Memory of a constant, with the place there; none where the loop does not have it."""
        return [(self.numbers[which], k) for which, k, _ in self.places.get(name, ())]

    def set(self, constants: dict[str, Any]) -> None:
        """Take constants by name.

        Raises:
            KeyError: a constant that the loop does not have.
        """
        places, numbers = self.places, self.numbers
        for name, value in constants.items():
            for which, k, component in places[name]:
                numbers[which][k] = value if component < 0 else value[component]

    def __call__(self, **constants: Any) -> tuple[float, ...]:
        """Run; returns the reductions.

        Raises:
            KeyError: a constant that the loop does not have.
        """
        if constants:
            self.set(constants)
        self._start(self.address)
        return tuple(self.results)


def _address(memory: array) -> int:
    return memory.buffer_info()[0]


@cache
def start_function(precision: str) -> Callable[[int], None]:
    """Foreign function that runs the launch at an address."""
    text = (NATIVE + RUN).format(precision=precision) + "\n\ndef loop(launch):\n    run(launch)\n"
    return folder.function(text, 1)


@cache
def list_function(precision: str) -> Callable[[int, int], None]:
    """Foreign function that runs the launches at a list of addresses, one after the other."""
    text = (NATIVE + RUN).format(precision=precision) + LIST
    return folder.function(text, 2)


def bytes_of(reductions: tuple[str, ...]) -> array:
    """How to reduce, for compiled code."""
    return array("B", [HOWS.index(how) for how in reductions])
