"""Numba's simulator in the place of a graphics card: the same names as in `cuda_card`."""

# pyright: reportAttributeAccessIssue=false, reportCallIssue=false, reportArgumentType=false
# The simulator's arrays are not Numba's.

from __future__ import annotations

from typing import Any

import numpy as np
from numba import cuda

from lasersph.compute.cuda_device import THREADS


class Piece:
    """Elements that lie side by side; `array` is the simulator's."""

    __slots__ = ("array", "dtype")

    def __init__(self, array: Any) -> None:
        self.array, self.dtype = array, np.dtype(array.dtype)

    def cut(self, first: int, last: int) -> Piece:
        """The elements from `first` to before `last`."""
        return Piece(self.array[first:last])


def allocate(count: int, dtype: np.dtype) -> Piece:
    """Elements of any values."""
    return Piece(cuda.device_array(count, dtype))


def zeros(count: int, dtype: np.dtype) -> Piece:
    """Elements that are 0."""
    return from_host(np.zeros(count, dtype))


def from_host(array: np.ndarray) -> Piece:
    """Copy of a NumPy array."""
    return Piece(cuda.to_device(np.ascontiguousarray(array)))


def to_host(piece: Piece) -> np.ndarray:
    """Copy as a NumPy array."""
    return piece.array.copy_to_host()


def wait() -> None:
    """Return: a start returns when it is done."""


class Room:
    """Memory that kernels write and the host reads."""

    def __init__(self, count: int, dtype: np.dtype) -> None:
        self.piece = allocate(count, dtype)

    def read(self) -> np.ndarray:
        """The elements."""
        return to_host(self.piece)


class Call:
    """A kernel with its arguments, started as often as wanted; see `cuda_card.Call`."""

    def __init__(self, kernel: Any, arguments: list[Any]) -> None:
        self._kernel, self._arguments = kernel, list(arguments)
        self._numbers: list[tuple[int, np.ndarray]] = []

    def numbers(self, first: int, count: int, dtype: np.dtype) -> np.ndarray:
        """Memory of the numbers from argument `first` on, which later starts take."""
        self._numbers.append((first, np.array(self._arguments[first : first + count], dtype)))
        return self._numbers[-1][1]

    def replace(self, place: int, piece: Piece) -> None:
        """Another piece of the same kind as an argument."""
        self._arguments[place] = piece

    def start(self, groups: int) -> None:
        """Run it with so many groups of threads."""
        for first, numbers in self._numbers:
            self._arguments[first : first + numbers.size] = numbers
        given = [one.array if type(one) is Piece else one for one in self._arguments]
        self._kernel[groups, THREADS](*given)
