"""Calls that native code understands beside functions of its own text.

| call | gives |
|---|---|
| `real(x)`, `np.uint64(x)`, ... | the number in another type |
| `at_float64(address)`, ... | elements at an address |
| `carray(elements, shape)` | a contiguous array |
| `scratch_...()` of a type | memory for `CAPACITY` elements, which no other memory overlaps |
| `minimum(a, b)`, `maximum(a, b)` | NaN where one is NaN, in any order of many |
| `invoke(loop, ...)` | what is compiled at an address, called with whole numbers |
| `share(loop, ...)` | the same for blocks of rows on several threads |
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.compute.native_code import Code
from lasersph.compute.native_values import (
    BOOL,
    INT64,
    LLVM,
    UINT64,
    Item,
    Number,
    Pointer,
    View,
    literal,
    number,
)

CAPACITY = 64
"""Elements of the scratch memory of a function: more than most particles have neighbors."""
SHARE = "lasersph_share_blocks"
"""Symbol of the function that shares blocks among threads."""
_ONE = {"sqrt", "exp", "log", "log10", "sin", "cos", "floor", "ceil"}
_TWO = {"pow", "copysign"}
_LIBRARY = {"tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "expm1", "log1p", "erf"}
_LIBRARY |= {"erfc", "atan2"}


def called(code: Code, name: str, given: list[Item]) -> Item | None:
    """Value of a call; None where the name is not known."""
    prefix, _, kind = name.partition("_")
    if prefix == "at" and kind in LLVM:
        return code.pointer(code.cast(number(given[0]), UINT64), np.dtype(kind))
    if prefix == "scratch" and kind in LLVM:
        return Pointer(np.dtype(kind), code.place(f"[{CAPACITY} x {LLVM[kind]}]"))
    if name in _NAMED:
        return _NAMED[name](code, given)
    library, _, function = name.rpartition(".")
    if library in ("math", "np"):
        return _mathematical(code, function, given)
    return None


def _mathematical(code: Code, name: str, given: list[Any]) -> Item | None:
    """A function of `math` or `numpy`."""
    if name in _ONE or name in _TWO:
        return code.intrinsic(name, given)
    if name in _LIBRARY:
        return code.library(name, given)
    return None


def _array(code: Code, given: list[Any]) -> View:
    elements, shape = given
    lengths = shape if isinstance(shape, list) else [shape]
    return View(elements.dtype, elements.text, tuple(code.cast(n, INT64) for n in lengths))


def _whole(code: Code, given: list[Any]) -> Number:
    """int(x)."""
    (value,) = given
    return value if value.dtype.kind == "u" else code.cast(value, INT64)


def _length(_code: Code, given: list[Any]) -> Number:
    """len(x)."""
    (one,) = given
    return one.shape[0] if isinstance(one, View) else literal(len(one))


def _invoked(code: Code, given: list[Any]) -> list:
    """Call what is compiled at an address."""
    loop, *numbers = given
    arguments = ", ".join(code.cast(one, UINT64).typed for one in numbers)
    place = code.register(f"inttoptr {loop.typed} to ptr")
    code.put(f"call void {place}({arguments})")
    return []


def _shared(code: Code, given: list[Any]) -> list:
    """Call the loop at an address for each of its blocks, on several threads."""
    arguments = ", ".join(code.cast(one, UINT64).typed for one in given)
    code.declared.add(f"declare void @{SHARE}({', '.join(['i64'] * len(given))})")
    code.put(f"call void @{SHARE}({arguments})")
    return []


_NAMED = {
    "carray": _array,
    "int": _whole,
    "len": _length,
    "bool": lambda code, given: code.cast(given[0], BOOL),
    "abs": lambda code, given: code.absolute(given[0]),
    "min": lambda code, given: code.extreme("<", given),
    "max": lambda code, given: code.extreme(">", given),
    "minimum": lambda code, given: code.intrinsic("minimum", given, "nsz "),
    "maximum": lambda code, given: code.intrinsic("maximum", given, "nsz "),
    "invoke": _invoked,
    "share": _shared,
}
