"""Forcing of a surface that moves, beside the melt below it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries.surface_drives import SurfaceDrive, SurfaceWave
from lasersph.surface.flat_surface import ImposedTemperature


@dataclass(frozen=True)
class SurfaceForcing:
    """Temperature, pressure and mass flux that a case imposes on the surface, and vapor's recoil.

    Attributes:
        temperature: [K]. pressure: [Pa]. mass_flux: that leaves [kg/(m^2 s)].
        recoil: gauge recoil [Pa] of vapor at temperatures [K], any shape, where vapor leaves; what
            heat has evaporated then leaves the surface as well.
    """

    temperature: ImposedTemperature | None = None
    pressure: SurfaceDrive | None = None
    mass_flux: SurfaceWave | None = None
    recoil: Callable[[NDArray[np.float64]], NDArray[np.float64]] | None = None
