"""Waves and bumps that a case imposes on a surface for a time.

wave     amplitude cos(2 pi x / period), in 3-D times cos(2 pi y / period_y) where that is given
bump     amplitude exp(-r^2 / radius^2), r the distance from x = y = 0, or from an axis
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from lasersph.input import (
    Length,
    MassFlux,
    Model,
    Pressure,
    TemperatureDifference,
    Time,
    refusal,
)

if TYPE_CHECKING:
    from lasersph.boundaries.surface_shapes import Bump, SurfaceShape, Wave

Array = NDArray[np.float64]


class SurfaceDrive(Model, ABC):
    """A quantity on the surface that varies along it, from `start` to `end`."""

    amplitude: float = Field(description="at x = 0")
    start: Annotated[Time, Field(ge=0)] = Field(default=0.0, description="when it sets in")
    end: Annotated[Time, Field(gt=0)] | None = Field(
        default=None, description="when it ends; default: never"
    )

    @model_validator(mode="after")
    def _check_times(self) -> SurfaceDrive:
        if self.end is not None and self.end <= self.start:
            raise refusal(("end", "is not after start; give a later end, or none"))
        return self

    @property
    @abstractmethod
    def shape(self) -> SurfaceShape:
        """How it varies along the surface while it acts."""

    def at(self, x: NDArray[np.floating], y: Array | float = 0.0) -> Array:
        """The quantity at x and y [m] while it acts, any shape."""
        return self.shape.at(np.asarray(x, float), y)

    @property
    def is_timed(self) -> bool:
        """Whether it sets in or ends in the run."""
        return (self.start, self.end) != (0.0, None)

    def share_of(self, begin: float, end: float) -> float:
        """Part of the time from `begin` to `end` [s] in which it acts; of an instant 0 or 1."""
        last = np.inf if self.end is None else self.end
        if end <= begin:
            return float(self.start <= begin < last)
        return max(min(end, last) - max(begin, self.start), 0.0) / (end - begin)

    def mean_over(self, places: Sequence[Array], begin: float, end: float) -> Array:
        """The quantity at places along x, and y where there is one [m], averaged over the time from
        `begin` to `end` [s]."""
        return self.share_of(begin, end) * self.at(*places)


class SurfaceWave(SurfaceDrive):
    """A quantity on the surface with amplitude cos(2 pi x / period), times cos(2 pi y / period_y),
    from `start` to `end`."""

    period: Annotated[Length, Field(gt=0)] = Field(description="wavelength along x")
    period_y: Annotated[Length, Field(gt=0)] | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="wavelength along y; 3-D; default: nothing varies along y",
    )

    @property
    def shape(self) -> Wave:
        """How it varies along the surface while it acts."""
        from lasersph.boundaries.surface_shapes import Wave  # few cases have one

        return Wave(self.amplitude, self.period, self.period_y)


class SurfaceBump(SurfaceDrive):
    """A quantity on the surface with amplitude exp(-r^2 / radius^2), from `start` to `end`."""

    radius: Annotated[Length, Field(gt=0)] = Field(description="where it has fallen to 1/e")

    @property
    def shape(self) -> Bump:
        """How it varies along the surface while it acts."""
        from lasersph.boundaries.surface_shapes import Bump  # few cases have one

        return Bump(self.amplitude, self.radius)


class TemperatureWave(SurfaceWave):
    """Variation of a given temperature of the surface."""

    amplitude: TemperatureDifference = Field(description="at x = 0")


class PressureWave(SurfaceWave):
    """A pressure on a surface that moves."""

    amplitude: Pressure = Field(description="at x = 0")


class MassFluxWave(SurfaceWave):
    """Mass that leaves a surface that moves, per its true area."""

    amplitude: MassFlux = Field(description="at x = 0")


class TemperatureBump(SurfaceBump):
    """Variation of a given temperature of the surface: amplitude exp(-r^2 / radius^2)."""

    amplitude: TemperatureDifference = Field(description="at r = 0")


class PressureBump(SurfaceBump):
    """A pressure on a surface that moves: amplitude exp(-r^2 / radius^2)."""

    amplitude: Pressure = Field(description="at r = 0")
