"""Running of loops: bind arguments by name, find or generate the loop, launch it.

A loop is generated for the functions, the kinds of their arguments and the dimension. What a call's
names decide is kept in its `Signature`; the compiled loop is found there by the kinds of the arrays
and constants, so that a repeated call neither resolves names, nor reads source text, nor hashes it.
Lengths, rows and lists are checked at every call. Before each use the global names that entered are
compared with those of the first call; an edited constant or callee gives a new loop.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable
from functools import lru_cache
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np

from lasersph.compute import loop_texts, source
from lasersph.compute.arguments import argument_for, array_kind, fingerprint
from lasersph.compute.array_types import PairList
from lasersph.compute.generate import Loop, LoopText
from lasersph.compute.launch import Bound, Compiled, Launch, Launcher, bytes_of
from lasersph.compute.rebinding import has_known_layout, rebindable, rebinding_function
from lasersph.compute.recording import Recorder, without_names
from lasersph.compute.signature import Call, Signature, listed

_layout = attrgetter("dtype", "shape", "strides")
_INDEX, _OFFSET = np.dtype(np.uint32), np.dtype(np.uint64)
KEPT = 4
"""Launches kept for calls of the same names whose arrays differ in type or shape."""
_PLAIN = {float, int}
"""Types of constants that tell all about them."""


class Given(NamedTuple):
    """Arrays and constants of one call, in the order of its signature, as the launcher takes them.

    Attributes:
        tables: constants that are arrays. numbers: the others by name, with the period of the list.
        row_start, row_end, neighbor: the list, None without. geometry: kernel, mean, periodic axes
            and dimension as far as the loop depends on them, else None.
    """

    call: Call
    signature: Signature
    arrays: list[np.ndarray]
    tables: list[np.ndarray]
    numbers: dict[str, Any]
    outs: list[np.ndarray | None]
    rows: np.ndarray | None
    row_start: np.ndarray | None
    row_end: np.ndarray | None
    neighbor: np.ndarray | None
    geometry: tuple | None

    @property
    def named(self) -> list[tuple[str, np.ndarray]]:
        """All arrays but the lists, with what messages call them."""
        outs = [(f"out {k}", out) for k, out in enumerate(self.outs) if out is not None]
        fields = zip(self.signature.symbols, self.arrays, strict=True)
        return [*fields, *outs, *zip(self.signature.tables, self.tables, strict=True)]


class Loops:
    """All loops of one backend, found by signature and kinds; the `recorder` takes those of graphs,
    which are run again."""

    def __init__(
        self, precision: str, launcher: Launcher, unwrap: Callable, object_address: Callable = id
    ) -> None:
        self.precision, self.launcher, self.unwrap = precision, launcher, unwrap
        self._object_address = object_address
        self.real = np.dtype(precision)
        self._signatures: dict[Any, Signature] = {}
        self.recorder = Recorder()
        self._rebinds = launcher.rebinds and has_known_layout()
        if self._rebinds:
            rebinding_function(precision)

    def run(self, call: Call) -> tuple[float, ...]:
        """Launch the loop of a call; returns the reductions."""
        recorder = self.recorder
        if recorder.recording is not None:
            launch = self._bind_again(without_names(call), recorder.recording.next_before())
            return recorder.add(launch, call)
        results = self._run_rebound(call) if self._rebinds else self.bind(call)()
        if recorder.tally is not None:
            recorder.tally += results
        return results

    def bind(self, call: Call) -> Launch:
        """The loop of a call, bound to its arrays."""
        return self.launcher.launch(self._bound(self.given(call)))

    def _bind_again(self, call: Call, again: Launch | None) -> Launch:
        """The loop of a call, bound to its arrays; `again` itself where it can take them."""
        if not self._rebinds:
            return self.bind(call)
        signature, kinds, ones, values = self._addresses(call)
        key, found = (signature, kinds), None if again is None else again.rebound
        is_same = found and found.key == key and source.is_current(found.watched)
        if again and found and is_same and found.run(again, ones, values):
            again.holds(call)
            return again
        launch = rebindable(self.launcher, self._bound(self.given(call)), signature, call)
        launch.rebound.only_binds(key)
        launch.holds(call)
        return launch

    def _run_rebound(self, call: Call) -> tuple[float, ...]:
        """Run a call by the launch of an earlier one with arrays of the same kinds, if any."""
        signature, kinds, ones, values = self._addresses(call)
        launches = signature.rebound.get(kinds, ())
        for launch in launches:
            found = launch.rebound
            if source.is_current(found.watched) and found.run(launch, ones, values):
                return tuple(launch.results)
        launch = rebindable(self.launcher, self._bound(self.given(call)), signature, call)
        signature.rebound[kinds] = (launch, *launches[: KEPT - 1])
        return launch()

    def _addresses(self, call: Call) -> tuple[Signature, tuple, array, tuple]:
        """Signature, kinds beside those of arrays, addresses and numbers for `Rebound`."""
        signature = self._signature(call)
        _, _, neighbors, fields, out, rows, _, _, constants, _ = call
        outs, values = listed(out), signature.number_values(constants)
        kinds: tuple = tuple(map(type, values))
        if not _PLAIN.issuperset(kinds):
            kinds = tuple(map(fingerprint, values))
        stored, address = [one for one in outs if one is not None], self._object_address
        if len(stored) < len(outs):
            kinds += tuple([one is None for one in outs])
        ones = [0, 0 if rows is None else address(rows), 0, 0, 0, 0]
        ones += map(address, signature.field_values(fields))
        if neighbors is not None:
            support, position, end = neighbors.support, neighbors.position, neighbors.row_end
            ones[2:4] = address(neighbors.row_start), 0 if end is None else address(end)
            ones[4:6] = address(neighbors.neighbor), 0 if support is None else address(support)
            if signature.position:
                ones.append(0 if position is None else address(position))
            if signature.support:
                ones.append(ones[5])
            if signature.geometry:
                values += (neighbors.period,)
                kinds += (neighbors.kernel, neighbors.mean, neighbors.period)
        ones += map(address, stored)
        ones += map(address, signature.table_values(constants))
        return signature, kinds, array("Q", ones), values

    def _bound(self, given: Given) -> Bound:
        """The loop of a call with its arguments, all checked."""
        listed, rows, key = _checked(given, self.launcher)
        loops = given.signature.loops
        compiled = loops.get(key)
        if compiled is None or not source.is_current(compiled.watched):
            _refuse_strides(given)
            compiled = loops[key] = self._compiled(given)
        symbols, row_end = given.signature.symbols, given.row_end
        if given.row_start is not None and row_end is None:
            row_end = self.launcher.behind_first(given.row_start)
        lists = given.rows, given.row_start, row_end, given.neighbor
        return Bound(
            compiled,
            listed,
            rows,
            [one for one in lists if one is not None],
            [given.arrays[symbols.index(symbol)] for symbol in compiled.arrays],
            given.outs,
            [given.tables[given.signature.tables.index(name)] for name in compiled.tables],
            given.numbers,
        )

    def _signature(self, call: Call) -> Signature:
        """Signature of a call: all that its names decide."""
        shape, function, _, fields, _, rows, finish, reduce, constants, combine = call
        names = (
            shape,
            function,
            finish,
            tuple(fields),
            tuple(constants),
            tuple(reduce) if type(reduce) is list else reduce,
            tuple(combine) if type(combine) is list else combine,
            rows is None,
        )
        signature = self._signatures.get(names)
        if signature is None:
            signature = self._signatures[names] = Signature(call)
        return signature

    def given(self, call: Call) -> Given:
        """Arrays and constants that the call's signature asks for."""
        signature, unwrap = self._signature(call), self.unwrap
        neighbors, fields, constants = call.neighbors, call.fields, call.constants
        arrays = [unwrap(fields[symbol]) for symbol in signature.fields]
        row_start = row_end = neighbor = geometry = None
        if neighbors is not None:
            row_start, neighbor = unwrap(neighbors.row_start), unwrap(neighbors.neighbor)
            row_end = None if neighbors.row_end is None else unwrap(neighbors.row_end)
            if signature.position:
                arrays.append(unwrap(neighbors.position))
            if signature.support:
                arrays.append(unwrap(neighbors.support))
            if signature.geometry:
                geometry = _geometry(signature, neighbors, arrays)
        tables = [unwrap(constants[name]) for name in signature.tables]
        numbers = {name: constants[name] for name in signature.numbers}
        if geometry is not None and neighbors is not None:
            numbers["period"] = neighbors.period
        outs = [o if o is None else unwrap(o) for o in listed(call.out)]
        active = None if call.rows is None else unwrap(call.rows)
        lists = active, row_start, row_end, neighbor
        return Given(call, signature, arrays, tables, numbers, outs, *lists, geometry)

    def text(self, given: Given) -> tuple[LoopText, str]:
        """Source of a call's loop, and its lines; see `loop_texts.written`."""
        call, signature = given.call, given.signature
        dimension = given.geometry[3] if given.geometry else 0
        arrays = dict(zip(signature.symbols, given.arrays, strict=True))
        tables = dict(zip(signature.tables, given.tables, strict=True))
        constants = given.numbers | tables

        def value(role: str, symbol: str) -> Any:
            return (constants if role == "constant" else arrays).get(symbol)

        def arguments(roles: tuple) -> tuple:
            return tuple(
                argument_for(name, role, symbol, value(role, symbol), dimension)
                for name, role, symbol in roles
            )

        outs = {f"o_{k}": out for k, out in enumerate(given.outs) if out is not None}
        named = {f"a_{symbol}": array for symbol, array in arrays.items()} | outs
        named |= {f"c_{name}": table for name, table in tables.items()}
        loop = Loop(
            call.shape,
            self.precision,
            call.function,
            arguments(signature.roles),
            tuple(None if o is None else array_kind(o) for o in given.outs),
            signature.reduce,
            given.rows is not None,
            call.finish,
            arguments(signature.finish_roles),
            given.geometry,
            signature.combine,
            tuple((name, array.dtype.name) for name, array in named.items()),
        )
        return loop_texts.written(self.launcher.text, loop)

    def _compiled(self, given: Given) -> Compiled:
        """Generate, cache and load the loop of new kinds."""
        signature = given.signature
        if any(how not in (None, "sum", "max", "min") for how in signature.reduce):
            raise ValueError('reduce takes None, "sum", "max" or "min"')
        if any(how not in ("sum", "max", "min") for how in signature.combine):
            raise ValueError('combine takes "sum", "max" or "min"')
        self._refuse_precision(given)
        text, lines = self.text(given)
        entry = self.launcher.compile(lines)
        places: dict[str, list[tuple[int, int, int]]] = {name: [] for name in given.numbers}
        for which, names in enumerate((text.reals, text.whole)):
            for k, (name, component) in enumerate(names.values()):
                is_tuple = isinstance(given.numbers[name], tuple | list)
                places[name].append((which, k, component if is_tuple else -1))
        reductions = tuple(text.reductions)
        return Compiled(
            entry,
            tuple(text.arrays),
            tuple(text.tables),
            places,
            (len(text.reals), len(text.whole)),
            reductions,
            bytes_of(reductions),
            self.real,
            text.loop.block,
            text.unit.watched(),
        )

    def _refuse_precision(self, given: Given) -> None:
        """Raise ValueError where real numbers are not of the backend's precision."""
        roles = [(role, symbol) for _, role, symbol in given.signature.roles]
        for name, one in given.named:
            is_real, is_pair = one.dtype.kind == "f", ("pair", name) in roles
            if is_real and one.dtype != self.real and not (is_pair and one.dtype == np.float32):
                raise ValueError(f"{name} is {one.dtype}, the backend {self.precision}")


