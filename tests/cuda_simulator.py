"""Numba's CUDA simulator made fit for tests: a thread of Python only where threads wait.

The simulator starts a thread of Python per thread of the card and watches them in a busy loop; this
takes 5 ms per group of threads. Here threads of kernels without barriers take turns in one thread,
and those of the others wait for each other at a barrier of the operating system.

Where the environment names a file as LASERSPH_KERNELS, it holds at the end every kernel that was
started, with the types of its arguments, for `machine_code`.
"""

import atexit
import json
import os
import threading
from pathlib import Path

import numpy as np

KERNELS = "LASERSPH_KERNELS"


def hasten():
    """Let the simulator run groups of threads as above."""
    from numba.cuda.simulator import kernel

    if kernel.BlockManager.run is _run:
        return
    kernel.BlockManager.run = _run
    kernel.BlockThread.syncthreads = lambda thread: thread._manager.barrier.wait()
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


def _type_of(argument):
    """Type of an argument and its number of axes, 0 for a number, as text."""
    if isinstance(argument, bool | int | float):
        return f"{type(argument).__name__} 0"
    return f"{argument.dtype} {argument.ndim}"


def _run(manager, grid_point, *arguments):
    """Run one group of threads."""
    if {"syncthreads", "other_lane"} & set(manager._f.__code__.co_names):
        _together(manager, grid_point, arguments)
    else:
        _in_turn(manager, grid_point, arguments)


def _in_turn(manager, grid_point, arguments):
    from numba.cuda.simulator.kernelapi import Dim3

    thread = threading.current_thread()
    thread._manager, thread.blockIdx = manager, Dim3(*grid_point)
    for place in np.ndindex(*manager._block_dim):
        thread.threadIdx = Dim3(*place)
        manager._f(*arguments)


def _together(manager, grid_point, arguments):
    from numba.cuda.simulator.kernel import BlockThread

    def run():
        try:
            manager._f(*arguments)
        except BaseException:
            manager.barrier.abort()
            raise

    places = list(np.ndindex(*manager._block_dim))
    manager.barrier = threading.Barrier(len(places))
    threads = [BlockThread(run, manager, grid_point, place, manager._debug) for place in places]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    failures = [thread.exception for thread in threads if thread.exception]
    for error, trace in failures:
        raise error.with_traceback(trace)
