"""Measured quantities: key, unit and words of each quantity, declared once beside its formula.

The columns of history.csv, the keys of summary.json, the tables of the report, `lasersph info` and
the page "Results" of the documentation all derive from these declarations.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from lasersph.input.key_units import suffix

MOMENT = re.compile(r"(?!pulses\.starts)(.*[._])?((start|end)s?|at|time)(_any|_half)?_s")
"""Keys of times that count from the start of the run; those of lengths of time say otherwise."""


@dataclass(frozen=True)
class Quantity:
    """Something that an observer measures.

    Attributes:
        key: column of history.csv, or dotted key of summary.json; it ends in the unit (`_m_s`).
            `<name>` in it stands for the name of a probe, a trace, ...
        unit: SI, "" for a pure number or a text. Amounts: in 3-D, see
            `input.key_units.EXTENSIVE`.
        words: what it is, as a table says it.
        largest: key of summary.json for its largest value; `..._at_s` beside it says when.
        end: key of summary.json for its value at the end of the run.
        at: keys of summary.json that say when and where.
        is_main: whether `lasersph info` shows it.
        cells: cells by which its largest value or that at the end jumps, as sizes in whole cells
            do; half as many where it is interpolated between them; 0 for what does not jump.
    """

    key: str
    unit: str
    words: str
    largest: str = ""
    end: str = ""
    at: tuple[str, ...] = ()
    is_main: bool = False
    cells: float = 0.0

    def __post_init__(self) -> None:
        """Raises ValueError where a key does not say the unit."""
        for key in (self.key, self.largest, self.end):
            # the last part of a key says the unit, so that a reader of numbers knows it
            if key and suffix(self.unit) + "_" not in key + "_":
                raise ValueError(f'"{key}" must have "{suffix(self.unit)}" at its end: {self.unit}')

    @property
    def largest_at(self) -> str:
        """Key of the time at which it was largest."""
        return f"{self.largest.removesuffix(suffix(self.unit))}_at_s"

    def of(self, name: str) -> Quantity:
        """The same of something with a name."""
        keys = (key.replace("<name>", name) for key in (self.key, self.largest, self.end))
        return replace(self, **dict(zip(("key", "largest", "end"), keys, strict=True)))

    def results(self) -> Iterator[Quantity]:
        """The keys of summary.json that follow from a column."""
        # a largest value has its own key, with the time at which it was reached
        if self.largest:
            words, at = f"largest {self.words}", (self.largest_at, *self.at)
            yield replace(self, key=self.largest, words=words, at=at, largest="", end="")
        # a last value too, named so where both are there
        if self.end:
            words = f"{self.words}, at the end" if self.largest else self.words
            is_main = self.is_main and not self.largest
            yield replace(self, key=self.end, words=words, is_main=is_main, largest="", end="")
