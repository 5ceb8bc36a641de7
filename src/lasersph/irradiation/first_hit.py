"""`FirstHitLight`: light falls down columns of one spacing onto the particles that it meets first.

`columns` says who takes what. Which particles are hit is found when particles have moved or left
(`find_hit`), the light of a step in each step (`shine`), what of it they absorb from their
temperatures (`absorb`). All light of a column is absorbed, reflected or, where the column is empty,
transmitted; no sum is scaled.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

import numpy as np

from lasersph.compute.array_types import Array, Constants, Rows
from lasersph.compute.backend import Backend
from lasersph.irradiation.columns import (
    NOWHERE,
    absorbed_light,
    add,
    add_heat,
    add_light,
    column_along,
    column_at_corner,
    cover_of_uppermost,
    excess_for_column,
    heights,
    larger,
    mark_hit,
    share_of,
    top_of,
)
from lasersph.irradiation.light import COLDEST, HOTTEST
from lasersph.lasers import Laser
from lasersph.materials import Material
from lasersph.particles.kinds import GONE
from lasersph.particles.neighbor_lists import NeighborList, members_of
from lasersph.surface.surface import upward

BAND = 0.5
"""Depth over the spacing down to which particles of a column are uppermost. Geometry: particles of
one layer share the light of a column, those of the next do not."""


class Corner(NamedTuple):
    """One corner of the square of each particle.

    Attributes:
        column: (n,) number of the column there. cover: (n,) share of it that the particle covers.
            members: the particles of each column.
    """

    column: Array
    cover: Array
    members: NeighborList


class FirstHitLight:
    """Columns over the surface, and the light in them, see `Light`.

    Args:
        bounds: lower and upper bound along x (and y) [m], empty in 1-D. periodic: which of these
            axes are. deposit: (N,) what each particle absorbs in a step [J], kept up to date.

    Attributes:
        center: (dim - 1, columns) [m]. width: along each axis [m]. up: against the beam, a unit
            vector. hit: the particles that are hit, kind "index".
    """

    hit: Rows

    def __init__(
        self,
        backend: Backend,
        laser: Laser,
        material: Material,
        bounds: Sequence[tuple[float, float]],
        spacing: float,
        periodic: Sequence[bool],
        deposit: Array,
    ) -> None:
        self.backend, self.laser, self.spacing = backend, laser, spacing
        self.dimension, self.deposit = len(bounds) + 1, deposit
        self.incident = self.transmitted = self.reflected = 0.0
        # the columns: as many as fit, so that their width is the spacing or close to it
        low, high = np.array(bounds, dtype=float).reshape(-1, 2).T
        counts = [max(1, round(extent / spacing)) for extent in high - low]
        shape, wraps = (*counts, 1, 1), (*(float(one) for one in periodic), 0.0, 0.0)
        self._grid = {
            "count_x": float(shape[0]),
            "count_y": float(shape[1]),
            "wraps_x": wraps[0],
            "wraps_y": wraps[1],
        }
        self._low, self.width = low, (high - low) / np.array(counts, dtype=float)
        self.count = shape[0] * shape[1]
        number = np.indices(counts).reshape(len(counts), self.count)
        self._lower = low[:, None] + number * self.width[:, None]
        self.center = self._lower + 0.5 * self.width[:, None]
        self._upper = self._lower + self.width[:, None]
        self.up = upward(self.dimension)
        self._above = {"up": self.up, "band": BAND * spacing}
        self.material = material
        table = laser.reflectivity_table(material, COLDEST, HOTTEST)
        self._R_T, self._R_R = (backend.asarray(values) for values in table)
        # the tables have one entry more, for "no column"
        self._energy, self._top, self._covers = (backend.zeros(self.count + 1) for _ in range(3))
        self._shares: list[tuple[Array, Array]] = []
        self._corners: list[Corner] = []
        self._is_hit = np.zeros(self.count, bool)
        self._set_hit(backend.zeros(0, "index"))

    # --- who is hit -----------------------------------------------------------------------------

    def find_hit(self, position: Array, kind: Array, candidates: Rows) -> None:
        """Find which particles the light meets first.

        Args:
            position: (dim, N) [m]. kind: (N,); what has left and walls are transparent.
                candidates: numbers of the particles that may be hit, kind "index".
        """
        backend, self._searched = self.backend, candidates
        size = max(candidates.shape[0], self.count + 1)
        # gather those that may be hit; entries beyond them count as gone
        x, kinds = backend.zeros((self.dimension, size)), backend.zeros(size)
        backend.fill(kinds, GONE)
        backend.gather(position, candidates, x)
        backend.gather(kind, candidates, kinds)

        # columns of each particle, then the highest particle of each column
        self._corners = self._find_corners(x, kinds)
        self._find_tops()

        # s_pc at the four corners; hit is what takes a share of any column
        shares, is_hit = [], backend.zeros(size)
        tables = {"tops": self._top, "covers": self._covers, **self._above}
        for column, cover, _ in self._corners:
            share, fields = backend.zeros(size), {"x": x, "column": column, "cover": cover}
            backend.pointwise(share_of, fields, share, **tables)
            backend.pointwise(mark_hit, {"hit": is_hit, "share": share}, is_hit)
            shares.append((column, share))

        # keep shares of what is hit alone, in its own order
        order = backend.rows_where(is_hit, 1.0)
        self._shares = [
            (self._gather(column, order, "index"), self._gather(share, order))
            for column, share in shares
        ]
        # what is no longer hit absorbs nothing
        backend.scatter(backend.zeros(self.hit.shape[0]), self.hit, self.deposit)
        self._set_hit(self._gather(candidates, order, "index"))

    def _set_hit(self, hit: Rows) -> None:
        """Let `hit` be the particles that are hit, and allocate the arrays over them."""
        self.hit = hit
        self._light, self._temperature, self._absorbed = (
            self.backend.zeros(hit.shape[0]) for _ in range(3)
        )

    def _find_corners(self, x: Array, kind: Array) -> list[Corner]:
        """Column and cover of each particle at each corner of its square."""
        backend, size, lateral = self.backend, x.shape[1], self.dimension - 1
        fields = {"kind": kind}
        # lower edge of the square along each lateral axis: column, and how far it lies beyond
        for axis, name in enumerate("xy"):
            column, beyond = backend.zeros(size), backend.zeros(size)
            fields |= {f"column_{name}": column, f"beyond_{name}": beyond}
            if axis < lateral:
                unit = tuple(float(k == axis) for k in range(self.dimension))
                place: Constants = {
                    "low": float(self._low[axis]),
                    "inverse": 1.0 / float(self.width[axis]),
                }
                backend.pointwise(column_along, {"x": x}, (column, beyond), axis=unit, **place)

        # the 2^(d-1) corners of the square, and the particles of each column by this corner
        found = []
        for right, back in product(*[(0.0, 1.0)] * lateral, *[(0.0,)] * (2 - lateral)):
            column, cover = backend.zeros(size, "index"), backend.zeros(size)
            where: Constants = {"right": right, "back": back, **self._grid}
            backend.pointwise(column_at_corner, fields, (column, cover), **where)
            found.append(Corner(column, cover, members_of(backend, column, self.count, x)))
        return found

    def _find_tops(self) -> None:
        """Height of the highest particle of each column, and the cover of its uppermost ones."""
        backend, count = self.backend, self.count
        highest, any_height, part, other = (backend.zeros(count) for _ in range(4))
        backend.fill(highest, NOWHERE)
        backend.fill(any_height, NOWHERE)
        # highest of those that cover enough, and of all, over the four lists
        for _, cover, members in self._corners:
            fields, out = {"cover": cover}, (part, other)
            backend.pair_sum(heights, members, fields, out, combine=("max", "max"), up=self.up)
            backend.pointwise(larger, {"a": highest, "b": part}, highest)
            backend.pointwise(larger, {"a": any_height, "b": other}, any_height)

        # top of each column, and the cover of its uppermost particles: the denominator of s_pc
        top, covers = backend.head(self._top, count), backend.head(self._covers, count)
        backend.pointwise(top_of, {"covering": highest, "any_height": any_height}, top)
        backend.fill(covers, 0.0)
        for _, cover, members in self._corners:
            fields = {"cover": cover, "top": top}
            backend.pair_sum(cover_of_uppermost, members, fields, part, **self._above)
            backend.pointwise(add, {"a": covers, "b": part}, covers)
        self._is_hit = backend.to_host(covers) > 0.0

    def _gather(self, source: Array, order: Rows, kind: str = "real") -> Array:
        out = self.backend.zeros(order.shape[0], kind)
        self.backend.gather(source, order, out)
        return out

    def column_tops(self) -> np.ndarray:
        """z of the upper face of the highest particle of each column [m]; NaN where none is."""
        top = self.backend.to_host(self._top)[: self.count]
        return np.where(top > NOWHERE, top + 0.5 * self.spacing, np.nan)

    # --- what they take -------------------------------------------------------------------------

    def largest_flux(self, start: float, end: float) -> float:
        """Largest mean flux that a column may absorb from `start` to `end` [s], [W/m^2]."""
        density = self.laser.energy_density(self._lower, self._upper, start, end)
        absorptivity = 1.0 - float(np.min(self._reflectivities(start, end)))
        return absorptivity * float(np.max(density)) / (end - start)

    def _reflectivities(self, start: float, end: float) -> np.ndarray:
        """R of the table over temperature in a step from `start` to `end` [s]."""
        interval = (start, end)
        return self.laser.reflectivity_table(self.material, COLDEST, HOTTEST, interval)[1]

    def shine(self, start: float, end: float) -> None:
        """Fix the light from `start` to `end` [s]; sets `incident` and `transmitted`."""
        backend = self.backend
        density = self.laser.energy_density(self._lower, self._upper, start, end)
        # energy of the columns; those in which nothing is hit transmit theirs
        energy = density * np.prod(self.width)
        self.incident = float(energy.sum())
        self.transmitted = float(energy[~self._is_hit].sum())
        backend.copy(backend.asarray(np.append(energy, 0.0)), self._energy)
        # an absorptivity over time has one value in the step
        if self.laser.absorbs_over_time:
            backend.copy(backend.asarray(self._reflectivities(start, end)), self._R_R)
        self._distribute(self._energy)

    def _distribute(self, energy: Array) -> None:
        """Let the energy of the columns (columns + 1,) [J] fall on what is hit: `_light`."""
        backend = self.backend
        backend.fill(self._light, 0.0)
        # sum over the corners of s_pc times the energy of the column
        for column, share in self._shares:
            fields = {"light": self._light, "column": column, "share": share}
            backend.pointwise(add_light, fields, self._light, energy=energy)

    def absorb(self, temperature: Array) -> float:
        """Set `deposit` and `reflected` from the temperatures (N,) [K]; returns what is absorbed
        [J]."""
        backend, taken = self.backend, self._absorbed
        backend.gather(temperature, self.hit, self._temperature)
        fields = {"light": self._light, "T": self._temperature}
        out, table = (taken, None), {"R_T": self._R_T, "R_R": self._R_R}
        absorbed, self.reflected = backend.pointwise(
            absorbed_light, fields, out, reduce=("sum", "sum"), **table
        )
        backend.scatter(taken, self.hit, self.deposit)
        return absorbed

    def pass_excess_down(
        self, excess: Array, position: Array, kind: Array, h: Array, m: Array
    ) -> float:
        """Give the excess of what has left to what is hit now, which is found anew.

        Args:
            excess: (N,) [J]. position, kind: (dim, N) [m] and (N,), now. h: (N,) [J/kg], changed.
                m: (N,) [kg].

        Returns:
            What was given [J]; less than the excess where columns are empty now.
        """
        backend, count = self.backend, self.count
        size = self._corners[0].column.shape[0]
        # excess and covers of what was searched when the light was distributed
        own, whole = backend.zeros(size), backend.zeros(size)
        backend.gather(excess, self._searched, own)
        total, part = backend.zeros(count + 1), backend.zeros(count)
        for _, cover, _ in self._corners:
            backend.pointwise(add, {"a": whole, "b": cover}, whole)
        # hand the excess to the columns, each by its part of the covers
        for _, cover, members in self._corners:
            fields = {"excess": own, "cover": cover, "whole": whole}
            backend.pair_sum(excess_for_column, members, fields, part)
            head = backend.head(total, count)
            backend.pointwise(add, {"a": head, "b": part}, head)

        # what lies open now takes it, by the shares of the light
        self.find_hit(position, kind, self._searched)
        self._distribute(total)
        enthalpy, mass = self._gather(h, self.hit), self._gather(m, self.hit)
        fields = {"h": enthalpy, "m": mass, "given": self._light}
        (given,) = backend.pointwise(add_heat, fields, (enthalpy, None), reduce=(None, "sum"))
        backend.scatter(enthalpy, self.hit, h)
        return given
