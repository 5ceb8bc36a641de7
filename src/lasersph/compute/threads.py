"""Threads of the parallel loops, and the options that must be set before Numba starts.

OpenMP's idle threads must sleep, not spin: where another process wants the core, spinning makes a
call of 15 us take 8 ms. They first turn a few times, until the next short loop has come: a thread
that is woken for each of them stays on the core of the one that wakes it, and both share it. Who
has chosen a policy gets that one.
"""

import os

if "OMP_WAIT_POLICY" not in os.environ:
    os.environ["OMP_WAIT_POLICY"] = "passive"
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
