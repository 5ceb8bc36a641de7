"""`LayeredLight`: light that a body below a flat surface absorbs layer by layer.

    E_i = (1 - R(T_s)) F A_i s_i

F is the energy per area that falls in the step on the column of the particle (exact in time, exact
cell means over the column), A_i its lateral cross-section, s_i the exact share of the absorbed
light that stays in its depth cell [Demuth2020, eq. (8)], T_s the temperature of the surface over
it at the new time [Demuth2020, eq. (78)].

Particles that moved (2-D) stand in the column and at the depth where they are now. Their shares no
longer add up to 1 exactly: all are scaled to what the same particles took on the lattice, and
`rescaled` is the energy that this has added.
"""

from __future__ import annotations

from math import exp

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import interpolate
from lasersph.irradiation.light import COLDEST, HOTTEST
from lasersph.lasers import Laser
from lasersph.materials import Material
from lasersph.particles.filling import Filling

SMALLEST_SHARE = 1e-30
"""Share of the light below which a particle is dark; products with smaller ones are not normal."""


def enter_column(F, T_s, R_T, R_R):
    """Light that enters the column below a surface particle [J/m^(d-1)]: (1 - R(T_s)) F.

    Args:
        T_s: surface temperature [K]. R_T, R_R: table of R(T).
    """
    return (1.0 - interpolate(T_s, R_T, R_R)) * F


def absorb_light(share, column, columns):
    """Energy absorbed by a particle [J]: A_i s_i times the light that enters its column."""
    return share * columns[column]


def absorb_moving(share, column, moved, columns):
    """The same of a particle that moved, else 0 [J]."""
    return moved * (share * columns[column])


def locate(x, depth, moved, above, share, low, width, columns, half, alpha):
    """Column of a particle and its cross-section times its share of the light [m].

    Args:
        x: position [m]. depth: below the surface [m]. moved: 1 where it counts. above, share: as
            they were on the lattice. low, width, columns: place and width of the columns [m],
            their number. half: half a cell [m].
    """
    if moved <= 0.0:
        return above, share
    place = int(max((x[0] - low) / width, 0.0))
    top = max(depth - half, 0.0)
    left = exp(-alpha * top) - exp(-alpha * max(depth + half, 0.0))
    return min(place, columns - 1), width * left


def rescale(share, moved, factor):
    """Share of a particle that moved, scaled."""
    return share * factor if moved > 0.0 else share


class LayeredLight:
    """The laser on the particles of a filling, see `Light`.

    Attributes:
        deposit: (n,) absorbed in the step [J]. incident: what falls on the surface [J];
            transmitted: none, since the body is thick. rescaled: what the scaling has added [J].
    """

    def __init__(
        self, backend: Backend, laser: Laser | None, material: Material, filling: Filling
    ) -> None:
        self.backend, self.laser = backend, laser
        count = filling.count
        self.deposit = backend.zeros(count)
        self.incident = self.transmitted = self.rescaled = 0.0
        if laser is None:
            return
        width, surface = filling.width[:, :count], filling.surface
        depth, half = filling.depth[:count], 0.5 * width[-1]
        # shares of the particles where they lie on the lattice
        alpha = laser.absorption_coefficient(material)
        is_deep = np.isfinite(alpha) and laser.absorption.kind == "beer-lambert"
        self.alpha = float(alpha) if is_deep else None
        share = laser.absorption.deposited(
            np.maximum(depth - half, 0.0), depth + half, alpha if np.isfinite(alpha) else None
        )
        area = np.prod(width[:-1], axis=0)
        share = np.where(share > SMALLEST_SHARE, area * share, 0.0)
        self._lattice, self._now = (
            {"column": backend.asarray(filling.above, "index"), "share": backend.asarray(share)}
            for _ in range(2)
        )
        # columns below the surface particles, and the light that enters them
        position, size = filling.position[:-1, surface], width[:-1, surface]
        self.lower, self.upper = position - 0.5 * size, position + 0.5 * size
        self.surface_area = area[surface]
        table = laser.reflectivity_table(material, COLDEST, HOTTEST)
        self._reflectivity = dict(zip(("R_T", "R_R"), map(backend.asarray, table), strict=True))
        self.fluence, self.columns = backend.zeros(surface.size), backend.zeros(surface.size)
        self._place = {"columns": surface.size, "half": 0.5 * float(width[-1, surface[0]])}
        if len(self.lower):
            self._place |= {"low": float(self.lower[0, 0]), "width": float(self.surface_area[0])}

    def shine(self, start: float, end: float) -> None:
        """Fix the light of the step from `start` to `end` [s]; `incident` is its energy [J]."""
        self.incident = self.rescaled = 0.0
        if self.laser is None:
            return
        density = self.laser.energy_density(self.lower, self.upper, start, end)
        self.incident = float(np.sum(density * self.surface_area))
        self.backend.copy(self.backend.asarray(density), self.fluence)

    def follow(self, position: Array, depth: Array, moved: Array, temperature: Array) -> None:
        """Let the light that `shine` fixed meet particles where they are now (2-D).

        Light absorbed at the surface itself stays as it is.

        Args:
            position: (2, n) [m]. depth: (n,) below the surface [m]. moved: (n,) 1 where it counts.
            temperature: (n,) [K].
        """
        if self.incident == 0.0 or self.alpha is None:
            return
        backend = self.backend
        self._enter(temperature)
        lattice, now, where = self._lattice, self._now, {"moved": moved}
        fields = {"x": position, "depth": depth, "above": lattice["column"], **where}
        fields["share"] = lattice["share"]
        out = (now["column"], now["share"])
        backend.pointwise(locate, fields, out, alpha=self.alpha, **self._place)
        # scale to what the particles that moved took on the lattice
        wanted, found = (
            backend.pointwise(
                absorb_moving, shares | where, (None,), reduce=("sum",), columns=self.columns
            )[0]
            for shares in (lattice, now)
        )
        if found > 0.0:
            factor = wanted / found
            backend.pointwise(rescale, now | where, now["share"], factor=factor)
            self.rescaled = wanted - found

    def absorb(self, temperature: Array) -> float:
        """Set `deposit` [J] from the temperatures of the surface [K]; returns their sum [J].

        Args:
            temperature: (n,); the first ones are those of the surface, the others are not read.
        """
        if self.incident == 0.0:
            self.backend.fill(self.deposit, 0.0)
            return 0.0
        self._enter(temperature)
        return self.backend.pointwise(
            absorb_light, self._now, self.deposit, reduce=("sum",), columns=self.columns
        )[0]

    def _enter(self, temperature: Array) -> None:
        """Light that enters each column, at the temperatures of the surface."""
        T_s = self.backend.head(temperature, self.columns.shape[0])
        fields = {"F": self.fluence, "T_s": T_s}
        self.backend.pointwise(enter_column, fields, self.columns, **self._reflectivity)
