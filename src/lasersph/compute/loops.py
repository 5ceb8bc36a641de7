"""Running of loops: bind arguments by name, find or generate the loop, launch it.

A loop is generated for the functions, the kinds of their arguments and the dimension. What a call's
names decide is kept in its `Signature`; the compiled loop is found there by the kinds of the arrays
and constants, so that a repeated call neither resolves names, nor reads source text, nor hashes it.
Lengths, rows and lists are checked at every call. Before each use the global names that entered are
compared with those of the first call; an edited constant or callee gives a new loop.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np

from lasersph.compute import cache, source
from lasersph.compute.arguments import argument_for, array_kind, fingerprint
from lasersph.compute.generate import Loop, LoopText
from lasersph.compute.launch import Bound, Compiled, Launch, Launcher
from lasersph.compute.signature import Call, Signature, listed

_layout = attrgetter("dtype", "shape", "strides")
_INDEX, _OFFSET, _WHOLE = np.dtype(np.uint32), np.dtype(np.uint64), np.dtype(np.int64)


class Given(NamedTuple):
    """Arrays and constants of one call, in the order of its signature, as the launcher takes them.

    Attributes:
        row_start, neighbor: the list, None without. geometry: kernel, mean, periodic axes and
            dimension as far as the loop depends on them, else None.
    """

    call: Call
    signature: Signature
    arrays: list[Any]
    constants: list[Any]
    outs: list[Any]
    rows: Any
    row_start: Any
    neighbor: Any
    geometry: tuple | None


class Ready(NamedTuple):
    """A compiled loop and where its arguments stand in `Given`.

    Attributes:
        arrays, outs: (place, function that takes it apart, None for scalars), as they enter.
        tables: places of constants. reals, whole: (place, component; -1 for a number).
    """

    compiled: Compiled
    arrays: tuple[tuple[int, Callable | None], ...]
    outs: tuple[tuple[int, Callable | None], ...]
    tables: tuple[int, ...]
    reals: tuple[tuple[int, int], ...]
    whole: tuple[tuple[int, int], ...]


class Loops:
    """All loops of one backend, found by signature and kinds."""

    def __init__(self, precision: str, launcher: Launcher, unwrap: Callable[[Any], Any]) -> None:
        self.precision, self.launcher, self.unwrap = precision, launcher, unwrap
        self.real = np.dtype(precision)
        self._signatures: dict[Any, Signature] = {}
        self._record: list[Launch] | None = None

    def run(self, call: Call) -> tuple[float, ...]:
        """Launch the loop of a call; returns the reductions."""
        bound, launcher = self._bound(call), self.launcher
        if self._record is None:
            return launcher.run(bound, launcher.partial(bound))
        launch = Launch(bound, launcher)
        if launch.reduces:
            raise ValueError(f"{call.function.__name__}(): no reduction is recorded")
        self._record.append(launch)
        return launch()

    def prepared(self, call: Call) -> Launch:
        """The loop of a call, bound to its arrays."""
        return Launch(self._bound(call), self.launcher)

    def recorded(self, run: Callable[[], None]) -> Callable[[], None]:
        """Run `run`; returns a function that launches the same loops once more."""
        if self._record is not None:
            raise ValueError("a recording is under way")
        launches = self._record = []
        try:
            run()
        finally:
            self._record = None

        def replay() -> None:
            for launch in launches:
                launch()

        return replay

    def _bound(self, call: Call) -> Bound:
        """The loop of a call with its arguments, all checked."""
        given = self.given(call)
        rows, visits, key = _checked(given, self.launcher)
        loops = given.signature.loops
        ready = loops.get(key)
        if ready is None or not source.is_current(ready.compiled.watched):
            _refuse_strides(given)
            ready = loops[key] = self._ready(given)
        return _arguments(given, ready, rows, visits)

    def given(self, call: Call) -> Given:
        """Arrays and constants that the call's signature asks for."""
        shape, function, neighbors, fields, out, rows, finish, reduce, constants, combine = call
        names = (
            shape, function, finish, tuple(fields), tuple(constants),
            tuple(reduce) if type(reduce) is list else reduce,
            tuple(combine) if type(combine) is list else combine, rows is None,
        )  # fmt: skip
        signature = self._signatures.get(names)
        if signature is None:
            signature = self._signatures[names] = Signature(call)
        unwrap = self.unwrap
        arrays = [unwrap(fields[symbol]) for symbol in signature.fields]
        row_start = neighbor = geometry = None
        if neighbors is not None:
            row_start, neighbor = unwrap(neighbors.row_start), unwrap(neighbors.neighbor)
            if signature.position:
                arrays.append(unwrap(neighbors.position))
            if signature.support:
                arrays.append(unwrap(neighbors.support))
            if signature.geometry:
                geometry = _geometry(signature, neighbors, arrays)
        values = []
        for name in signature.constants:
            value = constants[name]
            values.append(unwrap(value) if hasattr(value, "shape") else value)
        outs = [o if o is None else unwrap(o) for o in listed(out)]
        active = None if rows is None else unwrap(rows)
        return Given(call, signature, arrays, values, outs, active, row_start, neighbor, geometry)

    def text(self, given: Given) -> LoopText:
        """Source of a call's loop, before it is written."""
        call, signature = given.call, given.signature
        dimension = given.geometry[3] if given.geometry else 0
        arrays = dict(zip(signature.symbols, given.arrays, strict=True))
        constants = dict(zip(signature.constants, given.constants, strict=True))

        def value(role: str, symbol: str) -> Any:
            return (constants if role == "constant" else arrays).get(symbol)

        def arguments(roles: tuple) -> tuple:
            return tuple(
                argument_for(name, role, symbol, value(role, symbol), dimension)
                for name, role, symbol in roles
            )

        outputs = tuple(None if o is None else array_kind(o) for o in given.outs)
        loop = Loop(
            call.shape, self.precision, call.function, arguments(signature.roles), outputs,
            signature.reduce, given.rows is not None, call.finish,
            arguments(signature.finish_roles), given.geometry, signature.combine,
        )  # fmt: skip
        return self.launcher.text(loop)

    def _ready(self, given: Given) -> Ready:
        """Generate, cache and load the loop of new kinds."""
        signature = given.signature
        if any(how not in (None, "sum", "max", "min") for how in signature.reduce):
            raise ValueError('reduce takes None, "sum", "max" or "min"')
        if any(how not in ("sum", "max", "min") for how in signature.combine):
            raise ValueError('combine takes "sum", "max" or "min"')
        self._refuse_precision(given)
        text = self.text(given)
        module = cache.load(text.written())
        compiled = Compiled(
            module.loop, tuple(text.arrays), tuple(text.tables),
            tuple(text.reals.values()), tuple(text.whole.values()),
            tuple([how for how in signature.reduce if how is not None]), self.real,
            text.loop.block, text.unit.watched(),
        )  # fmt: skip
        places = {name: k for k, name in enumerate(signature.constants)}
        values = given.constants
        if given.geometry is not None:
            places["period"], values = len(values), [*values, ()]

        def numbers(names: tuple[tuple[str, int], ...]) -> tuple[tuple[int, int], ...]:
            found = [(places[name], component) for name, component in names]
            return tuple((k, c if isinstance(values[k], tuple | list) else -1) for k, c in found)

        arrays = [signature.symbols.index(symbol) for symbol in compiled.arrays]
        split = self.launcher.split
        return Ready(
            compiled, tuple((k, split(given.arrays[k].shape[:-1])) for k in arrays),
            tuple((k, split(o.shape[:-1])) for k, o in enumerate(given.outs) if o is not None),
            tuple(places[name] for name in compiled.tables),
            numbers(compiled.reals), numbers(compiled.whole),
        )  # fmt: skip

    def _refuse_precision(self, given: Given) -> None:
        """Raise ValueError where real numbers are not of the backend's precision."""
        signature = given.signature
        named = [
            *zip(signature.symbols, given.arrays, strict=True),
            *((f"out {k}", o) for k, o in enumerate(given.outs)),
            *zip(signature.constants, given.constants, strict=True),
        ]
        for name, array in named:
            if getattr(array, "ndim", 0) == 0 or array.dtype.kind != "f":
                continue
            is_pair = ("pair", name) in [(role, symbol) for _, role, symbol in signature.roles]
            if array.dtype != self.real and not (is_pair and array.dtype == np.float32):
                raise ValueError(f"{name} is {array.dtype}, the backend {self.precision}")


