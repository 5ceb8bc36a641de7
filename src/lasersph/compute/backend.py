"""CPU backend: arrays, and the loop shapes pair sum, pair values and pointwise."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from lasersph.compute import key_order, threads
from lasersph.compute.arguments import components
from lasersph.compute.array_types import Array, Outputs, PairList, Rows
from lasersph.compute.compiled_iteration import iterate
from lasersph.compute.graph import step_of
from lasersph.compute.launch import Launcher
from lasersph.compute.loops import Loops
from lasersph.compute.signature import Call
from lasersph.compute.vectors import constant, same

_KINDS = {
    "index": np.dtype(np.uint32),
    "offset": np.dtype(np.uint64),
    "flag": np.dtype(np.uint8),
    "single": np.dtype(np.float32),
}

MAPPED = 4 * 2**20
"""Elements from which on memory is mapped for an array alone: in float64 the 32 MiB up to which the
C library may take it from what was given back, and write it. Mapped memory is not taken before it
is written."""
LARGEST = 2**26
"""Guard: elements up to which more is mapped than an array has, 1.5 GiB of vectors in 3-D: a
system may refuse addresses for more than it has memory."""
GROWTH, MAPPED_GROWTH = 2, 8
"""Guard: elements that there is memory for where an array may grow, over those that it has."""


class Backend:
    """Loops on the processor with a fixed number of threads and one precision.

    Attributes:
        name: as asked for by --backend. device: what computes, None for the processor.
        real: NumPy type of kind "real". threads: number of threads of a loop.
        search: what finds neighbors and renews rows; None where `search` itself does.
    """

    name = "cpu"
    device: str | None = None
    search: Any = None

    def __init__(self, threads_wanted: int | None, precision: str) -> None:
        if precision not in ("float64", "float32"):
            raise ValueError(f'precision must be "float64" or "float32", not {precision!r}')
        self.precision = precision
        self.real = np.dtype(precision)
        self.threads = threads.chosen(threads_wanted)
        self.loops = Loops(self.precision, self.launcher(), self.unwrap, self.object_address)

    def launcher(self) -> Launcher:
        """The launcher of the loops."""
        return Launcher(self.threads, self.precision)

    # --- arrays ---------------------------------------------------------------------------------

    def kind(self, kind: str) -> np.dtype:
        """NumPy type of a kind: "real", "index" uint32, "offset" uint64, "flag" uint8, "single"."""
        if kind == "real":
            return self.real
        if kind not in _KINDS:
            raise ValueError(f"kind must be real, index, offset, flag or single, not {kind!r}")
        return _KINDS[kind]

    def wrap(self, array: np.ndarray) -> Array:
        """Array as the caller sees it."""
        return array

    def unwrap(self, array: Array) -> np.ndarray:
        """NumPy array behind the caller's array."""
        return array  # type: ignore[return-value]

    object_address = staticmethod(id)
    """Address of the NumPy object behind the caller's array, which compiled code reads."""
    _undefined: Callable[..., Any] = staticmethod(np.empty)
    """Array of a shape and NumPy type with any elements, as `unwrap` gives it."""
    _zeroed: Callable[..., Any] = staticmethod(np.zeros)
    """Array of a shape and NumPy type with elements 0, as `unwrap` gives it."""

    def zeros(self, shape: int | tuple[int, ...], kind: str = "real") -> Array:
        """Array of zeros; (n,) scalar, (dim, n) vector, (dim, dim, n) tensor fields."""
        recording = self.loops.recorder.recording
        if recording is None:
            return self.wrap(self._zeroed(shape, self.kind(kind)))
        array = self.wrap(recording.make(shape, self.kind(kind), self._undefined))
        self.fill(array, 0)
        return array

    def unset(self, shape: int | tuple[int, ...]) -> Array:
        """Array of reals that a loop sets as a whole before any is read."""
        recording = self.loops.recorder.recording
        if recording is None:
            return self.empty(shape, self.real)
        return self.wrap(recording.make(shape, self.real, self._undefined))

    def capacity_for(self, count: int) -> int:
        """Elements to have memory for where an array of so many may grow."""
        mapped = MAPPED_GROWTH * count
        if mapped > LARGEST:
            return count + count // MAPPED_GROWTH
        return mapped if mapped >= MAPPED else GROWTH * count

    def empty(self, shape: int | tuple[int, ...], dtype: Any) -> Array:
        """Array with undefined elements."""
        return self.wrap(self._undefined(shape, np.dtype(dtype)))

    def asarray(self, array: ArrayLike, kind: str = "real") -> Array:
        """Copy of host data as an array of this backend."""
        return self.wrap(np.array(array, dtype=self.kind(kind), order="C"))

    def to_host(self, array: Array) -> np.ndarray:
        """Copy as a NumPy array."""
        self._refuse_in_graph("to_host")
        return np.array(self.unwrap(array))

    def host_view(self, array: Array) -> np.ndarray:
        """The array for reading, until the next loop; not copied where it lies in this memory.

        Elsewhere it is copied only as far as it is looked at; to NumPy it is an array.
        """
        host = self.unwrap(array).view()
        host.flags.writeable = False
        return host

    def snapshot(self, array: Array) -> np.ndarray:
        """Copy for reading, as of `host_view`, that later loops do not change."""
        copy = self.empty(array.shape, array.dtype)
        self.copy(array, copy)
        return self.host_view(copy)

    def shown(self, host: np.ndarray) -> np.ndarray:
        """Host array that never changes, for reading beside what `host_view` gives."""
        return host

    def wait(self) -> None:
        """Return when everything that was started is done, as it is here."""

    def single(self, array: Array, into: Callable[[int], Array] | None = None) -> Array:
        """Copy (n,) in float32, which loops of any precision may read per pair; itself if it is.

        Args:
            into: gives an array of so many, kind "single", which may hold an earlier copy.
        """
        if array.dtype == np.float32:
            return array
        count = array.shape[0]
        copy = self.empty(count, np.float32) if into is None else into(count)
        self.copy(array, copy)
        return copy

    def copy(self, source: Array, destination: Array) -> None:
        """Copy all elements of `source` into `destination` of the same shape."""
        first, second = self.unwrap(source), self.unwrap(destination)
        if first.shape != second.shape:
            raise ValueError(f"copy of shape {first.shape} into shape {second.shape}")
        if self.loops.recorder.recording is None:
            self._copy_elements(first, second)
        else:
            self.pointwise(same, {"value": source}, destination)

    def _copy_elements(self, first: Any, second: Any) -> None:
        """Copy elements at once, of arrays as `unwrap` gives them."""
        second[...] = first

    def fill(self, array: Array, value: float) -> None:
        """Set all elements."""
        if self.loops.recorder.recording is None:
            self._fill_elements(self.unwrap(array), value)
            return
        number = int(value)
        if array.dtype.kind == "f":
            number = value if isinstance(value, float) else float(value)
        for k in range(math.prod(array.shape[:-1])):
            self.pointwise(constant, {}, self.component(array, k), value=number)

    def _fill_elements(self, whole: Any, value: float) -> None:
        """Set all elements at once, of an array as `unwrap` gives it."""
        whole.fill(value)

    def head(self, array: Array, count: int) -> Array:
        """View of the first `count` particles of (n,), (dim, n) or (dim, dim, n)."""
        host = self.unwrap(array)
        if not 0 <= count <= host.shape[-1]:
            raise ValueError(f"the first {count} of {host.shape[-1]} particles")
        return self.wrap(host[..., :count])

    def gather(self, source: Array, order: Array, out: Array) -> None:
        """out[..., k] = source[..., order[k]]."""
        self._refuse_in_graph("gather")
        first, last = self.unwrap(source), self.unwrap(out)
        index = self.unwrap(order)
        if first.dtype != last.dtype or first.shape[:-1] != last.shape[:-1]:
            raise ValueError("gather between arrays of different kind")
        if index.size and index.max() >= first.shape[-1]:
            raise IndexError(f"particle {index.max()} of {first.shape[-1]}")
        for a, b in zip(components(first), components(last), strict=True):
            np.take(a, index, out=b[: index.size], mode="clip")  # others buffer what they write

    def scatter(self, source: Array, order: Array, out: Array) -> None:
        """out[..., order[k]] = source[..., k]; the other elements keep their values."""
        self._refuse_in_graph("scatter")
        first, last = self.unwrap(source), self.unwrap(out)
        index = self.unwrap(order)
        if first.dtype != last.dtype or first.shape[:-1] != last.shape[:-1]:
            raise ValueError("scatter between arrays of different kind")
        for a, b in zip(components(first), components(last), strict=True):
            b[index] = a

    def exclusive_scan(self, counts: Array, out: Array) -> None:
        """out[k] = counts[0] + ... + counts[k-1] for k = 0 ... n; out is "offset", length n + 1."""
        self._refuse_in_graph("exclusive_scan")
        first, last = self.unwrap(counts), self.unwrap(out)
        if last.dtype != np.uint64 or last.size != first.size + 1:
            raise ValueError("out must be of kind offset and one longer than counts")
        last[0] = 0
        np.cumsum(first, dtype=np.uint64, out=last[1:])

    def rows_where(self, array: Array, value: float) -> Rows:
        """Rows k in order, kind "index", whose array[k] is exactly `value`."""
        self._refuse_in_graph("rows_where")
        return self.wrap(key_order.rows_where(self.unwrap(array), value))

    def rows_by_key(self, keys: Array, key_count: int) -> tuple[Array, Rows]:
        """Where the rows of each index key 0 ... key_count - 1 begin, kind "offset", one more than
        there are keys; and the rows, key after key and in order, kind "index"."""
        self._refuse_in_graph("rows_by_key")
        start, order = key_order.rows_by_key(self.unwrap(keys), key_count)
        return self.wrap(start), self.wrap(order)

    def sort_by_key(self, keys: Array, key_count: int) -> Rows:
        """Stable order that sorts index keys 0 ... key_count - 1, kind "index"."""
        return self.rows_by_key(keys, key_count)[1]

    def count_by_key(self, keys: Array, key_count: int) -> Rows:
        """How often each key 0 ... key_count - 1 occurs among index keys, kind "index"."""
        self._refuse_in_graph("count_by_key")
        return self.wrap(key_order.count_by_key(self.unwrap(keys), key_count))

    def _refuse_in_graph(self, name: str) -> None:
        """Raise ValueError while a graph is recorded, which would not run this again."""
        if self.loops.recorder.recording is not None:
            raise ValueError(f"{name}() is no loop: a graph would not run it again")

    # --- loop shapes ----------------------------------------------------------------------------

    def pair_sum(
        self,
        function: Callable,
        neighbors: PairList,
        fields: Mapping[str, Array],
        out: Outputs,
        *,
        rows: Rows | None = None,
        finish: Callable | None = None,
        reduce: Any = None,
        combine: Any = None,
        **constants: Any,
    ) -> tuple[float, ...]:
        """For each row i: out[i] = finish(sum over neighbors j of function(...)).

        Args:
            function: pair function, arguments by name (see `compute.arguments`).
            neighbors: list with row_start, neighbor, position, support, kernel, mean, period.
            fields: symbol -> array; per-pair arrays under "name_ij".
            out: array or tuple of arrays (None: not stored), one per returned value.
            rows: active rows (index array); the others keep their values.
            finish: pointwise function of `total` (or `total_0`, ...), fields at i and constants.
            reduce: None or per returned value None, "sum", "max" or "min", component by component.
            combine: None for sums, or per value of `function` "sum", "min" or "max" over the
                neighbors, component by component. A row without neighbors has 0, inf or -inf;
                NaN of any neighbor stays NaN.

        Returns:
            The reductions in order, the same bits for any number of threads.

        Raises:
            ValueError: a missing field, a wrong length, precision or shape.
            LoopSourceError: a function contains what a loop cannot.
        """
        call = Call(
            "pair_sum", function, neighbors, fields, out, rows, finish, reduce, constants, combine
        )
        return self.loops.run(call)

    def pair_values(
        self,
        function: Callable,
        neighbors: PairList,
        fields: Mapping[str, Array],
        out: Outputs,
        *,
        rows: Rows | None = None,
        **constants: Any,
    ) -> None:
        """out[p] = function(...) for each pair p, in list order; see `pair_sum`."""
        call = Call("pair_values", function, neighbors, fields, out, rows, None, None, constants)
        self.loops.run(call)

    def pointwise(
        self,
        function: Callable,
        fields: Mapping[str, Array],
        out: Outputs,
        *,
        rows: Rows | None = None,
        reduce: Any = None,
        **constants: Any,
    ) -> tuple[float, ...]:
        """out[i] = function(fields at i, constants) for each particle; see `pair_sum`.

        The number of particles is the length of the first stored output, else of the fields.
        """
        call = Call("pointwise", function, None, fields, out, rows, None, reduce, constants)
        return self.loops.run(call)

    def iterate(
        self, function: Callable[..., tuple], steps: Sequence[Any], *numbers: float
    ) -> tuple[float, ...]:
        """Results of a plain function of steps and numbers, compiled where it can be.

        See `compute.compiled_iteration`: it is called as `function(*steps, *numbers)`.

        Args:
            steps: graphs of their owners (`compute.graph`), with all arguments but one number given
                by `functools.partial`; other functions of one number; None for none.
        """
        return iterate(function, [step_of(step) for step in steps], numbers, self.precision)

    def component(self, array: Array, k: int) -> Array:
        """View of component k of a vector or tensor, row-major: (n,) of (dim, n), (dim, dim, n)."""
        return self.wrap(components(self.unwrap(array))[k])
