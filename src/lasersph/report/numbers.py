"""Values of summary.json as texts of the report, their units taken from the ends of their keys."""

from __future__ import annotations

from functools import partial
from typing import Any

from lasersph.input import format_number, format_quantity

quantity = partial(format_quantity, typographic=True)
shown = partial(format_number, typographic=True)

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
