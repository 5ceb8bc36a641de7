"""Kinds of particles in the flow: which move, which bound the melt.

Fluid is what is completely molten (f_m = 1), or all of a box. Solid within the support radius of
fluid is dummy, and its next layer to the fluid edge [Demuth2020, Section 4.3]; all else is
interior. Mush is wall. Kinds follow the melt fraction and the positions and are found anew in every
step.
"""

from __future__ import annotations

from collections.abc import Callable

from lasersph.compute.array_types import Array, Rows
from lasersph.particles.kinds import DUMMY, EDGE, FLUID, INTERIOR
from lasersph.particles.neighbor_lists import NeighborList
from lasersph.particles.particles import Particles

MOLTEN = 1.0 - 1e-9
"""Melt fraction from which a particle is fluid: 1 but for rounding."""
EDGE_RATIO = 1.5
"""Distance of the edge from fluid over the spacing: diagonal neighbors of a lattice are 1.41 apart.
"""


def is_fluid(f_m, is_box):
    """1 where a particle flows, else 0."""
    if is_box > 0.0 or f_m >= MOLTEN:
        return 1.0
    return 0.0


def fluid_neighbors(fluid_j, r_ij, l_ij, edge_distance):
    """Fluid neighbors within the support, and within the distance of the edge."""
    return (
        fluid_j if r_ij < l_ij else 0.0 * fluid_j,
        fluid_j if r_ij < edge_distance else 0.0 * fluid_j,
    )


def kind_of(total_0, total_1, fluid):
    """Kind, and 1 where the pressure is an unknown, 1 where it is that of the edge, 1 if either."""
    if fluid > 0.0:
        return FLUID, 1.0, 0.0, 1.0
    if total_1 > 0.0:
        return EDGE, 1.0, 0.0, 1.0
    if total_0 > 0.0:
        return DUMMY, 0.0, 1.0, 1.0
    return INTERIOR, 0.0, 0.0, 0.0


class ParticleKinds:
    """Kinds of all particles.

    Attributes:
        kind: (n,) see `particles.kinds`. fluid, unknown, dummy: (n,) 1 where a particle flows; its
            pressure is an unknown; it takes that of the edge. active: 1 for all three. before:
            (n,) `fluid` one step ago.
        fluid_rows, unknown_rows, dummy_rows, active_rows: index arrays.
    """

    fluid_rows: Rows
    unknown_rows: Rows
    dummy_rows: Rows
    active_rows: Rows

    def __init__(self, particles: Particles, spacing: float, *, is_box: bool) -> None:
        particles.add("kind", "was_fluid")
        backend, count = particles.backend, particles.count
        self.backend, self.edge_distance = backend, EDGE_RATIO * spacing
        self.is_box = float(is_box)
        self.kind, self.before = particles["kind"], particles["was_fluid"]
        self.fluid, self.unknown = backend.zeros(count), backend.zeros(count)
        self.dummy, self.active = backend.zeros(count), backend.zeros(count)

    def find_fluid(self, melt_fraction: Array) -> float:
        """Mark what flows; returns how many particles do."""
        (count,) = self.backend.pointwise(
            is_fluid, {"f_m": melt_fraction}, (self.fluid,), reduce=("sum",), is_box=self.is_box
        )
        return count

    def remember(self) -> None:
        """Keep what flows now as what flowed before."""
        self.backend.copy(self.fluid, self.before)

    def find_walls(
        self, pairs: NeighborList, gather: Callable[[Array], Array], count: int, rows: Rows
    ) -> None:
        """Mark edge and dummies among the first `count` particles; `pairs` has these rows."""
        backend = self.backend
        marks = (self.kind, self.unknown, self.dummy, self.active)
        for mark in marks:
            backend.fill(mark, 0)
        out, fields = tuple(backend.head(m, count) for m in marks), {"fluid": gather(self.fluid)}
        near = {"edge_distance": self.edge_distance}
        backend.pair_sum(fluid_neighbors, pairs, fields, out, finish=kind_of, rows=rows, **near)
        self.fluid_rows = backend.rows_where(self.fluid, 1.0)
        self.unknown_rows = backend.rows_where(self.unknown, 1.0)
        self.dummy_rows = backend.rows_where(self.dummy, 1.0)
        self.active_rows = backend.rows_where(self.active, 1.0)
