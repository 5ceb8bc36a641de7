"""Facts that the names in a call decide, before any array is looked at.

Calls of one place in the program have the same functions and the same names of fields and
constants, so that roles, missing and unknown names are worked out once for all of them. Their
arrays are new at each call, and are checked at each call.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from operator import itemgetter
from typing import Any, NamedTuple

from lasersph.compute.arguments import pair_roles, parameter_names
from lasersph.compute.array_types import Array, Outputs, PairList, Rows

NEEDS = ("row", "neighbor", "pair")
"""Roles of an array: with an entry for each row, each particle, each pair."""


class Call(NamedTuple):
    """One call of a loop shape, as the caller wrote it."""

    shape: str
    function: Callable
    neighbors: PairList | None
    fields: Mapping[str, Array]
    out: Outputs
    rows: Rows | None
    finish: Callable | None
    reduce: Any
    constants: dict[str, Any]
    combine: Any = None


class Signature:
    """Arguments of the loops of all calls with the same functions and names.

    Attributes:
        roles, finish_roles: (name, role, symbol) of each argument.
        fields: symbols of the fields that are read. position, support: whether those of the
            neighbor list are, as x and l; their places come after the fields'.
        symbols: all of these in order. needs: (place among them, place in `NEEDS` of what it must
            have entries for, name of the argument). neighbors: (place, name) of those that are
            read at neighbors.
        constants: names. numbers, tables: those that are numbers or tuples of them, and arrays.
        field_values, number_values, table_values: give these of a call's fields or constants.
        reduce, combine: for each result.
        geometry: whether the loop depends on the list's period. apart: and on the dimension.
            kernel, mean: and on these.
        loops: compiled loops by the kinds of arrays and constants. rebound: launches
            that take other arrays of the same kinds.
    """

    def __init__(self, call: Call) -> None:
        # where each argument of the function and of `finish` comes from
        self.roles = _bound(call, call.function, _roles(call.shape, call.function))
        self.finish_roles: tuple = ()
        if call.finish is not None:
            self.finish_roles = _bound(call, call.finish, _roles("finish", call.finish))
        arguments = (*self.roles, *self.finish_roles)
        # constants: tables are arrays, all others numbers
        self.constants = _once(name for name, role, _ in arguments if role == "constant")
        extra = sorted(set(call.constants) - set(self.constants))
        if extra:
            raise ValueError(f"{call.function.__name__}() has no argument {', '.join(extra)}")
        self.tables = tuple(n for n in self.constants if getattr(call.constants[n], "ndim", 0))
        self.numbers = tuple(n for n in self.constants if n not in self.tables)
        # reductions and combinations, one for each result
        self.reduce = () if call.reduce is None else tuple(listed(call.reduce))
        self.combine = () if call.combine is None else tuple(listed(call.combine))
        self._place(call, [one for one in arguments if one[1] in NEEDS])
        self.field_values = _values_of(self.fields)
        self.number_values = _values_of(self.numbers)
        self.table_values = _values_of(self.tables)
        self.loops: dict[Any, Any] = {}
        self.rebound: dict[Any, Any] = {}

    def _place(self, call: Call, arrays: list[tuple[str, str, str]]) -> None:
        """Decide where each array comes from and how long it must be."""
        # geometry that the functions ask for
        wanted = {name for name, role, _ in self.roles if role == "geometry"}
        symbols = _once(symbol for _, _, symbol in arrays)
        read = {symbol for _, role, symbol in self.roles if role in ("row", "neighbor")}
        # what that needs of the list: distances, kernel, mean, positions and supports
        self.apart = bool(wanted - {"l_ij"})
        weighted = bool(wanted & {"l_ij", "W_ij", "dW_ij"})
        self.geometry = bool(wanted)
        self.kernel = bool(wanted & {"W_ij", "dW_ij"})
        self.mean = bool(wanted - {"x_ij", "r_ij"})
        self.position = self.apart or ("x" in read and "x" not in call.fields)
        self.support = weighted or ("l" in read and "l" not in call.fields)
        # symbols of the arrays: fields first, then those of the list
        given = {"x": self.position, "l": self.support}
        self.fields = tuple([symbol for symbol in symbols if not given.get(symbol)])
        self.symbols = (*self.fields, *(symbol for symbol in given if given[symbol]))
        # entries that each must have; those read at neighbors have no need at rows
        needs = {(role, symbol): name for name, role, symbol in arrays}
        for symbol in given if self.geometry else ():
            if symbol in self.symbols:
                needs["neighbor", symbol] = symbol
        self.needs = tuple(
            (self.symbols.index(symbol), NEEDS.index(role), name)
            for (role, symbol), name in needs.items()
            if role != "row" or ("neighbor", symbol) not in needs
        )
        self.neighbors = tuple(
            (self.symbols.index(symbol), name)
            for name, role, symbol in self.roles
            if role == "neighbor"
        )


def listed(value: Any) -> tuple | list:
    """A single value as a tuple of one."""
    return value if isinstance(value, tuple | list) else (value,)


def _values_of(names: tuple[str, ...]) -> Callable[[Mapping[str, Any]], tuple]:
    """Function of a dictionary that gives its values of some names."""
    if not names:
        return lambda given: ()
    (first, *others) = names
    return itemgetter(*names) if others else lambda given: (given[first],)


def _once(names: Any) -> tuple[str, ...]:
    return tuple(dict.fromkeys(names))


def _roles(shape: str, function: Callable) -> tuple:
    """(name, role, symbol) of a function's arguments; "bare" is a field or a constant."""
    if shape in ("pair_sum", "pair_values"):
        return pair_roles(function)
    return tuple(
        (name, "total" if shape == "finish" and name.partition("_")[0] == "total" else "bare", name)
        for name in parameter_names(function)
    )


def _bound(call: Call, function: Callable, roles: tuple) -> tuple:
    """The roles, bare names decided.

    Raises:
        ValueError: a field or a constant is missing.
    """
    # a bare name is a field where the call has such a field, else a constant
    bound = []
    for name, role, symbol in roles:
        if role == "bare":
            role = "row" if name in call.fields else "constant"
        if role == "constant" and name not in call.constants:
            raise ValueError(f"{function.__name__}() needs a value for {name}")
        if role in NEEDS and symbol not in call.fields and symbol not in ("x", "l"):
            known = ", ".join(sorted(call.fields)) or "none"
            raise ValueError(
                f"{function.__name__}() needs field {symbol} for {name}; given: {known}"
            )
        bound.append((name, role, symbol))
    return tuple(bound)
