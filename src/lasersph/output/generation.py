"""The generation of a run folder: how a reader notices that a run wrote while it read.

`.generation` holds a number, which the run raises before it overwrites or cuts what is in its
files. A reader compares the number before and after and reads again where it has changed: the
sequence lock of operating systems (Lamport, Concurrent reading and writing, 1977). Readers never
hold a run up, and need no right to write.

What is only appended, or replaced whole, needs no raise. One raise for each commit is enough,
since it comes after the journal has appeared and before the first old byte is overwritten
(`transaction`): whoever reads the number after the raise finds the journal or the finished work.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from lasersph.output.errors import OutputError, clear_errors

NAME = ".generation"
DIGITS = 20
"""Fixed, so that the number is overwritten in place and takes no further room on a full disk."""
ATTEMPTS = 500
PAUSE = 0.01
"""Between two attempts [s]: 5 s in all, while one commit takes some hundredths of a second."""

Result = TypeVar("Result")


def generation(folder: Path) -> bytes:
    """The number as it stands in the folder; nothing where no run has overwritten anything."""
    try:
        return (folder / NAME).read_bytes()
    except OSError:
        return b""


def raise_generation(folder: Path) -> None:
    """Make readers of the folder read again. Raises OutputError."""
    before = generation(folder)  # a power cut may leave anything
    number = int(before) + 1 if before.isdigit() else 1
    path = folder / NAME
    with clear_errors("write", path):
        # opened and closed each time: other hosts of a network folder see what a closed file holds
        descriptor = os.open(path, os.O_WRONLY | os.O_CREAT, 0o666)
        try:
            os.pwrite(descriptor, f"{number:0{DIGITS}d}".encode(), 0)
        finally:
            os.close(descriptor)


def read_unchanged(folder: Path, read: Callable[[], Result]) -> Result:
    """Result of `read()`, taken while nothing in the folder was overwritten.

    Raises:
        OutputError: the folder changes faster than it can be read, or what `read` raises.
    """
    for _ in range(ATTEMPTS):
        before = generation(folder)
        try:
            result = read()
        except Exception:  # of whatever kind half a commit gives
            # An error while the number changed is that of half a commit, and the next attempt reads
            # again.
            if generation(folder) == before:
                raise
        else:
            if generation(folder) == before:
                return result
        time.sleep(PAUSE)
    raise OutputError(f"{folder} changes faster than it can be read: try again")
