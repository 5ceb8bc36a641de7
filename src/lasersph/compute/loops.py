"""Running of loops: bind arguments by name, find or generate the loop, launch it.

A loop is generated for the functions, the kinds of their arguments and the dimension, and found
again by a key made of the function objects and the arrays' shapes, so that a repeated call neither
reads source text nor hashes it. Before each use the global names that entered are compared with
those of the first call; an edited constant or callee gives a new loop.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np

from lasersph.compute import cache, source
from lasersph.compute.arguments import (
    argument_for,
    array_kind,
    components,
    fingerprint,
    pair_roles,
    parameter_names,
)
from lasersph.compute.generate import Loop, LoopText
from lasersph.compute.launch import Compiled, Launch


class Call(NamedTuple):
    """One call of a loop shape, as the caller wrote it."""

    shape: str
    function: Callable
    neighbors: Any
    fields: Mapping[str, Any]
    out: Any
    rows: Any
    finish: Callable | None
    reduce: Any
    constants: dict[str, Any]
    combine: Any = None


class Bound:
    """Arrays and constants of one call, by symbol and name, and the roles of the arguments."""

    def __init__(self, call: Call, unwrap: Callable[[Any], np.ndarray], roles: Callable) -> None:
        self.call, self.unwrap = call, unwrap
        self.arrays: dict[str, np.ndarray] = {}
        self.constants: dict[str, Any] = {}
        self.roles = self._bound(call.function, roles(call.shape, call.function))
        self.finish_roles: tuple = ()
        if call.finish is not None:
            self.finish_roles = self._bound(call.finish, roles("finish", call.finish))
        if len(self.constants) < len(call.constants):
            extra = ", ".join(sorted(set(call.constants) - set(self.constants)))
            raise ValueError(f"{call.function.__name__}() has no argument {extra}")
        self.outs = [None if o is None else unwrap(o) for o in _listed(call.out)]
        self.reduce = () if call.reduce is None else tuple(_listed(call.reduce))
        self.combine = () if call.combine is None else tuple(_listed(call.combine))
        self.rows = None if call.rows is None else unwrap(call.rows)
        self.geometry = None if call.neighbors is None else self._geometry(call.neighbors)

    def _bound(self, function: Callable, roles: tuple) -> tuple:
        fields, constants = self.call.fields, self.call.constants
        bound = []
        for name, role, symbol in roles:
            if role == "bare":
                role = "row" if name in fields else "constant"
            if role == "constant":
                if name not in constants:
                    raise ValueError(f"{function.__name__}() needs a value for {name}")
                value = constants[name]
                self.constants[name] = self.unwrap(value) if hasattr(value, "shape") else value
            elif role in ("row", "neighbor", "pair"):
                if symbol in fields:
                    if symbol not in self.arrays:
                        self.arrays[symbol] = self.unwrap(fields[symbol])
                elif symbol not in ("x", "l"):
                    known = ", ".join(sorted(fields)) or "none"
                    raise ValueError(
                        f"{function.__name__}() needs field {symbol} for {name}; given: {known}"
                    )
            bound.append((name, role, symbol))
        return tuple(bound)

    def _geometry(self, neighbors: Any) -> tuple | None:
        """Kernel, mean, periodic axes and dimension, as far as they are asked for."""
        wanted = {name for name, role, _ in self.roles if role == "geometry"}
        symbols = {symbol for _, role, symbol in self.roles if role in ("row", "neighbor")}
        dimension = 0
        if wanted - {"l_ij"}:
            self.arrays["x"] = self.unwrap(neighbors.position)
            dimension = self.arrays["x"].shape[0]
        elif "x" in symbols and "x" not in self.arrays:
            self.arrays["x"] = self.unwrap(neighbors.position)
        if wanted & {"l_ij", "W_ij", "dW_ij"} or ("l" in symbols and "l" not in self.arrays):
            self.arrays["l"] = self.unwrap(neighbors.support)
        if not wanted:
            return None
        kernel = neighbors.kernel if wanted & {"W_ij", "dW_ij"} else None
        mean = neighbors.mean if wanted - {"x_ij", "r_ij"} else None
        period = tuple([bool(width) for width in neighbors.period or (0.0,) * dimension])
        return (kernel, mean, period, dimension)

    def key(self) -> tuple:
        """Hashable that decides which loop is needed."""
        call = self.call
        return (
            call.shape, call.function, call.finish, self.reduce, self.combine, self.rows is None,
            self.geometry,
            tuple([(name, fingerprint(value)) for name, value in self.arrays.items()]),
            tuple([(name, fingerprint(value)) for name, value in self.constants.items()]),
            tuple([o if o is None else fingerprint(o) for o in self.outs]),
        )  # fmt: skip

    def count(self) -> int:
        """Number of rows, after checking the lengths of all arrays.

        Raises:
            ValueError: an array is too short, not contiguous or of the wrong type.
        """
        call, arrays = self.call, self.arrays
        total, pairs = 0, 0
        if call.neighbors is None:
            outs = [o for o in self.outs if o is not None]
            lengths = {a.shape[-1] for a in arrays.values()}
            if outs:
                rows = outs[0].shape[-1]
            elif len(lengths) == 1:
                rows = lengths.pop()
            else:
                raise ValueError(f"{call.function.__name__}(): fields of lengths {lengths}")
        else:
            row_start, neighbor = self._list()
            rows, pairs = row_start.size - 1, self.last(row_start)
            support = call.neighbors.support
            total = rows if support is None else support.shape[-1]
            if pairs > neighbor.size or total < rows:
                raise ValueError(f"{pairs} pairs, {neighbor.size} stored; {total} particles")
        needed = {"row": rows, "neighbor": total, "pair": pairs}
        for name, role, symbol in (*self.roles, *self.finish_roles):
            if role in needed:
                _check(name, arrays[symbol], needed[role])
        if self.geometry is not None:
            for symbol in ("x", "l"):
                if symbol in arrays:
                    _check(symbol, arrays[symbol], total)
        for k, out in enumerate(self.outs):
            if out is not None:
                _check(f"out {k}", out, pairs if call.shape == "pair_values" else rows)
                for name, role, symbol in self.roles:
                    if role == "neighbor" and arrays[symbol] is out:
                        raise ValueError(f"out is also read at neighbors, as {name}")
        if self.rows is None:
            return rows
        if self.rows.dtype != np.uint32:
            raise ValueError(f"rows must be of kind index (uint32), not {self.rows.dtype}")
        self.refuse_beyond(self.rows, rows)
        return self.rows.size

    def reductions(self) -> tuple[str, ...]:
        """How values are reduced, those that are."""
        return tuple([how for how in self.reduce if how is not None])

    def last(self, row_start: Any) -> int:
        """The last row pointer: the number of pairs."""
        return int(row_start[-1])

    def refuse_beyond(self, rows: Any, count: int) -> None:
        """Raise ValueError where a listed row is not below `count`."""
        if rows.size and int(rows.max()) >= count:
            raise ValueError(f"row {int(rows.max())} of {count}")

    def _list(self) -> tuple[np.ndarray, np.ndarray]:
        neighbors = self.call.neighbors
        row_start, neighbor = self.unwrap(neighbors.row_start), self.unwrap(neighbors.neighbor)
        if row_start.dtype != np.uint64 or neighbor.dtype != np.uint32:
            raise ValueError(
                f"row_start must be uint64 and neighbor uint32, not {row_start.dtype} and"
                f" {neighbor.dtype}"
            )
        return row_start, neighbor


class Loops:
    """All loops of one backend, found by key.

    Attributes:
        bound, loop_text: what binds the arrays and writes the loops of this backend.
    """

    bound: type[Bound] = Bound
    loop_text: type[LoopText] = LoopText

    def __init__(self, precision: str, threads: int, unwrap: Callable[[Any], np.ndarray]) -> None:
        self.precision, self.threads, self.unwrap = precision, threads, unwrap
        self.real = np.dtype(precision)
        self._compiled: dict[Any, Compiled] = {}
        self._record: list[Launch] | None = None
        self._roles: dict[Any, tuple] = {}

    def run(self, call: Call) -> tuple[float, ...]:
        """Launch the loop of a call; returns the reductions."""
        launch = self.prepared(call)
        if self._record is not None:
            if launch.reductions:
                raise ValueError(f"{call.function.__name__}(): no reduction is recorded")
            self._record.append(launch)
        return launch()

    def prepared(self, call: Call) -> Launch:
        """The loop of a call, bound to its arrays."""
        bound = self.bound(call, self.unwrap, self.roles)
        key = bound.key()
        compiled = self._compiled.get(key)
        if compiled is None or not source.is_current(compiled.watched):
            compiled = self._compiled[key] = self.compiled(bound)
        return self._launch(compiled, bound)

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

    def roles(self, shape: str, function: Callable) -> tuple:
        """(name, role, symbol) of a function's arguments; "bare" is a field or a constant."""
        roles = self._roles.get((shape, function))
        if roles is None:
            if shape in ("pair_sum", "pair_values"):
                roles = pair_roles(function)
            else:
                roles = tuple((name, "bare", name) for name in parameter_names(function))
                if shape == "finish":
                    roles = tuple(
                        (name, "total", name) if name.partition("_")[0] == "total" else role
                        for name, role in zip(parameter_names(function), roles, strict=True)
                    )
            self._roles[(shape, function)] = roles
        return roles

    def text(self, bound: Bound) -> LoopText:
        """Source of a call's loop, before it is written."""
        call = bound.call
        dimension = bound.geometry[3] if bound.geometry else 0

        def value(role: str, symbol: str) -> Any:
            return (bound.constants if role == "constant" else bound.arrays).get(symbol)

        def arguments(roles: tuple) -> tuple:
            return tuple(
                argument_for(name, role, symbol, value(role, symbol), dimension)
                for name, role, symbol in roles
            )

        outputs = tuple(None if o is None else array_kind(o) for o in bound.outs)
        loop = Loop(
            call.shape, self.precision, call.function, arguments(bound.roles), outputs,
            bound.reduce, bound.rows is not None, call.finish, arguments(bound.finish_roles),
            bound.geometry, bound.combine,
        )  # fmt: skip
        return self.loop_text(loop)

    def compiled(self, bound: Bound) -> Compiled:
        """Generate, cache and load the loop of a new key."""
        if any(how not in (None, "sum", "max", "min") for how in bound.reduce):
            raise ValueError('reduce takes None, "sum", "max" or "min"')
        if any(how not in ("sum", "max", "min") for how in bound.combine):
            raise ValueError('combine takes "sum", "max" or "min"')
        arrays = [*bound.arrays.items(), *((f"out {k}", o) for k, o in enumerate(bound.outs))]
        for name, array in [*arrays, *bound.constants.items()]:
            if getattr(array, "ndim", 0) == 0 or array.dtype.kind != "f":
                continue
            is_pair = ("pair", name) in [(role, symbol) for _, role, symbol in bound.roles]
            if array.dtype != self.real and not (is_pair and array.dtype == np.float32):
                raise ValueError(f"{name} is {array.dtype}, the backend {self.precision}")
        text = self.text(bound)
        module = cache.load(text.written())
        return Compiled(
            module.block, module.loop, tuple(text.arrays), tuple(text.tables),
            tuple(text.reals.values()), tuple(text.whole.values()), text.unit.watched(),
        )  # fmt: skip

    def _launch(self, compiled: Compiled, bound: Bound) -> Launch:
        """The loop with the arrays of a call."""
        rows = bound.count()
        arrays = [] if bound.rows is None else [*components(bound.rows)]
        constants = bound.constants
        neighbors = bound.call.neighbors
        if neighbors is not None:
            for array in (neighbors.row_start, neighbors.neighbor):
                arrays += components(self.unwrap(array))
            constants = constants | {"period": neighbors.period}
        for symbol in compiled.arrays:
            arrays += components(bound.arrays[symbol])
        for name in compiled.tables:
            arrays += components(constants[name])
        for out in bound.outs:
            if out is not None:
                arrays += components(out)
        return self.launched(compiled, arrays, constants, bound, rows)

    def launched(
        self, compiled: Compiled, arrays: list, constants: dict[str, Any], bound: Bound, rows: int
    ) -> Launch:
        """The loop with the components of its arrays, in order, and its constants."""
        return Launch(
            compiled, arrays, constants, rows=rows, thread_count=self.threads, real=self.real,
            reductions=bound.reductions(),
        )  # fmt: skip


def _listed(value: Any) -> tuple | list:
    return value if isinstance(value, tuple | list) else (value,)


def _check(name: str, array: np.ndarray, length: int) -> None:
    if array.shape[-1] < length:
        raise ValueError(f"{name} has {array.shape[-1]} entries, {length} are needed")
    if array.size and array.strides[-1] != array.itemsize:
        raise ValueError(f"{name} is not contiguous along its last axis")
