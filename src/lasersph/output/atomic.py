"""Files that appear whole or not at all.

A file is written under a temporary name in the same folder, flushed to the disk (fsync) and
renamed (`os.replace`), so that a kill at any moment leaves the old file or the new one.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, BinaryIO

from lasersph.output.errors import clear_errors

TEMPORARY_SUFFIX = ".writing"


def replace_file(path: Path, write: Callable[[BinaryIO], object]) -> None:
    """Write `path` through the function `write(stream)` so that it appears whole or not at all.

    Raises:
        OutputError: the disk is full, permission is missing, ...; the old file is intact.
    """
    temporary = path.with_name(path.name + TEMPORARY_SUFFIX)
    with clear_errors("write", path):
        try:
            with open(temporary, "wb") as stream:
                # The bytes are on the disk before the name appears: a power cut leaves no empty
                # file of that name.
                write(stream)
                stream.flush()
                os.fsync(stream.fileno())
            os.replace(temporary, path)
            sync_folder(path.parent)
        except BaseException:
            temporary.unlink(missing_ok=True)
            raise


def replace_text(path: Path, text: str) -> None:
    """Write a text file (UTF-8) whole or not at all. Raises OutputError."""
    replace_file(path, lambda stream: stream.write(text.encode()))


def replace_json(path: Path, value: Any) -> None:
    """Write `value` as readable JSON, whole or not at all. Raises OutputError.

    NaN and infinity are refused by JSON and become null.
    """
    text = json.dumps(to_json_values(value), indent=2, allow_nan=False, ensure_ascii=False)
    replace_text(path, text + "\n")


def sync_folder(folder: Path) -> None:
    """Make a rename inside `folder` last through a power cut."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def to_json_values(value: Any) -> Any:
    """Numbers, text, lists and dicts that JSON knows; NumPy scalars and arrays are converted."""
    if isinstance(value, dict):
        return {str(key): to_json_values(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [to_json_values(item) for item in value]
    if hasattr(value, "tolist"):
        return to_json_values(value.tolist())
    # JSON has no NaN and no infinity.
    if isinstance(value, float) and (value != value or value in (float("inf"), float("-inf"))):
        return None
    if isinstance(value, Path):
        return str(value)
    return value
