"""Laser heat source: what each particle absorbs in a step.

    E_i = (1 - R(T_s)) F A_i s_i

F is the energy per area that falls in the step on the column of the particle (exact in time, exact
cell means over the column), A_i its lateral cross-section, s_i the exact share of the absorbed
light that stays in its depth cell [Demuth2020, eq. (8)], T_s the temperature of the surface over
it at the new time [Demuth2020, eq. (78)].

Particles that moved (2-D) stand in the column and at the depth where they are now; their shares no
longer add up to 1 exactly, so that all shares are scaled to the light that enters the columns.
"""

from __future__ import annotations

from math import exp
from typing import Any

import numpy as np

from lasersph.compute.backend import Backend
from lasersph.compute.vectors import dot, interpolate
from lasersph.irradiation.light import COLDEST, HOTTEST
from lasersph.lasers import Laser
from lasersph.materials import Material
from lasersph.particles.filling import Filling

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


def standing(x, moved, above, share, low, width, columns, half, alpha):
    """Column of a particle and its cross-section times its share of the light [m].

    Args:
        x: position [m]. moved: 1 where it counts. above, share: as they were on the lattice. low,
            width, columns: place and width of the columns [m], their number. half: half a cell [m].
    """
    if moved <= 0.0:
        return above, share
    place = int(max((dot(x, (1.0, 0.0)) - low) / width, 0.0))
    depth = -dot(x, (0.0, 1.0))
    top = max(depth - half, 0.0)
    kept = exp(-alpha * top) - exp(-alpha * max(depth + half, 0.0))
    return min(place, columns - 1), width * kept


def scaled(area_share, moved, factor):
    """Share of a particle that moved, scaled."""
    return area_share * factor if moved > 0.0 else area_share


def split(area_share, above, moved, columns):
    """Light that a particle takes: if it moved, if it did not [J]."""
    light = area_share * columns[above]
    return moved * light, (1.0 - moved) * light


class LayeredLight:
    """The laser on the particles of a filling, see `Light`.

    Attributes:
        deposit: (n,) absorbed in the step [J]. incident: what falls on the surface [J];
            transmitted: none, since the body is thick.
    """

    def __init__(
        self, backend: Backend, laser: Laser | None, material: Material, filling: Filling
    ) -> None:
        self.backend, self.laser = backend, laser
        count = filling.count
        self.deposit = backend.zeros(count)
        self.incident = self.transmitted = 0.0
        self.alpha: float | None = None
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
        self._above = backend.asarray(filling.above, "index")
        self._area_share = backend.asarray(np.where(lit, area * share, 0.0))
        is_deep = np.isfinite(alpha) and laser.absorption.kind == "beer-lambert"
        self.alpha = float(alpha) if is_deep else None
        self.finest = float(width[-1, filling.surface[0]])
        surface = filling.surface
        position, size = filling.position[:-1, surface], width[:-1, surface]
        self.lower, self.upper = position - 0.5 * size, position + 0.5 * size
        self.surface_area = area[surface]
        table = laser.reflectivity_table(material, COLDEST, HOTTEST)
        self.R_T, self.R_R = (backend.asarray(values) for values in table)
        self.fluence = backend.zeros(surface.size)
        self.columns = backend.zeros(surface.size)

    def follow(self, position: Any, moved: Any, temperature: Any) -> None:
        """Let the light that `shine` fixed meet particles where they are now.

        Light absorbed at the surface itself stays as it is.

        Args:
            position: (2, n) [m]. moved: (n,) 1 where it counts. temperature: (n,) [K].
        """
        if self.incident == 0.0 or self.alpha is None:
            return
        backend = self.backend
        self._admit(temperature)
        fields = {
            "x": position, "moved": moved, "above": self._above, "share": self._area_share,
        }  # fmt: skip
        width = float(self.surface_area[0])
        backend.pointwise(
            standing, fields, (self.above, self.area_share), low=float(self.lower[0, 0]),
            width=width, columns=self.surface_area.size, half=0.5 * self.finest,
            alpha=self.alpha,
        )  # fmt: skip
        before = {"area_share": self._area_share, "above": self._above, "moved": moved}
        now = {"area_share": self.area_share, "above": self.above, "moved": moved}
        wanted, found = (
            backend.pointwise(
                split, which, (None, None), reduce=("sum", "sum"), columns=self.columns
            )[0]
            for which in (before, now)
        )
        if found > 0.0:
            fields = {"area_share": self.area_share, "moved": moved}
            backend.pointwise(scaled, fields, self.area_share, factor=wanted / found)

    def shine(self, start: float, end: float) -> None:
        """Fix the light of the step from `start` to `end` [s]; `incident` is its energy [J]."""
        self.incident = 0.0
        if self.laser is None:
            return
        density = self.laser.energy_density(self.lower, self.upper, start, end)
        self.incident = float(np.sum(density * self.surface_area))
        self.backend.copy(self.backend.asarray(density), self.fluence)

    def absorb(self, temperature: Any) -> float:
        """Set `deposit` [J] from the temperatures of the surface [K]; returns their sum [J].

        Args:
            temperature: (n,); the first ones are those of the surface, the others are not read.
        """
        backend = self.backend
        if self.incident == 0.0:
            backend.fill(self.deposit, 0.0)
            return 0.0
        self._admit(temperature)
        fields = {"area_share": self.area_share, "above": self.above}
        return backend.pointwise(
            absorbed, fields, self.deposit, reduce=("sum",), columns=self.columns
        )[0]

    def _admit(self, temperature: Any) -> None:
        """Light that enters each column, at the temperatures of the surface."""
        T_s = self.backend.head(temperature, self.columns.shape[0])
        fields = {"F": self.fluence, "T_s": T_s}
        self.backend.pointwise(admitted, fields, self.columns, R_T=self.R_T, R_R=self.R_R)
