"""The least that a call of a loop must move and compute.

Bytes are those of all arrays of the call, each read once from memory and written once. A written
array counts twice where the loop does not read it, as the processor fetches a line before it
changes part of it. Operations are those of the functions, on a sample of rows and pairs; what a
pair function computes from its row alone is left out, since it is the same for all pairs of a row.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from hot_loops.counted import Table, Tally, as_counted
from lasersph.compute.signature import Call, Signature, listed
from lasersph.compute.vectors import norm

SAMPLE = 64
"""Rows and pairs whose operations are counted."""


@dataclass(frozen=True)
class Least:
    """Bytes [B], operations, and divisions and roots, which take several times as long."""

    traffic: float = 0.0
    operations: float = 0.0
    divisions: float = 0.0

    def __add__(self, other: Least) -> Least:
        """Both, one after the other."""
        return Least(
            self.traffic + other.traffic,
            self.operations + other.operations,
            self.divisions + other.divisions,
        )

    def times(self, factor: float) -> Least:
        """So many of them, or a share."""
        return Least(self.traffic * factor, self.operations * factor, self.divisions * factor)


def least_of(call: Call) -> Least:
    """Of one call with NumPy's arrays. Left out: the sums of blocks that a reduction leaves.

    Raises:
        ValueError: only some rows are active, whose pairs are not counted.
    """
    if call.rows is not None:
        raise ValueError(f"{call.function.__name__}(): listed rows are not counted")
    given = _Given(call)
    return Least(given.traffic()) + given.operations()


class _Given:
    """Arrays of a call by symbol, and where its rows and pairs are."""

    def __init__(self, call: Call) -> None:
        self.call: Any = call  # of NumPy's arrays, which are looked into here
        self.signature = Signature(call)
        self.outs: list[Any] = [one for one in listed(call.out) if one is not None]
        lists: Any = call.neighbors
        extra = {"x": lists.position, "l": lists.support} if lists is not None else {}
        own = self.signature.fields
        self.arrays: dict[str, Any] = {
            symbol: call.fields[symbol] if symbol in own else extra[symbol]
            for symbol in self.signature.symbols
        }
        if lists is None:
            first = self.outs[0] if self.outs else next(iter(self.arrays.values()))
            self.rows, self.pairs = first.shape[-1], 0
        else:
            self.rows, self.pairs = lists.row_start.shape[0] - 1, lists.neighbor.shape[0]

    def traffic(self) -> float:
        """Bytes, of arrays that share memory only once."""
        lists = self.call.neighbors
        read = dict[int, float]()
        for array in (*self.arrays.values(), *self._tables()):
            read[_place(array)] = max(array.nbytes, read.get(_place(array), 0.0))
        written = [array.nbytes * (1.0 if _place(array) in read else 2.0) for array in self.outs]
        total = sum(read.values()) + sum(written)
        if lists is not None:
            total += lists.row_start.nbytes + lists.neighbor.nbytes
            total -= self._unread()
        return total

    def _unread(self) -> float:
        """Bytes of arrays at neighbors beyond the last one, where each row has but one of few."""
        places = self.signature.neighbors
        if not places or self.pairs > self.rows:
            return 0.0
        last = int(self.call.neighbors.neighbor.max(initial=0)) + 1
        read = [self.arrays[self.signature.symbols[place]] for place, _ in places]
        return sum(array.nbytes * (1.0 - last / array.shape[-1]) for array in read)

    def _tables(self) -> list[np.ndarray]:
        names = self.signature.constants
        return [one for name in names if isinstance(one := self.call.constants[name], np.ndarray)]

    def operations(self) -> Least:
        """Those of all pairs and of all rows."""
        total = Least()
        has_pairs = self.call.neighbors is not None
        sums: tuple = ()
        if self.pairs:
            tally = Tally()
            for pair in _sample(self.pairs):
                sums = self._pair(pair, tally)
                tally.simple += _size(sums)  # each is added up
            total += _mean(tally, self.pairs)
        elif has_pairs:
            return total
        if not has_pairs or self.call.finish is not None:
            tally = Tally()
            for row in _sample(self.rows):
                self._row(row, sums, tally)
            total += _mean(tally, self.rows)
        return total

    def _pair(self, pair: int, tally: Tally) -> tuple:
        """Values of a pair function; what it does with j is counted."""
        lists, function = self.call.neighbors, self.call.function
        i = int(np.searchsorted(lists.row_start, pair, side="right")) - 1
        j = int(lists.neighbor[pair])
        wanted = {name for name, role, _ in self.signature.roles if role == "geometry"}
        geometry = self._geometry(wanted, i, j, tally) if wanted else {}
        values = []
        for name, role, symbol in self.signature.roles:
            if role == "geometry":
                values.append(geometry[name])
            elif role == "constant":
                values.append(self._constant(name, tally))
            elif role == "row":
                values.append(_at(self.arrays[symbol], i))
            else:
                array = self.arrays[symbol]
                values.append(as_counted(_at(array, j if role == "neighbor" else pair), tally))
        return listed(function(*values))  # type: ignore[return-value]

    def _geometry(self, wanted: set[str], i: int, j: int, tally: Tally) -> dict[str, Any]:
        """Those of the geometry's values that the loop computes, as `compute.generate` does."""
        found: dict[str, Any] = {}
        lists = self.call.neighbors
        if wanted - {"l_ij"}:
            x = self.arrays["x"]
            found["x_ij"] = x[:, i] - as_counted(x[:, j], tally)
        if wanted & {"r_ij", "W_ij", "dW_ij"}:
            found["r_ij"] = norm(found["x_ij"])
        if wanted & {"l_ij", "W_ij", "dW_ij"}:
            support = self.arrays["l"]
            found["l_ij"] = lists.mean(support[i], as_counted(support[j], tally))
        if wanted & {"W_ij", "dW_ij"}:
            inverse = 1.0 / found["l_ij"]
            s, scale = found["r_ij"] * inverse, lists.kernel.sigma
            for _ in range(lists.kernel.dimension):
                scale = scale * inverse
            if "W_ij" in wanted:
                found["W_ij"] = scale * lists.kernel.shape(s)
            if "dW_ij" in wanted:
                found["dW_ij"] = scale * inverse * lists.kernel.slope(s)
        return found

    def _row(self, row: int, sums: tuple, tally: Tally) -> None:
        """A pointwise function, or what finishes the sums of a row; and its reductions."""
        finish = self.call.finish
        function = self.call.function if finish is None else finish
        roles = self.signature.roles if finish is None else self.signature.finish_roles
        totals = {f"total_{k}": total for k, total in enumerate(sums)} | {"total": sums[:1]}
        values = []
        for name, role, symbol in roles:
            if role == "total":
                total = totals[name][0] if name == "total" else totals[name]
                values.append(_noted_in(tally, total))
            elif role == "constant":
                values.append(self._constant(name, tally))
            else:
                values.append(as_counted(_at(self.arrays[symbol], row), tally))
        function(*values)
        tally.simple += sum(1 for how in self.signature.reduce if how is not None)

    def _constant(self, name: str, tally: Tally) -> Any:
        """A number, a vector, or a table."""
        value = self.call.constants[name]
        if isinstance(value, np.ndarray):
            # entries lie along the last axis of a table
            return Table(value, tally) if value.dtype.kind == "f" else np.moveaxis(value, -1, 0)
        return np.array(value) if isinstance(value, tuple | list) else value


def _place(array: np.ndarray) -> int:
    """Where an array begins in memory."""
    return array.__array_interface__["data"][0]


def _at(array: np.ndarray, index: int) -> Any:
    """One particle's or pair's value; whole numbers as Python's, which index tables."""
    value = array[..., index]
    return int(value) if value.ndim == 0 and value.dtype.kind != "f" else value


def _noted_in(tally: Tally, value: Any) -> Any:
    """A value of a pair function, counted anew for the row."""
    if isinstance(value, np.ndarray):
        return as_counted(np.array([getattr(v, "value", v) for v in value], dtype=float), tally)
    return as_counted(float(getattr(value, "value", value)), tally)


def _size(values: tuple) -> int:
    """Numbers among scalars and vectors."""
    return sum(np.size(np.asarray(value, dtype=object)) for value in values)


def _sample(count: int) -> list[int]:
    """Some of `count` numbers, evenly."""
    return [count * k // min(SAMPLE, count) for k in range(min(SAMPLE, count))]


def _mean(tally: Tally, count: int) -> Least:
    """What a sample did, for all."""
    share = count / min(SAMPLE, count) if count else 0.0
    return Least(0.0, tally.simple * share, tally.divisions * share)
