"""Loops on the graphics card: binding, and starting of kernels."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from numba import cuda

from lasersph.compute.cuda_array import CudaArray
from lasersph.compute.cuda_device import SUMMING_GROUPS, THREADS, groups
from lasersph.compute.cuda_text import CudaLoopText
from lasersph.compute.launch import EMPTY, TOTAL, Compiled
from lasersph.compute.loops import Bound, Loops


@cache
def _partial(size: int, real: Any) -> Any:
    """Place for the groups' values; read before another loop starts, so that one serves all."""
    return cuda.device_array(size, real)


class CudaLaunch:
    """A kernel with its arrays; called with the numbers that have changed, it runs.

    Args:
        arrays: components of rows, lists, fields, tables and outputs, in the kernel's order.
        constants: numbers by name. rows: how many. reductions: "sum", "max", "min" in order.
        written: arrays that it writes.
    """

    def __init__(
        self,
        compiled: Compiled,
        arrays: list[Any],
        constants: dict[str, Any],
        *,
        rows: int,
        reductions: tuple[str, ...],
        real: np.dtype,
        written: tuple[Any, ...],
    ) -> None:
        self.rows, self.reductions, self.written = rows, reductions, written
        self._kernel: Any = compiled.loop
        self.groups = groups(rows, SUMMING_GROUPS) if reductions else groups(rows)
        self._arguments: list[Any] = [np.uint64(rows), *arrays]
        self._places: dict[str, list[tuple[type, int, int]]] = {}
        for names, kind in ((compiled.reals, real.type), (compiled.whole, np.int64)):
            for name, component in names:
                place = (kind, len(self._arguments), component)
                self._places.setdefault(name, []).append(place)
                self._arguments.append(kind(0))
        for name in self._places:
            self._set(name, constants[name])
        self._partial = None
        if reductions and rows:
            self._partial = _partial(len(reductions) * self.groups, real)
            self._arguments.append(self._partial)

    def _set(self, name: str, value: Any) -> None:
        for kind, k, component in self._places[name]:
            number = value[component] if isinstance(value, tuple | list) else value
            self._arguments[k] = kind(number)

    def __call__(self, **constants: Any) -> tuple[float, ...]:
        """Run; returns the reductions.

        Raises:
            KeyError: a constant that the loop does not have.
        """
        for name, value in constants.items():
            self._set(name, value)
        if self.rows == 0:
            return tuple([EMPTY[how] for how in self.reductions])
        self._kernel[self.groups, THREADS](*self._arguments)
        for array in self.written:
            array.changed()
        if self._partial is None:
            return ()
        parts = self._partial.copy_to_host().reshape(len(self.reductions), self.groups)
        pairs = zip(self.reductions, parts, strict=True)
        return tuple([float(TOTAL[how](row, dtype=np.float64)) for how, row in pairs])


class CudaBound(Bound):
    """Arrays and constants of one call."""

    def last(self, row_start: CudaArray) -> int:
        """The last row pointer: the number of pairs."""
        return row_start.last()

    def refuse_beyond(self, rows: CudaArray, count: int) -> None:
        """Raise ValueError where a listed row is not below `count`."""
        if rows.size and rows.largest() >= count:
            raise ValueError(f"row {rows.largest()} of {count}")


class CudaLoops(Loops):
    """All loops of the graphics card, found by key."""

    bound = CudaBound
    loop_text = CudaLoopText

    def launched(
        self, compiled: Compiled, arrays: list, constants: dict[str, Any], bound: Bound, rows: int
    ) -> Any:
        """The kernel with its arrays."""
        return CudaLaunch(
            compiled, arrays, constants, rows=rows, real=self.real, reductions=bound.reductions(),
            written=tuple([o for o in bound.outs if o is not None]),
        )  # fmt: skip
