"""Paths: where the axis of a moving beam is."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field, model_validator

from lasersph.input import Angle, Length, Model, Time, Velocity

Array = NDArray[np.float64]


class LinearPath(Model):
    """A straight path at constant speed, from `laser.position` at t = 0."""

    kind: Literal["linear"] = "linear"
    speed: Annotated[Velocity, Field(gt=0)]
    direction: Angle = Field(default=0.0, description="azimuth in the surface, from x towards y")

    def at(self, time: ArrayLike) -> Array:
        """Displacement from the start at times [s], shape (2, ...) [m]."""
        distance = self.speed * np.asarray(time, float)
        return np.stack([distance * np.cos(self.direction), distance * np.sin(self.direction)])

    def breakpoints(self) -> Array:
        """Times of corners [s]: none."""
        return np.empty(0)


class TabulatedPath(Model):
    """Rows of time, x and y; straight between them, at rest before the first and after the last."""

    kind: Literal["tabulated"] = "tabulated"
    table: tuple[tuple[Time, Length, Length], ...] = Field(
        min_length=2, description="rows of time, x and y"
    )

    @model_validator(mode="after")
    def _check_table(self) -> TabulatedPath:
        if np.any(np.diff([row[0] for row in self.table]) <= 0.0):
            raise ValueError("the times of a path must rise from row to row; a beam cannot jump")
        return self

    def at(self, time: ArrayLike) -> Array:
        """Position at times [s], shape (2, ...) [m]."""
        t, x, y = np.array(self.table, float).T
        time = np.asarray(time, float)
        return np.stack([np.interp(time, t, x), np.interp(time, t, y)])

    def breakpoints(self) -> Array:
        """Times of corners [s]."""
        return np.array([row[0] for row in self.table])


Path = Annotated[LinearPath | TabulatedPath, Field(discriminator="kind")]
