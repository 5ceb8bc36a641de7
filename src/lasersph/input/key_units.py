"""Units at the ends of keys: columns of history.csv, keys of summary.json.

A key ends in the unit of what it holds, `_m_s` for m/s. Amounts are named as in 3-D: a 1-D run
holds a unit area and a 2-D run a unit length, so that the energy stored in a section is in J/m;
that of a section (r, z) is of the whole revolution, in J.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

EXTENSIVE = {"J": ("J/m^2", "J/m", "J"), "kg": ("kg/m^2", "kg/m", "kg"), "m^3": ("m", "m^2", "m^3")}
"""Units of amounts in 1-D, 2-D and 3-D: a 1-D run holds a unit area, a 2-D run a unit length."""
UNITS = ("K/s", "K/m", "m^3/s", "m^2/s", "m/s^2", "1/s", "1/m", "W/m^2", "N/m", "Pa", "m/s")
UNITS += ("m^3", "m^2", "m", "s", "K", "J", "kg", "N", "deg")
"""Units that keys end in, those with two parts first."""


def suffix(unit: str) -> str:
    """End of a key that says the unit: m/s -> _m_s, m^2/s -> _m2_s, 1/s -> _1_s."""
    return "_" + unit.replace("^", "").replace("/", "_") if unit else ""


def unit_of(key: str) -> str:
    """Unit that a key ends in, amounts as in 3-D; empty for a pure number or a text."""
    # The list has the longest units first, so that _m2_s is not taken for _s.
    return next((unit for unit in UNITS if key.endswith(suffix(unit))), "")


def amount_dimension(summary: Mapping[str, Any]) -> int:
    """Dimensions that the amounts of a summary cover: 3 of a body of revolution, else its own."""
    return int(summary.get("amount_dimensions", summary.get("dimensions", 3)))


def is_section(summary: Mapping[str, Any]) -> bool:
    """Whether a summary is of a section (r, z), whose amounts cover more axes than it has."""
    return amount_dimension(summary) > int(summary.get("dimensions", 3))


def unit_in(unit: str, dimension: int) -> str:
    """Unit in a run of a dimension: amounts are per area in 1-D, per length in 2-D."""
    return EXTENSIVE[unit][dimension - 1] if unit in EXTENSIVE else unit
