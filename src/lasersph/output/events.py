"""The file `events.jsonl`: what happened in a run, one JSON object per line.

Each line has `time_s`, `step`, `event` (a short name), `clock` (date and time, for people only)
and whatever else the event says. Lines are written at once; a resumed run drops those later
than its checkpoint.
"""

from __future__ import annotations

import json
import os
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from lasersph.output.atomic import to_json_values
from lasersph.output.errors import OutputError, clear_errors
from lasersph.output.history import complete_lines, keep_lines


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
