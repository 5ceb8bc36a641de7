"""The graphics card by NVIDIA's packages: memory, copies, and calls of kernels.

Memory comes from the card's pool, and all is done in the order of its default stream, so that what
is freed can be taken at once. Numba writes the kernels (`cuda_assembly`) but does not start them:
that takes it 45 us, and a `Call` that is made once 5 us. One thread uses the card, that which made
the backend.
"""

# pyright: reportAttributeAccessIssue=false, reportCallIssue=false
# NVIDIA's packages say little about what they hold.

from __future__ import annotations

import ctypes
from array import array
from functools import cache
from typing import Any

import numpy as np
from cuda.bindings import driver
from cuda.core import Device, ObjectCode

from lasersph.compute.cuda_assembly import Kind, assembly
from lasersph.compute.cuda_device import THREADS

_STREAM = 0
"""The default stream."""
_WORDS = {size: np.dtype(f"u{size}") for size in (1, 2, 4, 8)}
"""Types of the same bits as numbers of so many bytes."""


class Piece:
    """Elements that lie side by side in the card's memory.

    Attributes:
        shape: (n,), or (n, m) of a table. address: of the first element.
        kind: type of the elements and number of axes.
        words: the array as kernels take it: no owner, number and size of the elements, address of
            the first, lengths and strides.
    """

    __slots__ = ("_owner", "address", "dtype", "kind", "shape", "words")

    def __init__(self, owner: Any, address: int, shape: tuple[int, ...], dtype: np.dtype) -> None:
        self._owner, self.address, self.shape, self.dtype = owner, address, shape, dtype
        self.kind: Kind = dtype, len(shape)
        size = dtype.itemsize
        if len(shape) == 1:
            self.words = (0, 0, shape[0], size, address, shape[0], size)
        else:
            rows, row = shape
            self.words = (0, 0, rows * row, size, address, rows, row, row * size, size)

    def cut(self, first: int, last: int) -> Piece:
        """The elements from `first` to before `last`."""
        address = self.address + first * self.dtype.itemsize
        return Piece(self._owner, address, (last - first,), self.dtype)

    @property
    def bytes(self) -> int:
        """Size [B]."""
        return self.words[2] * self.words[3]


def allocate(count: int, dtype: np.dtype) -> Piece:
    """Elements of any values."""
    device, stream = _device()
    owner = device.allocate(count * dtype.itemsize, stream=stream)
    return Piece(owner, int(owner.handle), (count,), dtype)


def zeros(count: int, dtype: np.dtype) -> Piece:
    """Elements that are 0."""
    piece = allocate(count, dtype)
    _done(driver.cuMemsetD8Async(piece.address, 0, piece.bytes, _STREAM))
    return piece


def from_host(array: np.ndarray) -> Piece:
    """Copy of a NumPy array."""
    given = np.ascontiguousarray(array)
    whole = allocate(given.size, given.dtype)
    _done(driver.cuMemcpyHtoD(whole.address, given.ctypes.data, given.nbytes))
    return Piece(whole, whole.address, given.shape, given.dtype)


def to_host(piece: Piece) -> np.ndarray:
    """Copy as a NumPy array."""
    host = np.empty(piece.shape, piece.dtype)
    _done(driver.cuMemcpyDtoH(host.ctypes.data, piece.address, piece.bytes))
    return host


def wait() -> None:
    """Return when the card has done all that was started."""
    _done(driver.cuStreamSynchronize(_STREAM))


class Room:
    """The host's memory that kernels write.

    Attributes:
        piece: it, as kernels take it.
    """

    def __init__(self, count: int, dtype: np.dtype) -> None:
        size = count * dtype.itemsize
        (address,) = _done(driver.cuMemHostAlloc(size, driver.CU_MEMHOSTALLOC_DEVICEMAP))
        memory = (ctypes.c_char * size).from_address(int(address))
        self._host = np.frombuffer(memoryview(memory), dtype)
        self.piece = Piece(None, int(address), (count,), dtype)

    def read(self) -> np.ndarray:
        """The elements, once all that was started has been done."""
        wait()
        return self._host


class Call:
    """A kernel with its arguments, started as often as wanted.

    Args:
        kernel: Numba's. arguments: pieces, and numbers of NumPy's types.
    """

    def __init__(self, kernel: Any, arguments: list[Any]) -> None:
        # a word of 64 bits for each that the kernel takes, and the address of each
        words: list[int] = []
        self._places, kinds = [], []
        for one in arguments:
            self._places.append(len(words))
            if type(one) is Piece:
                words += one.words
                kinds.append(one.kind)
            else:
                words.append(int(one.view(_WORDS[one.itemsize])))
                kinds.append((one.dtype, 0))
        memory = array("Q", words)
        first = memory.buffer_info()[0]
        self._pointers = array("Q", range(first, first + 8 * len(words), 8))
        self._address = self._pointers.buffer_info()[0]
        self._words = np.frombuffer(memory, np.uint64)
        self._function = _function(kernel, tuple(kinds))
        self._arguments = arguments

    def numbers(self, first: int, count: int, dtype: np.dtype) -> np.ndarray:
        """Memory of the numbers from argument `first` on, which later starts take."""
        place = self._places[first] if count else 0
        return self._words[place : place + count].view(dtype)[:: 8 // dtype.itemsize]

    def replace(self, place: int, piece: Piece) -> None:
        """Another piece of the same kind as an argument."""
        first = self._places[place]
        self._words[first : first + len(piece.words)] = piece.words
        self._arguments[place] = piece

    def start(self, groups: int) -> None:
        """Start it with so many groups of threads."""
        _done(
            driver.cuLaunchKernel(
                self._function, groups, 1, 1, THREADS, 1, 1, 0, _STREAM, self._address, 0
            )
        )


@cache
def _function(kernel: Any, kinds: tuple[Kind, ...]) -> Any:
    """A kernel for arguments of these kinds, loaded to the card."""
    capability = _device()[0].compute_capability
    name, text = assembly(kernel, kinds, (capability.major, capability.minor))
    loaded = ObjectCode.from_ptx(text.encode()).get_kernel(name)
    _loaded.append(loaded)
    return driver.CUfunction(int(loaded.handle))


_loaded: list[Any] = []
"""Kernels, which stay as long as the process."""


@cache
def _device() -> tuple[Any, Any]:
    """The card and its default stream."""
    device = Device()
    device.set_current()
    return device, device.default_stream


def _done(answer: tuple) -> tuple:
    """The answer of a function of the driver, without its error.

    Raises:
        RuntimeError: it has one; of a kernel that failed it comes later.
    """
    error, *found = answer
    if error:
        raise RuntimeError(f"the graphics card answers {error.name}")
    return tuple(found)
