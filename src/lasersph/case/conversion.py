"""Keys of older case files at their present places.

Version 1 had the keys that only one solver reads beside [solver]; version 2 has them in it, and one
has another name. They move with all that is in them, so that a table keeps keys that came later.
"""

from __future__ import annotations

import copy
from dataclasses import replace
from typing import Any

from lasersph.case.contents import SCHEMA_VERSION
from lasersph.input import Document, dotted

Path = tuple[str | int, ...]
MOVED: dict[Path, Path] = {
    ("flow",): ("solver", "flow"),
    ("vessel",): ("solver", "vessel"),
    ("motion",): ("solver", "motion"),
    ("ejection",): ("solver", "ejection"),
    ("time", "steady"): ("solver", "steady"),
    ("solver", "sleep"): ("solver", "active_region"),
}


def present_place(path: Path) -> Path:
    """Where a key is today, given where it is or was."""
    for old, new in MOVED.items():
        if path[: len(old)] == old:
            return (*new, *path[len(old) :])
    return path


def convert(document: Document) -> tuple[Document, list[str]]:
    """A document of any version with its keys at their present places, and what moved.

    Each key that moved is told as "flow is solver.flow".

    A file that says to be of the present version is left as it is.
    """
    # A file of the present version has its keys where it says.
    version = document.data.get("schema_version")
    if version not in (1, None):
        return document, []
    data, moved = copy.deepcopy(document.data), []
    for old, new in MOVED.items():
        if _move(data, old, new):
            moved.append(f"{dotted(old)} is {dotted(new)}")
    # A file without a version stays without one.
    if version is not None:
        data["schema_version"] = SCHEMA_VERSION
    lines = {present_place(path): line for path, line in document.lines.items()}
    return replace(document, data=data, lines=lines), moved


def _move(data: dict[Any, Any], old: Path, new: Path) -> bool:
    """Move a key; where its place is taken or it is not there, nothing happens."""
    # Down to the table that holds the key.
    (*tables, key), source = old, data
    for step in tables:
        source = source.get(step, {}) if isinstance(source, dict) else {}
    if not isinstance(source, dict) or key not in source:
        return False
    # A new place that is taken belongs to the reader: nothing is overwritten.
    target = data.setdefault(new[0], {})
    if not isinstance(target, dict) or new[-1] in target:
        return False
    target[new[-1]] = source.pop(key)
    return True
