"""Paths: where the axis of a moving beam is, and the integral of its light over time.

That is a Gauss-Legendre rule on panels in which the beam moves a fraction of its size, its weights
scaled to the pulse's exact energy in each panel: the total over a surface that catches the whole
beam is right to rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Annotated, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field, model_validator

from lasersph.input import Angle, Length, Model, Time, Velocity
from lasersph.lasers.pulses import Pulse

Array = NDArray[np.float64]
Axis = Callable[[Array | float], Array]
"""Position of the beam's axis at times [s], shape (2, ...) [m]."""
ROUNDING = 1e-12
"""Cosine of a right angle. Rounding: some thousand times that of an angle in radians."""
PANEL_NODES, PANEL_WEIGHTS = np.polynomial.legendre.leggauss(6)


class LinearPath(Model):
    """A straight path at constant speed, from `laser.position` at t = 0."""

    kind: Literal["linear"] = "linear"
    speed: Annotated[Velocity, Field(gt=0)] = Field(description="of the beam over the surface")
    direction: Angle = Field(default=0.0, description="azimuth in the surface, from x towards y")

    def at(self, time: ArrayLike) -> Array:
        """Displacement from the start at times [s], shape (2, ...) [m]."""
        distance = self.speed * np.asarray(time, float)
        return np.stack([distance * np.cos(self.direction), distance * np.sin(self.direction)])

    def leaves(self, axis: int) -> bool:
        """Whether the beam leaves the plane x = 0 (axis 0) or y = 0 (axis 1)."""
        across = (np.cos(self.direction), np.sin(self.direction))[axis]
        return bool(abs(across) > ROUNDING)

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

    def leaves(self, axis: int) -> bool:
        """Whether the beam leaves the plane x = 0 (axis 0) or y = 0 (axis 1)."""
        return any(row[1 + axis] != 0.0 for row in self.table)

    def breakpoints(self) -> Array:
        """Times of corners [s]."""
        return np.array([row[0] for row in self.table])


Path = Annotated[LinearPath | TabulatedPath, Field(discriminator="kind")]


def path_quadrature(
    pulse: Pulse, axis: Axis, corners: Array, scale: float, t0: float, t1: float
) -> tuple[Array, Array]:
    """Times and shares of a pulse's energy that stand for the motion from t0 to t1 [s].

    Args:
        corners: times at which the path turns [s]. scale: size of the beam [m].
    """
    # Gauss-Legendre nodes of all panels, weighted by the power there
    start, end = _panels(pulse, axis, corners, scale, t0, t1)
    half = 0.5 * (end - start)[:, None]
    times = start[:, None] + half * (PANEL_NODES + 1.0)
    tiny = 1e-6 * half
    power = np.maximum(pulse.delivered(times - tiny, times + tiny), 0.0) * PANEL_WEIGHTS
    sums = power.sum(axis=1, keepdims=True)
    # scaled to the exact energy of each panel; even where no node meets light
    even = np.broadcast_to(0.5 * PANEL_WEIGHTS, power.shape)
    weights = np.divide(power, sums, out=even.copy(), where=sums > 0.0)
    shares = weights * pulse.delivered(start, end)[:, None]
    return times.ravel(), shares.ravel()


def _panels(
    pulse: Pulse, axis: Axis, corners: Array, scale: float, t0: float, t1: float
) -> tuple[Array, Array]:
    """Starts and ends of panels between breakpoints, short against pulse and beam size."""
    # no panel crosses a jump of the power or a corner of the path
    marks = np.concatenate([pulse.breakpoints(t0, t1), corners])
    edges = np.unique(np.concatenate([[t0, t1], marks[(marks > t0) & (marks < t1)]]))
    cuts = [np.empty((2, 0))]
    for a, b in pairwise(edges):
        if float(pulse.delivered(a, b)) > 0.0:
            # the beam moves at most half its size in a panel, and the pulse changes little
            distance = float(np.linalg.norm(axis(b) - axis(a)))
            longest = max(2.0 * distance / scale, (b - a) / (20 * pulse.resolution))
            parts = np.linspace(a, b, max(1, int(np.ceil(longest))) + 1)
            cuts.append(np.array([parts[:-1], parts[1:]]))
    start, end = np.concatenate(cuts, axis=1)
    return start, end
