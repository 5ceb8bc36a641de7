"""Arithmetic of the source compiler: scalar code for operators and functions of scalars, vectors
and tensors, every literal in the working precision.

`lines.atom(text)` stores an expression in a new local and returns its name, so that a component
used twice is computed once. Broadcasting goes no further than scalar with vector or tensor.
"""

from __future__ import annotations

import math
import operator
from typing import Protocol

from lasersph.compute.values import (
    Group,
    LoopSourceError,
    Number,
    Term,
    Value,
    boolean_text,
    integer_text,
    is_integer,
    real_parts,
    scalar,
    shape_of,
)


class Lines(Protocol):
    """Receives statements of the function being written."""

    def atom(self, text: str) -> str:
        """Name of a local that holds the expression."""
        ...


_FOLD = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "//": operator.floordiv,
    "%": operator.mod,
    "**": operator.pow,
}
_COMPARE = {
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": operator.eq,
    "!=": operator.ne,
}


def binary(lines: Lines, op: str, a: Term, b: Term) -> Term:
    """a op b for + - * / // % and **."""
    # literals are computed here; whole numbers stay whole but for / and **
    if isinstance(a, Number) and isinstance(b, Number):
        return Number(_FOLD[op](a.value, b.value))
    if is_integer(a) and is_integer(b) and op not in ("/", "**"):
        return scalar(f"({integer_text(a)} {op} {integer_text(b)})", "int")
    # all else is real: powers, then component by component
    if op == "**":
        return power(lines, a, b)
    left, right = shape_of(a), shape_of(b)
    if op in ("//", "%") and (left or right):
        raise LoopSourceError(f"operator {op} is for scalars")
    if left and right and left != right:
        raise LoopSourceError(f"shapes {left} and {right} do not fit for {op}")
    shape = left or right
    first, second = real_parts(a), real_parts(b)
    count = max(len(first), len(second))
    # a scalar beside a vector: evaluated once, for all components
    if shape and not left:
        first = (lines.atom(first[0]),) * count
    if shape and not right:
        # one division and products in place of a division for each component
        if op == "/" and count > 1:
            op, second = "*", (f"real(1.0) / {second[0]}",)
        second = (lines.atom(second[0]),) * count
    pairs = zip(first, second, strict=True)
    return Value("real", shape, tuple(f"({x} {op} {y})" for x, y in pairs))


def power(lines: Lines, base: Term, exponent: Term) -> Term:
    """base ** exponent: products for whole, sqrt for half exponents up to 8, else pow()."""
    shape = shape_of(base)
    if shape_of(exponent) != ():
        raise LoopSourceError("an exponent must be a scalar")
    # an exponent that no product gives
    if not isinstance(exponent, Number) or (2 * exponent.value) % 1:
        text = real_parts(exponent)[0]
        text = lines.atom(text) if shape else text
        parts = tuple(f"math.pow({part}, {text})" for part in real_parts(base))
        return Value("real", shape, parts)
    # large exponents are left to pow()
    if abs(exponent.value) > 8:
        text = real_parts(exponent)[0]
        parts = tuple(f"math.pow({part}, {text})" for part in real_parts(base))
        return Value("real", shape, parts)
    return Value(
        "real", shape, tuple(_product(lines, part, exponent.value) for part in real_parts(base))
    )


def _product(lines: Lines, base: str, exponent: float) -> str:
    """Text of base ** exponent by repeated squaring and one square root."""
    if exponent == 0:
        return "real(1.0)"
    # half an exponent is a square root, the rest products
    base = lines.atom(base)
    whole, half = int(abs(exponent)), abs(exponent) % 1
    factors = [f"math.sqrt({base})"] if half else []
    # binary digits of the exponent: a square for each, a factor where it is 1
    square = base
    while whole:
        if whole & 1:
            factors.append(square)
        whole >>= 1
        if whole:
            square = lines.atom(f"{square} * {square}")
    text = "(" + " * ".join(factors) + ")"
    return text if exponent > 0 else f"(real(1.0) / {text})"


def negative(a: Term) -> Term:
    """-a."""
    if isinstance(a, Number):
        return Number(-a.value)
    if is_integer(a):
        return scalar(f"(-{integer_text(a)})", "int")
    return Value("real", shape_of(a), tuple(f"(-{part})" for part in real_parts(a)))


