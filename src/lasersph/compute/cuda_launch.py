"""Starting of loops on the graphics card."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from operator import methodcaller
from typing import Any, cast

import numpy as np
from numba import cuda

from lasersph.compute import cache as folder
from lasersph.compute.cuda_array import CudaArray
from lasersph.compute.cuda_device import SUMMING_GROUPS, THREADS, groups
from lasersph.compute.cuda_text import CudaLoopText
from lasersph.compute.generate import LoopText
from lasersph.compute.launch import Bound, Launcher
from lasersph.compute.run_text import EMPTY

TOTAL = {"sum": np.add.reduce, "max": np.maximum.reduce, "min": np.minimum.reduce}


class CudaLauncher(Launcher):
    """Loops on the graphics card, on `CudaArray`s; numbers enter the kernels one by one."""

    text: type[LoopText] = CudaLoopText
    last: Callable = staticmethod(methodcaller("last"))
    rebinds = False

    def __init__(self) -> None:
        """One thread starts the loops."""
        self.threads = 1

    def compile(self, text: str) -> Any:
        """The kernel of a text."""
        return folder.load(text).loop

    def largest(self, rows: CudaArray) -> int:
        """The largest of some row numbers."""
        return rows.largest()

    def launch(self, bound: Bound, *, holds: bool = True) -> Any:
        """A loop ready to run, which keeps its arrays."""
        return CudaLaunch(bound)


class CudaLaunch:
    """A loop with its arrays on a graphics card; see `launch.Launch`."""

    def __init__(self, bound: Bound) -> None:
        self._bound, compiled = bound, bound.compiled
        ours = [*bound.lists, *bound.fields, *bound.outs, *bound.tables]
        arrays = cast("list[CudaArray]", [one for one in ours if one is not None])
        self._arrays = [part for one in arrays for part in one.parts]
        self._outs = cast("list[CudaArray]", [out for out in bound.outs if out is not None])
        reals, whole = compiled.numbers
        self._numbers = np.zeros(reals, compiled.real), np.zeros(whole, np.int64)
        self.set(bound.constants)
        self.reductions, self.places = compiled.reductions, compiled.places
        self._groups = groups(bound.rows, SUMMING_GROUPS)

    @property
    def reduces(self) -> bool:
        """Whether a run returns numbers."""
        return bool(self.reductions)

    def set(self, constants: dict[str, Any]) -> None:
        """Take constants by name."""
        for name, value in constants.items():
            for which, k, component in self._bound.compiled.places[name]:
                self._numbers[which][k] = value if component < 0 else value[component]

    def __call__(self, **constants: Any) -> tuple[float, ...]:
        """Run; returns the reductions."""
        self.set(constants)
        compiled, rows = self._bound.compiled, self._bound.rows
        if rows == 0:
            return tuple([EMPTY[how] for how in self.reductions])
        taken = [np.uint64(rows), *self._arrays, *self._numbers[0], *self._numbers[1]]
        partial = None
        if self.reductions:
            partial = _room(len(self.reductions) * self._groups, compiled.real)
            compiled.entry[self._groups, THREADS](*taken, partial)
        else:
            compiled.entry[groups(rows), THREADS](*taken)
        for out in self._outs:
            out.changed()
        if partial is None:
            return ()
        rows_of_parts = partial.copy_to_host().reshape(len(self.reductions), -1)
        pairs = zip(self.reductions, rows_of_parts, strict=True)
        return tuple([float(TOTAL[how](parts, dtype=np.float64)) for how, parts in pairs])


@cache
def _room(size: int, real: Any) -> Any:
    """Place for the groups' values; read before another loop starts, so that one serves all."""
    return cuda.device_array(size, real)
