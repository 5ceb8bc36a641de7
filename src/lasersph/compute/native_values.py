"""Values of native code: numbers, addresses and arrays, each with its type, as LLVM writes them.

Types are NumPy's; which type two numbers have together follows Numba's rules for whole numbers
(64 bits, signed where one of both is) and NumPy's for the rest.
"""

from __future__ import annotations

import struct
from typing import Any, NamedTuple

import numpy as np

from lasersph.compute.values import LoopSourceError

BOOL, INT64, UINT64, FLOAT64 = map(np.dtype, ("bool", "int64", "uint64", "float64"))
LLVM = {
    "bool": "i1",
    "uint8": "i8",
    "uint32": "i32",
    "int64": "i64",
    "uint64": "i64",
    "float32": "float",
    "float64": "double",
}
"""LLVM's names of types."""


class Number(NamedTuple):
    """A number: its type, and its register or its literal."""

    dtype: np.dtype
    text: str

    @property
    def is_literal(self) -> bool:
        """Whether it is known."""
        return not self.text.startswith("%")

    @property
    def typed(self) -> str:
        """Type and text, as instructions take them."""
        return f"{LLVM[self.dtype.name]} {self.text}"


class Pointer(NamedTuple):
    """Address of elements of a type."""

    dtype: np.dtype
    text: str


class View(NamedTuple):
    """A contiguous array: type of its elements, address, and its lengths."""

    dtype: np.dtype
    text: str
    shape: tuple[Number, ...]


Item = Number | Pointer | View | list[Any]
"""An expression gives one of these, or a list of several."""


def literal(value: Any) -> Number:
    """A number that is known.

    Raises:
        LoopSourceError: it is no number.
    """
    dtype = BOOL if isinstance(value, bool | np.bool_) else np.asarray(value).dtype
    if dtype.name not in LLVM:
        raise LoopSourceError(f"{value!r} is no number of a loop")
    if dtype.kind == "f":  # the bits of the number in double precision, which LLVM asks for
        return Number(dtype, f"0x{struct.unpack('<Q', struct.pack('<d', value))[0]:016X}")
    if dtype == BOOL:
        return Number(dtype, "true" if value else "false")
    return Number(dtype, str(int(value)))


def joined(a: np.dtype, b: np.dtype) -> np.dtype:
    """Type that holds numbers of both."""
    if a == b:
        return a
    if "f" in (a.kind, b.kind):
        return np.promote_types(a, b)
    return INT64 if "i" in (a.kind, b.kind) or BOOL in (a, b) else UINT64


def arithmetic(a: np.dtype, b: np.dtype) -> np.dtype:
    """Type of a sum or product: whole numbers have 64 bits."""
    if "f" in (a.kind, b.kind):
        return np.promote_types(a, b)
    return UINT64 if a.kind == b.kind == "u" else INT64


def number(item: Item) -> Number:
    """The number that an expression gives.

    Raises:
        LoopSourceError: it gives something else.
    """
    if not isinstance(item, Number):
        raise LoopSourceError("a number is asked for")
    return item
