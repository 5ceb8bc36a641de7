"""Which case a run folder belongs to, and what a resumed run may have otherwise.

A run may be resumed with other values of the keys that its origin names as changeable: when frames
and rows are written, and with a later end. All that was computed stays; what comes follows the new
values. `started_with` in resolved.json keeps the values that the run began with.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lasersph.output.atomic import replace_json, replace_text, sync_folder, to_json_values
from lasersph.output.errors import FolderRefused, clear_errors
from lasersph.output.older_results import RESULTS_SCHEMA

RESOLVED = "resolved.json"
CASE = "case.toml"
SUMMARY = "summary.json"
END = "time.end"
"""Key that may only become larger."""
DERIVED = ("uncertainty.json", "report.html")
"""Files that are derived from a summary, and go with it."""
SHOWN_LETTERS = 60
"""Of two values that differ; longer ones, tables of laws, would fill the line."""


@dataclass(frozen=True)
class Origin:
    """Case and programs that a run begins with.

    Attributes:
        case_text: the case file as given. case: with all defaults, SI.
        versions: of the programs that compute. case_hash: which case this is; from `case` if empty.
        changeable: keys of the case ("output", "time.end") that a resumed run may have otherwise.
    """

    case_text: str
    case: Mapping[str, Any]
    versions: Mapping[str, str]
    case_hash: str = ""
    changeable: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """Short name of the case that the folder belongs to."""
        return self.case_hash or hash_of_case(self.case)


def hash_of_case(case: Mapping[str, Any]) -> str:
    """Short name of a case: equal for equal content, whatever the order of its keys."""
    text = json.dumps(to_json_values(case), sort_keys=True, ensure_ascii=True)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def write_origin(folder: Path, origin: Origin, started_with: Mapping[str, Any]) -> None:
    """Write resolved.json, which says whose folder it is, and case.toml.

    Args:
        started_with: values that the run began with, by the keys that have others now.

    Raises:
        OutputError: they cannot be written.
    """
    resolved = {
        "schema_version": RESULTS_SCHEMA,
        "case_hash": origin.name,
        "versions": dict(origin.versions),
        "case": origin.case,
    }
    if started_with:
        resolved["started_with"] = dict(started_with)
    replace_json(folder / RESOLVED, resolved)
    replace_text(folder / CASE, origin.case_text)


def started_with(folder: Path) -> dict[str, Any]:
    """Values of changed keys that the run in a folder began with. Raises FolderRefused."""
    return _read(folder).get("started_with", {})


def check_owner(folder: Path, origin: Origin) -> dict[str, Any]:
    """Refuse a folder that holds another case.

    Returns:
        Values that the folder has for changeable keys which the origin has otherwise, by key; empty
        where the cases are the same.

    Raises:
        FolderRefused: with the first key that may not be changed, and both values.
    """
    found = _read(folder)

    # The hash decides; the cases only say where they differ.
    there, here = found.get("case"), json.loads(json.dumps(to_json_values(origin.case)))
    try:
        old, new = str(found["case_hash"]), origin.name
    except (KeyError, TypeError) as error:
        raise _damaged(folder) from error
    if old == new:
        return {}

    # What may not be changed has to agree, and so does the variant of a study (after the hyphen).
    fixed = [_without(case, origin.changeable) for case in (there, here)]
    is_same_variant = old.partition("-")[2] == new.partition("-")[2]
    differs = fixed[0] != fixed[1]

    # An end that is fixed has a message of its own.
    without_end = [_without(case, (END,)) for case in fixed]
    if is_same_variant and differs and without_end[0] == without_end[1]:
        raise FolderRefused(
            f"{folder} holds a run to another end{first_difference(*fixed)}, which says how long "
            "each pulse is computed where pauses are jumped over, and which runs of a study keep: "
            "compute it anew in another folder, or with --overwrite"
        )
    if differs or not is_same_variant:
        raise FolderRefused(
            f"{folder} holds a run of another case{first_difference(*fixed)}: resume it with the "
            "case and settings that it was started with, or choose another folder"
        )

    # What may be changed, with both values; an end only becomes later.
    values = {key: (_value(there, key), _value(here, key)) for key in origin.changeable}
    changed = {key: before for key, (before, after) in values.items() if before != after}
    if END in changed and changed[END] > values[END][1]:
        raise FolderRefused(
            f"{folder} holds a run to a later end{first_difference(*values[END], END)}: resume it "
            "with the same end or a later one, or choose another folder"
        )
    return changed


def change_origin(folder: Path, origin: Origin, changed: Mapping[str, Any]) -> None:
    """Let a folder belong to the changed case, so that a kill at any moment loses nothing.

    The summary goes first: until resolved.json is replaced the folder holds a run of the old case
    that can be resumed, to the same summary, or changed again. From then on it is of the new one.

    Args:
        changed: as `check_owner` returns it.

    Raises:
        OutputError: it cannot be written.
    """
    # Values from the very beginning win over those of an earlier resumption.
    first = {**changed, **started_with(folder)}
    with clear_errors("write", folder):
        for name in (SUMMARY, *DERIVED):
            (folder / name).unlink(missing_ok=True)
        sync_folder(folder)
    replace_text(folder / CASE, origin.case_text)
    now = {key: _value(origin.case, key) for key in first}
    # A key that is back at its first value is no change.
    write_origin(folder, origin, {key: old for key, old in first.items() if old != now[key]})


def first_difference(there: Any, here: Any, key: str = "") -> str:
    """The first key that two cases have not alike, with both values if they are short [SI]."""
    # Walk down to the first key with different values.
    if isinstance(there, Mapping) and isinstance(here, Mapping):
        name = next((k for k in {**there, **here} if there.get(k) != here.get(k)), None)
        below = f"{key}.{name}" if key else f"{name}"
        return "" if name is None else first_difference(there.get(name), here.get(name), below)
    old, new = json.dumps(there), json.dumps(here)
    is_short = len(old + new) <= SHOWN_LETTERS
    return f" ({key} is {old} there, not {new}, SI)" if is_short else f" ({key} is another)"


def _read(folder: Path) -> dict[str, Any]:
    """Content of resolved.json. Raises FolderRefused."""
    path = folder / RESOLVED
    with clear_errors("read", path, FolderRefused):
        text = path.read_text(encoding="utf-8")
    try:
        found = json.loads(text)
    except ValueError as error:
        raise _damaged(folder) from error
    if not isinstance(found, dict):
        raise _damaged(folder)
    return found


def _damaged(folder: Path) -> FolderRefused:
    return FolderRefused(f"{folder / RESOLVED} is damaged: start the run again in a new folder")


def _value(case: Any, key: str) -> Any:
    """Value at a dotted key; None where there is none."""
    for name in key.split("."):
        case = case.get(name) if isinstance(case, Mapping) else None
    return to_json_values(case)


def _without(case: Any, keys: tuple[str, ...]) -> Any:
    """A copy of a case without some dotted keys."""
    left = deepcopy(case)
    for key in keys:
        *sections, name = key.split(".")
        # A section that is missing has no such key either.
        part = left
        for section in sections:
            part = part.get(section) if isinstance(part, dict) else None
        if isinstance(part, dict):
            part.pop(name, None)
    return left
