"""Events of a run that is computed: what has grown, so that a page fetches just that.

Server-sent events carry sizes and no data. A page that lost the connection misses nothing: the
first event after it says all again.
"""

from __future__ import annotations

import json
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from typing import Any

import anyio

from lasersph.web.folder_list import Entry
from lasersph.web.run_page import state_of

PAUSE = 0.5
"""From one look at the files to the next [s]."""
SILENT_LOOKS = 20
"""Looks without news after which a line is sent, so that proxies keep the connection."""


async def events(
    entry: Entry, note_of: Callable[[Entry], str], is_stopping: Callable[[], bool]
) -> AsyncIterator[str]:
    """Lines of the event stream, until the server stops or the folder is gone.

    Args:
        note_of: last words of a process that this server started and that failed.
    """
    before, silent = None, 0
    # Look, say what changed, and now and then that nothing did.
    while not is_stopping():
        found = await anyio.to_thread.run_sync(_sizes, entry.path)
        found["note"] = note_of(entry)
        if found != before:
            yield f"data: {json.dumps(found)}\n\n"
            before, silent = found, 0
        elif silent == SILENT_LOOKS:
            yield ": nothing new\n\n"
            silent = 0
        else:
            silent += 1
        # The folder is gone: there is nothing more to say.
        if found["state"] == "gone":
            return
        await anyio.sleep(PAUSE)


def _sizes(folder: Path) -> dict[str, Any]:
    """State and sizes of what grows."""
    # Sizes of files that grow, times of those that are replaced.
    try:
        started = (folder / "resolved.json").stat().st_mtime_ns
    except OSError:
        return {"state": "gone"}
    return {
        "state": state_of(folder),
        "started": str(started),  # beyond the whole numbers of JavaScript
        "history": _size(folder / "history.csv"),
        "particles": _changed(folder / "particles.vtkhdf"),
        "log": _size(folder / "run.log"),
        "figures": _changed(folder / "figures"),
        "report": _size(folder / "report.html"),
    }


def _size(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError:
        return 0


def _changed(path: Path) -> str:
    try:
        return str(path.stat().st_mtime_ns)
    except OSError:
        return ""
