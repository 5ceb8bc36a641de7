"""Measured values: "3.2 +- 0.1 um", "200 nm +- 5 %", "1.1 +- 0.2"."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from lasersph.input import KINDS, QuantityError, did_you_mean, parse_quantity
from lasersph.observers import RESULTS

_SIGN = re.compile(r"\s*(?:\+-|\+/-|±)\s*")
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_NAMES = {
    re.compile(re.escape(key).replace("<name>", r"[^.]+")): one for key, one in RESULTS.items()
}


@dataclass(frozen=True)
class Measured:
    """A value and its standard error, in SI."""

    value: float
    sd: float


def read_measured(text: str, kind: str) -> Measured:
    """A value with its standard error.

    Args:
        text: e.g. "3.2 +- 0.1 um", "200 nm +- 5 %"; the unit may stand once, at the end.
        kind: of the quantity ("length"), or "" for a bare number.

    Raises:
        QuantityError: no "+-", no number, a unit of another kind, a standard error of zero.
    """
    example = KINDS[kind].example if kind else "1.1"
    number, _, unit = example.partition(" ")
    hint = f'write e.g. "{f"{number} +- {0.05 * float(number):g} {unit}".strip()}"'
    # value and error, each with its unit, or one unit for both at the end
    parts = _SIGN.split(text.strip())
    if len(parts) != 2:
        raise QuantityError(f'"{text}" needs a value and its standard error; {hint}')
    left, right = parts
    if right.endswith("%") and kind != "fraction":
        value = _number(left, kind)
        sd = 1e-2 * abs(value) * _number(right.removesuffix("%"), "")
    else:
        # a bare value takes the unit of its error
        if _NUMBER.fullmatch(left):
            match = _NUMBER.match(right)
            left += right[match.end() :] if match else ""
        value = _number(left, kind)
        sd = _number(right, "temperature_difference" if kind == "temperature" else kind)
    if not sd > 0.0:
        raise QuantityError(f'the standard error in "{text}" must be above zero; {hint}')
    return Measured(value, sd)


def _number(text: str, kind: str) -> float:
    if kind:
        return parse_quantity(text, kind)
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise QuantityError(f'"{text.strip()}" is no number')
    return value


def unit_of_number(key: str) -> str:
    """SI unit of a number of summaries ("melt.depth_max_m").

    Raises:
        QuantityError: no observer fills this key.
    """
    found = next((one for pattern, one in _NAMES.items() if pattern.fullmatch(key)), None)
    if found is None:
        near = did_you_mean(key, RESULTS)
        raise QuantityError(f'"{key}" is no number of a summary{near}; docs/results.md lists them')
    return found.unit


def kind_of_number(key: str) -> str:
    """Kind of quantity of a number of summaries; empty where it is written without unit, in SI.

    Raises:
        QuantityError: no observer fills this key.
    """
    unit = unit_of_number(key)
    return next((kind.name for kind in KINDS.values() if kind.unit == unit), "")
