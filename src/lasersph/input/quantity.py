"""A quantity is one finite decimal number and a unit: "0.6 J/cm^2", "8 nm", "20 degC".

The number is checked by a regular expression, the unit by a grammar of its own, and the product is
taken in exact rational arithmetic, so "3.97 nm" is the float nearest to 3.97e-9.
"""

from __future__ import annotations

import math
import re
from fractions import Fraction
from functools import lru_cache

from lasersph.input.kinds import KINDS, kind_of
from lasersph.input.units import UnitError, parse_unit

_NUMBER = re.compile(
    r"\s*([+-]?(?:[0-9]{1,40}(?:\.[0-9]{0,40})?|\.[0-9]{1,40})(?:[eE][+-]?[0-9]{1,3})?)(.*)",
    re.DOTALL,
)


class QuantityError(ValueError):
    """A text that is no quantity of the wanted kind; says what is wrong and what would be right."""


@lru_cache(maxsize=4096)
def parse_quantity(text: str, kind: str) -> float:
    """Read a quantity.

    Args:
        text: a number and a unit, for example "0.6 J/cm^2".
        kind: name of a kind in `KINDS`, for example "fluence".

    Returns:
        The value in SI units of that kind.

    Raises:
        QuantityError: no number, no unit, unknown unit, wrong kind, not finite.
    """
    wanted = KINDS[kind]
    hint = f'write e.g. "{wanted.example}"'
    shown = text if len(text) <= 60 else text[:57] + "..."
    match = _NUMBER.match(text.replace("\u2212", "-"))
    if match is None:
        raise QuantityError(f'"{shown}" does not start with a number; {hint}')
    number, unit_text = match.group(1), match.group(2).strip()
    if not unit_text:
        if kind == "fraction":
            return _finite(Fraction(number), shown)
        raise QuantityError(f'"{shown}" has no unit; {hint}')
    if re.match(r"[,.0-9]", unit_text) and not re.match(r"1\s*/", unit_text):
        raise QuantityError(f'the number in "{shown}" cannot be read; {hint}')
    try:
        unit = parse_unit(unit_text)
    except UnitError as error:
        raise QuantityError(f'{error} in "{shown}"; {hint}') from None
    if unit.offset and kind == "temperature_difference":
        raise QuantityError(f'"{shown}" is a temperature, not a difference; write it in K')
    if not wanted.accepts(unit):
        given = kind_of(unit)
        what = f"is {given.words}" if given else "has another dimension"
        raise QuantityError(f'"{shown}" {what}, not {wanted.words}; {hint}')
    return _finite(Fraction(number) * unit.factor + unit.offset, shown)


def _finite(exact: Fraction, shown: str) -> float:
    try:
        value = float(exact)
    except OverflowError:
        value = math.inf
    if not math.isfinite(value) or (value == 0.0 and exact != 0):
        raise QuantityError(f'"{shown}" is outside the range of floating-point numbers')
    return value
