"""Numbers with units as people read them: 2.77e-07 m is "277 nm"."""

from __future__ import annotations

import math
from typing import Any

PREFIXES = ((1e-12, "p"), (1e-9, "n"), (1e-6, "µ"), (1e-3, "m"), (1.0, ""))
WITH_PREFIX = ("s", "m")
SMALLEST = 1e-15
"""Lengths [m] and times [s] below this are rounding errors."""
MOST_LISTED = 8
"""Longer lists are not written out."""
SUFFIXES = (
    ("_K_s", "K/s"),
    ("_K_m", "K/m"),
    ("_m2_s", "m²/s"),
    ("_m_s2", "m/s²"),
    ("_1_s", "1/s"),
    ("_1_m", "1/m"),
    ("_W_m2", "W/m²"),
    ("_Pa", "Pa"),
    ("_m_s", "m/s"),
    ("_m3", "m³"),
    ("_m", "m"),
    ("_s", "s"),
    ("_K", "K"),
    ("_J", "J"),
    ("_deg", "°"),
)


def quantity(value: float | None, unit: str, digits: int = 4) -> str:
    """A value in SI with its unit, times and lengths with a prefix; "–" for None.

    Args:
        value: in `unit`.
        unit: "s", "m", "K", "J/m", ...
        digits: significant digits.
    """
    if value is None or not math.isfinite(value):
        return "–"
    if unit in WITH_PREFIX and abs(value) < SMALLEST:
        value = 0.0
    if unit in WITH_PREFIX and 0.0 < abs(value) < 1.0:
        factor, prefix = next(
            ((f, p) for f, p in PREFIXES if abs(round_to(value / f, digits)) < 1000.0), PREFIXES[-1]
        )
        return f"{shown(value / factor, digits)} {prefix}{unit}"
    return f"{shown(value, digits)} {pretty_unit(unit)}".rstrip()


def shown(value: float, digits: int = 4) -> str:
    """A number with some significant digits, powers of ten as 1.2·10³, thousands apart."""
    if value == 0.0:
        return "0"
    exponent = math.floor(math.log10(abs(value)))
    if -4 <= exponent < max(6, digits):
        decimals = max(0, digits - 1 - exponent)
        text = f"{round_to(value, digits):,.{decimals}f}".replace(",", " ")
        return text.rstrip("0").rstrip(".") if "." in text else text
    mantissa, power = f"{value:.{digits - 1}e}".split("e")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return f"{mantissa}·10{superscript(int(power))}"


def round_to(value: float, digits: int) -> float:
    """Round to significant digits; large whole numbers keep all of theirs."""
    if value == 0.0:
        return 0.0
    places = digits - 1 - math.floor(math.log10(abs(value)))
    return round(value, max(places, 0))


def superscript(number: int) -> str:
    """A whole number in raised digits."""
    return str(number).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def pretty_unit(unit: str) -> str:
    """J/m^2 -> J/m²."""
    return unit.replace("^2", "²").replace("^3", "³")


def entry(key: str, value: Any, energy_unit: str = "J") -> str:
    """A value of summary.json in words, its unit taken from the end of its key."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value
    if isinstance(value, list) and len(value) > MOST_LISTED:
        return f"{len(value)} numbers"
    if isinstance(value, list):
        return ", ".join(entry(key, item, energy_unit) for item in value) or "–"
    unit = next((unit for suffix, unit in SUFFIXES if key.endswith(suffix)), "")
    return quantity(float(value), energy_unit if unit == "J" else unit)
