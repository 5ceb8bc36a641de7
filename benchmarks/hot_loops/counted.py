"""Numbers that count what a pair or pointwise function does with them.

Such functions are plain Python: called with these in the place of floats they tell how many
operations their formula has, and the count cannot differ from the code that is timed.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

import numpy as np


class Tally:
    """How many operations were done.

    Attributes:
        simple: additions, multiplications, comparisons. divisions: divisions, roots, powers.
    """

    def __init__(self) -> None:
        self.simple, self.divisions = 0, 0


class Counted:
    """A float whose operations are noted in a tally; what plain floats do is not."""

    __slots__ = ("tally", "value")
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, value: Any, tally: Tally) -> None:
        self.value, self.tally = float(value), tally

    def sqrt(self) -> Counted:
        """Root; NumPy asks for it by this name."""
        self.tally.divisions += 1
        return Counted(self.value**0.5, self.tally)

    def __pow__(self, exponent: float) -> Counted:
        """Multiplications by repeated squaring where the exponent is whole."""
        if float(exponent).is_integer() and exponent > 0:
            whole = int(exponent)
            self.tally.simple += whole.bit_length() + whole.bit_count() - 2
        else:
            self.tally.divisions += 1
        return Counted(self.value**exponent, self.tally)

    def __neg__(self) -> Counted:
        """The sign goes into the next addition."""
        return Counted(-self.value, self.tally)

    def __abs__(self) -> Counted:
        """A bit, no arithmetic."""
        return Counted(abs(self.value), self.tally)

    def __int__(self) -> int:
        """Whole part, of which nothing more is counted: addresses are no arithmetic."""
        self.tally.simple += 1
        return int(self.value)


def _result(function: Callable, kind: str, *, reflected: bool = False) -> Callable:
    """Method that notes one operation; numbers stay counted, comparisons give a bool."""

    def method(self: Counted, other: Any) -> Any:
        if isinstance(other, np.ndarray):
            return NotImplemented  # NumPy then goes through the components
        tally = self.tally
        setattr(tally, kind, getattr(tally, kind) + 1)
        value = other.value if isinstance(other, Counted) else other
        result = function(value, self.value) if reflected else function(self.value, value)
        return Counted(result, tally) if isinstance(result, float) else result

    return method


for _name in ("add", "sub", "mul", "truediv"):
    _kind = "divisions" if _name == "truediv" else "simple"
    _function = getattr(operator, _name)
    setattr(Counted, f"__{_name}__", _result(_function, _kind))
    setattr(Counted, f"__r{_name}__", _result(_function, _kind, reflected=True))
for _name in ("lt", "le", "gt", "ge", "eq", "ne"):
    setattr(Counted, f"__{_name}__", _result(getattr(operator, _name), "simple"))


class Table:
    """A table of real numbers, vectors or tensors whose entries are counted."""

    def __init__(self, array: np.ndarray, tally: Tally) -> None:
        self.array, self.tally = array, tally

    def __len__(self) -> int:
        """Number of entries."""
        return self.array.shape[-1]

    def __getitem__(self, place: int) -> Any:
        """One entry: a number, vector or tensor."""
        return as_counted(self.array[..., place], self.tally)


def as_counted(value: Any, tally: Tally) -> Any:
    """A number or vector as counted ones; whole numbers as they are."""
    array = np.asarray(value)
    if array.dtype.kind != "f":
        return value
    if array.ndim == 0:
        return Counted(value, tally)
    numbers = np.empty(array.shape, dtype=object)
    for place in np.ndindex(array.shape):
        numbers[place] = Counted(array[place], tally)
    return numbers