def _geometry(signature: Signature, neighbors: Any, arrays: list[Any]) -> tuple:
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
    """Number of rows, after checking the lengths of all arrays; about how many rows or pairs are
    visited; and the kinds of the arrays.

    Raises:
        ValueError: an array is too short or of the wrong type, or read while it is written.
    """
    call, signature, arrays, constants, outs, active, row_start, neighbor, geometry = given
    kinds: list[Any] = [geometry]
    lengths = []
    for array in arrays:
        dtype, shape, strides = _layout(array)
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
    kinds += map(fingerprint, constants)
    total = pairs = 0
    if row_start is not None:
        rows, total, pairs = _list_size(call, row_start, neighbor, launcher.last(row_start))
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
    visits = rows if row_start is None else pairs * rows // max(listed, 1)
    return rows, visits, tuple(kinds)


def _list_size(call: Call, row_start: Any, neighbor: Any, pairs: int) -> tuple[int, int, int]:
    """Rows, particles and pairs of a list."""
    if row_start.dtype != _OFFSET or neighbor.dtype != _INDEX:
        raise ValueError(
            f"row_start must be uint64 and neighbor uint32, not {row_start.dtype} and"
            f" {neighbor.dtype}"
        )
    rows = row_start.size - 1
    support = call.neighbors.support
    total = rows if support is None else support.shape[-1]
    if pairs > neighbor.size or total < rows:
        raise ValueError(f"{pairs} pairs, {neighbor.size} stored; {total} particles")
    return rows, total, pairs


