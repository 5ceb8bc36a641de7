"""Numba's CUDA simulator made fit for tests: all threads of the card in one thread of Python.

The simulator starts a thread of Python per thread of the card and watches them in a busy loop; this
takes 5 ms per group of threads. Here threads of kernels without barriers take turns, and those of
the others are greenlets, which go on from barrier to barrier one after the other. Kernels read and
write NumPy's arrays, not its wrappers of them, and call functions of their own module at once.

Where the environment names a file as LASERSPH_KERNELS, it holds at the end every kernel that was
started, with the types of its arguments, for `machine_code`.
"""

import atexit
import json
import os
import sys
import threading
from functools import cache
from pathlib import Path

import numpy as np
from greenlet import getcurrent, greenlet

KERNELS = "LASERSPH_KERNELS"


def hasten():
    """Let the simulator run groups of threads as above."""
    from numba.cuda.simulator import kernel, kernelapi

    if kernel.BlockManager.run is _run:
        return
    kernel.BlockManager.run = _run
    kernel.FakeCUDAKernel.__call__ = _hastened(kernel.FakeCUDAKernel.__call__, kernel)
    kernelapi.FakeCUDAShared.array = _shared
    if KERNELS in os.environ:
        _record(kernel.FakeCUDAKernel, Path(os.environ[KERNELS]))


def _record(kind, file):
    """Write (source file, name, types of the arguments) of every kernel that is started."""
    found, call = set(), kind.__call__

    def noted(kernel, *arguments):
        if not kernel._device:
            code = kernel.fn.__code__
            found.add((code.co_filename, code.co_name, tuple(map(_type_of, arguments))))
        return call(kernel, *arguments)

    kind.__call__ = noted
    atexit.register(lambda: file.write_text(json.dumps(sorted(found))))


def _hastened(call, simulator):
    """The call of a kernel or of a function on the card, which is a plain one where the simulator
    has put itself in place of `cuda` already: in the module of the kernel that runs."""

    def called(kernel, *arguments):
        context = simulator._kernel_context
        if context is not None and kernel.fn.__globals__.get("cuda") is context:
            return kernel.fn(*arguments)
        return call(kernel, *arguments)

    return called


def _shared(memory, shape, dtype):
    """The array that the threads of a group share, by the line that asks for it."""
    caller = sys._getframe(1)
    place = caller.f_code, caller.f_lineno
    if place not in memory._allocations:
        memory._allocations[place] = np.empty(shape, dtype)
    return memory._allocations[place]


def _type_of(argument):
    """Type of an argument and its number of axes, 0 for a number, as text."""
    if isinstance(argument, bool | int | float):
        return f"{type(argument).__name__} 0"
    return f"{argument.dtype} {argument.ndim}"


def _run(manager, grid_point, *arguments):
    """Run one group of threads."""
    from numba.cuda.simulator.kernelapi import Dim3

    thread, function = threading.current_thread(), manager._f
    thread._manager, thread.blockIdx = manager, Dim3(*grid_point)
    places, given = _places(manager._block_dim), [_bare(argument) for argument in arguments]
    if {"syncthreads", "other_lane"} & set(function.__code__.co_names):
        _together(thread, places, function, given)
        return
    for thread.threadIdx in places:
        function(*given)


def _bare(argument):
    """The array of NumPy in a wrapper of the simulator; anything else as it is."""
    from numba.cuda.simulator.cudadrv.devicearray import FakeWithinKernelCUDAArray

    return argument._item._ary if isinstance(argument, FakeWithinKernelCUDAArray) else argument


@cache
def _places(shape):
    """Places of the threads of a group."""
    from numba.cuda.simulator.kernelapi import Dim3

    return [Dim3(*place) for place in np.ndindex(*shape)]


def _together(thread, places, function, given):
    """Run the threads of a group from barrier to barrier, every other time the last one first: what
    lacks a barrier then reads what is not there yet, or no more."""
    thread.syncthreads = getcurrent().switch
    lanes = [(place, greenlet(function)) for place in places]
    while lanes:
        for thread.threadIdx, lane in lanes:
            lane.switch(*given)
        given = ()
        waiting = [one for one in reversed(lanes) if not one[1].dead]
        assert len(waiting) in (0, len(lanes)), "threads wait for one that has ended"
        lanes = waiting
