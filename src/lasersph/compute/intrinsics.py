"""Mathematical functions and built-ins that pair and pointwise functions may call."""

from __future__ import annotations

import math
import types
from typing import Any

import numpy as np

from lasersph.compute import algebra, vectors
from lasersph.compute.tensors import HELPERS
from lasersph.compute.values import Number, Term, Value, is_integer, real_parts, scalar, shape_of

_SAME_NAME = "sqrt exp expm1 log log1p log10 sin cos tan sinh cosh tanh floor ceil"
_ARCS = {"asin": np.arcsin, "acos": np.arccos, "atan": np.arctan}
_MATH = {getattr(module, name): name for module in (math, np) for name in _SAME_NAME.split()}
_MATH |= {getattr(math, name): name for name in (*_ARCS, "erf", "erfc")}
_MATH |= {function: name for name, function in _ARCS.items()}
_EXTREME = {min: "min", max: "max", np.minimum: "min", np.maximum: "max"}
_TWO = dict.fromkeys((math.atan2, np.arctan2), "atan2")
_TWO |= dict.fromkeys((math.copysign, np.copysign), "copysign")
_POWER = (pow, math.pow, np.power)
_ABSOLUTE = (abs, math.fabs, np.abs, np.fabs)


def is_helper(target: Any) -> bool:
    """Whether this is a helper of `compute.vectors` that is written out component by component."""
    name = getattr(target, "__name__", "")
    return name in HELPERS and getattr(vectors, name) is target


def intrinsic(lines: algebra.Lines, target: Any, values: list[Term]) -> Term | None:
    """Value of a call of a built-in or mathematical function; None where it is not understood."""
    count = len(values)
    if not isinstance(target, types.BuiltinFunctionType | type | np.ufunc):
        return algebra.select(lines, *values) if target is np.where and count == 3 else None
    if target in _MATH and count == 1:
        return algebra.unary(_MATH[target], values[0])
    if target in _EXTREME:
        return algebra.extreme(lines, _EXTREME[target], values)
    if target in _ABSOLUTE and count == 1:
        return algebra.absolute(values[0])
    if target in _POWER and count == 2:
        return algebra.power(lines, values[0], values[1])
    if target in _TWO and count == 2:
        return scalar(f"math.{_TWO[target]}({', '.join(real_parts(v)[0] for v in values)})")
    if target is float and count == 1 and shape_of(values[0]) == ():
        return Value("real", (), real_parts(values[0]))
    if target is int and count == 1 and shape_of(values[0]) == ():
        text = real_parts(values[0])[0]
        return values[0] if is_integer(values[0]) else scalar(f"np.int64({text})", "int")
    if target is len and count == 1:
        if isinstance(values[0], Value) and values[0].is_table:
            return scalar(f"np.int64({values[0].parts[0]}.size)", "int")
        return Number(shape_of(values[0])[0])
    return None