def _geometry(signature: Signature, neighbors: PairList, arrays: list[np.ndarray]) -> tuple:
    """Kernel, mean, periodic axes and dimension, as far as they are asked for."""
    dimension = 0
    if signature.apart:
        dimension = arrays[signature.symbols.index("x")].shape[0]
    return (
        neighbors.kernel if signature.kernel else None,
        neighbors.mean if signature.mean else None,
        _periodic(tuple(neighbors.period or ()), dimension),
        dimension,
    )


@lru_cache(maxsize=256)
def _periodic(period: tuple[float, ...], dimension: int) -> tuple[bool, ...]:
    return tuple([bool(width) for width in period or (0.0,) * dimension])


def _checked(given: Given, launcher: Launcher) -> tuple[int, int, tuple]:
    """Rows, rows to run, and the kinds of the arrays.

    Raises:
        ValueError: an array is too short or of the wrong type, or read while it is written.
    """
    call, signature, arrays, tables, numbers, outs, active, row_start, *_, geometry = given
    kinds: list[Any] = [geometry]
    lengths = []
    for one in arrays:
        dtype, shape, strides = _layout(one)
        kinds += (dtype, shape[:-1], strides[-1])
        lengths.append(shape[-1])
    written = []
    for out in outs:
        if out is None:
            kinds.append(None)
            continue
        dtype, shape, strides = _layout(out)
        kinds += (dtype, shape[:-1], strides[-1])
        written.append(shape[-1])
    for table in tables:
        dtype, shape, strides = _layout(table)
        kinds += (dtype, shape[:-1], strides[-1])
    kinds += map(fingerprint, numbers.values())
    total = pairs = 0
    if row_start is not None:
        rows, total, pairs = _list_size(given, launcher.last(row_start))
    elif written:
        rows = written[0]
    elif len(set(lengths)) == 1:
        rows = lengths[0]
    else:
        raise ValueError(f"{call.function.__name__}(): fields of lengths {set(lengths)}")
    needed = (rows, total, pairs)
    for place, need, name in signature.needs:
        if lengths[place] < needed[need]:
            _refuse_length(name, lengths[place], needed[need])
    least = pairs if call.shape == "pair_values" else rows
    for k, out in enumerate(outs):
        if out is None:
            continue
        if out.shape[-1] < least:
            _refuse_length(f"out {k}", out.shape[-1], least)
        for place, name in signature.neighbors:
            if arrays[place] is out:
                raise ValueError(f"out is also read at neighbors, as {name}")
    listed = rows
    if active is not None:
        rows = _active(active, rows, launcher)
    return listed, rows, tuple(kinds)


