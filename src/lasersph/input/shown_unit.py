"""Units in which a user wrote a number: answers come back in them.

A plan that says `"laser.fluence" = ["0.4 J/cm^2", ...]` is answered in J/cm^2. A key whose numbers
were written without a unit is shown in SI, fluences and intensities per square centimeter.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from lasersph.input.formatting import format_quantity
from lasersph.input.units import UnitError, parse_unit

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

USUAL = {"J/m^2": "J/cm^2", "W/m^2": "W/cm^2"}
"""Units of the field beside those of SI."""
QUANTITY = re.compile(r"\s*[-+]?[\d.]+(?:[eE][-+]?\d+)?\s*(?:\+-\s*[\d.eE+-]+\s*)?(\D.*)$")
NUMBER_AND_UNIT = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([^\d\s.,].*?)\s*")
REWRITTEN_DIGITS = 6
"""Of a number that is written in another unit."""
DIGITS = 15
"""Significant digits that a double always keeps: 0.4 J/cm^2 comes back as 0.4."""


class ShownUnit(NamedTuple):
    """A unit with its size in SI and, of a temperature, its zero [K]."""

    name: str
    size: float = 1.0
    zero: float = 0.0

    def number(self, value: float) -> float:
        """A number in SI in this unit, without the rounding of the conversion."""
        return float(f"{(value - self.zero) / self.size:.{DIGITS}g}")

    def numbers(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Numbers in SI in this unit."""
        return (values - self.zero) / self.size

    def text(self, value: float, digits: int = 4) -> str:
        """A number in SI with this unit: 0.564 J/cm^2."""
        return f"{self.number(value):.{digits}g} {self.name}".rstrip()


def shown_unit(unit: str, written: str = "") -> ShownUnit:
    """The unit in which numbers of an SI unit are shown: that in which they were written, or the
    usual one."""
    name = written or USUAL.get(unit, unit)
    if name == unit or not name:
        return ShownUnit(unit)
    found = parse_unit(name)
    return ShownUnit(name, float(found.factor), float(found.offset))


def number_and_unit(text: str) -> tuple[str, str]:
    """The parts of a quantity as it is written, "0.6" and "J/cm^2"; empty where it is none."""
    found = NUMBER_AND_UNIT.fullmatch(text)
    return (found[1], found[2]) if found else ("", "")


def in_unit_of(value: str, pattern: str) -> str:
    """A quantity that a program wrote in SI in the unit of another, "6000.0 J/m^2" as "0.6 J/cm^2";
    with the prefix that fits where the other has no unit. Other units are a person's and stay."""
    # Only SI is rewritten: another unit was chosen by a person.
    number, unit = number_and_unit(value)
    _, wanted = number_and_unit(pattern)
    try:
        given, target = parse_unit(unit), parse_unit(wanted) if wanted else None
    except UnitError:
        return value
    if given.factor != 1 or given.offset:
        return value
    # Without a unit of the pattern the prefix decides, else the number is converted to it.
    if target is None:
        return format_quantity(float(number), unit, REWRITTEN_DIGITS)
    if target.dimension != given.dimension:
        return value
    size = (float(number) - float(target.offset)) / float(target.factor)
    return f"{size:.{REWRITTEN_DIGITS}g} {wanted}"


def units_written(plan: str, units: Mapping[str, str]) -> dict[str, ShownUnit]:
    """For each key with its SI unit that in which the text of a plan gives its values, by the first
    of them; see `shown_unit` for keys without."""
    tables = tomllib.loads(plan)
    found = {}
    # The first quantity of the right dimension below each key decides.
    for key, unit in units.items():
        fitting = (one for one in _texts(tables, key) if _is_unit_of(one, unit))
        found[key] = shown_unit(unit, next(fitting, "") if unit else "")
    return found


def _texts(value: Any, key: str, path: str = "") -> Iterator[str]:
    """Units of the quantities that stand below a key, in their order."""
    if isinstance(value, dict):
        # An unknown names its key in a table of its own.
        is_named = value.get("key") == key  # an unknown of another name
        for name, one in value.items():
            yield from _texts(one, key, key if is_named else f"{path}.{name}".strip("."))
    elif isinstance(value, list):
        for one in value:
            yield from _texts(one, key, path)
    elif isinstance(value, str) and _is_below(path, key) and (match := QUANTITY.match(value)):
        yield match[1].strip()


def _is_below(path: str, key: str) -> bool:
    return f".{key}." in f".{path}."


def _is_unit_of(text: str, unit: str) -> bool:
    """Whether a text is a unit of the same dimension."""
    try:
        return parse_unit(text).dimension == parse_unit(unit).dimension
    except UnitError:
        return False
