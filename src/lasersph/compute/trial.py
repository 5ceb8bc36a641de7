"""Trial of parts of Numba that may end a process: once, in a process of its own.

    python -m lasersph.compute.trial PART

runs loops by such a part, and ends with 0 where they do what they should. The answer is kept in the
cache folder, for one Numba and one processor.
"""

from __future__ import annotations

import ctypes
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.compute import machine_code
from lasersph.compute.arguments import address
from lasersph.compute.generate import NATIVE

PREFIX = "trial_"
"""Begins the names of the files with answers."""
_LONGEST = 600.0
"""Compiling two loops takes seconds [s], on a machine that does nothing else."""
_BLOCKS = 40
_SHARED_LOOP = """
def loop(begin, end, threads, frame):
    visits = at_uint64(frame)
    if end - begin > np.uint64(1):
        dispatch_blocks()
        return
    for b in range(begin, end):
        visits[b] += b + np.uint64(1)
"""
"""Adds to each block its number and one, on several threads."""
_PLAIN_LOOP = """
def loop(begin, end, threads, frame):
    visits = at_uint64(frame)
    for b in range(begin, end):
        visits[b] += b + np.uint64(1)
"""


def passes(folder: Path, part: str) -> bool:
    """Whether a part, by its name, did what it should when it was tried.

    Args:
        folder: where the answer is kept.
    """
    kept = folder / f"{PREFIX}{part.lower()}-{machine_code.target()}.txt"
    if kept.is_file():
        return kept.read_text(encoding="utf-8") == "passes"
    command = [sys.executable, "-m", __name__, part]
    try:
        found = subprocess.run(command, capture_output=True, timeout=_LONGEST, check=False)
    except subprocess.TimeoutExpired:
        return False
    answer = "passes" if found.returncode == 0 else "fails"
    with suppress(OSError):  # without the file, the next process tries again
        kept.write_text(answer, encoding="utf-8")
    return answer == "passes"


def _function_of(text: str) -> Any:
    """The function `loop` of a text."""
    space: dict[str, Any] = {"__name__": "lasersph_trial"}
    exec(NATIVE.format(precision="float64") + text, space)
    return space["loop"]


def _visits(part: str) -> list[int]:
    """Values that a loop over all blocks but two, compiled by a part, leaves of zeros."""
    from lasersph.compute import numba_internals

    visits = np.zeros(_BLOCKS, np.uint64)
    if part == numba_internals.Part.THREADS.name:
        function = _function_of(_SHARED_LOOP)
        callback = numba_internals.compiled_callback(function, "trial", is_fast=True)
        entry = callback.address
    else:
        code = machine_code.compile_function(_function_of(_PLAIN_LOOP), "trial", is_fast=True)
        entry = machine_code.address_of(code, "trial")
        assert entry is not None
    call = ctypes.PYFUNCTYPE(None, *[ctypes.c_uint64] * 4)(entry)
    call(1, _BLOCKS - 1, 2, address(visits))
    return visits.tolist()


def main(part: str) -> int:
    """0 where each block was visited once, else 1."""
    return 0 if _visits(part) == [0, *range(2, _BLOCKS), 0] else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
