"""Backend on a graphics card: the CPU backend's arrays, copies and sorts in its memory.

Loops come from the same pair functions (`cuda_launch`). Work is queued in order; only what returns
numbers to the host waits for it. Orders and neighbors are not compared with the lengths of what
they index.
"""

from __future__ import annotations

from typing import Any, cast

import numpy as np

from lasersph.compute import cuda_device, cuda_kernels, cuda_memory
from lasersph.compute.array_types import Array, Rows
from lasersph.compute.backend import GROWTH, Backend
from lasersph.compute.cuda_array import CudaArray
from lasersph.compute.cuda_device import THREADS
from lasersph.compute.cuda_launch import CudaLauncher
from lasersph.compute.cuda_memory import start
from lasersph.compute.cuda_search import CudaSearch
from lasersph.compute.device_array import DeviceArray

FEW = 8 * THREADS
"""Pieces whose sums one group of threads adds up, in eight turns."""


def twice(value):
    """The value, to be reduced in two ways."""
    return value, value


class CudaBackend(Backend):
    """Loops on the first graphics card in one precision.

    Attributes:
        device: name of the card.

    Raises:
        NoDevice: there is none, or numba-cuda is missing.
    """

    name = "cuda"
    _undefined = staticmethod(CudaArray.of_shape)

    def __init__(self, precision: str) -> None:
        self.device = cuda_device.checked()
        super().__init__(1, precision)
        self.search = CudaSearch(self)
        self._shown: dict[Any, DeviceArray] = {}

    def launcher(self) -> CudaLauncher:
        """The launcher of the loops."""
        return CudaLauncher()

    # --- arrays ---------------------------------------------------------------------------------

    def wrap(self, array: CudaArray | np.ndarray) -> CudaArray:
        """Array as the caller sees it; host data are copied."""
        return array if isinstance(array, CudaArray) else CudaArray.from_host(array)

    def unwrap(self, array: Array) -> CudaArray:
        """The array, whose components are the kernels' arguments.

        Raises:
            TypeError: it does not come from this backend.
        """
        if type(array) is not CudaArray:
            raise TypeError(f"{type(array).__name__} given; make it with backend.asarray()")
        return array

    def to_host(self, array: Array) -> np.ndarray:
        """Copy as a NumPy array."""
        return self.unwrap(array).to_host()

    def host_view(self, array: Array) -> np.ndarray:
        """The array for reading, until the next loop; copied as far as it is looked at."""
        return cast(np.ndarray, DeviceArray(self, self.unwrap(array)))  # to NumPy it is one

    def shown(self, host: np.ndarray) -> np.ndarray:
        """Host array that never changes, with a copy on the card; copied once."""
        place = host.__array_interface__
        key = place["data"], host.shape, host.strides
        if key not in self._shown:
            array = CudaArray.from_host(np.array(host, self.real, order="C"))
            self._shown[key] = DeviceArray(self, array, whole=host)
        return cast(np.ndarray, self._shown[key])

    def extremes(self, array: Array, rows: Rows | None = None) -> tuple[float, float]:
        """Least and largest element (n,), of some rows or all; NaN where there is one."""
        least, most = self.pointwise(
            twice, {"value": array}, (None, None), rows=rows, reduce=("min", "max")
        )
        return least, most

    def capacity_for(self, count: int) -> int:
        """Elements to have memory for where an array of so many may grow; it is taken at once."""
        return count + count // GROWTH

    def empty(self, shape: int | tuple[int, ...], dtype: Any) -> CudaArray:
        """Array with undefined elements."""
        return CudaArray.of_shape(shape, np.dtype(dtype))

    def zeros(self, shape: int | tuple[int, ...], kind: str = "real") -> CudaArray:
        """Array of zeros; (n,) scalar, (dim, n) vector, (dim, dim, n) tensor fields."""
        return self.unwrap(super().zeros(shape, kind))

    def _zeroed(self, shape: int | tuple[int, ...], dtype: np.dtype) -> CudaArray:
        """Array with elements 0."""
        return CudaArray.of_shape(shape, dtype, cuda_memory.zeros)

    def wait(self) -> None:
        """Return when the card has done everything that was started."""
        cuda_memory.wait()

    def _copy_elements(self, first: CudaArray, second: CudaArray) -> None:
        """Copy elements at once."""
        for a, b in zip(first.parts, second.parts, strict=True):
            start(cuda_kernels.cast, first.shape[-1], a, b)
        second.changed()

    def _fill_elements(self, whole: CudaArray, value: float) -> None:
        """Set all elements at once."""
        for part in whole.parts:
            start(cuda_kernels.fill, whole.shape[-1], part, whole.dtype.type(value))
        whole.changed()

    def head(self, array: Array, count: int) -> CudaArray:
        """View of the first `count` particles of (n,), (dim, n) or (dim, dim, n)."""
        source = self.unwrap(array)
        if not 0 <= count <= source.shape[-1]:
            raise ValueError(f"the first {count} of {source.shape[-1]} particles")
        return source.head(count)

    def component(self, array: Array, k: int) -> CudaArray:
        """View of component k of a vector or tensor, row-major: (n,) of (dim, n), (dim, dim, n)."""
        return self.unwrap(array).component(k)

    def gather(self, source: Array, order: Array, out: Array) -> None:
        """out[..., k] = source[..., order[k]]."""
        self._move(cuda_kernels.gather, "gather", source, order, out)

    def scatter(self, source: Array, order: Array, out: Array) -> None:
        """out[..., order[k]] = source[..., k]; the other elements keep their values."""
        self._move(cuda_kernels.scatter, "scatter", source, order, out)

    def _move(self, kernel: Any, verb: str, source: Array, order: Array, out: Array) -> None:
        first, last, index = self.unwrap(source), self.unwrap(out), self.unwrap(order)
        if first.dtype != last.dtype or first.shape[:-1] != last.shape[:-1]:
            raise ValueError(f"{verb} between arrays of different kind")
        if index.size > (last if verb == "gather" else first).shape[-1]:
            raise ValueError(f"{verb} of {index.size} elements")
        for a, b in zip(first.parts, last.parts, strict=True):
            start(kernel, index.size, a, index.parts[0], b)
        last.changed()

    def exclusive_scan(self, counts: Array, out: Array) -> None:
        """out[k] = counts[0] + ... + counts[k-1] for k = 0 ... n; out is "offset", length n + 1."""
        first, last = self.unwrap(counts), self.unwrap(out)
        if last.dtype != np.uint64 or last.size != first.size + 1:
            raise ValueError("out must be of kind offset and one longer than counts")
        self._scan(first.parts[0], first.size, last.parts[0])
        last.changed()

    def _scan(self, counts: Any, size: int, out: Any) -> None:
        """Sums within pieces, of the pieces before each, and both together."""
        if size == 0:
            start(cuda_kernels.fill, 1, out, np.uint64(0))
            return
        # running sums within pieces of a group's size
        pieces = -(-size // THREADS)
        sums = self.empty(pieces, np.uint64).parts[0]
        start(cuda_kernels.piece_sums, size, counts, out, sums)
        if pieces == 1:
            return
        # sums before each piece: by one group, of very many by the same scan
        if pieces <= FEW:
            cuda_memory.start_one(cuda_kernels.sums_before, pieces, sums)
            before = sums
        else:
            before = self.empty(pieces + 1, np.uint64).parts[0]
            self._scan(sums, pieces, before)
        start(cuda_kernels.add_piece_sums, size, before, out)

    def rows_where(self, array: Array, value: float) -> CudaArray:
        """Rows k in order, kind "index", whose array[k] is exactly `value`."""
        source = self.unwrap(array)
        size = source.size
        marks = self.empty(size, np.uint32)
        # compared in double precision, which holds every number of every kind but huge offsets
        start(cuda_kernels.mark_equal, size, source.parts[0], np.float64(value), marks.parts[0])
        # a marked row goes to the number of marks before it
        place = self.empty(size + 1, np.uint64)
        self.exclusive_scan(marks, place)
        rows = self.empty(place.last(), np.uint32)
        start(cuda_kernels.list_marked, size, marks.parts[0], place.parts[0], rows.parts[0])
        return rows

    def rows_by_key(self, keys: Array, key_count: int) -> tuple[CudaArray, CudaArray]:
        """Where the rows of each index key begin, and these key after key, see `Backend`."""
        first = self.empty(key_count + 1, np.uint64)
        self.exclusive_scan(self.count_by_key(keys, key_count), first)
        return first, self._sorted(keys, key_count)

    def sort_by_key(self, keys: Array, key_count: int) -> CudaArray:
        """Stable order that sorts index keys 0 ... key_count - 1, kind "index"."""
        # refuse keys that are too large
        self.count_by_key(keys, key_count)
        return self._sorted(keys, key_count)

    def _sorted(self, keys: Array, key_count: int) -> CudaArray:
        """Stable order that sorts index keys below `key_count`."""
        size = keys.size
        # radix sort: keys and rows by one digit after the other, the lowest first
        pieces = -(-size // THREADS)
        now = self.unwrap(keys).parts[0]
        order = self.empty(size, np.uint32)
        start(cuda_kernels.number, size, order.parts[0])
        for shift in range(0, max(key_count - 1, 0).bit_length(), cuda_kernels.DIGIT_BITS):
            # how often each digit occurs in each piece, and the places that follow
            counts = self.zeros(cuda_kernels.DIGITS * pieces, "index")
            place = self.empty(counts.size + 1, np.uint64)
            digit = (np.uint64(shift), np.uint64(pieces))
            start(cuda_kernels.count_digits, size, now, *digit, counts.parts[0])
            self.exclusive_scan(counts, place)
            # move keys and rows there, equal digits in order
            after, moved = self.empty(size, np.uint32), self.empty(size, np.uint32)
            start(
                cuda_kernels.sort_digits,
                size,
                now,
                order.parts[0],
                *digit,
                place.parts[0],
                after.parts[0],
                moved.parts[0],
            )
            now, order = after.parts[0], moved
        return order

    def count_by_key(self, keys: Array, key_count: int) -> CudaArray:
        """How often each key 0 ... key_count - 1 occurs among index keys, kind "index"."""
        source = self.unwrap(keys)
        counts, beyond = self.zeros(key_count, "index"), self.zeros(1, "index")
        start(
            cuda_kernels.count_keys,
            source.size,
            source.parts[0],
            np.uint64(key_count),
            counts.parts[0],
            beyond.parts[0],
        )
        key = int(beyond.to_host()[0])
        if key or (key_count == 0 and source.size):
            raise ValueError(f"key {key} is not below {key_count}")
        return counts
