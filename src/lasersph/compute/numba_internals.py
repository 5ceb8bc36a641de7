"""The one part of Numba that it does not document: the entry of its threads.

Blocks of a loop are handed to Numba's threads through that entry (`parallel.BY_ENTRY`). Numba may
change it: whether it is there is found out once in each process; of a Numba newer than those that
it was tested with, it is tried in a process of its own (`trial`). Without it one line says so, and
blocks are shared by a parallel loop of Numba's own (`parallel.shared_by_numba`): the same bits.

Importing this starts nothing.
"""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable
from importlib.metadata import version

UNTESTED = (0, 69)
"""First Numba that the entry was not tested with."""
PARALLEL_FOR = "numba_parallel_for"
_found: list[bool] = []


def check_entry(passes: Callable[[], bool]) -> None:
    """Find out once whether the entry is as known, and say so if it is not.

    Args:
        passes: whether it does what it should when it is tried.
    """
    if _found:
        return
    _found.append(True)
    reason = _missing(passes)
    if reason:
        _found[0] = False
        text = f"Numba {version('numba')} has no entry of its threads ({reason}): results stay the "
        warnings.warn(f"{text}same, but a start takes seconds longer", RuntimeWarning, stacklevel=2)


def has_entry() -> bool:
    """Whether the entry is as known, as far as was found out; see `check_entry`."""
    return _found != [False]


def _missing(passes: Callable[[], bool]) -> str:
    """Why the entry is not as known; empty where it is."""
    import llvmlite.binding as llvm
    from numba import get_num_threads

    get_num_threads()  # starts the threads, which makes their entry known
    if llvm.address_of_symbol(PARALLEL_FOR) is None:
        return f"{PARALLEL_FOR} is unknown"
    # what only a run of machine code shows, which may end the process
    if _release() >= UNTESTED and not passes():
        return "its trial failed"
    return ""


def _release() -> tuple[int, ...]:
    """Numba's version, its first two numbers."""
    return tuple(int(number) for number in re.findall(r"\d+", version("numba"))[:2])