def compare(op: str, a: Term, b: Term) -> Term:
    """a op b for < <= > >= == !=."""
    if isinstance(a, Number) and isinstance(b, Number):
        return Number(_COMPARE[op](a.value, b.value))
    if shape_of(a) or shape_of(b):
        raise LoopSourceError("vectors have no order; compare components or norms")
    # whole numbers are compared as such, all others in the working precision
    if is_integer(a) and is_integer(b):
        return scalar(f"({integer_text(a)} {op} {integer_text(b)})", "bool")
    return scalar(f"({real_parts(a)[0]} {op} {real_parts(b)[0]})", "bool")


def invert(a: Term) -> Term:
    """not a."""
    if isinstance(a, Number):
        return Number(not a.value)
    return scalar(f"(not {boolean_text(a)})", "bool")


def select(lines: Lines, condition: Term, a: Term, b: Term) -> Term:
    """a if condition else b, component by component."""
    if is_integer(a) and is_integer(b):
        test = boolean_text(condition)
        return scalar(f"({integer_text(a)} if {test} else {integer_text(b)})", "int")
    # the condition is evaluated once for all components
    shape = shape_of(a)
    if shape != shape_of(b):
        raise LoopSourceError("both branches must have the same shape")
    test = boolean_text(condition)
    test = lines.atom(test) if shape else test
    pairs = zip(real_parts(a), real_parts(b), strict=True)
    return Value("real", shape, tuple(f"({x} if {test} else {y})" for x, y in pairs))


def extreme(lines: Lines, name: str, values: list[Term]) -> Term:
    """min() or max() of two or more scalars."""
    if len(values) < 2 or any(shape_of(value) for value in values):
        raise LoopSourceError(f"{name}() takes two or more scalars")
    if all(isinstance(value, Number) for value in values):
        return Number((min if name == "min" else max)(v.value for v in values))  # type: ignore[union-attr]
    whole = all(is_integer(value) for value in values)
    # calls of two values, one in the other
    texts = [integer_text(v) if whole else real_parts(v)[0] for v in values]
    result = texts[0]
    for text in texts[1:]:
        result = f"{name}({result}, {text})"
    return scalar(result, "int" if whole else "real")


def absolute(a: Term) -> Term:
    """|a| of a scalar, or of each component."""
    if isinstance(a, Number):
        return Number(abs(a.value))
    if is_integer(a):
        return scalar(f"abs({integer_text(a)})", "int")
    return Value("real", shape_of(a), tuple(f"abs({part})" for part in real_parts(a)))


def unary(name: str, a: Term) -> Term:
    """Function of module math, component by component."""
    if isinstance(a, Number) and hasattr(math, name):
        return Number(getattr(math, name)(a.value))
    prefix = "np." if name in ("floor", "ceil") else "math."
    parts = tuple(f"{prefix}{name}({part})" for part in real_parts(a))
    return Value("real", shape_of(a), parts)


def _entry(lines: Lines, table: Value, index: list[Term]) -> Value:
    """Entry of a table: a scalar, vector or tensor."""
    if len(index) != 1 or not is_integer(index[0]):
        raise LoopSourceError(
            f"table {table.table_name} is indexed by one integer; its entries then by literal ones"
        )
    # the place is computed once for all components of an entry
    place = f"np.uint64({integer_text(index[0])})"
    if len(table.parts) > 1:
        place = lines.atom(place)
    elements = [f"{part}[{place}]" for part in table.parts]
    if table.kind == "int-table":
        return Value("int", table.shape, tuple(f"np.int64({element})" for element in elements))
    return Value("real", table.shape, tuple(elements))


def component(lines: Lines, a: Term, index: list[Term]) -> Term:
    """a[index]: tables by integer code; vectors, tensors and tuples by literal numbers."""
    if isinstance(a, Value) and a.is_table:
        return _entry(lines, a, index)
    if not all(isinstance(k, Number) and is_integer(k) for k in index):
        raise LoopSourceError("components are indexed by literal integers")
    numbers = [int(k.value) for k in index]  # type: ignore[union-attr]
    if isinstance(a, Group):
        return (
            component(lines, a.items[numbers[0]], index[1:]) if index[1:] else a.items[numbers[0]]
        )
    shape = shape_of(a)
    if len(numbers) > len(shape):
        raise LoopSourceError(f"{len(numbers)} indices for shape {shape}")
    assert isinstance(a, Value)
    # one index after the other cuts the row-major components to a part
    parts = list(a.parts)
    for k, number in enumerate(numbers):
        if not -shape[k] <= number < shape[k]:
            raise LoopSourceError(f"index {number} is outside shape {shape}")
        stride = len(parts) // shape[k]
        start = (number % shape[k]) * stride
        parts = parts[start : start + stride]
    return Value(a.kind, shape[len(numbers) :], tuple(parts))
