"""One plane wave of several that interfere: its direction and its electric field."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from lasersph.input import Angle, Model

Array = NDArray[np.float64]
Polarization = Literal["s", "p"] | Angle


class Wave(Model):
    """One plane wave that falls onto the surface.

    Its electric field points along the direction of azimuth `polarization` in the surface plane,
    made perpendicular to the wave; "s" is perpendicular to the plane of incidence and "p" lies in
    it, with the sign that makes two opposite waves of small angle parallel. Left out for all waves,
    the fields are taken as parallel (E_j.E_l = |E_j| |E_l|), which is what s-polarized waves in one
    plane of incidence do.
    """

    polar: Annotated[Angle, Field(ge=0, lt=np.pi / 2)] = Field(
        description="angle between the wave and the surface normal"
    )
    azimuth: Angle = Field(default=0.0, description="direction along the surface, from x towards y")
    amplitude: float = Field(default=1.0, gt=0, description="of the electric field, relative")
    phase: Angle = Field(default=0.0, description="at the origin")
    polarization: Polarization | None = Field(
        default=None, description="azimuth of the electric field, or to the plane of incidence"
    )

    def direction(self) -> Array:
        """Unit vector of propagation, shape (3,), z upward."""
        sin = np.sin(self.polar)
        x, y = sin * np.cos(self.azimuth), sin * np.sin(self.azimuth)
        return np.array([x, y, -np.cos(self.polar)])

    def field(self) -> Array:
        """Electric field, shape (3,); along a fixed direction where no polarization is given."""
        if self.polarization is None:
            return np.array([0.0, 0.0, self.amplitude])
        azimuth, across = self.polarization, self.direction()
        if isinstance(azimuth, str):  # of the half plane of azimuths from 0 to 180 deg
            azimuth = self.azimuth % np.pi + (0.5 * np.pi if azimuth == "s" else 0.0)
        # the part of the direction that is perpendicular to the wave, of length 1
        along = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
        across = along - (along @ across) * across
        return self.amplitude * across / np.linalg.norm(across)
