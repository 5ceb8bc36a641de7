"""Strict backend: the CPU's loops on arrays that refuse NumPy.

A solver that runs on it touches particle-long arrays only through the backend, and so also runs
where these arrays live in the memory of a graphics card.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.compute.backend import Backend


class StrictArray:
    """Array that only its backend can read; knows its shape and type."""

    __slots__ = ("_host",)
    __hash__ = object.__hash__

    def __init__(self, host: np.ndarray) -> None:
        self._host = host

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the array."""
        return self._host.shape

    @property
    def dtype(self) -> np.dtype:
        """Type of the elements."""
        return self._host.dtype

    @property
    def ndim(self) -> int:
        """Number of axes."""
        return self._host.ndim

    @property
    def size(self) -> int:
        """Number of elements."""
        return self._host.size

    def __repr__(self) -> str:
        return f"StrictArray(shape={self.shape}, dtype={self.dtype})"

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
    def refuse(self: StrictArray, *args: Any) -> Any:
        _refuse(f"operator {name}")

    return refuse


_OPERATORS = (
    "add sub mul truediv floordiv mod pow matmul radd rsub rmul rtruediv rfloordiv rmod rpow"
    " rmatmul iadd isub imul itruediv ifloordiv imod ipow neg pos abs invert and or xor lt le gt"
    " ge eq ne getitem setitem len iter bool float int contains"
)
for _name in _OPERATORS.split():
    setattr(StrictArray, f"__{_name}__", _refusing(_name))


class StrictBackend(Backend):
    """CPU backend whose arrays are `StrictArray`."""

    def wrap(self, array: np.ndarray) -> Any:
        """Array as the caller sees it."""
        return StrictArray(array)

    def unwrap(self, array: Any) -> np.ndarray:
        """NumPy array behind the caller's array.

        Raises:
            TypeError: it does not come from a strict backend.
        """
        if type(array) is not StrictArray:
            raise TypeError(f"{type(array).__name__} given; make it with backend.asarray()")
        return array._host
