"""Roles of particles in the flow: which move, which bound the melt.

    rest    solid beyond the reach of the melt
    fluid   completely molten (f_m = 1), or in a box that is all fluid: moves
    edge    solid next to fluid: v = 0, its pressure is an unknown
    dummy   solid in reach of fluid, beyond the edge: v = 0, takes the pressure of the edge
                                                             [Demuth2020, Section 4.3]

Mush is wall. Roles follow the melt fraction and the positions and are found anew in every step.
"""

from __future__ import annotations

from typing import Any

from lasersph.particles.particles import Particles

REST, FLUID, EDGE, DUMMY = 0, 1, 2, 3
MOLTEN = 1.0 - 1e-9
EDGE_REACH = 1.5
"""Reach of the edge over the spacing: diagonal neighbors on the lattice are 1.41 apart."""


def flowing(f_m, is_box, molten):
    """1 where a particle flows, else 0."""
    if is_box > 0.0 or f_m >= molten:
        return 1.0
    return 0.0


def nearby(fluid_j, r_ij, l_ij, edge_reach):
    """Fluid neighbors within the support, and within the reach of the edge."""
    return (
        fluid_j if r_ij < l_ij else 0.0 * fluid_j,
        fluid_j if r_ij < edge_reach else 0.0 * fluid_j,
    )


def role_of(total_0, total_1, fluid, fluid_role, edge_role, dummy_role):
    """Role, and 1 where the pressure is an unknown, 1 where it is that of the edge, 1 if either."""
    if fluid > 0.0:
        return fluid_role, 1.0, 0.0, 1.0
    if total_1 > 0.0:
        return edge_role, 1.0, 0.0, 1.0
    if total_0 > 0.0:
        return dummy_role, 0.0, 1.0, 1.0
    return 0, 0.0, 0.0, 0.0


class Roles:
    """Roles of all particles.

    Attributes:
        fluid, unknown, dummy: (n,) 1 where a particle flows; its pressure is an unknown; it takes
            that of the edge. role: (n,) number of the role, active: 1 for all three.
            before: (n,) `fluid` one step ago.
        fluid_rows, unknown_rows, dummy_rows, active_rows: index arrays; active are all three.
    """

    def __init__(self, particles: Particles, spacing: float, *, is_box: bool) -> None:
        backend, count = particles.backend, particles.count
        self.backend, self.reach, self.is_box = backend, EDGE_REACH * spacing, float(is_box)
        self.fluid, self.unknown, self.dummy = (backend.zeros(count) for _ in range(3))
        self.before, self.active = particles["was_fluid"], backend.zeros(count)
        self.role = backend.zeros(count, "flag")

    def find_fluid(self, melt_fraction: Any) -> float:
        """Mark what flows; returns how many particles do."""
        (count,) = self.backend.pointwise(
            flowing, {"f_m": melt_fraction}, (self.fluid,), reduce=("sum",), is_box=self.is_box,
            molten=MOLTEN,
        )  # fmt: skip
        return count

    def remember(self) -> None:
        """Keep what flows now as what flowed before."""
        self.backend.copy(self.fluid, self.before)

    def find_walls(self, pairs: Any, gather: Any, count: int, wanted: Any) -> None:
        """Mark edge and dummies among the first `count` particles; `pairs` has the wanted rows."""
        backend, head = self.backend, self.backend.head
        marks = (self.role, self.unknown, self.dummy, self.active)
        for mark in marks:
            backend.fill(mark, 0.0)
        out = tuple(head(mark, count) for mark in marks)
        fields = {"fluid": gather(self.fluid)}
        backend.pair_sum(
            nearby, pairs, fields, out, finish=role_of, edge_reach=self.reach,
            rows=wanted, fluid_role=FLUID, edge_role=EDGE, dummy_role=DUMMY,
        )  # fmt: skip
        self.fluid_rows = backend.rows_where(self.fluid, 1.0)
        self.unknown_rows = backend.rows_where(self.unknown, 1.0)
        self.dummy_rows = backend.rows_where(self.dummy, 1.0)
        self.active_rows = backend.rows_where(self.active, 1.0)
