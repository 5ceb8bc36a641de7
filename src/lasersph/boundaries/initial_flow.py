"""Velocities that a flow in a box starts from: rest, Taylor-Green vortices, a table."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, ValidationInfo, model_validator

from lasersph.input import Length, Model, Velocity, refusal, with_rows_of_file

Array = NDArray[np.float64]
Box = tuple[tuple[float, float], ...]
COLUMNS = ("x", "z", "u", "w")


class RestingFlow(Model):
    """Nothing moves at the start."""

    kind: Literal["rest"] = "rest"

    def velocity(self, position: Array, box: Box) -> Array:
        """(d, n) velocity [m/s] at positions (d, n) [m]: zero."""
        return np.zeros_like(position)


class TaylorGreenFlow(Model):
    """Taylor-Green vortices, as many as fit into the box (`lasersph.analytic.taylor_green`).

    In 3-D those of [Taylor & Green 1937], of one size along all axes, k = 2 pi/period:

        u = U sin kx cos ky cos kz,    v = -U cos kx sin ky cos kz,    w = 0
    """

    kind: Literal["taylor-green"] = "taylor-green"
    speed: Annotated[Velocity, Field(gt=0)] = Field(description="the largest")
    period: Annotated[Length, Field(gt=0)] | None = Field(
        default=None, description="of the vortices along each axis; default: the width of the box"
    )

    def velocity(self, position: Array, box: Box) -> Array:
        """(d, n) velocity [m/s] at positions (d, n) [m] in a box ((x0, x1), ..., (z0, z1)) [m]."""
        from lasersph.analytic.taylor_green import TaylorGreen  # few cases start with them

        period = self.period or box[0][1] - box[0][0]
        if len(position) == 3:
            x, y, z = 2.0 * np.pi / period * position
            u, v = np.sin(x) * np.cos(y) * np.cos(z), -np.cos(x) * np.sin(y) * np.cos(z)
            return self.speed * np.stack([u, v, np.zeros_like(u)])
        return TaylorGreen(self.speed, period, viscosity=0.0).velocity(position)


class TabulatedFlow(Model):
    """Velocities from a table: linear between its places, the nearest one's outside them."""

    kind: Literal["table"] = "table"
    path: str = Field(
        default="", description="CSV file with columns x, z [m], u, w [m/s] and a headline"
    )
    rows: tuple[tuple[float, float, float, float], ...] = Field(
        default=(), description="the same as numbers, instead of a file; the file's are kept here"
    )

    @model_validator(mode="before")
    @classmethod
    def _fill(cls, data: Any, info: ValidationInfo) -> Any:
        """Rows from the file, which counts from the folder of the case file."""
        return with_rows_of_file(data, info, COLUMNS)

    @model_validator(mode="after")
    def _check_rows(self) -> TabulatedFlow:
        if not self.rows:
            raise refusal(("path", "missing; name a CSV file with columns x, z, u, w"))
        return self

    def velocity(self, position: Array, box: Box) -> Array:
        """(2, n) velocity [m/s] at positions (2, n) [m]; the box is not needed."""
        from scipy.interpolate import LinearNDInterpolator, NearestNDInterpolator

        # linear between the places of the table, the nearest one's value outside them
        table = np.array(self.rows)
        places, values = table[:, :2], table[:, 2:]
        nearest = NearestNDInterpolator(places, values)(position.T)
        # places on one line span no triangles
        if np.linalg.matrix_rank(places - places[0]) < 2:
            return nearest.T.copy()
        linear = LinearNDInterpolator(places, values)(position.T)
        return np.where(np.isnan(linear), nearest, linear).T.copy()


InitialFlow = Annotated[RestingFlow | TaylorGreenFlow | TabulatedFlow, Field(discriminator="kind")]
