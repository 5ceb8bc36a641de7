"""Kinds of particles in the flow: which move, which bound the melt.

Fluid is what is completely molten (f_m = 1), or all of a box. Solid within the support radius of
fluid is dummy, and its next layer to the fluid edge [Demuth2020, Section 4.3]; all else is
interior. Mush is wall. Kinds follow the melt fraction and the positions and are found anew in every
step.
"""

from __future__ import annotations

from lasersph.compute.array_types import Array, Rows
from lasersph.compute.graph import graph
from lasersph.compute.vectors import dot
from lasersph.particles.kinds import DUMMY, EDGE, FLUID, INTERIOR
from lasersph.particles.particles import Particles
from lasersph.solvers.melt_pool.block import Block

MOLTEN = 1.0 - 1e-9
"""Melt fraction from which a particle is fluid. Rounding: 1 is fluid."""
EDGE_RATIO = 1.5
"""Distance of the edge from fluid over the spacing. Geometry: diagonal neighbors of a lattice are
1.41 apart, the next but one 2."""


def is_fluid(f_m, fluid):
    """1 where a particle flows, else 0; the same; and 1 where that has changed."""
    flows = 1.0 if f_m >= MOLTEN else 0.0
    return flows, flows, abs(flows - fluid)


def stop_solid(v, fluid):
    """Velocity of what flows, 0 of all others [m/s]; and |v|^2."""
    flowing = fluid * v
    return flowing, dot(flowing, flowing)


def fluid_neighbors(fluid_j, g_ij, r_ij, edge_distance):
    """Fluid neighbors within the support, where weights are positive, and within the distance of
    the edge."""
    return (
        fluid_j if g_ij > 0.0 else 0.0 * fluid_j,
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
        fluid_rows, unknown_rows, dummy_rows, active_rows: index arrays. changes: how often what
            flows has become another.
    """

    def __init__(self, particles: Particles, spacing: float, *, is_box: bool) -> None:
        particles.add("kind", "was_fluid")
        backend, count = particles.backend, particles.count
        self.backend, self.edge_distance = backend, EDGE_RATIO * spacing
        self.is_box = is_box
        self.kind, self.before = particles["kind"], particles["was_fluid"]
        self.fluid, self.unknown = backend.zeros(count), backend.zeros(count)
        self.dummy, self.active = backend.zeros(count), backend.zeros(count)
        self.fluid_rows: Rows = backend.zeros(0, "index")
        self.unknown_rows: Rows = backend.zeros(0, "index")
        self.dummy_rows: Rows = backend.zeros(0, "index")
        self.active_rows: Rows = backend.zeros(0, "index")
        self._is_marked, self.changes = False, 0

    def find_fluid(self, melt_fraction: Array) -> float:
        """Mark what flows, all of a box; returns how many particles do."""
        if self.is_box:
            self._mark_all()
            return float(self.fluid.shape[0])
        fields, out = {"f_m": melt_fraction, "fluid": self.fluid}, (self.fluid, None, None)
        count, changed = self.backend.pointwise(is_fluid, fields, out, reduce=(None, "sum", "sum"))
        self.changes += changed > 0.0
        return count

    def _mark_all(self) -> None:
        """Mark all as fluid, once for all."""
        if self._is_marked:
            return
        self.backend.fill(self.kind, FLUID)
        for mark in (self.fluid, self.unknown, self.active):
            self.backend.fill(mark, 1.0)
        self._find_rows()
        self._is_marked = True

    def remember(self) -> None:
        """Keep what flows now as what flowed before."""
        self.backend.copy(self.fluid, self.before)

    def stop_solid(self, v: Array) -> tuple[float, ...]:
        """Set velocities (d, n) [m/s] to 0 where nothing flows; reduces the largest |v|^2."""
        fields = {"v": v, "fluid": self.fluid}
        return self.backend.pointwise(stop_solid, fields, (v, None), reduce=(None, "max"))

    def find_walls(self, block: Block) -> None:
        """Mark edge and dummies among the particles of a block; a box has none."""
        if self.is_box:
            return
        self.mark_walls(block)
        self._find_rows()

    @graph
    def mark_walls(self, block: Block) -> None:
        """Kinds and marks of the particles of a block, by their fluid neighbors."""
        # nothing is wall to begin with
        backend, count = self.backend, block.count
        marks = (self.kind, self.unknown, self.dummy, self.active)
        for mark in marks:
            backend.fill(mark, 0)
        out, near = tuple(backend.head(m, count) for m in marks), self.edge_distance

        # within the support of fluid: dummy; a spacing from it: edge
        fields = {"fluid": block.gather(self.fluid), "g_ij": block.weights}
        backend.pair_sum(
            fluid_neighbors,
            block.pairs,
            fields,
            out,
            finish=kind_of,
            rows=block.rows,
            edge_distance=near,
        )

    def _find_rows(self) -> None:
        backend = self.backend
        self.fluid_rows = backend.rows_where(self.fluid, 1.0)
        self.unknown_rows = backend.rows_where(self.unknown, 1.0)
        self.dummy_rows = backend.rows_where(self.dummy, 1.0)
        self.active_rows = backend.rows_where(self.active, 1.0)
