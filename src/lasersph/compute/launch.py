"""A loop bound to its arrays, and what runs it: once, or again with other numbers."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from operator import methodcaller
from typing import Any, NamedTuple

import numpy as np

from lasersph.compute.arguments import splitter
from lasersph.compute.generate import LoopText

TOTAL = {"sum": np.add.reduce, "max": np.maximum.reduce, "min": np.minimum.reduce}
EMPTY = {"sum": 0.0, "max": -np.inf, "min": np.inf}
SHARED = 50_000
"""Rows or pairs from which on several threads take part: below that, waking a thread that sleeps
takes longer than it saves."""
_FIRST, _ONE = np.uint64(0), np.uint64(1)
_count = lru_cache(maxsize=1024)(np.uint64)  # making one takes as long as looking up five


class Compiled(NamedTuple):
    """A compiled loop, with the order of its arguments.

    Attributes:
        arrays, tables: symbols and names. reals, whole: (name, component) of each number.
        reductions: "sum", "max", "min" in order. real: precision. block: rows of a block.
        watched: see `source.is_current`.
    """

    loop: Callable
    arrays: tuple[str, ...]
    tables: tuple[str, ...]
    reals: tuple[tuple[str, int], ...]
    whole: tuple[tuple[str, int], ...]
    reductions: tuple[str, ...]
    real: np.dtype
    block: int
    watched: tuple


class Bound(NamedTuple):
    """A loop with its arguments.

    Attributes:
        visits: rows or, where there is a list, pairs that it visits, about.
        arguments: rows, lists, fields, tables, outputs and numbers, in the order of the loop's.
        reals, whole: the numbers among them. outs: the outputs as a whole, None if not stored.
    """

    compiled: Compiled
    rows: int
    visits: int
    arguments: list[Any]
    reals: np.ndarray | None
    whole: np.ndarray | None
    outs: list[Any]


class Launcher:
    """All that loops need to know of where they run: here the processor, on NumPy's arrays.

    Attributes:
        text: writes the loops. split: see `splitter`. last: the last element of an array.
    """

    text: type[LoopText] = LoopText
    split: Callable = staticmethod(splitter)
    last: Callable = staticmethod(methodcaller("item", -1))

    def __init__(self, threads: int) -> None:
        self.threads = threads

    def largest(self, rows: Any) -> int:
        """The largest of some row numbers."""
        return int(np.maximum.reduce(rows))

    def partial(self, bound: Bound) -> Any:
        """Room for what each block reduces, one row a reduction; None without reductions."""
        compiled = bound.compiled
        count = len(compiled.reductions)
        return np.empty((count, -(-bound.rows // compiled.block)), compiled.real) if count else None

    def run(self, bound: Bound, partial: Any) -> tuple[float, ...]:
        """Run a loop; returns the reductions."""
        compiled, rows, visits, arguments, _, _, _ = bound
        reductions, block = compiled.reductions, compiled.block
        if rows == 0:
            return tuple([EMPTY[how] for how in reductions])
        if partial is not None:
            arguments = [*arguments, partial]
        blocks = _ONE if rows <= block else _count(-(-rows // block))
        threads = _ONE if visits < SHARED else _count(self.threads)
        compiled.loop(_FIRST, blocks, threads, _count(rows), *arguments)
        if partial is None:
            return ()
        if rows <= block:
            parts = zip(reductions, partial[:, 0].tolist(), strict=True)
            return tuple([0.0 + part if how == "sum" else part for how, part in parts])
        return totals(reductions, partial)


def totals(reductions: tuple[str, ...], partial: Any) -> tuple[float, ...]:
    """What the rows of `partial` reduce to."""
    pairs = zip(reductions, partial, strict=True)
    return tuple([float(TOTAL[how](parts, dtype=np.float64)) for how, parts in pairs])


class Launch:
    """A loop with its arrays; called with the numbers that have changed, it runs.

    Args:
        bound: with numbers that no other launch has.
    """

    def __init__(self, bound: Bound, launcher: Launcher) -> None:
        self._bound, self._launcher = bound, launcher
        self._partial = launcher.partial(bound)
        self._places: dict[str, list[tuple[Any, int, int]]] = {}
        compiled = bound.compiled
        for names, values in ((compiled.reals, bound.reals), (compiled.whole, bound.whole)):
            for k, (name, component) in enumerate(names):
                self._places.setdefault(name, []).append((values, k, component))

    @property
    def reduces(self) -> bool:
        """Whether a run returns numbers."""
        return bool(self._bound.compiled.reductions)

    def __call__(self, **constants: Any) -> tuple[float, ...]:
        """Run; returns the reductions.

        Raises:
            KeyError: a constant that the loop does not have.
        """
        for name, value in constants.items():
            for values, k, component in self._places[name]:
                values[k] = value[component] if isinstance(value, tuple | list) else value
        return self._launcher.run(self._bound, self._partial)
