"""`FirstHitLight`: light falls down columns of one spacing onto the particles that it meets first.

See `physics.first_hit` for who takes what. Which particles that are is found when particles have
moved or left (`sort`), the light of a step in each step (`shine`), what of it they absorb from
their temperatures (`absorb`).
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Any

import numpy as np

from lasersph.compute.backend import Backend
from lasersph.lasers import Laser
from lasersph.materials import Material
from lasersph.particles.kinds import GONE
from lasersph.particles.neighbor_lists import NeighborList, members_of
from lasersph.physics.first_hit import (
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
    share_of,
    top_of,
)
from lasersph.physics.heating import COLDEST, HOTTEST

BAND = 0.5
"""Depth over the spacing down to which particles of a column are uppermost."""


class FirstHitLight:
    """Columns over the surface, and the light in them.

    Args:
        bounds: lower and upper bound along x (and y) [m], empty in 1-D. periodic: which of these
            axes are. deposit: (N,) what each particle absorbs in a step [J], kept up to date.

    Attributes:
        center: (dim - 1, columns) [m]. width: along each axis [m]. incident: light of the step on
            all columns [J]; absorbed: what of it was; transmitted: what met no particle.
            up: against the beam, a unit vector. rows: the particles that are met.
    """

    def __init__(
        self,
        backend: Backend,
        laser: Laser,
        material: Material,
        bounds: Sequence[tuple[float, float]],
        spacing: float,
        periodic: Sequence[bool],
        deposit: Any,
    ) -> None:
        self.backend, self.laser, self.spacing = backend, laser, spacing
        self.dimension = len(bounds) + 1
        self.deposit = deposit
        self.incident = self.absorbed = self.transmitted = 0.0
        counts = [max(1, round((high - low) / spacing)) for low, high in bounds]
        self._shape = (*counts, 1, 1)[:2]
        self._wraps = (*(float(wraps) for wraps in periodic), 0.0, 0.0)[:2]
        self.width = np.array(
            [(high - low) / n for (low, high), n in zip(bounds, counts, strict=True)]
        )
        self.count = self._shape[0] * self._shape[1]
        edges = [low + np.arange(n) * w for (low, _), n, w in
                 zip(bounds, counts, self.width, strict=True)]  # fmt: skip
        mesh = np.meshgrid(*edges, indexing="ij") if edges else []
        self._lower = np.array([part.ravel() for part in mesh]).reshape(len(edges), self.count)
        self.center = self._lower + 0.5 * self.width[:, None]
        self._low = [low for low, _ in bounds]
        self.up = (0.0,) * (self.dimension - 1) + (1.0,)
        table = laser.reflectivity_table(material, COLDEST, HOTTEST)
        self._R_T, self._R_R = (backend.asarray(values) for values in table)
        self._absorptivity = 1.0 - float(np.min(table[1]))
        self._energy = backend.zeros(self.count + 1)
        self._top, self._covers = backend.zeros(self.count + 1), backend.zeros(self.count + 1)
        self._lit: list[tuple[Any, Any]] = []
        self._lists: list[tuple[Any, Any, NeighborList]] = []
        self._is_hit = np.zeros(self.count, bool)
        self._take(backend.zeros(0, "index"))

    # --- who is met -----------------------------------------------------------------------------

    def find_hit(self, position: Any, kind: Any, rows: Any) -> None:
        """Find which particles the light meets first.

        Args:
            position: (dim, N) [m]. kind: (N,); what has left and walls are transparent. rows:
                where to look, kind "index".
        """
        backend, self._sorted = self.backend, rows
        size = max(rows.shape[0], self.count + 1)
        x, kinds = backend.zeros((self.dimension, size)), backend.zeros(size)
        backend.fill(kinds, GONE)
        backend.gather(position, rows, x)
        backend.gather(kind, rows, kinds)
        corners = self._corners(x, kinds)
        self._lists = [
            (column, cover, members_of(backend, column, self.count, x)) for column, cover in corners
        ]
        self._find_tops()
        shares, lit = [], backend.zeros(size)
        for column, cover, _ in self._lists:
            share = backend.zeros(size)
            backend.pointwise(
                share_of, {"x": x, "column": column, "cover": cover}, share, tops=self._top,
                covers=self._covers, up=self.up, band=BAND * self.spacing,
            )  # fmt: skip
            backend.pointwise(mark_hit, {"lit": lit, "share": share}, lit)
            shares.append((column, share))
        met = backend.rows_where(lit, 1.0)
        self._lit = [
            (self._gather(column, met, "index"), self._gather(share, met))
            for column, share in shares
        ]
        backend.scatter(backend.zeros(self.rows.shape[0]), self.rows, self.deposit)
        self._take(self._gather(rows, met, "index"))

    def _take(self, rows: Any) -> None:
        """Let `rows` be what is met."""
        self.rows = rows
        self._light, self._temperature, self._absorbed = (
            self.backend.zeros(rows.shape[0]) for _ in range(3)
        )

    def _corners(self, x: Any, kind: Any) -> list[tuple[Any, Any]]:
        """Column and cover of each particle at each corner of its square."""
        backend, size = self.backend, x.shape[1]
        places = [(backend.zeros(size), backend.zeros(size)) for _ in range(2)]
        for axis in range(self.dimension - 1):
            unit = tuple(float(k == axis) for k in range(self.dimension))
            backend.pointwise(
                column_along, {"x": x}, places[axis], axis=unit, low=self._low[axis],
                inverse=1.0 / float(self.width[axis]),
            )  # fmt: skip
        fields = {
            "column_x": places[0][0], "beyond_x": places[0][1], "column_y": places[1][0],
            "beyond_y": places[1][1], "kind": kind,
        }  # fmt: skip
        found = []
        ends = [(0.0, 1.0)] * (self.dimension - 1) + [(0.0,)] * (3 - self.dimension)
        for right, back in product(*ends):
            column, cover = backend.zeros(size, "index"), backend.zeros(size)
            backend.pointwise(
                column_at_corner, fields, (column, cover), right=right, back=back,
                count_x=float(self._shape[0]), count_y=float(self._shape[1]),
                wraps_x=self._wraps[0], wraps_y=self._wraps[1],
            )  # fmt: skip
            found.append((column, cover))
        return found

    def _find_tops(self) -> None:
        """Height of the highest particle of each column, and the cover of its uppermost ones."""
        backend, count = self.backend, self.count
        highest, any_height, part, other = (backend.zeros(count) for _ in range(4))
        backend.fill(highest, NOWHERE)
        backend.fill(any_height, NOWHERE)
        for _, cover, columns in self._lists:
            backend.pair_sum(
                heights, columns, {"cover": cover}, (part, other), combine=("max", "max"),
                up=self.up,
            )  # fmt: skip
            backend.pointwise(larger, {"a": highest, "b": part}, highest)
            backend.pointwise(larger, {"a": any_height, "b": other}, any_height)
        top, covers = backend.head(self._top, count), backend.head(self._covers, count)
        backend.pointwise(top_of, {"covering": highest, "any_height": any_height}, top)
        backend.fill(covers, 0.0)
        for _, cover, columns in self._lists:
            backend.pair_sum(
                cover_of_uppermost, columns, {"cover": cover, "top": top}, part, up=self.up,
                band=BAND * self.spacing,
            )  # fmt: skip
            backend.pointwise(add, {"a": covers, "b": part}, covers)
        self._is_hit = backend.to_host(covers) > 0.0

    def _gather(self, source: Any, order: Any, kind: str = "real") -> Any:
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
        upper = self._lower + self.width[:, None]
        density = self.laser.energy_density(self._lower, upper, start, end)
        return self._absorptivity * float(np.max(density)) / (end - start)

    def shine(self, start: float, end: float) -> None:
        """Fix the light from `start` to `end` [s]; sets `incident` and `transmitted`."""
        backend = self.backend
        upper = self._lower + self.width[:, None]
        density = self.laser.energy_density(self._lower, upper, start, end)
        energy = density * np.prod(self.width)
        self.incident = float(energy.sum())
        self.transmitted = float(energy[~self._is_hit].sum())
        backend.copy(backend.asarray(np.append(energy, 0.0)), self._energy)
        self._distribute(self._energy)

    def _distribute(self, energy: Any) -> None:
        """Let the energy of the columns (columns + 1,) [J] fall on what is met: `_light`."""
        backend = self.backend
        backend.fill(self._light, 0.0)
        for column, share in self._lit:
            fields = {"light": self._light, "column": column, "share": share}
            backend.pointwise(add_light, fields, self._light, energy=energy)

    def absorb(self, temperature: Any) -> None:
        """Set `deposit` and `absorbed` from the temperatures (N,) of the particles [K]."""
        backend = self.backend
        backend.gather(temperature, self.rows, self._temperature)
        fields = {"light": self._light, "T": self._temperature}
        (self.absorbed,) = backend.pointwise(
            absorbed_light, fields, self._absorbed, reduce=("sum",), R_T=self._R_T, R_R=self._R_R
        )
        backend.scatter(self._absorbed, self.rows, self.deposit)

    def pass_excess_down(self, excess: Any, position: Any, kind: Any, h: Any, m: Any) -> float:
        """Give the excess of what has left to what is met now; sorts anew.

        Args:
            excess: (N,) [J]. position, kind: (dim, N) [m] and (N,), now. h: (N,) [J/kg], changed.
                m: (N,) [kg].

        Returns:
            What was given [J]; less than the excess where columns are empty now.
        """
        backend, count = self.backend, self.count
        size = self._lists[0][0].shape[0]
        own, whole = backend.zeros(size), backend.zeros(size)
        backend.gather(excess, self._sorted, own)
        total, part = backend.zeros(count + 1), backend.zeros(count)
        for _, cover, _ in self._lists:
            backend.pointwise(add, {"a": whole, "b": cover}, whole)
        for _, cover, columns in self._lists:
            fields = {"excess": own, "cover": cover, "whole": whole}
            backend.pair_sum(excess_for_column, columns, fields, part)
            head = backend.head(total, count)
            backend.pointwise(add, {"a": head, "b": part}, head)
        self.find_hit(position, kind, self._sorted)
        self._distribute(total)
        enthalpy, mass = self._gather(h, self.rows), self._gather(m, self.rows)
        fields = {"h": enthalpy, "m": mass, "given": self._light}
        (given,) = backend.pointwise(add_heat, fields, (enthalpy, None), reduce=(None, "sum"))
        backend.scatter(enthalpy, self.rows, h)
        return given


def mark_hit(lit, share):
    """1 for a particle that takes a share of any column."""
    return 1.0 if share > 0.0 else lit
