"""A quantity is one finite decimal number and a unit: "0.6 J/cm^2", "8 nm", "20 degC".

The number is checked by a regular expression, the unit by a grammar of its own, and the product is
taken in exact rational arithmetic, so "3.97 nm" is the float nearest to 3.97e-9. `KINDS` has the
dimension of each quantity, its SI unit, an example for messages and, where others share the
dimension, the sort of unit it must be written with: J/m^2 and N/m are both kg/s^2, but only the
first is a fluence.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from lasersph.input.units import (
    ENERGY,
    FORCE,
    NONE,
    POWER,
    Dimension,
    Unit,
    UnitError,
    dimension,
    parse_unit,
)

_NUMBER = re.compile(
    r"\s*([+-]?(?:[0-9]{1,40}(?:\.[0-9]{0,40})?|\.[0-9]{1,40})(?:[eE][+-]?[0-9]{1,3})?)(.*)",
    re.DOTALL,
)
_LIGHT = {"needs_one_of": frozenset({ENERGY, POWER}), "refuses": frozenset({FORCE})}
_DIFFUSION = dimension(m=2, s=-1)
_HEAT_SLOPE = dimension(m=-1, kg=1, s=-2, K=-2)
_KELVIN = dimension(K=1)


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
    # A number by the regular expression, the rest by the grammar of units.
    wanted = KINDS[kind]
    hint = f'write e.g. "{wanted.example}"'
    shown = text if len(text) <= 60 else text[:57] + "..."
    match = _NUMBER.match(text.replace("\u2212", "-"))
    if match is None:
        raise QuantityError(f'"{shown}" does not start with a number; {hint}')
    number, unit_text = match.group(1), match.group(2).strip()
    # A fraction is a pure number; all else needs a unit.
    if not unit_text:
        if kind == "fraction":
            return _finite(Fraction(number), shown)
        raise QuantityError(f'"{shown}" has no unit; {hint}')
    # A second number where the unit should be: 1,5 or 1.2.3.
    if re.match(r"[,.0-9]", unit_text) and not re.match(r"1\s*/", unit_text):
        raise QuantityError(f'the number in "{shown}" cannot be read; {hint}')
    try:
        unit = parse_unit(unit_text)
    except UnitError as error:
        raise QuantityError(f'{error} in "{shown}"; {hint}') from None
    # A difference has no zero: 20 degC is 293.15 K, or 20 K.
    if unit.offset and kind == "temperature_difference":
        raise QuantityError(f'"{shown}" is a temperature, not a difference; write it in K')
    # Dimension and symbols of the unit must be those of the kind.
    if not wanted.accepts(unit):
        given = kind_of(unit)
        what = f"is {given.words}" if given else "has another dimension"
        raise QuantityError(f'"{shown}" {what}, not {wanted.words}; {hint}')
    return _finite(Fraction(number) * unit.factor + unit.offset, shown)


def fits_kind(text: str, kind: str) -> bool:
    """Whether a text can be read as a quantity of a kind."""
    try:
        parse_quantity(text, kind)
    except QuantityError:
        return False
    return True


def _finite(exact: Fraction, shown: str) -> float:
    # The fraction rounds once, to the nearest double.
    try:
        value = float(exact)
    except OverflowError:
        value = math.inf
    if not math.isfinite(value) or (value == 0.0 and exact != 0):
        raise QuantityError(f'"{shown}" is outside the range of floating-point numbers')
    return value


@dataclass(frozen=True)
class Kind:
    """One kind of quantity; `needs_one_of` and `refuses` are dimensions of the symbols used."""

    name: str
    unit: str
    example: str
    dimension: Dimension
    needs_one_of: frozenset[Dimension] = frozenset()
    refuses: frozenset[Dimension] = frozenset()

    @property
    def words(self) -> str:
        """Name with its article, for messages: "a surface tension", "an energy"."""
        name = self.name.replace("_", " ")
        return f"{'an' if name[0] in 'aeiou' else 'a'} {name}"

    def accepts(self, unit: Unit) -> bool:
        """Whether a number with this unit is a quantity of this kind."""
        # J/m^2 and N/m have one dimension: the symbols tell them apart.
        if unit.dimension != self.dimension or unit.parts & self.refuses:
            return False
        return not self.needs_one_of or bool(unit.parts & self.needs_one_of)


_ALL = (
    Kind("length", "m", "8 nm", dimension(m=1)),
    Kind("time", "s", "10 ns", dimension(s=1)),
    Kind("temperature", "K", "298.15 K", _KELVIN),
    Kind("temperature_difference", "K", "5 K", _KELVIN),
    Kind("fluence", "J/m^2", "0.6 J/cm^2", dimension(kg=1, s=-2), **_LIGHT),
    Kind("intensity", "W/m^2", "9.6e11 W/m^2", dimension(kg=1, s=-3), **_LIGHT),
    Kind("heat_flux", "W/m^2", "1e6 W/m^2", dimension(kg=1, s=-3), **_LIGHT),
    Kind("power", "W", "20 W", POWER, refuses=frozenset({FORCE})),
    Kind("energy", "J", "1 mJ", ENERGY, refuses=frozenset({FORCE})),
    Kind("angle", "rad", "0.071 rad", dimension(rad=1)),
    Kind("absorption_coefficient", "1/m", "9.58e7 1/m", dimension(m=-1)),
    Kind("density", "kg/m^3", "2700 kg/m^3", dimension(m=-3, kg=1)),
    Kind("specific_heat", "J/(kg K)", "900 J/(kg K)", dimension(m=2, s=-2, K=-1)),
    Kind("volumetric_heat", "J/(m^3 K)", "2.1e4 J/(m^3 K)", dimension(m=-1, kg=1, s=-2, K=-1)),
    Kind("volumetric_heat_slope", "J/(m^3 K^2)", "71 J/(m^3 K^2)", _HEAT_SLOPE),
    Kind("coupling", "W/(m^3 K)", "2.1e16 W/(m^3 K)", dimension(m=-1, kg=1, s=-3, K=-1)),
    Kind("conductivity", "W/(m K)", "167 W/(m K)", dimension(m=1, kg=1, s=-3, K=-1)),
    Kind("diffusivity", "m^2/s", "5.3e-6 m^2/s", _DIFFUSION),
    Kind("specific_energy", "J/kg", "397 kJ/kg", dimension(m=2, s=-2), frozenset({ENERGY})),
    Kind("viscosity", "Pa s", "1.3 mPa s", dimension(m=-1, kg=1, s=-1)),
    Kind("kinematic_viscosity", "m^2/s", "5e-7 m^2/s", _DIFFUSION),
    Kind("surface_tension", "N/m", "0.87 N/m", dimension(kg=1, s=-2)),
    Kind("surface_tension_slope", "N/(m K)", "-0.43 mN/(m K)", dimension(kg=1, s=-2, K=-1)),
    Kind("expansion", "1/K", "2.3e-5 1/K", dimension(K=-1)),
    Kind("molar_mass", "kg/mol", "26.98 g/mol", dimension(kg=1, mol=-1)),
    Kind("molar_energy", "J/mol", "-166 kJ/mol", dimension(m=2, kg=1, s=-2, mol=-1)),
    Kind("surface_concentration", "mol/m^2", "1.3e-5 mol/m^2", dimension(m=-2, mol=1)),
    Kind("velocity", "m/s", "10 m/s", dimension(m=1, s=-1)),
    Kind("acceleration", "m/s^2", "9.81 m/s^2", dimension(m=1, s=-2)),
    Kind("mass_flux", "kg/(m^2 s)", "10 kg/(m^2 s)", dimension(m=-2, kg=1, s=-1)),
    Kind("pressure", "Pa", "101325 Pa", dimension(m=-1, kg=1, s=-2), refuses=frozenset({ENERGY})),
    Kind("heat_transfer_coefficient", "W/(m^2 K)", "20 W/(m^2 K)", dimension(kg=1, s=-3, K=-1)),
    Kind("frequency", "Hz", "10 kHz", dimension(s=-1)),
    Kind("angular_frequency", "rad/s", "1.2e16 rad/s", dimension(s=-1, rad=1)),
    Kind("collision_rate", "1/(K s)", "1.23e11 1/(K s)", dimension(s=-1, K=-1)),
    Kind("fraction", "1", "25 %", NONE),
)
KINDS: dict[str, Kind] = {kind.name: kind for kind in _ALL}


def kind_of(unit: Unit) -> Kind | None:
    """The first kind that a unit can stand for, to say what was given instead."""
    return next((kind for kind in _ALL if kind.accepts(unit)), None)
