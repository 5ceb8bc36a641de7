"""Strict backend: the CPU's loops on arrays that refuse NumPy.

A solver that runs on it touches particle-long arrays only through the backend, and so also runs
where these arrays live in the memory of a graphics card.
"""

from __future__ import annotations

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.opaque_array import OpaqueArray


class StrictArray(OpaqueArray):
    """Array of the processor's memory that only its backend can read."""

    __slots__ = ("_host",)

    def __init__(self, host: np.ndarray) -> None:
        super().__init__(host.shape, host.dtype)
        self._host = host


class StrictBackend(Backend):
    """CPU backend whose arrays are `StrictArray`, and whose graphs must do the same each time."""

    def __init__(self, threads_wanted: int | None, precision: str) -> None:
        super().__init__(threads_wanted, precision)
        self.loops.recorder.checks = True

    def wrap(self, array: np.ndarray) -> Array:
        """Array as the caller sees it."""
        return StrictArray(array)

    def unwrap(self, array: Array) -> np.ndarray:
        """NumPy array behind the caller's array.

        Raises:
            TypeError: it does not come from a strict backend.
        """
        if type(array) is not StrictArray:
            raise TypeError(f"{type(array).__name__} given; make it with backend.asarray()")
        return array._host

    def unset(self, shape: int | tuple[int, ...]) -> Array:
        """Array of NaN, which shows where an element is read that no loop has set."""
        found = super().unset(shape)
        self.unwrap(found)[...] = np.nan
        return found

    def object_address(self, array: Array) -> int:
        """Address of the NumPy object behind the caller's array."""
        return id(self.unwrap(array))
