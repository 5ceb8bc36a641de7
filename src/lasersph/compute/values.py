"""Values of the source compiler: what an expression is while its scalar code is being written.

A `Number` is a literal or module constant (its type is decided where it is used, so that `2 * x`
does not promote a float32 x); a `Value` is code for a scalar, vector, tensor or table; a `Group` is
a tuple of those. Vectors and tensors are held as one piece of text per component.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import product

_NAME = re.compile(r"[A-Za-z_][A-Za-z_0-9]*\Z")
_LITERAL = re.compile(r"real\([^()]*\)\Z|-?\d+\Z")


class LoopSourceError(TypeError):
    """A pair or pointwise function uses something that a loop cannot contain."""


@dataclass(frozen=True)
class Number:
    """A literal: Python int, float or bool."""

    value: float | int | bool


@dataclass(frozen=True)
class Value:
    """Code of kind "real", "int" or "bool"; shape () scalar, (m,) vector, (m, l) tensor.

    Tables have kind "real-table" or "int-table", the shape of one entry, and as parts the names of
    the arrays of its components.
    """

    kind: str
    shape: tuple[int, ...]
    parts: tuple[str, ...]

    @property
    def text(self) -> str:
        """The code of a scalar."""
        return self.parts[0]

    @property
    def is_table(self) -> bool:
        """Whether this is a table (array whose entries are indexed by integers)."""
        return self.kind.endswith("-table")

    @property
    def table_name(self) -> str:
        """Name of a table in its function."""
        return self.parts[0].partition("__")[0]


@dataclass(frozen=True)
class Group:
    """A tuple of values."""

    items: tuple[Number | Value | Group, ...]


Term = Number | Value | Group


def constant(value: object) -> Number | Group | None:
    """Literal for a module constant; None where the object is no number or tuple of numbers."""
    if isinstance(value, bool):
        return Number(value)
    # NumPy's scalars count as Python's
    if hasattr(value, "dtype") and getattr(value, "ndim", None) == 0:
        value = value.item()  # type: ignore[attr-defined]
    if isinstance(value, int):
        return Number(int(value))
    if isinstance(value, float):
        return Number(float(value))
    if isinstance(value, tuple):
        items = tuple(constant(item) for item in value)
        return None if None in items else Group(items)  # type: ignore[arg-type]
    return None


def scalar(text: str, kind: str = "real") -> Value:
    """Scalar value from its code."""
    return Value(kind, (), (text,))


def number_text(value: float | int | bool) -> str:
    """Literal in the working precision; repr() gives back every bit of a float64."""
    return f"real({float(value)!r})"


def is_atom(text: str) -> bool:
    """Whether repeating this text costs nothing (a name or a literal)."""
    return bool(_NAME.match(text) or _LITERAL.match(text))


def is_integer(value: Term) -> bool:
    """Whether the value is an integer scalar or integer literal."""
    if isinstance(value, Number):
        return isinstance(value.value, int) and not isinstance(value.value, bool)
    return isinstance(value, Value) and value.kind == "int" and value.shape == ()


def shape_of(value: Term) -> tuple[int, ...]:
    """Shape of a value in an expression: () for numbers; a group of scalars counts as a vector."""
    if isinstance(value, Number):
        return ()
    if isinstance(value, Group):
        if any(shape_of(item) != () for item in value.items):
            raise LoopSourceError("a tuple of vectors has no arithmetic")
        return (len(value.items),)
    if value.is_table:
        name = value.table_name
        raise LoopSourceError(f"table {name} must be indexed or passed to interpolate()")
    return value.shape


def real_parts(value: Term) -> tuple[str, ...]:
    """Component texts in the working precision."""
    if isinstance(value, Number):
        return (number_text(value.value),)
    if isinstance(value, Group):
        shape_of(value)
        return tuple(real_parts(item)[0] for item in value.items)
    shape_of(value)
    if value.kind == "real":
        return value.parts
    return tuple(f"real({part})" for part in value.parts)


def integer_text(value: Term) -> str:
    """Code of an integer scalar, literals unwrapped."""
    if isinstance(value, Number):
        return str(int(value.value))
    if not is_integer(value):
        raise LoopSourceError("an integer is needed here")
    return value.text  # type: ignore[union-attr]


def kind_of(value: Term):
    """Hashable description of a value's kind and shape, without its code; numbers become real."""
    if isinstance(value, Group):
        return ("group", tuple(kind_of(item) for item in value.items))
    if isinstance(value, Number):
        return ("real", ())
    return (value.kind, value.shape)


def named(kind, name: str) -> Term:
    """Value of a kind whose parts are `name` or `name__0`, `name__1`, ... (row-major)."""
    if kind[0] == "group":
        return Group(tuple(named(item, f"{name}__{k}") for k, item in enumerate(kind[1])))
    if kind[1] == ():
        return Value(kind[0], (), (name,))
    if name == "t":
        # its components would have the names of temporary values, t__0 and so on
        raise LoopSourceError("a vector or tensor cannot have the name t")
    # a name for each component, row-major
    indices = product(*(range(size) for size in kind[1]))
    parts = tuple(name + "__" + "_".join(str(k) for k in index) for index in indices)
    return Value(kind[0], kind[1], parts)


def flat_parts(value: Term, kind) -> tuple[str, ...]:
    """All component texts of a value, converted to `kind`."""
    # groups item by item, tables by the arrays of their components
    if kind[0] == "group":
        if not isinstance(value, Group) or len(value.items) != len(kind[1]):
            raise LoopSourceError("values of different structure")
        pairs = zip(value.items, kind[1], strict=True)
        return tuple(part for item, inner in pairs for part in flat_parts(item, inner))
    if kind[0].endswith("-table"):
        if not isinstance(value, Value) or (value.kind, value.shape) != kind:
            raise LoopSourceError("a table with entries of the same shape is needed here")
        return value.parts
    # numbers of the same shape, in the text of their kind
    if shape_of(value) != kind[1]:
        raise LoopSourceError(f"shape {shape_of(value)} where {kind[1]} is needed")
    if kind[0] == "int" and kind[1] == ():
        return (integer_text(value),)
    if kind[0] == "int" and isinstance(value, Value) and value.kind == "int":
        return value.parts
    if kind[0] == "bool":
        return (boolean_text(value),)
    return real_parts(value)


def boolean_text(value: Term) -> str:
    """Code of a condition: a bool, or a number compared with zero."""
    if isinstance(value, Number):
        return str(bool(value.value))
    if shape_of(value) != ():
        raise LoopSourceError("a condition must be a scalar")
    assert isinstance(value, Value)
    if value.kind == "bool":
        return value.text
    return f"({value.text} != {'0' if value.kind == 'int' else 'real(0.0)'})"


def joined_kind(first, second):
    """Kind that holds both: real wins over int and bool; structures must agree."""
    if first == second:
        return first
    # groups item by item; other kinds must have the same shape, and a table is no number
    if first[0] == "group" and second[0] == "group" and len(first[1]) == len(second[1]):
        pairs = zip(first[1], second[1], strict=True)
        return ("group", tuple(joined_kind(a, b) for a, b in pairs))
    if "group" in (first[0], second[0]) or first[1] != second[1]:
        raise LoopSourceError("values of different shape")
    if first[0].endswith("-table") or second[0].endswith("-table"):
        raise LoopSourceError("a table and a number")
    return ("real", first[1])
