"""Binding of a function's arguments by name: `T_i`, `T_j`, `x_ij`, `g_ij`, bare names.

In a pair function `name_i` and `name_j` are a field at the particle and at its neighbor, `x_ij r_ij
l_ij W_ij dW_ij` geometry, other `name_ij` per-pair arrays, bare names constants or tables. In a
pointwise function bare names are fields where there is such a field, else constants or tables.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from itertools import product
from operator import itemgetter

import numpy as np

from lasersph.compute.generate import Argument
from lasersph.compute.opaque_array import OpaqueArray

GEOMETRY = ("x_ij", "r_ij", "l_ij", "W_ij", "dW_ij")
_REALS = (float, np.floating)
_WHOLE = (int, np.integer, np.bool_)


def parameter_names(function) -> tuple[str, ...]:
    """Names of a plain function's arguments.

    Raises:
        TypeError: it is no plain Python function, or has *arguments.
    """
    code = getattr(function, "__code__", None)
    if code is None:
        raise TypeError(f"{function!r} is not a plain Python function")
    if code.co_flags & 0x0C or code.co_kwonlyargcount:
        raise TypeError(f"{function.__qualname__}() must have plain arguments")
    return code.co_varnames[: code.co_argcount]


def pair_roles(function) -> tuple[tuple[str, str, str], ...]:
    """(name, role, symbol) of each argument of a pair function."""
    roles = []
    for name in parameter_names(function):
        if name in GEOMETRY:
            roles.append((name, "geometry", name))
        elif name.endswith("_ij"):
            roles.append((name, "pair", name))
        elif name.endswith("_i"):
            roles.append((name, "row", name[:-2]))
        elif name.endswith("_j"):
            roles.append((name, "neighbor", name[:-2]))
        else:
            roles.append((name, "constant", name))
    return tuple(roles)


def array_kind(array: np.ndarray):
    """Kind of a field: real or int, with the shape of one particle's value."""
    return ("real" if array.dtype.kind == "f" else "int", array.shape[:-1])


def constant_kind(name: str, value):
    """(role, kind) of a constant; arrays are tables.

    Raises:
        TypeError: neither number, tuple of numbers nor 1-D array.
    """
    if isinstance(value, _REALS):
        return "constant", ("real", ())
    if isinstance(value, _WHOLE):
        return "constant", ("int", ())
    if getattr(value, "ndim", 0) == 1:
        return "table", (array_kind(value)[0] + "-table", ())
    if (
        isinstance(value, tuple | list)
        and value
        and all(isinstance(v, _REALS + _WHOLE) for v in value)
    ):
        return "constant", ("real", (len(value),))
    raise TypeError(f"constant {name} is {type(value).__name__}; give a number, a tuple or a table")


def argument_for(name: str, role: str, symbol: str, value, dimension: int) -> Argument:
    """Argument with its kind; `value` is the array or constant that it is bound to."""
    if role == "geometry":
        return Argument(name, role, symbol, ("real", (dimension,) if name == "x_ij" else ()))
    if role == "total":
        return Argument(name, role, symbol, None)
    if role == "constant":
        role, kind = constant_kind(name, value)
        return Argument(name, role, symbol, kind)
    return Argument(name, role, symbol, array_kind(value))


def fingerprint(value) -> object:
    """Hashable that changes whenever the argument's kind does, cheap enough for every call."""
    kind = type(value)
    if kind is float or kind is int:
        return kind
    if kind is tuple or kind is list:
        return len(value)
    if kind is np.ndarray or isinstance(value, OpaqueArray):
        return (value.dtype.char, value.shape[:-1])
    return kind


def components(array: np.ndarray) -> tuple[np.ndarray, ...]:
    """Contiguous 1-D views of a field, row-major."""
    split = splitter(array.shape[:-1])
    return (array,) if split is None else split(array)


@cache
def splitter(shape: tuple[int, ...]) -> Callable[[np.ndarray], tuple[np.ndarray, ...]] | None:
    """Function that takes a field with values of this shape apart; None where it is a scalar's.

    By indices, all at once: NumPy's iterator over rows takes three times as long.
    """
    if not shape:
        return None
    places = range(*shape) if len(shape) == 1 else list(product(*map(range, shape)))
    if len(places) == 1:
        return lambda array: (array[places[0]],)
    return itemgetter(*places)
