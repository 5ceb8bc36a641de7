"""Errors of the run folder: each carries one clear line for the user.

`OutputError` means the run failed (exit code 1); `FolderRefused` means the command was wrong
and nothing was written (exit code 2).
"""

from __future__ import annotations

import errno
import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

REASONS = {
    errno.ENOSPC: "the disk is full",
    errno.EDQUOT: "the disk quota is used up",
    errno.EACCES: "permission denied",
    errno.EPERM: "permission denied",
    errno.EROFS: "the file system is read-only",
    errno.EFBIG: "the file size limit is reached",
    errno.ENOTDIR: "a part of the path is a file, not a folder",
}


FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


class OutputError(Exception):
    """A run folder could not be written or read; the message is one clear line."""


class FolderRefused(OutputError):
    """The given folder cannot be used for this run; nothing was written."""


class FolderLocked(FolderRefused):
    """Another process is computing in the folder; nothing was written."""


@contextmanager
def clear_errors(action: str, path: Path, kind: type[OutputError] = OutputError) -> Iterator[None]:
    """Turn an operating-system error into one line: what was tried, where, and why it failed.

    Args:
        action: verb of the attempt, "write" or "read". path: the file or folder concerned.
        kind: class of the error raised; no room is a failure, whatever the command.

    Raises:
        OutputError: for every OSError raised inside the block.
    """
    try:
        yield
    except OSError as error:
        reason = REASONS.get(error.errno or 0, error.strerror or str(error))
        kind = OutputError if error.errno in FULL else kind
        raise kind(f"cannot {action} {path}: {reason}") from error


def install_hint(package: str, extra: str = "frames") -> str:
    """Sentence for an optional package that is not installed: which extra brings it."""
    return f"{package} is not installed: pip install 'lasersph[{extra}]' brings it"


def read_json(path: Path) -> dict[str, Any]:
    """Content of a JSON file. Raises OutputError."""
    with clear_errors("read", path):
        text = path.read_text(encoding="utf-8")
    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        raise OutputError(f"cannot read {path}: it is damaged") from error
