"""The table of fields: what a particle carries, with symbol, unit and shape.

Loops load arguments by symbol; files and figures take unit and shape from here.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Field:
    """One quantity of a particle.

    Attributes:
        symbol: name in pair and pointwise functions. unit: SI; "m^d" is a volume in d dimensions.
    """

    name: str
    symbol: str
    unit: str
    shape: Literal["scalar", "vector"] = "scalar"


FIELDS = {
    field.name: field
    for field in (
        Field("position", "x", "m", "vector"),
        Field("width", "w", "m", "vector"),
        Field("volume", "V", "m^d"),
        Field("mass", "m", "kg"),
        Field("support", "l", "m"),
        Field("layer", "layer", "1"),
        Field("normal_weight", "normal_weight", "1"),
        Field("lateral_weight", "lateral_weight", "1"),
        Field("enthalpy", "h", "J/kg"),
        Field("temperature", "T", "K"),
        Field("potential", "P", "W/m"),
        Field("conductivity", "k", "W/(m K)"),
        Field("melt_fraction", "f_m", "1"),
        Field("vapor_fraction", "f_v", "1"),
        Field("deposit", "E", "J"),
    )
}
