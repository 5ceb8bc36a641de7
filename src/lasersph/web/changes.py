"""Changes of a run to its case file, in the units in which the file is written."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from typing import Any

from lasersph.case import Case
from lasersph.input.document import split_settings
from lasersph.input.schema import Schema
from lasersph.input.shown_unit import in_unit_of, number_and_unit
from lasersph.report.tables import value_at


def changes(case_text: str) -> list[dict[str, str]]:
    """Changes of a run to its case file: key, value in the file, value that was computed."""
    settings, text = split_settings(case_text)
    # Without settings nothing was changed.
    try:
        given = tomllib.loads(text) if settings else {}
    except tomllib.TOMLDecodeError:
        given = {}
    found = []
    for setting in settings:
        name, _, value = setting.partition("=")
        key, now = name.strip(), value.strip().strip('"')
        # A setting that says what the file says, in whatever unit, is no change.
        before = value_at(given, key)
        was = "" if before is None else str(before)
        if _letters(was) != _letters(now) and _letters(was) != _letters(in_unit_of(now, was)):
            found.append({"key": key, "was": was, "now": in_unit_of(now, was)})
    return found


def unit_of_key(key: str) -> str:
    """SI unit of a dotted key of a case; empty where it has none."""
    parts = Schema(Case).parts(tuple(key.split(".")), None)
    return next((part["x-unit"] for part in parts if part.get("x-unit")), "")


def units_written(data: Any) -> Iterator[str]:
    """The units in a case file, in the order of its keys."""
    if isinstance(data, str) and (unit := number_and_unit(data)[1]):
        yield unit
    elif isinstance(data, dict):
        for value in data.values():
            yield from units_written(value)
    elif isinstance(data, list):
        for value in data:
            yield from units_written(value)


def _letters(value: str) -> str:
    """Letters of a value that tell it from another, however it is written."""
    return re.sub(r'[\s"^]|\.0\b', "", value)
