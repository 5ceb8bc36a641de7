"""Arrays in the memory of a graphics card."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numba import cuda

from lasersph.compute import cuda_kernels
from lasersph.compute.cuda_device import start
from lasersph.compute.opaque_array import OpaqueArray


class Memory:
    """Elements that arrays share; counts their changes.

    Attributes:
        version: number of times that the elements may have changed.
    """

    __slots__ = ("version",)

    def __init__(self) -> None:
        self.version = 0


class CudaArray(OpaqueArray):
    """Array of (n,), (dim, n) or (dim, dim, n) whose components are separate arrays of Numba.

    Attributes:
        parts: 1-D arrays of n elements, row-major; of one element, never read, where n is 0.
        memory: shared with all views of the same elements.
    """

    __slots__ = ("_known", "memory", "parts")

    def __init__(self, parts: tuple, shape: tuple[int, ...], memory: Memory) -> None:
        super().__init__(shape, np.dtype(parts[0].dtype))
        self.parts, self.memory = parts, memory
        self._known: dict[str, tuple[int, int]] = {}

    @classmethod
    def of_shape(cls, shape: int | tuple[int, ...], dtype: Any) -> CudaArray:
        """Array with undefined elements."""
        sizes = (shape,) if isinstance(shape, int) else tuple(int(n) for n in shape)
        count = max(sizes[-1], 1)
        number = math.prod(sizes[:-1])
        memory = cuda.device_array(max(number, 1) * count, dtype)
        return cls(_cut(memory, number, count), sizes, Memory())

    @classmethod
    def from_host(cls, array: np.ndarray) -> CudaArray:
        """Copy of an array in the host's memory."""
        if array.size == 0:
            return cls.of_shape(array.shape, array.dtype)
        memory = cuda.to_device(np.ascontiguousarray(array).reshape(-1))
        count = array.shape[-1]
        return cls(_cut(memory, array.size // count, count), array.shape, Memory())

    @property
    def itemsize(self) -> int:
        """Bytes of an element."""
        return self.dtype.itemsize

    @property
    def strides(self) -> tuple[int, ...]:
        """Bytes from element to element along the last axis: components are contiguous."""
        return (self.itemsize,)

    def head(self, count: int) -> CudaArray:
        """View of the first `count` elements of each component."""
        parts = tuple(part[: max(count, 1)] for part in self.parts)
        return CudaArray(parts, (*self.shape[:-1], count), self.memory)

    def component(self, number: int) -> CudaArray:
        """View of one component, row-major."""
        return CudaArray((self.parts[number],), self.shape[-1:], self.memory)

    def to_host(self) -> np.ndarray:
        """Copy in the host's memory."""
        count = self.shape[-1]
        host = np.empty((len(self.parts), count), self.dtype)
        if count:
            for part, row in zip(self.parts, host, strict=False):
                row[:] = part.copy_to_host()
        return host.reshape(self.shape)

    def last(self) -> int:
        """The last element of an array of whole numbers."""
        count = self.shape[-1]
        return self._fetched("last", lambda: self.parts[0][count - 1 : count])

    def largest(self) -> int:
        """The largest element of a 1-D index array, 0 where it is empty."""

        def found() -> Any:
            most = cuda.to_device(np.zeros(1, np.uint32))
            start(cuda_kernels.largest, self.size, np.uint64(self.size), self.parts[0], most)
            return most

        return self._fetched("largest", found)

    def _fetched(self, name: str, find: Callable[[], Any]) -> int:
        """A number of one element on the device, fetched where elements may have changed."""
        version, value = self._known.get(name, (-1, 0))
        if version != self.memory.version:
            value = int(find().copy_to_host()[0])
            self._known[name] = (self.memory.version, value)
        return value

    def changed(self) -> None:
        """Note that the elements may have been written."""
        self.memory.version += 1


def _cut(memory: Any, number: int, count: int) -> tuple:
    """Components of contiguous memory; one that is never read where there are none."""
    if number <= 1:
        return (memory,)
    return tuple(memory[k * count : (k + 1) * count] for k in range(number))