def _list_size(given: Given, pairs: int) -> tuple[int, int, int]:
    """Rows, particles and pairs of a list."""
    start, end, neighbor = given.row_start, given.row_end, given.neighbor
    assert start is not None and neighbor is not None
    if start.dtype != _OFFSET or neighbor.dtype != _INDEX:
        kinds = f"not {start.dtype} and {neighbor.dtype}"
        raise ValueError(f"row_start must be uint64 and neighbor uint32, {kinds}")
    rows = start.size - 1
    if end is not None and (end.dtype != _OFFSET or end.size < rows):
        raise ValueError(f"row_end has {end.size} {end.dtype} for {rows} rows")
    support = None if given.call.neighbors is None else given.call.neighbors.support
    total = rows if support is None else support.shape[-1]
    if pairs > neighbor.size or total < rows:
        raise ValueError(f"{pairs} pairs, {neighbor.size} stored; {total} particles")
    return rows, total, pairs


def _active(active: np.ndarray, rows: int, launcher: Launcher) -> int:
    """Number of active rows."""
    if active.dtype != _INDEX:
        raise ValueError(f"rows must be of kind index (uint32), not {active.dtype}")
    if active.size and (largest := launcher.largest(active)) >= rows:
        raise ValueError(f"row {largest} of {rows}")
    return active.size


def _refuse_length(name: str, length: int, needed: int) -> None:
    raise ValueError(f"{name} has {length} entries, {needed} are needed")


def _refuse_strides(given: Given) -> None:
    """Raise ValueError where an array is not contiguous along its last axis."""
    for name, one in given.named:
        if one.size and one.strides[-1] != one.itemsize:
            raise ValueError(f"{name} is not contiguous along its last axis")
