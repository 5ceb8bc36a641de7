"""Points: cases that differ in a few keys, each with its settings, its hash, or why it is refused.

A case file is read once, so that a point costs some milliseconds. A setting is a number in SI
units, text with a unit ("0.8 J/cm^2"), or a word, as `--set` takes them.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from os import PathLike
from typing import Any

from pydantic import BaseModel

from lasersph.case import Case, CaseFile, refuse_if_too_large
from lasersph.case.conversion import present_place
from lasersph.case.overrides import override
from lasersph.input import (
    KINDS,
    CaseError,
    QuantityError,
    did_you_mean,
    parse_quantity,
    quantity_kind,
)
from lasersph.input.findings import steps_of
from lasersph.input.schema import as_toml
from lasersph.output import hash_of_case

Value = float | int | bool | str
"""Of a key: a number (SI where the key has a unit), text with a unit, a word."""


@dataclass(frozen=True)
class Point:
    """One run that is wanted.

    Attributes:
        settings: what varies, by key; quantities in SI.
        overrides: all that differs from the case file, as `--set` takes it.
        case: None where it is refused. reason: why, in one line.
    """

    settings: Mapping[str, Value]
    overrides: tuple[str, ...] = ()
    case: Case | None = field(default=None, compare=False, repr=False)
    reason: str = ""

    @cached_property
    def hash(self) -> str:
        """Short name of the case, equal for equal cases; empty where it is refused."""
        return "" if self.case is None else self.case.hash()


class CaseTemplate:
    """A case file with settings for all runs, of which points are made.

    Attributes:
        name: of the case, as given. settings: of every run, by key.
    """

    def __init__(
        self, name_or_path: str | PathLike[str], settings: Mapping[str, Value] | None = None
    ) -> None:
        self.name = name_or_path
        self.settings = dict(settings or {})
        self.file = CaseFile(name_or_path)
        self._kinds: dict[str, str] = {}

    def hash_without(self, keys: Iterable[str]) -> str:
        """Short name of what all points have in common: the file and its settings without keys."""
        # an override without value leaves its key out
        settings = [as_override(key, value) for key, value in self.settings.items()]
        bare = override(self.file.document, [*settings, *(f"{key}=" for key in keys)])
        return hash_of_case(bare.data)

    def overrides(self, values: Mapping[str, Value]) -> tuple[str, ...]:
        """All that a point differs by from the case file, as `--set` takes it; numbers of keys
        with a unit are SI."""
        return tuple(
            as_override(key, self._with_unit(key, value))
            for key, value in {**self.settings, **values}.items()
        )

    def point(self, values: Mapping[str, Value]) -> Point:
        """The point with these values, by key; where the case refuses them it says why."""
        settings = {key: self.to_si(key, value) for key, value in values.items()}
        overrides = self.overrides(values)
        try:
            case = self.file.case(overrides)
            refuse_if_too_large(case)
        except CaseError as error:
            return Point(settings, overrides, None, reason_of(error))
        return Point(settings, overrides, case)

    def learn_kinds(self, values: Mapping[str, Value]) -> None:
        """Find which kind of quantity each key reads, from a case with values for all of them.

        Raises:
            CaseError: what the case says of these values.
        """
        # the models of the case say which quantity a key is, as values choose between them
        given = {**self.settings, **values}
        contents = self.file.contents([as_override(key, value) for key, value in given.items()])
        self._kinds |= {key: _kind_at(contents, key) for key in given}

    def kind(self, key: str) -> str:
        """Kind of quantity that a key reads ("fluence"); empty for a bare number or a word, and
        where neither the case nor `learn_kinds` has a value for it. Raises CaseError."""
        if key not in self._kinds:
            contents = self.file.contents([as_override(*each) for each in self.settings.items()])
            self._kinds[key] = _kind_at(contents, key)
        return self._kinds[key]

    def unit(self, key: str) -> str:
        """SI unit of a key; empty where it has none."""
        kind = self.kind(key)
        return KINDS[kind].unit if kind not in ("", "fraction") else ""

    def to_si(self, key: str, value: Value) -> Value:
        """A value of a key as a number in SI units where it is a quantity.

        Raises:
            QuantityError: text that is no quantity of this kind.
        """
        if isinstance(value, str) and (kind := self.kind(key)):
            return parse_quantity(value, kind)
        return value

    def _with_unit(self, key: str, value: Value) -> Value:
        unit = "" if isinstance(value, bool | str) else self.unit(key)
        return f"{value!r} {unit}" if unit else value


def find_key(contents: BaseModel, key: str) -> tuple[Any, str]:
    """Value of a case at a key ("laser.fluence"), and which kind of quantity it is; None and
    "" where it gives nothing there.

    Raises:
        QuantityError: there is no such key.
    """
    found: Any = contents
    kind = ""
    # down the models and tuples of the case, step by step
    for step in present_place(steps_of(key)):
        known = type(found).model_fields if isinstance(found, BaseModel) else {}
        if found is None:
            return None, ""
        if isinstance(found, tuple) and isinstance(step, int) and step < len(found):
            kind, found = "", found[step]
        elif isinstance(found, BaseModel) and step in known:
            kind, found = quantity_kind(type(found), str(step)), getattr(found, str(step))
        else:
            raise QuantityError(f'"{key}" is no key of this case{did_you_mean(str(step), known)}')
    if isinstance(found, BaseModel) and "value" in type(found).model_fields:  # a law of a metal
        kind = quantity_kind(type(found), "value")
    return found, kind


def _kind_at(contents: BaseModel, key: str) -> str:
    """Kind of quantity at a key; empty where the model of a case has no such key: the file may
    (material.base), or the case says so when it is asked for the point."""
    try:
        return find_key(contents, key)[1]
    except QuantityError:
        return ""


def as_override(key: str, value: Value | list | dict) -> str:
    """A key and its value as `--set` takes them: text stays as it is where it is read as text."""
    if not isinstance(value, str):
        return f"{key}={as_toml(value)}"
    try:
        # text that TOML reads as something else is put in quotes
        tomllib.loads(f"value = {value}")
    except tomllib.TOMLDecodeError:
        return f"{key}={value}"
    return f"{key}={as_toml(value)}"


def reason_of(error: CaseError) -> str:
    """Reason why a case is refused, in one line: its first problem, and how many more there are."""
    first, more = error.problems[0], len(error.problems) - 1
    text = ": ".join(part for part in (first.key, first.problem) if part)
    text += f"; {first.hint}" if first.hint else ""
    return " ".join(text.split()) + (f" (and {more} more)" if more else "")
