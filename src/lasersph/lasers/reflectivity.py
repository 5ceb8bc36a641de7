"""Reflectivity R or absorptivity A = 1 - R given in a case, instead of the material's.

Both are a number or a table over the temperature of the surface. A is also a table over time, as it
is measured: a step then takes the mean of A over its time, weighted with the power of the light.
"""

from __future__ import annotations

from typing import Annotated, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Discriminator, Field, Tag, ValidationInfo, model_validator

from lasersph.input import Fraction, Model, Temperature, Time, refusal, with_rows_of_file
from lasersph.lasers.path import path_quadrature
from lasersph.lasers.pulses import Pulse
from lasersph.materials import Material

Array = NDArray[np.float64]
Share = Annotated[Fraction, Field(ge=0, le=1)]
COLUMNS = ("t", "absorptivity")
"""Columns of a file of absorptivities."""
JUMP_WIDTH = 1e-3
"""Temperature below a jump over which the table for interpolation draws it [K]."""


class ReflectivityTable(Model):
    """R over the surface temperature, linear between rows, held beyond the first and last.

    Two rows at one temperature make a jump; at that temperature the second holds.
    """

    table: tuple[tuple[Temperature, Share], ...] = Field(
        min_length=2,
        description="rows of surface temperature and reflectivity",
        examples=[[["300 K", 0.7], ["1700 K", 0.6]]],
    )

    @model_validator(mode="after")
    def _check_table(self) -> ReflectivityTable:
        T = np.array([row[0] for row in self.table])
        if np.any(np.diff(T) < 0.0) or np.any(T[2:] == T[:-2]):
            raise ValueError(
                "the temperatures of the table must rise from row to row; two rows at one "
                "temperature make a jump, three are too many"
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


class AbsorptivityTable(Model):
    """A over the surface temperature, or over the time of the run.

    Linear between rows, held beyond the first and last; two rows at one place make a jump. A over
    time, beside the power over time, gives an absorbed power that was measured.
    """

    table: tuple[tuple[Temperature, Share], ...] = Field(
        default=(), description="rows of surface temperature and absorptivity"
    )
    over_time: tuple[tuple[Time, Share], ...] = Field(
        default=(),
        description="instead: rows of time and absorptivity; those of the file are kept here",
    )
    path: str = Field(
        default="",
        description="instead: CSV file with columns t [s] and absorptivity and a headline",
    )

    @model_validator(mode="before")
    @classmethod
    def _fill(cls, data: Any, info: ValidationInfo) -> Any:
        """Rows from the file, which counts from the folder of the case file."""
        largest = {"absorptivity": 1.0}
        return with_rows_of_file(data, info, COLUMNS, key="over_time", largest=largest)

    @model_validator(mode="after")
    def _check_rows(self) -> AbsorptivityTable:
        if self.table and self.over_time:
            raise refusal(("over_time", "contradicts table; leave one of them out"))
        key, rows = ("table", self.table) if self.table else ("over_time", self.over_time)
        if len(rows) < 2:
            raise refusal(
                (
                    key,
                    "needs two rows or more; give a table over temperature, over_time, or path of "
                    "a CSV file",
                )
            )
        # two rows at one place are a jump
        places = np.array([row[0] for row in rows])
        if np.any(np.diff(places) < 0.0) or np.any(places[2:] == places[:-2]):
            what = "temperatures" if self.table else "times"
            raise refusal(
                (
                    key,
                    f"has {what} that go back; they must rise from row to row, two rows at one "
                    "make a jump, three are too many",
                )
            )
        return self

    @property
    def law(self) -> ReflectivityTable | None:
        """R = 1 - A over the surface temperature; None over time."""
        rows = tuple((T, 1.0 - A) for T, A in self.table)
        return ReflectivityTable(table=rows) if rows else None

    @property
    def times(self) -> Array:
        """Times of the rows [s]."""
        return np.array([row[0] for row in self.over_time])

    @property
    def values(self) -> Array:
        """Absorptivities of the rows."""
        return np.array([row[1] for row in self.over_time])

    def mean(self, pulse: Pulse, interval: tuple[float, float] | None = None) -> float:
        """A of the light that comes in an interval of time [s]; by default in the first pulse."""
        start, end = pulse.support if interval is None else interval
        # nodes of Gauss and Legendre between the rows, weighted with the power there
        times, shares = path_quadrature(
            pulse, lambda time: np.zeros(2), self.times, np.inf, start, end
        )
        if not shares.sum() > 0.0:
            return float(np.interp(start, self.times, self.values))
        return float(shares @ np.interp(times, self.times, self.values) / shares.sum())


NUMBER, TABLE = "a number", "a table"
"""Names of both forms, which no key can have: they stand in the place of an error."""


def _form(value: Any) -> str:
    is_table = isinstance(value, dict | ReflectivityTable | AbsorptivityTable)
    return TABLE if is_table else NUMBER


Reflectivity = Annotated[
    Annotated[Share, Tag(NUMBER)] | Annotated[ReflectivityTable, Tag(TABLE)],
    Discriminator(_form),
]
Absorptivity = Annotated[
    Annotated[Share, Tag(NUMBER)] | Annotated[AbsorptivityTable, Tag(TABLE)],
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
