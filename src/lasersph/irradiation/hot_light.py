"""`HotLight`: layered light whose reflectivity and depth follow the electrons at the surface.

As `LayeredLight`, with R(nu) and alpha(nu) of each column instead of R(T_s): nu is the rate of
collisions of the electrons at its surface [`materials.hot_optics`]. One alpha holds from the top of
a column to its bottom. Shares of particles at rest are those of their depth cells with it; in cells
that particles have moved into, tau and its sums from above grow with alpha.
"""

from __future__ import annotations

from math import exp

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.graph import graph
from lasersph.compute.vectors import interpolate
from lasersph.irradiation.absorbing_cells import light_per_cover
from lasersph.irradiation.layered import LayeredLight, share_at_depth
from lasersph.lasers import Laser
from lasersph.materials import Material
from lasersph.materials.hot_optics import HotOptics
from lasersph.particles.filling import Filling


def enter_hot_column(F, nu, area, nu_nodes, R_nodes, depths, bottom):
    """Light that enters a column [J/m^(d-1)], what its cell reflects, what passes its bottom [J],
    and alpha [1/m].

    Args:
        nu: rate of collisions at the surface [1/s]. area: of the cell [m^(d-1)]. nu_nodes, R_nodes,
            depths: table. bottom: depth of the lowest end [m].
    """
    R = interpolate(nu, nu_nodes, R_nodes)
    alpha = 1.0 / interpolate(nu, nu_nodes, depths)
    return (1.0 - R) * F, R * F * area, (1.0 - R) * F * area * exp(-alpha * bottom), alpha


def hot_share(depth, half, area, column, alphas):
    """A_i s_i of a particle on its lattice [m^(d-1)], the exact share of its cell [Demuth2020].

    Args:
        depth: of its middle [m]. half: of its height [m]. area: [m^(d-1)]. alphas: of the columns.
    """
    alpha = alphas[column]
    return area * (exp(-alpha * max(depth - half, 0.0)) - exp(-alpha * (depth + half)))


def hot_share_in_column(x, V, column, area, width, tops, alphas):
    """A_i s_i of a particle that keeps its column [m^(d-1)], see `share_at_depth`."""
    return share_at_depth(x, V, column, area, width, tops, alphas[column])


def hot_light_per_cover(k, tau, total, tau_one, alphas, levels, cold):
    """`light_per_cover` with the alpha of the column of cell k over the cold one, 1/`cold`."""
    more = alphas[k // levels] * cold
    return light_per_cover(more * tau, more * total, more * tau_one)


class HotLight(LayeredLight):
    """The laser on particles with hot electrons; `absorb` takes their rates of collisions [1/s]."""

    def __init__(
        self,
        backend: Backend,
        laser: Laser | None,
        material: Material,
        filling: Filling,
        optics: HotOptics,
    ) -> None:
        self._deepest = float(optics.depth.max())
        super().__init__(backend, laser, material, filling)
        electrons, rate = optics.electrons, optics.rate
        self.collisions = {
            "B": electrons.collision_rate or 0.0,
            "ratio": electrons.scattering or 0.0,
            "lowest": float(rate[0]),
            "highest": float(rate[-1]),
        }
        # table over nu in the place of that over T
        self._varies = True
        values = {"nu_nodes": rate, "R_nodes": optics.reflectivity, "depths": optics.depth}
        self._entering = {name: backend.asarray(nodes) for name, nodes in values.items()}
        count = filling.count
        half = 0.5 * filling.width[-1, :count]
        self._entering["bottom"] = float(np.max(filling.depth[:count] + half))
        self._alphas = backend.zeros(filling.surface.size)
        # cells of the lattice, for shares anew in each step
        cells = {"depth": filling.depth[:count], "half": half, "area": filling.cross_section}
        self._cells_at_rest = {name: backend.asarray(given) for name, given in cells.items()}
        self._cells_at_rest["column"] = self._lattice["column"]
        self._grown: dict[str, Array] = {}
        self._tops = self._alphas

    def _lay_cells(self, width: np.ndarray, half: np.ndarray, alpha: float) -> None:
        """As `LayeredLight`, with levels as deep as the light ever reaches."""
        super()._lay_cells(width, half, 1.0 / self._deepest)
        self._tau_one = alpha * 2.0 * float(half[0])

    def follow_columns(self, position: Array, volume: Array, tops: Array) -> None:
        """Let the light meet particles that keep their columns, as `LayeredLight`."""
        super().follow_columns(position, volume, tops)
        if self.alpha is not None:
            column = self._lattice["column"]
            self._grown = {"x": position, "V": volume, "column": column, **self._cell}
            self._tops = tops

    @graph
    def find_shares(self) -> None:
        """Optical thickness of the cells in cold metal; light makes shares of them."""
        self._optical = self._thickness()
        self._light = self.backend.zeros(self._cells + 1)

    def _illuminate_columns(self, at_surface: Array, shares: dict[str, Array]) -> None:
        """As `LayeredLight` with rates of collisions [1/s]; set the shares of the particles with
        the alpha of their columns."""
        backend, alphas = self.backend, self._alphas
        fields = {"F": self.fluence, "area": self._area, "nu": at_surface}
        out, reduce = (self.columns, None, None, alphas), (None, "sum", "sum", None)
        backend.pointwise(enter_hot_column, fields, out, reduce=reduce, **self._entering)
        if self.alpha is None:
            return
        # particles that have moved: the cells that they are in, and below them those of the lattice
        if "share" not in shares:
            backend.pointwise(hot_share, self._cells_at_rest, shares["share_0"], alphas=alphas)
            cells = {"k": self._numbers, **self._optical}
            constants = {"tau_one": self._tau_one, "levels": self._levels, "cold": 1.0 / self.alpha}
            light = backend.head(self._light, self._cells)
            backend.pointwise(hot_light_per_cover, cells, light, alphas=alphas, **constants)
            self._share_cells(self._light)
            return
        # those that keep their columns, as high as they are now, or as on the lattice
        if self._grown:
            tables = {"tops": self._tops, "alphas": alphas}
            backend.pointwise(hot_share_in_column, self._grown, shares["share"], **tables)
            return
        backend.pointwise(hot_share, self._cells_at_rest, shares["share"], alphas=alphas)
