"""Reflectivity given in a case, instead of the material's: a number or a table over temperature."""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Discriminator, Field, Tag, model_validator

from lasersph.input import Fraction, Model, Temperature
from lasersph.materials import Material

Array = NDArray[np.float64]
Share = Annotated[Fraction, Field(ge=0, le=1)]
JUMP_WIDTH = 1e-3
"""Temperature below a jump over which the table for interpolation draws it [K]."""


class ReflectivityTable(Model):
    """R over the surface temperature, linear between rows, held beyond the first and last.

    Two rows at one temperature make a jump; at that temperature the second holds.
    """

    table: tuple[tuple[Temperature, Share], ...] = Field(
        min_length=2, description="rows of surface temperature and reflectivity"
    )

    @model_validator(mode="after")
    def _check_table(self) -> ReflectivityTable:
        T = np.array([row[0] for row in self.table])
        if np.any(np.diff(T) < 0.0) or np.any(T[2:] == T[:-2]):
            raise ValueError(
                "the temperatures of a reflectivity table must rise from row to row; two rows at "
                "one temperature make a jump, three are too many"
            )
        return self

    def nodes(self) -> tuple[Array, Array]:
        """Strictly rising temperatures [K] and reflectivities, a jump drawn over 1 mK below it."""
        T, R = np.array(self.table, float).T
        # interpolation needs rising nodes: a jump is a steep line
        T[:-1][np.diff(T) == 0.0] -= JUMP_WIDTH
        return T, R

    def at(self, temperature: ArrayLike) -> Array:
        """R at surface temperatures [K], any shape."""
        return np.interp(np.asarray(temperature, float), *self.nodes())


def _form(value: Any) -> str:
    return "table" if isinstance(value, dict | ReflectivityTable) else "number"


Reflectivity = Annotated[
    Annotated[Share, Tag("number")] | Annotated[ReflectivityTable, Tag("table")],
    Discriminator(_form),
]


def reflectivity_nodes(
    given: float | ReflectivityTable | None, material: Material, lower: float, upper: float
) -> tuple[Array, Array]:
    """Temperatures [K] and values of R for linear interpolation between lower and upper [K].

    Raises:
        ValueError: nothing is given and the material has no reflectivity.
    """
    # the case's own table or number goes before the material's
    if isinstance(given, ReflectivityTable):
        return given.nodes()
    if given is not None:
        return np.array([lower, upper]), np.array([given, given], float)
    if material.optics is None or material.optics.reflectivity is None:
        raise ValueError(
            f"material {material.name!r} has no reflectivity; "
            "write e.g. reflectivity = 0.9 in [laser]"
        )
    return material.table("reflectivity", lower, upper)
