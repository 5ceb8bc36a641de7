"""Numbers of a sweep as maps, sensitivities and calibration read them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lasersph.input.key_units import unit_of
from lasersph.studies.emulator import Box, box_of
from lasersph.sweeps import Table

Array = NDArray[np.float64]


def box_of_runs(points: Array) -> Box:
    """The box around runs (n, keys); a key counts logarithmically where the runs lie so: where the
    median is nearer to the geometric than to the arithmetic middle of its range.

    Raises:
        ValueError: a key has the same value in all runs.
    """
    low, high, middle = points.min(axis=0), points.max(axis=0), np.median(points, axis=0)
    # a median near the geometric middle: the key was spread evenly in its logarithm
    positive = low > 0.0
    geometric = np.sqrt(np.where(positive, low, 0.0) * high)
    bent = positive & (np.abs(middle - geometric) < np.abs(middle - 0.5 * (low + high)))
    return box_of(low, high, bent)


def numbers_of(table: Table, name: str) -> Array:
    """A number of each run (runs,); NaN where a run does not have it."""
    return np.array([row.numbers.get(name, np.nan) for row in table.rows])


def sizes_of(table: Table, column: str) -> Array:
    """A number of each run (runs,), NaN without a result; a size that a complete run does not give,
    because nothing melts, boils or is ablated, is zero. Raises KeyError."""
    values = table.values(column)
    is_size = unit_of(column) in ("m", "m^2", "m^3")
    return np.where(np.isnan(values) & table.is_complete & is_size, 0.0, values)


def numerical_deviation(table: Table, column: str) -> float:
    """Largest standard deviation that a size has because it is counted in cells; 0 for others."""
    found = numbers_of(table, f"numerical_sd.{column}")
    return float(np.nanmax(found, initial=0.0))
