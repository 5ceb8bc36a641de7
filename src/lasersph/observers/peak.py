"""The largest value of a quantity over a run, and when it was reached."""

from __future__ import annotations

from dataclasses import dataclass

VALUE_TOLERANCE = 1e-12
"""Relative difference of two values that are the same but for rounding."""
FALLEN = 0.5
"""Fall over the largest value after which that stands no longer. Guard: sizes of a pool flicker by
cells, of some percent; between two pulses it freezes."""


@dataclass
class Peak:
    """Largest value seen so far; `first` and `last` are the times between which it stood [s], and
    `stands` whether it still does.

    Sizes of a melt pool grow by whole cells, so the largest one stands for a while: `time` is the
    middle of that while, which is where a smooth curve would have its top. A later pulse that
    comes to the same size begins no while of its own.
    """

    value: float = 0.0
    first: float | None = None
    last: float | None = None
    stands: bool = True

    def update(self, value: float, time: float) -> None:
        """Take a value at a time into account."""
        # a new largest value, beyond rounding
        if self.first is None or value > self.value + VALUE_TOLERANCE * abs(self.value):
            self.value, self.first, self.last, self.stands = value, time, time, True
        # the same one still stands, within rounding
        elif self.stands and value >= self.value - VALUE_TOLERANCE * abs(self.value):
            self.value, self.last = max(value, self.value), time
        elif self.value - value > FALLEN * abs(self.value):
            self.stands = False

    @property
    def time(self) -> float | None:
        """Middle of the time during which the largest value stood [s]; None before any value."""
        if self.first is None or self.last is None:
            return None
        return 0.5 * (self.first + self.last)


@dataclass
class Span:
    """First and last time at which something held [s]."""

    first: float | None = None
    last: float | None = None

    def update(self, holds: bool, time: float) -> None:
        """Take note of whether it holds at a time."""
        if holds:
            self.first = time if self.first is None else self.first
            self.last = time
