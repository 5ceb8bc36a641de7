"""`LayeredLight`: light that a body below a flat surface absorbs layer by layer.

    E_i = (1 - R(T_s)) F A_i s_i

F is the energy per area that falls in the step on the column of the particle (exact in time, exact
cell means over the column), A_i its lateral cross-section, s_i the exact share of the light that
stays in its depth cell [Demuth2020, eq. (8)], T_s the temperature of the surface over it at the new
time [Demuth2020, eq. (78)].

Particles that moved take the light by what lies above them now, see `absorbing_cells`; light
that the surface absorbs is taken by the particles at it now, each for its part of a column. T_s is
that of the particles at the surface now.
"""

from __future__ import annotations

from itertools import product
from math import exp, prod
from typing import Any

import numpy as np

from lasersph.compute.array_types import Array, Constants
from lasersph.compute.backend import Backend
from lasersph.compute.graph import graph
from lasersph.compute.vectors import interpolate
from lasersph.irradiation.absorbing_cells import (
    add,
    cell_at_corner,
    column_share,
    light_per_cover,
    optical_thickness,
    running_sum,
)
from lasersph.irradiation.light import COLDEST, HOTTEST
from lasersph.lasers import Laser
from lasersph.lasers.rings import ring_means
from lasersph.materials import Material
from lasersph.particles.filling import Filling
from lasersph.particles.neighbor_lists import members_of
from lasersph.surface.columns import SurfaceColumns

SMALLEST_SHARE = 1e-30
"""Share of the light below which a particle is dark. Format: products with smaller ones are not
normal numbers."""
OPAQUE = 37.0
"""Optical thickness below which levels of cells are dark. Rounding: exp(-37) is that of 1."""


def enter_column(F, T_s, area, R_T, R_R, beyond):
    """Light that enters the column below a cell of the surface [J/m^(d-1)], (1 - R(T_s)) F, what
    the cell reflects and what passes through the bottom of the column [J].

    Args:
        T_s: surface temperature [K]. area: of the cell [m^(d-1)]. R_T, R_R: table of R(T).
            beyond: share of the light that is left at the bottom.
    """
    R = interpolate(T_s, R_T, R_R)
    return (1.0 - R) * F, R * F * area, (1.0 - R) * F * area * beyond


def scale(V, factor):
    """A number times a factor."""
    return factor * V


def share_at_depth(x, V, column, area, width, tops, alpha):
    """A_i s_i of a particle that keeps its column [m^(d-1)], with the exact share of its cell (8).

    Args:
        width: of the particle across the column [m]. tops: table of the places of the columns'
            upper ends [m]. alpha: absorption coefficient [1/m].
    """
    depth, half = tops[column] - x[-1], 0.5 * V / width
    return area * (exp(-alpha * max(depth - half, 0.0)) - exp(-alpha * (depth + half)))


def absorb_light(share, column, columns):
    """Energy absorbed by a particle [J]: A_i s_i times the light that enters its column."""
    return share * columns[column]


def absorb_more(deposit, share, column, columns):
    """The same with that of one more column in which the particle stands [J]."""
    return deposit + share * columns[column]


