"""`--set key=value`: one key of a case changed from the command line or from Python.

The value is read as TOML, and where it is none as plain text (`16nm`, `0.8 J/cm^2`). An empty
value removes the key. Later overrides win. Elements of arrays of tables count from 1:
`probes[1].depth=2um`. Files that a value names count from the folder where the command runs.
"""

from __future__ import annotations

import copy
import re
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from lasersph.case.conversion import present_place
from lasersph.input import CaseError, Document, dotted

_STEP = re.compile(r"([A-Za-z0-9_-]+)(?:\[([0-9]{1,6})\])?")


def override(document: Document, settings: Iterable[str]) -> Document:
    """The document with settings "key=value" applied in order.

    Raises:
        CaseError: a setting that is not key=value, or a key that leads through a plain value.
    """
    data, origins = copy.deepcopy(document.data), dict(document.origins)
    for setting in settings:
        where = f"--set {setting if len(setting) <= 80 else setting[:77] + '...'}"
        # The key as it is named today; files named on the command line lie where it runs.
        path, value = _parse(setting, where)
        path = present_place(path)
        value = from_here(path, value)
        _put(data, path, value, where)
        origins[path] = where
    return replace(document, data=data, origins=origins)


def moved_settings(settings: Iterable[str]) -> list[str]:
    """Keys of settings that are read elsewhere today, each as "flow is solver.flow"."""
    paths = [_parse(setting, f"--set {setting}")[0] for setting in settings]
    moved = {dotted(path): dotted(present_place(path)) for path in paths}
    return [f"{old} is {new}" for old, new in moved.items() if old != new]


def _parse(setting: str, where: str) -> tuple[tuple[str | int, ...], Any]:
    """("laser", "fluence"), "0.8 J/cm^2" from "laser.fluence=0.8 J/cm^2"; None for no value."""
    key, equals, text = setting.partition("=")
    if not equals or not key.strip():
        raise CaseError("is not key=value", "write e.g. --set laser.fluence=0.8J/cm2", file=where)
    # One step a name, and another for the index behind it.
    path: list[str | int] = []
    for step in key.strip().split("."):
        match = _STEP.fullmatch(step.strip())
        if match is None:
            raise CaseError(f'"{key.strip()}" is no key', "write e.g. laser.fluence", file=where)
        path.append(match.group(1))
        if match.group(2) is not None:
            if int(match.group(2)) < 1:
                raise CaseError(f'"{step}" counts from 1', file=where)
            path.append(int(match.group(2)) - 1)
    return tuple(path), _value(text.strip())


# TOML first; what is none is text.
def _value(text: str) -> Any:
    if not text:
        return None
    try:
        read = tomllib.loads(f"value = {text}")
    except (tomllib.TOMLDecodeError, ValueError, RecursionError):
        return text
    return read["value"] if list(read) == ["value"] else text


def from_here(path: tuple[str | int, ...], value: Any) -> Any:
    """A value whose files, counted from where the command runs, are named by their whole paths."""
    if isinstance(value, dict):
        return {key: from_here((*path, key), one) for key, one in value.items()}
    if isinstance(value, str) and value and names_file(path, value):
        return str(Path(value).expanduser().absolute())
    return value


def named_files(path: tuple[str | int, ...], value: Any) -> Iterator[tuple[tuple[Any, ...], str]]:
    """Keys at a path and below it whose values name files, and these."""
    if isinstance(value, dict):
        for key, one in value.items():
            yield from named_files((*path, key), one)
    elif isinstance(value, str) and value and names_file(path, value):
        yield path, value


def names_file(path: tuple[str | int, ...], value: str) -> bool:
    """Whether the text at a key names a file: `path` of a table, the image of a spot, a material
    that is no name."""
    if path in (("material",), ("material", "base")):
        return value.endswith(".toml") or "/" in value
    return path[-1] == "path" or path == ("laser", "spot", "image")


def _put(data: Any, path: tuple[str | int, ...], value: Any, where: str) -> None:
    # Walk down, and make the tables that are missing.
    for number, step in enumerate(path[:-1]):
        if isinstance(step, int):
            data = _element(data, step, where)
            continue
        following = path[number + 1]
        if not isinstance(data, dict):
            raise CaseError(f'"{path[number - 1]}" is not a table', file=where)
        # A change inside a material that is given by name makes it the base of a table.
        if step == "material" and number == 0 and isinstance(data.get(step), str):
            data[step] = {"base": data[step]}
        data = data.setdefault(step, [] if isinstance(following, int) else {})
    last = path[-1]
    if isinstance(last, int):
        _element(data, last, where)
        data[last] = value
    elif not isinstance(data, dict):
        raise CaseError(f'"{path[-2]}" is not a table', file=where)
    elif value is None:
        data.pop(last, None)
    else:
        data[last] = value


def _element(data: Any, index: int, where: str) -> Any:
    if not isinstance(data, list) or index >= len(data):
        count = len(data) if isinstance(data, list) else 0
        raise CaseError(f"there is no element {index + 1}, only {count}", file=where)
    return data[index]
