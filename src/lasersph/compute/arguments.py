"""Binding of a function's arguments by name: `T_i`, `T_j`, `x_ij`, `g_ij`, bare names.

In a pair function `name_i` and `name_j` are a field at the particle and at its neighbor, `x_ij r_ij
l_ij W_ij dW_ij` geometry, other `name_ij` per-pair arrays, bare names constants or tables. In a
pointwise function bare names are fields where there is such a field, else constants or tables. A
table is an array (n,), (d, n) or (d, d, n): what is read at a place is a scalar, vector or tensor.
"""

from __future__ import annotations

import ctypes
from itertools import product

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
    """(role, kind) of a constant; arrays are tables, whose entries lie along the last axis.

    Raises:
        TypeError: neither number, tuple of numbers nor an array of one to three axes.
    """
    if isinstance(value, _REALS):
        return "constant", ("real", ())
    if isinstance(value, _WHOLE):
        return "constant", ("int", ())
    axes = getattr(value, "ndim", 0)
    if 0 < axes <= 3:
        kind, shape = array_kind(value)
        return "table", (kind + "-table", shape)
    if axes:
        raise TypeError(
            f"table {name} has shape {value.shape}; scalars are (n,), vectors (d, n), tensors "
            "(d, d, n)"
        )
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
    """Contiguous 1-D views of a field, row-major.

    By indices, all at once: NumPy's iterator over rows takes three times as long.
    """
    shape = array.shape[:-1]
    if not shape:
        return (array,)
    return tuple([array[place] for place in product(*map(range, shape))])


def addresses(array: np.ndarray) -> list[int]:
    """Addresses of the components of a field, row-major."""
    first = address(array)
    shape = array.shape
    if len(shape) == 1:
        return [first]
    strides = array.strides
    if len(shape) == 2:
        return [first + k * strides[0] for k in range(shape[0])]
    rows, columns = strides[:2]
    return [first + a * rows + b * columns for a in range(shape[0]) for b in range(shape[1])]


def address(array: np.ndarray) -> int:
    """Address of the first element of an array."""
    return _word_at(id(array) + _DATA).value


_word_at = ctypes.c_uint64.from_address
_DATA = 16
"""Place of the address in the structure that NumPy documents for its arrays, behind the head of an
object: `PyArrayObject_fields.data`. Asking NumPy itself takes eight times as long."""
