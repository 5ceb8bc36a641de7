"""Laser heat source: what each particle absorbs in a step.

    E_i = (1 - R(T_s)) F A_i s_i

F is the energy per area that falls in the step on the column of the particle (exact in time, exact
cell means over the column), A_i its lateral cross-section, s_i the exact share of the absorbed
light that stays in its depth cell [Demuth2020, eq. (8)], T_s the temperature of the surface over
it at the new time [Demuth2020, eq. (78)].
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.compute.backend import Backend
from lasersph.compute.vectors import interpolate
from lasersph.lasers import Laser
from lasersph.materials import Material
from lasersph.particles.filling import Filling

COLDEST, HOTTEST = 1.0, 2.0e4
"""Range of surface temperatures of the reflectivity table [K]."""
SMALLEST_SHARE = 1e-30


def admitted(F, T_s, R_T, R_R):
    """Light that enters the column below a surface particle [J/m^(d-1)]: (1 - R(T_s)) F.

    Args:
        T_s: surface temperature [K]. R_T, R_R: table of R(T).
    """
    return (1.0 - interpolate(T_s, R_T, R_R)) * F


def absorbed(area_share, above, columns):
    """Energy absorbed by a particle [J]: A_i s_i times the light that enters its column."""
    return area_share * columns[above]


class Irradiation:
    """The laser on the particles of a filling.

    Attributes:
        energy: (n,) absorbed in the step [J]. incident: what falls on the surface [J].
    """

    def __init__(
        self, backend: Backend, laser: Laser | None, material: Material, filling: Filling
    ) -> None:
        self.backend, self.laser = backend, laser
        count = filling.count
        self.energy = backend.zeros(count)
        self.incident = 0.0
        if laser is None:
            return
        width = filling.width[:, :count]
        depth = -filling.position[-1, :count]
        half = 0.5 * width[-1]
        alpha = laser.absorption_coefficient(material)
        share = laser.absorption.deposited(
            np.maximum(depth - half, 0.0), depth + half, alpha if np.isfinite(alpha) else None
        )
        area = np.prod(width[:-1], axis=0)
        lit = share > SMALLEST_SHARE
        self.above = backend.asarray(filling.above, "index")
        self.area_share = backend.asarray(np.where(lit, area * share, 0.0))
        surface = filling.surface
        position, size = filling.position[:-1, surface], width[:-1, surface]
        self.lower, self.upper = position - 0.5 * size, position + 0.5 * size
        self.surface_area = area[surface]
        table = laser.reflectivity_table(material, COLDEST, HOTTEST)
        self.R_T, self.R_R = (backend.asarray(values) for values in table)
        self.fluence = backend.zeros(surface.size)
        self.columns = backend.zeros(surface.size)

    def shine(self, start: float, end: float) -> None:
        """Fix the light of the step from `start` to `end` [s]; `incident` is its energy [J]."""
        self.incident = 0.0
        if self.laser is None:
            return
        density = self.laser.energy_density(self.lower, self.upper, start, end)
        self.incident = float(np.sum(density * self.surface_area))
        self.backend.copy(self.backend.asarray(density), self.fluence)

    def absorb(self, temperature: Any) -> float:
        """Set `energy` [J] from the temperatures of the surface [K]; returns their sum [J].

        Args:
            temperature: (n,); the first ones are those of the surface, the others are not read.
        """
        backend = self.backend
        if self.incident == 0.0:
            backend.fill(self.energy, 0.0)
            return 0.0
        T_s = backend.head(temperature, self.columns.shape[0])
        fields = {"F": self.fluence, "T_s": T_s}
        backend.pointwise(admitted, fields, self.columns, R_T=self.R_T, R_R=self.R_R)
        fields = {"area_share": self.area_share, "above": self.above}
        return backend.pointwise(
            absorbed, fields, self.energy, reduce=("sum",), columns=self.columns
        )[0]
