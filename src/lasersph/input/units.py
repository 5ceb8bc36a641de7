"""Unit expressions such as "J/cm^2", "W/(m K)" or "µm" as an exact factor to SI and a dimension.

The grammar is this file's own, so no input is ever evaluated: symbols with integer exponents
(`cm^2`, `cm2`, `cm**2`, `cm²`, `cm^-1`), joined by a space, `*`, `·` or `/`, with parentheses;
`a/b/c` is a/(b c). SI units with prefixes come from the table below, which spares the 0.3 s that
pint needs to start; any other single name is looked up in pint's registry.

Leaves out: fractional exponents, logarithmic units. Source: SI brochure, 9th edition (2019).
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

DIMENSIONS = ("m", "kg", "s", "K", "mol", "A", "cd", "rad")
Dimension = tuple[int, ...]


def dimension(**exponents: int) -> Dimension:
    """Exponents of (m, kg, s, K, mol, A, cd, rad); angles keep a dimension of their own here."""
    return tuple(exponents.get(name, 0) for name in DIMENSIONS)


NONE = dimension()
ENERGY = dimension(m=2, kg=1, s=-2)
POWER = dimension(m=2, kg=1, s=-3)
FORCE = dimension(m=1, kg=1, s=-2)


class UnitError(ValueError):
    """A unit expression that cannot be read; the text says why."""


@dataclass(frozen=True)
class Unit:
    """SI value = number * factor + offset; `parts` are the dimensions of the symbols used."""

    factor: Fraction
    dimension: Dimension
    offset: Fraction = Fraction(0)
    parts: frozenset[Dimension] = frozenset()


_PREFIXES = {"f": -15, "p": -12, "n": -9, "u": -6, "m": -3, "c": -2, "d": -1, "": 0}
_PREFIXES |= {"h": 2, "k": 3, "M": 6, "G": 9, "T": 12, "P": 15}
_PREFIXED = {
    "m": (1, dimension(m=1)),
    "g": (Fraction(1, 1000), dimension(kg=1)),
    "s": (1, dimension(s=1)),
    "K": (1, dimension(K=1)),
    "mol": (1, dimension(mol=1)),
    "A": (1, dimension(A=1)),
    "J": (1, ENERGY),
    "W": (1, POWER),
    "N": (1, FORCE),
    "Pa": (1, dimension(m=-1, kg=1, s=-2)),
    "bar": (100_000, dimension(m=-1, kg=1, s=-2)),
    "Hz": (1, dimension(s=-1)),
    "eV": (Fraction("1.602176634e-19"), ENERGY),
    "rad": (1, dimension(rad=1)),
}
_KELVIN = Unit(Fraction(1), dimension(K=1), parts=frozenset({dimension(K=1)}))
_CELSIUS = Unit(Fraction(1), _KELVIN.dimension, Fraction("273.15"), _KELVIN.parts)
_FAHRENHEIT = Unit(Fraction(5, 9), _KELVIN.dimension, Fraction("459.67") * 5 / 9, _KELVIN.parts)


def _plain(factor: Fraction | float | str, dims: Dimension) -> Unit:
    return Unit(Fraction(factor), dims, parts=frozenset({dims}))


def _table() -> dict[str, Unit]:
    table = {
        "%": _plain("0.01", NONE),
        "percent": _plain("0.01", NONE),
        "ppm": _plain("1e-6", NONE),
        "deg": _plain(Fraction(math.pi) / 180, dimension(rad=1)),
        "min": _plain(60, dimension(s=1)),
        "h": _plain(3600, dimension(s=1)),
        "kelvin": _KELVIN,
        "micron": _plain("1e-6", dimension(m=1)),
        "angstrom": _plain("1e-10", dimension(m=1)),
        "atm": _plain(101325, dimension(m=-1, kg=1, s=-2)),
        "degC": _CELSIUS,
        "celsius": _CELSIUS,
        "degF": _FAHRENHEIT,
        "delta_degC": _KELVIN,
    }
    for symbol, (factor, dims) in _PREFIXED.items():
        for prefix, power in _PREFIXES.items():
            table.setdefault(prefix + symbol, _plain(factor * Fraction(10) ** power, dims))
    table["degree"] = table["degrees"] = table["deg"]
    return table


_TABLE = _table()
# Micro, Greek mu, angstrom (two signs), degree signs, dots, minus, superscripts.
_SPELLINGS = {"\u00b5": "u", "\u03bc": "u", "\u00c5": "angstrom", "\u212b": "angstrom"}
_SPELLINGS |= {"\u2103": "degC", "\u00b0C": "degC", "\u00b0F": "degF", "\u00b0K": "K"}
_SPELLINGS |= {"\u00b0": "deg", "\u00b7": "*", "\u22c5": "*", "\u00d7": "*", "\u2212": "-"}
_SPELLINGS |= {"**": "^", "\u00a0": " ", "\u202f": " ", "\u207b": "^-", "\u00b9": "^1"}
_SPELLINGS |= {"\u00b2": "^2", "\u00b3": "^3", "\u2074": "^4"}
_TOKEN = re.compile(r"([A-Za-z_]+|%|1)(?:\^?([+-]?\d))?|([*/()])|(\s+)|\^([+-]?\d)")


@lru_cache(maxsize=1024)
def parse_unit(text: str) -> Unit:
    """Read a unit expression.

    Args:
        text: for example "J/cm^2", "kJ/kg", "W/(m K)", "degC", "%".

    Returns:
        The `Unit`; only a lone temperature scale such as degC keeps its offset.

    Raises:
        UnitError: empty, unknown or malformed text.
    """
    # Spellings of people and of typesetters, as ASCII.
    plain = text.strip()
    for spelling, ascii_form in _SPELLINGS.items():
        plain = plain.replace(spelling, ascii_form)
    plain = plain.replace("^-^", "^-")
    if not plain:
        raise UnitError("no unit")
    # "/s" is 1/s.
    if plain.startswith("/"):
        plain = "1" + plain
    if len(plain) > 60:
        raise UnitError("the unit is longer than 60 characters")
    tokens = _tokens(plain, text)
    # A lone symbol keeps its zero, as degC has one.
    if len(tokens) == 1 and isinstance(tokens[0], tuple) and tokens[0][1] == 1:
        return _symbol(tokens[0][0])
    unit, end = _product(tokens, 0, text)
    if end != len(tokens):
        raise UnitError(f'the unit "{text}" has a ")" too many')
    return unit


def _tokens(plain: str, text: str) -> list[str | tuple[str, int]]:
    """Operators as strings, symbols as (name, exponent), an exponent after ")" as ("", n)."""
    tokens: list[str | tuple[str, int]] = []
    place = 0
    while place < len(plain):
        match = _TOKEN.match(plain, place)
        # A symbol with its exponent, an operator, or an exponent behind a parenthesis.
        if match is None:
            raise UnitError(f'the unit "{text}" cannot be read')
        name, exponent, operator, _space, late = match.groups()
        if name == "1" and exponent:
            raise UnitError(f'the unit "{text}" cannot be read')
        if name:
            tokens.append((name, int(exponent or 1)))
        elif operator:
            tokens.append(operator)
        elif late:
            if not tokens or tokens[-1] != ")":
                raise UnitError(f'the unit "{text}" cannot be read')
            tokens.append(("", int(late)))
        place = match.end()
    return tokens


def _product(tokens: list, start: int, text: str) -> tuple[Unit, int]:
    """Product of factors from `start` up to the end or the closing parenthesis."""
    result = Unit(Fraction(1), NONE)
    place = start
    sign = 1
    wanted = True
    while place < len(tokens) and tokens[place] != ")":
        # Operators stand between factors only.
        token = tokens[place]
        if token in ("*", "/"):
            if wanted:
                raise UnitError(f'the unit "{text}" cannot be read')
            sign, wanted = (-1 if token == "/" else 1), True
            place += 1
            continue
        # A parenthesis is a factor, with an exponent behind it.
        if token == "(":
            factor, place = _product(tokens, place + 1, text)
            if place >= len(tokens):
                raise UnitError(f'the unit "{text}" misses a ")"')
            exponent = 1
            if place + 1 < len(tokens) and tokens[place + 1][0] == "":
                place += 1
                exponent = tokens[place][1]
        else:
            name, exponent = token
            factor = _symbol(name)
        # Multiply factor and dimension by the power of this symbol.
        power = sign * exponent  # a temperature scale counts as its difference
        pairs = zip(result.dimension, factor.dimension, strict=True)
        dims = tuple(a + power * b for a, b in pairs)
        parts = result.parts | factor.parts
        result = Unit(result.factor * factor.factor**power, dims, parts=parts)
        sign, wanted = 1, False
        place += 1
    if wanted:
        raise UnitError(f'the unit "{text}" cannot be read')
    return result, place


def _symbol(name: str) -> Unit:
    if name == "1":
        return Unit(Fraction(1), NONE)
    return _TABLE[name] if name in _TABLE else _from_pint(name)


@lru_cache(maxsize=256)
def _from_pint(name: str) -> Unit:
    """A rarer unit by its name (psi, torr, inch, cal, ...); pint sees one bare word only."""
    if len(name) < 2:
        raise UnitError(f'unknown unit "{name}"{_case_hint(name)}')
    import pint

    # pint reads one plain word: units that the table does not have.
    registry = pint.get_application_registry()
    try:
        quantity = registry.Quantity(1.0, registry.parse_units(name)).to_base_units()
    except Exception as error:  # pint raises many types; all mean that this word is no plain unit
        raise UnitError(f'unknown unit "{name}"{_case_hint(name)}') from error
    # Dimensions by pint's names; an angle is none to pint, but one here.
    names = {
        "[length]": "m",
        "[mass]": "kg",
        "[time]": "s",
        "[temperature]": "K",
        "[substance]": "mol",
        "[current]": "A",
        "[luminosity]": "cd",
    }
    exponents: dict[str, int] = {}
    for key, power in quantity.dimensionality.items():
        if key not in names or power != int(power):
            raise UnitError(f'unknown unit "{name}"')
        exponents[names[key]] = int(power)
    if str(quantity.units) == "radian":
        exponents["rad"] = 1
    return _plain(f"{quantity.magnitude:.14g}", dimension(**exponents))


def _case_hint(name: str) -> str:
    # Capitals matter in units: mW and MW.
    if name == "C":
        return ' (do you mean "degC"?)'
    near = [known for known in _TABLE if known.lower() == name.lower()]
    return f' (do you mean "{near[0]}"?)' if near else ""
