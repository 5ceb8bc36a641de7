"""Numbers with units as people read them: 2.194e-1 s is "219.4 ms", 2.77e-7 m is "277 nm".

One function formats every time, length and other size that lasersph shows, so that a unit fits the
size of its number everywhere. Plain text can be typed back into a case file; typographic text, for
reports and figures, has raised powers of ten, a Greek mu and spaces between thousands.
"""

from __future__ import annotations

import math

PREFIXED = {"m": 1, "m^2": 2, "m^3": 3, "s": 1, "J": 1, "W": 1, "Pa": 1, "Hz": 1, "rad": 1}
"""Units of one symbol, which take a prefix, with the power of it that counts: 1 um^3 = 1e-18 m^3.
Temperatures and compound units take none."""
PREFIXES = ("f", "p", "n", "u", "m", "", "k", "M", "G", "T")
LARGEST = {1: 1e3, 2: 1e4, 3: 1e6}
"""Numbers from which the next prefix reads better, by that power: 994773 nm^2 is 0.9948 um^2."""
WITHOUT_KILO = ("m", "m^2", "m^3", "s")
"""Nobody says kilosecond, and no body here is a kilometer long."""
LEAST_POWER = {"m": -3}
"""Of a thousand; nobody measures metal in picometers: an atom is 0.25 nm wide."""
SMALLEST = {"m": 1e-15, "s": 1e-17}
"""Lengths [m] and times [s] below this are rounding errors: a proton, a thousandth of the shortest
pulses of light, whose steps are shown."""
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def format_quantity(
    value: float | None, unit: str, digits: int = 4, *, typographic: bool = False
) -> str:
    """A value in SI units with a prefix that reads well: (8e-9, "m") gives "8 nm".

    Args:
        value: in `unit`; None and what is not finite give "–".
        unit: "s", "m", "K", "J/m^2", ...; empty for a pure number. digits: significant digits.
        typographic: for reports and figures, not for case files.
    """
    if value is None or not math.isfinite(value):
        return "–"
    # Rounding leaves 1e-24 m where 0 is meant.
    if abs(value) < SMALLEST.get(unit, 0.0):
        value = 0.0
    name, scale = _fitting_unit(value, unit, digits, typographic=typographic)
    return f"{format_number(value / scale, digits, typographic=typographic)} {name}".rstrip()


def in_field_units(
    value: float, unit: str, error: float | None = None, *, typographic: bool = True
) -> str:
    """A number in SI with the unit in which users think of it: fluences per cm^2.

    Args:
        error: of the value, SI, which then decides on the digits.
    """
    if unit in ("J/m^2", "W/m^2"):
        value, error = 1e-4 * value, error and 1e-4 * error
        unit = unit.replace("m^2", "cm^2")
    return format_with_error(value, error, unit, typographic=typographic)


def _fitting_unit(value: float, unit: str, digits: int, *, typographic: bool) -> tuple[str, float]:
    """Unit with the prefix that fits a value, and its size in SI."""
    prefix, scale = "", 1.0
    # The power of a thousand whose prefix leaves a number from 1 up.
    if unit in PREFIXED and value:
        step = 1000.0 ** PREFIXED[unit]
        power = math.floor(math.log10(abs(value)) / math.log10(step))
        # 999.96 with four digits is 1000, the next prefix's 1
        power += abs(float(f"{value / step**power:.{digits}g}")) >= LARGEST[PREFIXED[unit]]
        # Not below the smallest usual prefix, nor kilo where nobody says it.
        power = max(LEAST_POWER.get(unit, -5), min(power, 0 if unit in WITHOUT_KILO else 4))
        prefix, scale = PREFIXES[power + 5], step**power
    if typographic:
        prefix = prefix.replace("u", "µ")
        unit = "°" if unit == "deg" else unit.replace("^2", "²").replace("^3", "³")
    return prefix + unit, scale


def format_with_error(
    value: float, error: float | None, unit: str, *, typographic: bool = False
) -> str:
    """A value and its error in one unit: (9.8e-6, 1e-7, "m") gives "9.80 +- 0.10 um".

    The error has two digits and the value as many decimals [GUM2008, 7.2.6]; without an error, or
    with none at all (0), the value stands alone.
    """
    if not error or not math.isfinite(error):
        return format_quantity(value, unit, typographic=typographic)
    # Value and error share the unit, and a power of ten where numbers get long.
    name, scale = _fitting_unit(value or error, unit, 4, typographic=typographic)
    value, error = value / scale, error / scale
    sign = "±" if typographic else "+-"
    largest = math.floor(math.log10(max(abs(value), error)))
    power = largest if not -3 <= largest < 6 else 0
    value, error = value / 10.0**power, error / 10.0**power
    # Two digits of the error decide on the decimals of both.
    digits = 1 - math.floor(math.log10(error))
    numbers = (f"{round(number, digits):,.{max(0, digits)}f}" for number in (value, error))
    text = f" {sign} ".join(numbers).replace(",", " " if typographic else "")
    if power:
        exponent = f"·10{str(power).translate(RAISED)}" if typographic else f"e{power}"
        text = f"({text}){exponent}"
    return f"{text} {name}".rstrip()


def format_number(value: float, digits: int = 4, *, typographic: bool = False) -> str:
    """A number with some significant digits; whole numbers below a million keep all of theirs."""
    # The point stays near the digits: below 1e-4 and from 1e6 on a power of ten stands apart.
    if value == 0.0:
        return "0"
    exponent = math.floor(math.log10(abs(value)))
    if -4 <= exponent < max(6, digits):
        decimals = max(0, digits - 1 - exponent)
        text = f"{value:,.{decimals}f}".replace(",", " " if typographic else "")
        return text.rstrip("0").rstrip(".") if "." in text else text
    mantissa, power = f"{value:.{digits - 1}e}".split("e")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    if typographic:
        return f"{mantissa}·10{str(int(power)).translate(RAISED)}"
    return f"{mantissa}e{power}"


def format_duration(seconds: float) -> str:
    """Time on the clock as a person says it: "42 s", "3 min 05 s", "2 h 10 min"."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"
