"""Values of summary.json as texts of the report, their units taken from the ends of their keys."""

from __future__ import annotations

from functools import partial
from typing import Any

from lasersph.input import format_number, format_quantity
from lasersph.observers.quantity import suffix

quantity = partial(format_quantity, typographic=True)
shown = partial(format_number, typographic=True)

MOST_LISTED = 8
"""Longer lists are not written out."""
UNITS = ("K/s", "K/m", "m^2/s", "m/s^2", "1/s", "1/m", "W/m^2", "Pa", "m/s", "m^3", "m^2", "m", "s")
UNITS += ("K", "J", "deg")
"""Units that keys end in, those with two parts first."""


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
    unit = next((unit for unit in UNITS if key.endswith(suffix(unit))), "")
    return quantity(float(value), energy_unit if unit == "J" else unit)
