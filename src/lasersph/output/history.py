"""Files that grow with a run: the table `history.csv`, a row per step, and `events.jsonl`.

Numbers are written with the fewest digits that read back to the same double, so the file holds
the run exactly. Rows gather in memory and reach the file every few hundred rows, after half a
second, so that who looks on sees them come, and at each checkpoint; a resumed run cuts the file
back to the rows its checkpoint knows. Each line of `events.jsonl` is a JSON object: `time_s`,
`step`, `event` (a short name), `clock` (date and time, for people only) and whatever else the event
says; it is written at once.
"""

from __future__ import annotations

import json
import os
import time
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.output.atomic import to_json_values
from lasersph.output.errors import OutputError, clear_errors
from lasersph.output.generation import raise_generation

Value = float | int | str
LONGEST_GATHERING = 0.5
"""After this time [s] rows are written, however few: what they say does not depend on when."""


WARNING = "warning"
"""Name of the events that hold a warning as their `message`."""


class History:
    """Appends rows to a CSV file whose columns are fixed by the first row."""

    def __init__(self, path: Path, *, buffer_rows: int = 256) -> None:
        """Continue the table at `path`, or start it with the first row where there is none."""
        self.path = path
        self.buffer_rows = buffer_rows
        self.rows = 0
        self.columns: tuple[str, ...] = ()
        self._buffer: list[str] = []
        self._written_at = time.monotonic()
        # The first line has the names of the columns.
        if path.exists():
            lines = complete_lines(path)
            if lines:
                self.columns = tuple(lines[0].split(","))
                self.rows = len(lines) - 1

    def append(self, row: Mapping[str, Value]) -> None:
        """Add one row; every row has the columns of the first one.

        Raises:
            ValueError: a column is missing or unknown.
            OutputError: the file could not be written.
        """
        if not self.columns:
            self.columns = tuple(row)
            self._buffer.append(",".join(self.columns))
        # A row with other columns would shift all numbers after them.
        if len(row) != len(self.columns) or any(name not in row for name in self.columns):
            difference = sorted(set(row) ^ set(self.columns))
            raise ValueError(f"history row with other columns than the first: {difference}")
        self._buffer.append(",".join(csv_text(row[name]) for name in self.columns))
        self.rows += 1
        # Rows go to the file by number or by time, whichever comes first.
        gathering = time.monotonic() - self._written_at
        if len(self._buffer) >= self.buffer_rows or gathering > LONGEST_GATHERING:
            self.flush()

    def flush(self, *, sync: bool = False) -> None:
        """Bring buffered rows into the file; with `sync`, onto the disk. Raises OutputError."""
        if not self._buffer and not (sync and self.path.exists()):
            return
        with clear_errors("write", self.path), open(self.path, "ab") as stream:
            size = stream.tell()
            try:
                stream.write("".join(line + "\n" for line in self._buffer).encode())
                stream.flush()
                if sync:
                    os.fsync(stream.fileno())
            except OSError:
                # A full disk can leave half of the rows: the file goes back to its old length.
                os.ftruncate(stream.fileno(), size)
                raise
        self._buffer.clear()
        self._written_at = time.monotonic()

    def cut(self, rows: int) -> None:
        """Keep the first `rows` rows and drop what follows; 0 drops the whole table.

        Raises:
            OutputError: the file holds fewer complete rows.
        """
        self._buffer.clear()
        # Readers look again where rows disappear.
        if rows == 0:
            raise_generation(self.path.parent)
            with clear_errors("write", self.path):
                self.path.unlink(missing_ok=True)
            self.columns = ()
        else:
            lines = keep_lines(self.path, rows + 1, "rows")
            self.columns = tuple(lines[0].split(","))
        self.rows = rows


def csv_text(value: Value) -> str:
    """Text that reads back to exactly the same value."""
    if isinstance(value, str):
        if "," in value or "\n" in value or '"' in value:
            raise ValueError(f"text in a history row must not hold commas or quotes: {value!r}")
        return value
    if isinstance(value, bool | int | np.integer):
        return str(int(value))
    # `repr` gives the shortest text that reads back to the same double.
    return repr(float(value))


def complete_lines(path: Path) -> list[str]:
    """The lines of a text file that end in a newline; a torn last line is left out."""
    with clear_errors("read", path):
        data = path.read_bytes()
    return data[: data.rfind(b"\n") + 1].decode(errors="replace").splitlines()


def keep_lines(path: Path, count: int, what: str) -> list[str]:
    """Keep the first lines of a text file, cut off the others, and return those kept.

    Raises:
        OutputError: the file holds fewer complete lines.
    """
    lines = complete_lines(path) if path.exists() else []
    if len(lines) < count:
        raise OutputError(f"{path} holds fewer {what} than the checkpoint: {count}")

    # What follows in the file came after the checkpoint.
    if path.exists():
        raise_generation(path.parent)
        with clear_errors("write", path):
            os.truncate(path, sum(len(line.encode()) + 1 for line in lines[:count]))
    return lines[:count]


def read_history(path: Path) -> dict[str, np.ndarray]:
    """The table as arrays of length (rows,): int64, float64, or text, by column name.

    Raises:
        OutputError: the file is missing or damaged.
    """
    lines = complete_lines(path)
    if not lines:
        return {}
    names = lines[0].split(",")
    rows = [line.split(",") for line in lines[1:]]
    if any(len(row) != len(names) for row in rows):
        raise OutputError(f"cannot read {path}: a row has another number of columns")
    return {name: column([row[k] for row in rows]) for k, name in enumerate(names)}


def column(texts: list[str]) -> np.ndarray:
    """Parse one column: whole numbers, else floating-point numbers, else text."""
    # The narrowest type that holds every entry: integers, then doubles, then texts.
    for kind in (np.int64, np.float64):
        try:
            return np.array([kind(text) for text in texts], dtype=kind)
        except ValueError:
            continue
    return np.array(texts)


class Events:
    """Appends events to a JSON-lines file."""

    def __init__(self, path: Path) -> None:
        """Continue the file at `path`, or start it with the first event."""
        self.path = path
        self.count = len(complete_lines(path)) if path.exists() else 0

    def append(self, event: str, *, time: float, step: int, **details: Any) -> None:
        """Write one event. `time` in seconds of the simulation.

        Raises:
            OutputError: the file could not be written.
        """
        clock = datetime.now(UTC).isoformat(timespec="seconds")
        entry = {"time_s": time, "step": step, "event": event, "clock": clock, **details}
        line = json.dumps(to_json_values(entry), ensure_ascii=False) + "\n"
        with clear_errors("write", self.path), open(self.path, "ab") as stream:
            stream.write(line.encode())
        self.count += 1

    def flush(self) -> None:
        """Bring the file onto the disk. Raises OutputError."""
        if self.path.exists():
            with clear_errors("write", self.path), open(self.path, "ab") as stream:
                os.fsync(stream.fileno())

    def cut(self, count: int) -> None:
        """Keep the first `count` events. Raises OutputError where the file holds fewer."""
        keep_lines(self.path, count, "events")
        self.count = count


def read_events(path: Path) -> list[dict[str, Any]]:
    """All events of a file; an empty list where there is none. Raises OutputError."""
    if not path.exists():
        return []
    try:
        return [json.loads(line) for line in complete_lines(path) if line.strip()]
    except json.JSONDecodeError as error:
        raise OutputError(f"cannot read {path}: {error}") from error
