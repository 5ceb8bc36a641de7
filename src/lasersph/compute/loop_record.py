"""Loops as JSON: all that decides their texts, functions and kernels by their names.

A record stays true while what it names keeps its name and its arguments; the text of the loop is
written from the functions as they are.
"""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from importlib import import_module
from types import FunctionType
from typing import Any

from lasersph.compute.generate import Loop

_NAME = "="
"""Begins the name of a function or of a class of this package; no other text of a loop does."""
_PACKAGE = "lasersph."


def record_of(part: Any) -> Any:
    """Plain lists, texts and numbers for JSON of a loop, or of a part of one.

    A dataclass is a list of its name and its fields.

    Raises:
        ValueError: a function that cannot be found by its name, or a value of another type.
    """
    if isinstance(part, tuple | list):
        return [record_of(one) for one in part]
    if isinstance(part, FunctionType):
        return _name_that_finds(part)
    if is_dataclass(part) and not isinstance(part, type):
        values = (record_of(getattr(part, field.name)) for field in fields(part))
        return [_name_of(type(part)), *values]
    if part is None or isinstance(part, str | int | float):
        return part
    raise ValueError(f"{part!r} has no record")


def loop_of(record: Any) -> Loop:
    """The loop of a record.

    Raises:
        AttributeError, ImportError, TypeError: what it names is gone, or takes other arguments.
    """
    loop = _part_of(record)
    if not isinstance(loop, Loop):
        raise TypeError(f"{record!r} is no loop")
    return loop


def _part_of(record: Any) -> Any:
    if isinstance(record, str) and record.startswith(_NAME):
        return _named(record)
    if isinstance(record, list):
        parts = tuple([_part_of(one) for one in record])
        is_class = bool(parts) and isinstance(parts[0], type)
        return parts[0](*parts[1:]) if is_class else parts
    return record


def _name_that_finds(function: FunctionType) -> str:
    """Name of a function. Raises ValueError where another one, or none, has that name."""
    name = _name_of(function)
    try:
        found = _named(name)
    except (AttributeError, ImportError):
        found = None
    if found is not function:
        raise ValueError(f"{name.removeprefix(_NAME)}() is not found by its name")
    return name


def _name_of(named: Any) -> str:
    return f"{_NAME}{named.__module__.removeprefix(_PACKAGE)}:{named.__qualname__}"


def _named(name: str) -> Any:
    module, _, path = name.removeprefix(_NAME).partition(":")
    found = import_module(_PACKAGE + module)
    for part in path.split("."):
        found = getattr(found, part)
    return found
