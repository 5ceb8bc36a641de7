"""Numbers of the melt that flows."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lasersph.materials.viscosity import ViscosityTable


@dataclass(frozen=True)
class Liquid:
    """Numbers of the melt: nu at the liquidus [m^2/s], temperatures [K] and nu there over that,
    rho [kg/m^3], beta [1/K], T_l [K], g [m/s^2], thermal diffusivity [m^2/s], surface tension [N/m]
    (0 where it is not known)."""

    viscosity: float
    relative_viscosity: ViscosityTable
    density: float
    expansion: float
    reference_temperature: float
    gravity: float
    diffusivity: float
    surface_tension: float

    @cached_property
    def largest_viscosity(self) -> float:
        """nu of the melt where it is most viscous [m^2/s]."""
        return self.viscosity * float(np.max(self.relative_viscosity[1]))
