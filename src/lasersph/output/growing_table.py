"""Parts of a `history.csv` that a run still writes: new rows, the last row, some rows of all.

A table of a long run is never read whole here. Rows of a run that was killed and resumed come again
with the same bits, so that a place in the file stays good.
"""

from __future__ import annotations

import os
from pathlib import Path

from lasersph.output.errors import clear_errors

LARGEST_PART = 1 << 22
"""Bytes of one part: some thousand rows, what a page takes in without a halt."""
LONGEST_LINE = 1 << 14
"""Bytes at the end of a file among which the last row is looked for."""


def new_rows(path: Path, start: int) -> tuple[bytes, int]:
    """Whole lines from a byte on, and the byte where the next part begins.

    Args:
        start: 0 or what the last call returned.

    Raises:
        ValueError: `start` is negative, or no line begins there. OutputError: it cannot be read.
    """
    if start < 0:
        raise ValueError("from must not be negative")
    with clear_errors("read", path), open(path, "rb") as stream:
        # The byte before the start tells whether a row begins there.
        if start:
            stream.seek(start - 1)
            before = stream.read(1)
            if not before:  # cut back by a resumed run, which writes the same rows again
                return b"", start
            if before != b"\n":
                raise ValueError(f"no row begins at byte {start}")
        part = stream.read(LARGEST_PART)
    # A row that is only half written waits for the next call.
    whole = part[: part.rfind(b"\n") + 1]
    return whole, start + len(whole)


def last_row(path: Path) -> dict[str, float]:
    """Numbers of the last whole row by column; empty where there is none. Raises OutputError."""
    with clear_errors("read", path), open(path, "rb") as stream:
        header = stream.readline()
        first = stream.tell()
        size = stream.seek(0, os.SEEK_END)
        # The last line before the end is at most `LONGEST_LINE` long; what follows its newline is
        # torn.
        stream.seek(max(first, size - LONGEST_LINE))
        lines = stream.read().split(b"\n")[:-1]
    return _numbers(header, lines[-1]) if header.endswith(b"\n") and lines else {}


def some_values(path: Path, column: str, count: int) -> list[float]:
    """A column at `count` places spread evenly over the file, in its order; for a small picture.

    Raises OutputError.
    """
    with clear_errors("read", path), open(path, "rb") as stream:
        header = stream.readline()
        first, size = stream.tell(), stream.seek(0, os.SEEK_END)
        found = []

        # Equal steps in bytes are about equal steps in rows: each place is moved on to the next
        # full row.
        for k in range(count):
            stream.seek(first + (size - first) * k // count)
            if k:
                stream.readline()  # the rest of a row
            line = stream.readline()
            if not line.endswith(b"\n"):
                break
            value = _numbers(header, line).get(column)
            if value is not None:
                found.append(value)
    return found


def _numbers(header: bytes, line: bytes) -> dict[str, float]:
    names = header.decode(errors="replace").strip().split(",")
    found: dict[str, float] = {}
    # A torn or foreign line gives what it has; texts are no numbers.
    for name, text in zip(names, line.decode(errors="replace").strip().split(","), strict=False):
        try:
            found[name] = float(text)
        except ValueError:
            continue
    return found
