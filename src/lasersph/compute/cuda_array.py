"""Arrays in the memory of a graphics card."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from lasersph.compute import cuda_kernels, cuda_memory
from lasersph.compute.opaque_array import OpaqueArray


class CudaArray(OpaqueArray):
    """Array of (n,), (dim, n) or (dim, dim, n) whose components are separate pieces of memory.

    Attributes:
        parts: pieces of n elements, row-major; of one element, never read, where n is 0.
        base: the array whose elements this one shows; None where they are its own.
    """

    __slots__ = ("_changes", "_known", "base", "parts")

    def __init__(self, parts: tuple, shape: tuple[int, ...], base: CudaArray | None = None) -> None:
        super().__init__(shape, np.dtype(parts[0].dtype))
        self.parts, self.base = parts, base
        self._changes = 0
        self._known: dict[str, tuple[int, int]] = {}

    @classmethod
    def of_shape(
        cls, shape: int | tuple[int, ...], dtype: np.dtype, allocate: Any = cuda_memory.allocate
    ) -> CudaArray:
        """Array with undefined elements, or as `allocate` gives them."""
        sizes = (shape,) if isinstance(shape, int) else tuple(int(n) for n in shape)
        count = max(sizes[-1], 1)
        number = math.prod(sizes[:-1])
        memory = allocate(max(number, 1) * count, dtype)
        return cls(_cut(memory, number, count), sizes)

    @classmethod
    def from_host(cls, array: np.ndarray) -> CudaArray:
        """Copy of an array in the host's memory."""
        if array.size == 0:
            return cls.of_shape(array.shape, array.dtype)
        memory = cuda_memory.from_host(np.ascontiguousarray(array).reshape(-1))
        count = array.shape[-1]
        return cls(_cut(memory, array.size // count, count), array.shape)

    @property
    def _root(self) -> CudaArray:
        """The array whose own the elements are."""
        return self if self.base is None else self.base

    @property
    def version(self) -> int:
        """Number of times that the elements may have changed."""
        return self._root._changes

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
        parts = tuple([part.cut(0, max(count, 1)) for part in self.parts])
        return CudaArray(parts, (*self.shape[:-1], count), self._root)

    def behind_first(self) -> CudaArray:
        """View of all elements but the first, of an array of one axis."""
        count = self.size
        return CudaArray((self.parts[0].cut(min(1, count - 1), count),), (count - 1,), self._root)

    def component(self, number: int) -> CudaArray:
        """View of one component, row-major."""
        return CudaArray((self.parts[number],), self.shape[-1:], self._root)

    def to_host(self) -> np.ndarray:
        """Copy in the host's memory."""
        count = self.shape[-1]
        host = np.empty((len(self.parts), count), self.dtype)
        if count:
            for part, row in zip(self.parts, host, strict=False):
                row[:] = cuda_memory.to_host(part)
        return host.reshape(self.shape)

    def last(self) -> int:
        """The last element of an array of whole numbers."""
        count = self.shape[-1]
        return self._fetched("last", lambda: self.parts[0].cut(count - 1, count))

    def largest(self) -> int:
        """The largest element of a 1-D index array, 0 where it is empty."""

        def found() -> Any:
            most = cuda_memory.zeros(1, np.dtype(np.uint32))
            cuda_memory.start(cuda_kernels.largest, self.size, self.parts[0], most)
            return most

        return self._fetched("largest", found)

    def _fetched(self, name: str, find: Callable[[], Any]) -> int:
        """A number of one element on the device, fetched where elements may have changed."""
        version, value = self._known.get(name, (-1, 0))
        if version != self.version:
            value = int(cuda_memory.to_host(find())[0])
            self._known[name] = (self.version, value)
        return value

    def changed(self) -> None:
        """Note that the elements may have been written."""
        self._root._changes += 1


def _cut(memory: Any, number: int, count: int) -> tuple:
    """Components of contiguous memory; one that is never read where there are none."""
    if number <= 1:
        return (memory,)
    return tuple([memory.cut(k * count, (k + 1) * count) for k in range(number)])
