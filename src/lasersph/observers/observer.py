"""The base of every observer: fill its columns at each step, sum up at the end, survive a kill."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import asdict, is_dataclass
from typing import Any

from lasersph.observers.peak import Peak
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View

Row = dict[str, float | int | str]
"""Values of the history columns at a step, by key."""


class Observer(ABC):
    """Looks at a run after every step and changes nothing but itself.

    A subclass declares its `columns`, measures them in `observe` and hands them to `record`. What
    else it finds it declares as `results` and returns from `values`.

    Attributes:
        title, note: heading of its table in the report, and what the reader must know about it.
        columns: what it measures at each step; an instance may narrow them.
        results: what it says at the end, beside the largest and last values of its columns.
        kept: names of the attributes that a checkpoint holds, beside those of this class.
        peak: largest value so far of the columns that have a key for it.
        last: row of the last step.
    """

    title = ""
    note = ""
    columns: tuple[Quantity, ...] = ()
    results: tuple[Quantity, ...] = ()
    kept: tuple[str, ...] = ()

    # peaks of the columns that say so, and the last row
    def __init__(self) -> None:
        self.peak = {one.key: Peak() for one in self.columns if one.largest}
        self.last: Row = dict.fromkeys((one.key for one in self.columns), 0.0)

    @classmethod
    def all_results(cls) -> tuple[Quantity, ...]:
        """Every key of summary.json that it fills, with unit and words."""
        return (*(one for column in cls.columns for one in column.results()), *cls.results)

    @abstractmethod
    def observe(self, view: View) -> Row:
        """Values of its columns at this step."""

    def record(self, time: float, values: Sequence[float | int | str]) -> Row:
        """The row of some values, in the order of the columns, which it takes into account."""

        # values in the order of the columns, and what they do to the peaks
        keys = (one.key for one in self.columns)
        self.last = dict(zip(keys, values, strict=True))
        for key, peak in self.peak.items():
            peak.update(float(self.last[key]), time)
        return dict(self.last)

    def values(self) -> dict[str, object]:
        """Its `results` by dotted key."""
        return {}

    def summary(self) -> dict[str, Any]:
        """Its part of summary.json."""
        found: dict[str, object] = {}
        for one in self.columns:
            # a column of which the largest counts, and one of which the end does
            if one.largest:
                found[one.largest] = self.peak[one.key].value
                found[one.largest_at] = time_of(self.peak[one.key])
            if one.end:
                found[one.end] = self.last[one.key]
        return nest({**found, **self.values()})

    def state(self) -> dict[str, Any]:
        """State for `restore`: numbers, texts, lists and dicts."""
        return {name: to_plain(getattr(self, name)) for name in ("peak", "last", *self.kept)}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Continue from a state."""
        for name, value in state.items():
            setattr(self, name, rebuild(getattr(self, name), value))


def time_of(peak: Peak) -> float | None:
    """When a size peaked [s]; None where it never was above zero."""
    return peak.time if peak.value > 0.0 else None


def nest(flat: Mapping[str, object]) -> dict[str, Any]:
    """Dotted keys as dicts in dicts: {"melt.depth_m": 1} -> {"melt": {"depth_m": 1}}."""
    result: dict[str, Any] = {}
    for key, value in flat.items():
        *sections, name = key.split(".")
        # walk to the section of each key, made where it is missing
        part = result
        for section in sections:
            part = part.setdefault(section, {})
        part[name] = value
    return result


def to_plain(value: Any) -> Any:
    """A copy made of dicts, lists, numbers and texts."""
    if is_dataclass(value) and not isinstance(value, type):
        return asdict(value)
    if isinstance(value, dict):
        return {key: to_plain(item) for key, item in value.items()}
    return [to_plain(item) for item in value] if isinstance(value, list | tuple) else value


def rebuild(old: Any, value: Any) -> Any:
    """A plain value with the data classes of the one that it replaces."""
    # data classes of the state that is replaced
    if is_dataclass(old) and not isinstance(old, type):
        return type(old)(**value)
    if isinstance(old, dict) and isinstance(value, dict):
        return {key: rebuild(old.get(key), item) for key, item in value.items()}
    if isinstance(old, list) and isinstance(value, list) and len(old) == len(value):
        return [rebuild(one, item) for one, item in zip(old, value, strict=True)]
    return to_plain(value)
