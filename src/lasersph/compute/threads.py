"""Threads of the parallel loops, and the options that must be set before Numba starts.

OpenMP's idle threads must sleep, not spin: where another process wants the core, spinning makes a
call of 15 us take 8 ms. They first look around for as long as the next short loop takes to come,
some 20 us: a thread that is woken for each of them stays on the core of the one that wakes it, and
both share it.
"""

import os

os.environ.setdefault("OMP_WAIT_POLICY", "passive")
os.environ.setdefault("GOMP_SPINCOUNT", "2000")


def available() -> int:
    """Number of processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def chosen(threads: int | None) -> int:
    """Number of threads to use: as asked for, no more than there are; None takes them all.

    Raises:
        ValueError: fewer than one thread.
    """
    import numba

    if threads is not None and threads < 1:
        raise ValueError(f"threads must be at least 1, not {threads}")
    limit = min(available(), numba.config.NUMBA_NUM_THREADS)  # type: ignore[attr-defined]
    return limit if threads is None else min(threads, limit)
