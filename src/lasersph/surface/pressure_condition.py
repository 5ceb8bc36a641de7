"""Pairs across a moving surface: the pressure they see, and how much of its stress they pass on.

A pair across the surface sees g_ij (d_i + d_j) of its length, which sums up to the whole where
particles lie in rows. Rows a fiftieth of a spacing lower see 2 % less, and so much of the stress
was lost: films of aluminum at rest were 6 % too shallow. So ghosts get the jump of their velocity
over the share that the pairs of the column and of its neighbors see. Where the viscosity varies,
each pair passes on the stress of its own; its length counts as that over the surface's.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.backend import Backend
from lasersph.compute.graph import graph
from lasersph.materials import Material
from lasersph.materials.viscosity import ViscosityTable
from lasersph.particles.neighbor_lists import NeighborList
from lasersph.surface import loops
from lasersph.surface.column_loops import thickness_of
from lasersph.surface.height_field import HeightField
from lasersph.surface.surface import PressureCondition, SurfaceGhosts, SurfaceNeighbors

HostArray = NDArray[np.float64]
LEAST_SHARE = 0.5
"""Share at least, and its inverse at most. Guard: rows a fiftieth of a spacing from their place
change it by 2 %; half of the surface unseen is a gap between particles, and its stress is not
doubled and more."""


class SurfaceLiquid(NamedTuple):
    """The melt below: rho of its flow and m/V of the particles [kg/m^3], eta at the liquidus
    [Pa s], temperatures [K] and eta there over that, and the metal, for gamma(T).

    Flow has the density of the melt, particles that of the cold metal, and nothing swells: so mass
    that leaves takes the volume that it has in them, else those that stay grow heavy.
    """

    density: float
    particle_density: float
    viscosity: float
    relative_viscosity: ViscosityTable
    material: Material

    def relative_viscosity_at(self, T: HostArray) -> HostArray:
        """eta at temperatures [K] over that at the liquidus."""
        return np.interp(T, *self.relative_viscosity)


class PairsAcross:
    """Condition and share of a line that pairs across it see; arrays are kept while a block has as
    many rows.

    Attributes:
        condition: of the pressure equation.
    """

    def __init__(self, backend: Backend, line: HeightField) -> None:
        self.backend, self.line = backend, line
        self._columns = {"k": backend.asarray(np.arange(line.count), "index")}
        self._seen = backend.zeros(line.count)
        self._make_arrays(0)

    def _make_arrays(self, count: int) -> None:
        """Arrays of so many particles."""
        self._a, self._p_b, self._length = (self.backend.zeros(count) for _ in range(3))
        self.condition = PressureCondition(coefficient=self._a, value=self._p_b)

    def find(
        self,
        molten: NDArray[np.bool_],
        members: NeighborList,
        ghosts: SurfaceGhosts,
        neighbors: SurfaceNeighbors,
        relative_viscosity: HostArray,
        length_ratio: HostArray,
    ) -> HostArray:
        """Set the condition; returns the share of the surface (columns,) that pairs see.

        Args:
            molten: (columns,) which move. members: particles that flow, by column.
                relative_viscosity: (columns,) of the surface over that at the liquidus.
                length_ratio: (columns,) its true length over that seen from above.
        """
        backend, line = self.backend, self.line
        count = neighbors.pairs.row_start.shape[0] - 1
        if self._a.shape[0] != count:
            self._make_arrays(count)
        self.sum_pairs(neighbors, ghosts)
        # length that the particles of each column see, over its own, of rings over their area
        tables = {"row_start": members.row_start, "member": members.neighbor, "V": self._length}
        inverse_area = line.inverse_area
        backend.pointwise(
            thickness_of, self._columns, self._seen, **tables, inverse_area=inverse_area
        )
        seen = backend.to_host(self._seen)
        share = seen / (line.measure.ravel() * length_ratio * relative_viscosity)
        shape = line.shape
        mean = line.mean_of_neighbors(share.reshape(shape), molten.reshape(shape)).ravel()
        share = np.where(molten, mean, 1.0)
        return np.clip(share, LEAST_SHARE, 1.0 / LEAST_SHARE)

    @graph
    def sum_pairs(self, neighbors: SurfaceNeighbors, ghosts: SurfaceGhosts) -> None:
        """Boundary coefficient, p_b and length of surface seen, for each particle."""
        backend, length = self.backend, self._length
        fields = {"g_ij": neighbors.weights, "across": neighbors.across}
        fields |= {"distance": neighbors.gather(ghosts.distance)}
        fields |= {"p_b": neighbors.gather(ghosts.pressure)}
        terms, finish = loops.given_pressure, loops.given_pressure_of_row
        out = self._a, self._p_b, length
        backend.pair_sum(terms, neighbors.pairs, fields, out, finish=finish)
        # where viscosity varies, the length counts as the stress of the pairs does
        if neighbors.viscous_weights is not neighbors.weights:
            fields["g_ij"] = neighbors.viscous_weights
            out = backend.zeros(length.shape[0]), backend.zeros(length.shape[0]), length
            backend.pair_sum(terms, neighbors.pairs, fields, out, finish=finish)
