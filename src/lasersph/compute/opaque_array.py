"""Arrays that refuse NumPy: only their backend reads them.

The strict backend's arrays are such, and those of a graphics card, whose elements NumPy would fetch
one by one if it could reach them at all.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np


class OpaqueArray:
    """Array that only its backend can read; knows its shape and type.

    Attributes:
        shape: as NumPy's. dtype: type of the elements.
    """

    __slots__ = ("dtype", "shape")
    __hash__ = object.__hash__

    def __init__(self, shape: tuple[int, ...], dtype: np.dtype) -> None:
        self.shape, self.dtype = shape, dtype

    @property
    def ndim(self) -> int:
        """Number of axes."""
        return len(self.shape)

    @property
    def size(self) -> int:
        """Number of elements."""
        return math.prod(self.shape)

    def __repr__(self) -> str:
        return f"{type(self).__name__}(shape={self.shape}, dtype={self.dtype})"

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        _refuse(f"np.{ufunc.__name__}")

    def __array_function__(self, function: Any, types: Any, args: Any, kwargs: Any) -> Any:
        _refuse(f"np.{function.__name__}")

    def __array__(self, *args: Any, **options: Any) -> Any:
        _refuse("conversion to a NumPy array")


def _refuse(what: str) -> None:
    raise TypeError(
        f"{what} on a backend's array; use the backend's loops, or backend.to_host() in output"
    )


def _refusing(name: str) -> Any:
    def refuse(self: OpaqueArray, *args: Any) -> Any:
        _refuse(f"operator {name}")

    return refuse


_OPERATORS = (
    "add sub mul truediv floordiv mod pow matmul radd rsub rmul rtruediv rfloordiv rmod rpow"
    " rmatmul iadd isub imul itruediv ifloordiv imod ipow neg pos abs invert and or xor lt le gt"
    " ge eq ne getitem setitem len iter bool float int contains"
)
for _name in _OPERATORS.split():
    setattr(OpaqueArray, f"__{_name}__", _refusing(_name))