class LayeredLight:
    """The laser on the particles of a filling, see `Light`.

    Attributes:
        deposit: (n,) absorbed in the step [J]. incident: what falls on the surface, reflected: what
            it throws back, transmitted: what passes through the bottom [J]. collisions: constants
            of the rate of collisions that `absorb` takes instead of temperatures; None for light
            that heat changes by the temperature alone.
    """

    collisions: dict[str, Any] | None = None

    def __init__(
        self, backend: Backend, laser: Laser | None, material: Material, filling: Filling
    ) -> None:
        self.backend, self.laser = backend, laser
        count = filling.count
        self.deposit = backend.zeros(count)
        self.incident = self.reflected = self.transmitted = 0.0
        self.alpha: float | None = None
        if laser is None:
            return
        width, surface = filling.width[:, :count], filling.surface
        depth, half = filling.depth[:count], 0.5 * width[-1]
        # shares of the particles where they lie on the lattice
        alpha = laser.absorption_coefficient(material)
        is_deep = np.isfinite(alpha) and laser.absorption.kind == "beer-lambert"
        self.alpha = float(alpha) if is_deep else None
        # A_i s_i, with the exact share of each depth cell (8)
        share = laser.absorption.deposited(
            np.maximum(depth - half, 0.0), depth + half, alpha if np.isfinite(alpha) else None
        )
        area = filling.cross_section
        share = np.where(share > SMALLEST_SHARE, area * share, 0.0)
        self._lattice = {
            "column": backend.asarray(filling.above, "index"),
            "share": backend.asarray(share),
        }
        # columns below the surface particles, and the light that enters them
        position, size = filling.position[:-1, surface], width[:-1, surface]
        self.lower, self.upper = position - 0.5 * size, position + 0.5 * size
        self.surface_area = area[surface]
        if filling.is_axisymmetric:
            self._means = ring_means(laser, self.lower[0], self.upper[0])
        else:
            self._means = laser.resting_means(self.lower, self.upper)
        self.material = material
        table = laser.reflectivity_table(material, COLDEST, HOTTEST)
        self._varies = bool(np.ptp(table[1]) > 0.0)
        R_T, R_R = map(backend.asarray, table)
        # light that passes the bottom of the lowest particle
        bottom = float(np.max(depth + half))
        beyond = 0.0 if self.alpha is None else exp(-self.alpha * bottom)
        self._entering: dict[str, Any] = {"R_T": R_T, "R_R": R_R, "beyond": beyond}
        self._area = backend.asarray(self.surface_area)
        self.fluence, self.columns = backend.zeros(surface.size), backend.zeros(surface.size)
        # temperatures of the surface are those of the first particles but for coarse columns
        self._fine_count, self._fine_surface = filling.fine_count, filling.fine_surface
        self._over = backend.asarray(surface, "index") if filling.beside is not None else None
        self._T_s = backend.zeros(surface.size)
        self._surface: SurfaceColumns | None = None
        self._in_columns: dict[str, Array] = {}
        self._cell = {"area": backend.asarray(area), "width": backend.asarray(width[0])}
        self._moving: list[dict[str, Array]] = []
        self._corners_of_column = tuple(product((0.0, 1.0), repeat=filling.position.shape[0] - 1))
        # only light that goes deep into what moves needs cells
        if filling.position.shape[0] > 1 and self.alpha is not None:
            self._lay_cells(width, half, self.alpha)

    def _lay_cells(self, width: np.ndarray, half: np.ndarray, alpha: float) -> None:
        """Cells for particles as large as those of the surface, which come first."""
        backend, columns = self.backend, self._fine_surface
        # coarse layers below keep the shares that they have on the lattice
        is_fine = np.all(np.isclose(width, width[:, :1], rtol=1e-9), axis=0)
        self._fine = is_fine.size if is_fine.all() else int(np.argmin(is_fine))
        sizes, size_z = tuple(map(float, width[:-1, 0])), 2.0 * float(half[0])

        # as many levels as there are fine layers, or as the light reaches
        levels = min(self._fine // columns, int(np.ceil(OPAQUE / (alpha * size_z))))
        low, high = self.lower[:, :columns].min(axis=1), self.upper[:, :columns].max(axis=1)
        counts = tuple(float(n) for n in np.round((high - low) / sizes))
        self._grid: Constants = {"columns": counts, "levels": float(levels)}
        self._grid |= {"low": tuple(map(float, low)), "inverse_height": 1.0 / size_z}
        self._grid |= {"inverse_width": tuple(1.0 / size for size in sizes)}
        self._levels, self._cells, self._tau_one = levels, columns * levels, alpha * size_z
        self._column_area, self._inverse_cell = prod(sizes), 1.0 / (prod(sizes) * size_z)
        self._numbers = backend.asarray(np.arange(self._cells), "index")
        self._size = backend.asarray(np.ones(self._fine))

    def shine(self, start: float, end: float) -> None:
        """Fix the light of the step from `start` to `end` [s]; `incident` is its energy [J]."""
        self.incident = self.reflected = self.transmitted = 0.0
        if self.laser is None:
            return
        density = self.laser.energy_density(self.lower, self.upper, start, end, self._means)
        # an absorptivity over time has one value in the step
        if self.laser.absorbs_over_time:
            span, R_R = (COLDEST, HOTTEST), self._entering["R_R"]
            _, R = self.laser.reflectivity_table(self.material, *span, (start, end))
            self.backend.copy(self.backend.asarray(R), R_R)
        self.incident = float(np.sum(density * self.surface_area))
        self.backend.copy(self.backend.asarray(density), self.fluence)

    def reset(self) -> None:
        """Let the light meet particles on their lattice, as at the start."""
        self._surface = None

    def follow_columns(self, position: Array, volume: Array, tops: Array) -> None:
        """Let the light meet particles that keep their columns, which have grown.

        Args:
            position: (2, n) [m]. volume: (n,) [m^2]. tops: (columns,) their upper ends [m].
        """
        if self.alpha is None:
            return
        column, share = self._lattice["column"], self.backend.zeros(volume.shape[0])
        fields = {"x": position, "V": volume, "column": column, **self._cell}
        self.backend.pointwise(share_at_depth, fields, share, tops=tops, alpha=self.alpha)
        self._in_columns = {"column": column, "share": share}

    def distribute(
        self,
        position: Array,
        depth: Array,
        surface: SurfaceColumns,
        volume: Array | None = None,
    ) -> None:
        """Let the light that `shine` fixed meet particles where they are now.

        Args:
            position: (d, n) [m]. depth: (n,) below the surface [m]. surface: the particles at it.
            volume: (n,) [m^d], where it changes.
        """
        self._surface = surface
        if self.incident == 0.0:
            return
        backend = self.backend
        if not self._moving:
            self._allocate_shares()
        if self.alpha is None:
            # surface absorption: the particles at the surface take all, each of its columns
            corners = surface.shares(float(self.surface_area[0]))
            for own, (column, share) in zip(self._moving, corners, strict=True):
                backend.fill(backend.head(own["share"], self._fine_count), 0.0)
                backend.scatter(share, surface.rows, own["share"])
                backend.scatter(column, surface.rows, own["column"])
            return
        # c_ik: cells of each particle, and how much of it lies in them
        self.find_cells(position, depth, volume)
        for (cell, _, _), members in zip(self._corners, self._members, strict=True):
            members_of(backend, cell, self._cells, into=members)
        self.find_shares()

    @graph
    def find_cells(self, position: Array, depth: Array, volume: Array | None) -> None:
        """Cell, column and cover of each particle, by the corners of its own cell."""
        backend, fine = self.backend, self._fine
        # evaporated particles are less high: their volume over that of a cell
        if volume is not None:
            fields = {"V": backend.head(volume, fine)}
            backend.pointwise(scale, fields, self._size, factor=self._inverse_cell)

        # a particle covers up to two cells along each axis
        fields = {"x": backend.head(position, fine), "depth": backend.head(depth, fine)}
        fields["size"] = self._size
        self._corners = []
        for upper, lower in product(self._corners_of_column, (0.0, 1.0)):
            cell, column = backend.zeros(fine, "index"), backend.zeros(fine, "index")
            cover = backend.zeros(fine)
            out, corner = (cell, column, cover), {"upper": upper, "lower": lower}
            backend.pointwise(cell_at_corner, fields, out, **corner, **self._grid)
            self._corners.append((cell, column, cover))

    @graph
    def find_shares(self) -> None:
        """Shares of the particles in their columns."""
        backend, cells = self.backend, self._cells
        fields = self._thickness()
        # s_k over the cover of the cells
        light = backend.zeros(cells + 1)
        out = backend.head(light, cells)
        backend.pointwise(light_per_cover, fields, out, tau_one=self._tau_one)
        self._share_cells(light)

    def _thickness(self) -> dict[str, Array]:
        """tau_k of the cells, and the sum of it and all above."""
        backend, cells = self.backend, self._cells
        tau, part = backend.zeros(cells + 1), backend.zeros(cells)
        inner, one = backend.head(tau, cells), self._tau_one
        for (_, _, cover), members in zip(self._corners, self._members, strict=True):
            backend.pair_sum(optical_thickness, members, {"cover": cover}, part, tau_one=one)
            backend.pointwise(add, {"a": inner, "b": part}, inner)
        return {"tau": inner, "total": self._sums_from_above(inner)}

    def _share_cells(self, light: Array) -> None:
        """Shares from the light of each cell over the cover in it."""
        backend, fine = self.backend, self._fine
        # s_ik: what a particle takes of each of its columns, upper and lower cell together
        pairs = zip(self._corners[::2], self._corners[1::2], strict=True)
        for own, (upper, lower) in zip(self._moving, pairs, strict=True):
            fields = {"upper": upper[0], "cover_upper": upper[2]}
            fields |= {"lower": lower[0], "cover_lower": lower[2]}
            out = backend.head(own["share"], fine)
            backend.pointwise(column_share, fields, out, area=self._column_area, light=light)
            backend.copy(upper[1], backend.head(own["column"], fine))

    def _allocate_shares(self) -> None:
        """Arrays of particles that have moved, the coarse ones as they are on the lattice."""
        backend = self.backend
        for _ in self._corners_of_column:
            column, share = self._lattice["column"], self._lattice["share"]
            own = {"column": backend.zeros(column.shape[0], "index")}
            own["share"] = backend.zeros(share.shape[0])
            self._moving.append(own)
        # those that are deep or beside keep what they have on the lattice
        for name, values in self._lattice.items():
            backend.copy(values, self._moving[0][name])
        if self.alpha is not None:
            key, corners = backend.zeros(self._fine, "index"), 2 * len(self._moving)
            self._members = [members_of(backend, key, self._cells) for _ in range(corners)]

    def _sums_from_above(self, tau: Array) -> Array:
        """For each cell the tau of it and all above it in its column [1]."""
        backend, distance = self.backend, 1
        total, other = backend.zeros(self._cells), backend.zeros(self._cells)
        backend.copy(tau, total)
        # running sum in log2(levels) passes, each adding the sum `distance` cells above
        while distance < self._levels:
            fields = {"k": self._numbers, "total": total}
            backend.pointwise(
                running_sum, fields, other, totals=total, distance=distance, levels=self._levels
            )
            total, other, distance = other, total, 2 * distance
        return total

    def _illuminate_columns(self, at_surface: Array, shares: dict[str, Array]) -> None:
        """Let the light enter the columns; reduces what is reflected and transmitted [J].

        Args:
            at_surface: T_s of each column [K]. shares: of the particles, see `take_light`.
        """
        fields = {"F": self.fluence, "area": self._area, "T_s": at_surface}
        out, reduce = (self.columns, None, None), (None, "sum", "sum")
        self.backend.pointwise(enter_column, fields, out, reduce=reduce, **self._entering)

    def absorb(self, temperature: Array) -> float:
        """Set `deposit`, `reflected` and `transmitted` [J] from the temperatures (n,) [K] of the
        particles at the surface; returns the sum of the deposits [J]."""
        if self.incident == 0.0:
            self.backend.fill(self.deposit, 0.0)
            return 0.0
        T_s, shares = temperature, self._in_columns or self._lattice
        if self._over is not None:
            T_s = self._T_s
            self.backend.gather(temperature, self._over, T_s)
        # R depends on T: the mean of the particles at the surface now
        if self._varies and self._surface is not None:
            mean = self._surface.mean(temperature)
            if self._over is None:
                T_s = mean
            else:
                self.backend.copy(mean, self.backend.head(T_s, self._fine_surface))
        if self._surface is not None and self._moving:
            own = enumerate(self._moving)
            shares = {f"{name}_{k}": values for k, one in own for name, values in one.items()}
        self.reflected, self.transmitted, absorbed = self.take_light(T_s, shares)
        return absorbed

    @graph
    def take_light(self, T_s: Array, shares: dict[str, Array]) -> None:
        """Light that enters the columns, and what the particles take of it.

        Args:
            shares: share and column of each particle; of several, by their numbers.

        Reduces what is reflected, transmitted and absorbed [J].
        """
        backend, table = self.backend, {"columns": self.columns}
        self._illuminate_columns(backend.head(T_s, self.columns.shape[0]), shares)
        if "share" in shares:
            backend.pointwise(absorb_light, shares, self.deposit, reduce=("sum",), **table)
            return
        # each particle takes its share of each of its columns; the last one sums up all
        last = len(shares) // 2 - 1
        for k in range(last + 1):
            fields = {name: shares[f"{name}_{k}"] for name in ("share", "column")}
            if k == 0:
                backend.pointwise(absorb_light, fields, self.deposit, **table)
                continue
            fields |= {"deposit": self.deposit}
            reduce = ("sum",) if k == last else (None,)
            backend.pointwise(absorb_more, fields, self.deposit, reduce=reduce, **table)
