"""Trial of the entry of Numba's threads, which may end a process: once, in a process of its own.

    python -m lasersph.compute.trial

shares the blocks of a loop through it, and ends with 0 where each was done once. The answer is kept
in the cache folder, for one Numba and one processor.
"""

from __future__ import annotations

import ctypes
import subprocess
import sys
from contextlib import suppress
from importlib.metadata import version
from pathlib import Path

import numpy as np

from lasersph.compute import machine_code
from lasersph.compute.arguments import address

PREFIX = "trial_"
"""Begins the names of the files with answers."""
_LONGEST = 600.0
"""Two small loops take tenths of a second [s], on a machine that does nothing else."""
_BLOCKS = 40
_BLOCK = """
def loop(block, count, frame):
    visits = at_uint64(frame)
    visits[block] += block + count
"""
"""Adds to each block its number and the count."""
_SHARED = """
def loop(block_address, blocks, threads, count, frame):
    share(block_address, blocks, threads, count, frame)
"""


def passes(folder: Path) -> bool:
    """Whether the entry did what it should when it was tried.

    Args:
        folder: where the answer is kept.
    """
    kept = folder / f"{PREFIX}threads-{version('numba')}-{machine_code.target()}.txt"
    if kept.is_file():
        return kept.read_text(encoding="utf-8") == "passes"
    command = [sys.executable, "-m", __name__]
    try:
        found = subprocess.run(command, capture_output=True, timeout=_LONGEST, check=False)
    except subprocess.TimeoutExpired:
        return False
    answer = "passes" if found.returncode == 0 else "fails"
    with suppress(OSError):  # without the file, the next process tries again
        kept.write_text(answer, encoding="utf-8")
    return answer == "passes"


def _compiled(text: str, symbol: str) -> int:
    """Address of the function of a text."""
    place = machine_code.address_of(machine_code.compile_text(text, symbol, is_fast=False), symbol)
    assert place is not None
    return place


def main() -> int:
    """0 where each block was visited once, else 1."""
    visits = np.zeros(_BLOCKS, np.uint64)
    shared = ctypes.PYFUNCTYPE(None, *[ctypes.c_uint64] * 5)(_compiled(_SHARED, "trial_shared"))
    shared(_compiled(_BLOCK, "trial_block"), _BLOCKS - 1, 2, 1, address(visits))
    return 0 if visits.tolist() == [*range(1, _BLOCKS), 0] else 1


if __name__ == "__main__":
    sys.exit(main())
