"""Starting of loops on the graphics card."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from operator import attrgetter, methodcaller
from typing import Any

import numpy as np
from numba import cuda

from lasersph.compute.cuda_array import CudaArray
from lasersph.compute.cuda_device import SUMMING_GROUPS, THREADS, groups
from lasersph.compute.cuda_text import CudaLoopText
from lasersph.compute.generate import LoopText
from lasersph.compute.launch import EMPTY, Bound, Launcher, totals


class CudaLauncher(Launcher):
    """Loops on the graphics card, on `CudaArray`s; numbers enter the kernels one by one."""

    text: type[LoopText] = CudaLoopText
    split: Callable = staticmethod(lambda shape: attrgetter("parts"))
    last: Callable = staticmethod(methodcaller("last"))

    def largest(self, rows: CudaArray) -> int:
        """The largest of some row numbers."""
        return rows.largest()

    def partial(self, bound: Bound) -> Any:
        """Room for what each group of threads reduces, one row a reduction; None without."""
        count = len(bound.compiled.reductions) * groups(bound.rows, SUMMING_GROUPS)
        return _room(count, bound.compiled.real) if count else None

    def run(self, bound: Bound, partial: Any) -> tuple[float, ...]:
        """Run a loop; returns the reductions."""
        compiled, rows, _, arguments, _, _, outs = bound
        reductions = compiled.reductions
        if rows == 0:
            return tuple([EMPTY[how] for how in reductions])
        taken: list[Any] = [np.uint64(rows)]
        for one in arguments:
            if type(one) is np.ndarray:
                taken.extend(one)
            else:
                taken.append(one.parts[0] if type(one) is CudaArray else one)
        kernel: Any = compiled.loop
        if partial is None:
            kernel[groups(rows), THREADS](*taken)
        else:
            kernel[groups(rows, SUMMING_GROUPS), THREADS](*taken, partial)
        for out in outs:
            if out is not None:
                out.changed()
        if partial is None:
            return ()
        return totals(reductions, partial.copy_to_host().reshape(len(reductions), -1))


@cache
def _room(size: int, real: Any) -> Any:
    """Place for the groups' values; read before another loop starts, so that one serves all."""
    return cuda.device_array(size, real)
