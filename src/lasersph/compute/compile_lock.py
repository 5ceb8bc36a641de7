"""One process compiles a loop at a time; others that want it wait, and read what it has written."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

try:
    import fcntl
except ImportError:  # a system without record locks: each process compiles what it needs
    fcntl = None

FILE = "compiling.lock"
_PLACES = 1 << 40
"""Bytes of the file that stand for names; a lock reaches beyond the end of a file."""


@contextmanager
def compiling_alone(folder: Path, name: str, *, waits: bool = True) -> Iterator[bool]:
    """Hold the lock of a name in a folder inside a `with` block; it ends with the process.

    Args:
        name: hexadecimal. waits: until another process has released it.

    Yields:
        Whether it is held: False where another process has it. True, without a lock, where the
        folder or the system knows none.
    """
    handle = _handle(folder)
    if fcntl is None or handle is None:
        yield True
        return
    place = int(name, 16) % _PLACES
    try:
        fcntl.lockf(handle, fcntl.LOCK_EX | (0 if waits else fcntl.LOCK_NB), 1, place)
        is_locked = True
    except BlockingIOError:
        yield False
        return
    except OSError:  # as network folders without locks answer
        is_locked = False
    try:
        yield True
    finally:
        if is_locked:
            fcntl.lockf(handle, fcntl.LOCK_UN, 1, place)


@cache
def _handle(folder: Path) -> int | None:
    """Open lock file of a folder, one for the whole process: closing any would free all locks."""
    try:
        return os.open(folder / FILE, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
    except OSError:
        return None