def _active(active: Any, rows: int, launcher: Launcher) -> int:
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
    outs = {f"out {k}": out for k, out in enumerate(given.outs) if out is not None}
    arrays = dict(zip(given.signature.symbols, given.arrays, strict=True))
    for name, array in (arrays | outs).items():
        if array.size and array.strides[-1] != array.itemsize:
            raise ValueError(f"{name} is not contiguous along its last axis")


def _arguments(given: Given, ready: Ready, rows: int, visits: int) -> Bound:
    """The arguments of a loop in its order."""
    arguments: list[Any] = [] if given.rows is None else [given.rows]
    if given.row_start is not None:
        arguments += (given.row_start, given.neighbor)
    constants = given.constants
    _append(arguments, given.arrays, ready.arrays)
    for k in ready.tables:
        arguments.append(constants[k])
    _append(arguments, given.outs, ready.outs)
    if given.geometry is not None:
        constants = [*constants, given.call.neighbors.period]
    reals = _numbers(constants, ready.reals, ready.compiled.real)
    whole = _numbers(constants, ready.whole, _WHOLE)
    if reals is not None:
        arguments.append(reals)
    if whole is not None:
        arguments.append(whole)
    return Bound(ready.compiled, rows, visits, arguments, reals, whole, given.outs)


def _append(arguments: list[Any], arrays: list[Any], places: tuple) -> None:
    """Add the components of the arrays at some places."""
    for k, split in places:
        if split is None:
            arguments.append(arrays[k])
        else:
            arguments += split(arrays[k])


def _numbers(
    constants: list[Any], places: tuple[tuple[int, int], ...], kind: np.dtype
) -> np.ndarray | None:
    """Constants as one array, filled one by one, which for so few takes half the time."""
    if not places:
        return None
    values = np.empty(len(places), kind)
    for k, (place, component) in enumerate(places):
        value = constants[place]
        values[k] = value if component < 0 else value[component]
    return values
