"""A loop bound to its arrays, ready to be run again with other numbers.

Binding names, checking lengths and finding the loop take some 40 us, which an iteration on small
arrays would spend most of its time with; a launch takes a fifth of that.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from lasersph.compute import threads
from lasersph.compute.generate import BLOCK

TOTAL = {"sum": np.add.reduce, "max": np.maximum.reduce, "min": np.minimum.reduce}
EMPTY = {"sum": 0.0, "max": -np.inf, "min": np.inf}


class Compiled(NamedTuple):
    """A compiled loop, with the order of its arguments."""

    block: Callable
    loop: Callable
    arrays: tuple[str, ...]
    tables: tuple[str, ...]
    reals: tuple[tuple[str, int], ...]
    whole: tuple[tuple[str, int], ...]
    watched: tuple


class Launch:
    """A loop with its arrays; called with the numbers that have changed, it runs.

    Args:
        arrays: rows, lists, fields, tables and outputs, in the order of the loop's arguments.
        constants: numbers by name. rows: how many. reductions: "sum", "max", "min" in order.
    """

    def __init__(
        self,
        compiled: Compiled,
        arrays: list[np.ndarray],
        constants: dict[str, Any],
        *,
        rows: int,
        reductions: tuple[str, ...],
        thread_count: int,
        real: np.dtype,
    ) -> None:
        self.rows, self.blocks = rows, -(-rows // BLOCK)
        self.reductions, self.thread_count = reductions, thread_count
        self.block, self.loop = compiled.block, compiled.loop
        self._places: dict[str, list[tuple[np.ndarray, int, int]]] = {}
        self._arguments: list[Any] = list(arrays)
        for names, kind in ((compiled.reals, real), (compiled.whole, np.dtype(np.int64))):
            values = np.zeros(len(names), kind)
            if names:
                self._arguments.append(values)
            for k, (name, component) in enumerate(names):
                self._places.setdefault(name, []).append((values, k, component))
        for name in self._places:
            self._set(name, constants[name])
        self._partial = np.empty((len(reductions), self.blocks), real)
        if reductions:
            self._arguments.append(self._partial)

    def _set(self, name: str, value: Any) -> None:
        for values, k, component in self._places[name]:
            values[k] = value[component] if isinstance(value, tuple | list) else value

    def __call__(self, **constants: Any) -> tuple[float, ...]:
        """Run; returns the reductions.

        Raises:
            KeyError: a constant that the loop does not have.
        """
        for name, value in constants.items():
            self._set(name, value)
        if self.rows == 0:
            return tuple([EMPTY[how] for how in self.reductions])
        if self.blocks == 1:
            self.block(np.uint64(0), np.uint64(self.rows), *self._arguments)
        else:
            threads.use(self.thread_count)
            self.loop(self.blocks, np.uint64(self.rows), *self._arguments)
        pairs = zip(self.reductions, self._partial, strict=True)
        return tuple([float(TOTAL[how](parts, dtype=np.float64)) for how, parts in pairs])
