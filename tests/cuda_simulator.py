"""Numba's CUDA simulator made fit for tests: a thread of Python only where threads wait.

The simulator starts a thread of Python per thread of the card and watches them in a busy loop; this
takes 5 ms per group of threads. Here threads of kernels without barriers take turns in one thread,
and those of the others wait for each other at a barrier of the operating system.
"""

import threading

import numpy as np


def hasten():
    """Let the simulator run groups of threads as above."""
    from numba.cuda.simulator import kernel

    kernel.BlockManager.run = _run
    kernel.BlockThread.syncthreads = lambda thread: thread._manager.barrier.wait()


def _run(manager, grid_point, *arguments):
    """Run one group of threads."""
    if "syncthreads" in manager._f.__code__.co_names:
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
