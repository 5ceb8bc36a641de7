"""`EulerianPool`: a pool whose particles keep their columns, and whose melt passes from one to the
next.

For sections (r, z), and for boxes and flat pools whose case says so. A ring that kept its mass
would change its area in the plane as 1/r, so that particles would gather or part wherever the melt
flows out or in. In a plane they may move or stay; those that stay need no shifting, which takes
from a flow what it cannot resolve, and keep their pairs.

    particles     ride with the surface where it moves, and rest below a flat one    `RidingSurface`
    fluxes        F_ij from v^n, without divergence; h and v of the middle of the step `transport`
    v*            viscosity, of rings with the hoop stress, body forces              (68)
    p, v^(n+1)    pressure and its gradient                                          (69), (70)
    h^(n+1)       conduction between the same pairs                                  (64)

Below a surface that moves, positions, pairs and forces are those of the middle of the step, as the
line of the surface is then.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import numpy as np

from lasersph.solvers.conduction.solver import Conduction
from lasersph.solvers.melt_pool.domain import PoolDomain
from lasersph.solvers.melt_pool.flow import Flow
from lasersph.solvers.melt_pool.passing_block import PassingBlock
from lasersph.solvers.melt_pool.settings import MeltPoolSettings
from lasersph.solvers.melt_pool.solver import MeltPool
from lasersph.solvers.melt_pool.transport import Transport
from lasersph.surface.columns import OwnColumns, product
from lasersph.surface.riding_surface import Ride, RidingSurface


class EulerianPool(MeltPool):
    """Solver of a run whose melt flows between particles that keep their columns; arguments of
    `MeltPool`."""

    is_passing = True

    def __init__(
        self,
        heat: Conduction,
        flow: Flow,
        domain: PoolDomain,
        settings: MeltPoolSettings,
        pause: Literal["compute", "spread", "remove"] = "compute",
    ) -> None:
        super().__init__(heat, flow, domain, settings, pause)
        backend, count = self.backend, self.body.count
        self.transport = Transport(self.particles, self.flow.volume)
        lattice = self.domain.lattice
        self._lengths = backend.asarray(lattice.geometry.measure(lattice.position))
        self._at_rest = Ride(backend.zeros(self.position.shape), backend.zeros(count))
        self._columns = OwnColumns(backend, self.body.filling.fine_surface, self.body.area)
        self._at_surface = backend.asarray(self.body.filling.surface, "index")
        self._size_bodies()

    def _size_bodies(self) -> None:
        """Volumes of the bodies, of rings [m^3], from those of the particles [m^2]."""
        fields = {"a": self.particles["volume"], "b": self._lengths}
        self.backend.pointwise(product, fields, self.flow.volume)

    def advect(self, step: float) -> None:
        """Let particles ride with the surface and the melt pass between them, which carries h and
        v; find the operators there."""
        domain, flow, kinds = self.domain, self.flow, self.kinds
        block = domain.block_for(self.position, kinds)
        assert isinstance(block, PassingBlock)
        flow.set_block(block)
        # particles and pairs at the middle of the step
        ride = self._ride(step)
        block.renew_pairs(self.position, self._rows_to_find(block, self.position))
        kinds.find_walls(block)
        # h and v that fluxes carry
        self.transport.carry(flow, kinds, ride, step, self.state.time_step)
        self.body.update_temperature()
        # viscosity and stress at the new temperatures
        flow.update_viscosity(self.particles["temperature"], self.kinds)
        now = self._surface_step(self.position, step)
        domain.surface.update_stress(now, block, kinds.active)

    def _ride(self, step: float) -> Ride:
        """Let the particles follow a surface that moves to the middle of the step."""
        surface = self.domain.surface
        if not isinstance(surface, RidingSurface):
            return self._at_rest
        now = self._surface_step(self.position, step)
        surface.advance_first_half(now)
        # vapor leaves with the heat of the particle at the surface
        self.state.energy["removed"] += surface.heat_lost(now.enthalpy)
        ride = surface.ride(now)
        surface.find(self.position)
        self._size_bodies()
        return ride

    def update_positions(self, step: float) -> None:
        """The line at the end of the step; particles have ridden, and conduct where they are."""
        block, surface = self.flow.block, self.domain.surface
        surface.advance_second_half(self._surface_step(self.position, step))
        block.normalize_surface_flux()
        self.exchange.find_walls(block)
        # below a flat surface pairs of the body are those of the lattice
        if surface.moves:
            self.pairs.update(block)

    def illuminate(self, step: float) -> None:
        """Light and losses of the step on the columns as they are."""
        light, surface = self.body.light, self.domain.surface
        light.shine(self.state.time, self.state.time + step)
        if not isinstance(surface, RidingSurface):
            return
        volume = self.particles["volume"]
        # columns that are coarse rest
        tops = np.zeros(self._at_surface.shape[0])
        tops[: self._columns.count] = surface.column_tops(self.position, volume)
        light.follow_columns(self.position, volume, self.backend.asarray(tops))
        self._columns.incline(surface.length_ratio())
        self.heat.exchange.use_columns(self._columns, self._at_surface)

    def rearrange(self, step: float) -> None:
        """Particles stay even in their columns."""

    def lay_out(self) -> None:
        """Lay the particles out evenly below the surface; below a flat one they are."""
        if self.domain.surface.moves:
            super().lay_out()
            self._size_bodies()

    def _update_resting_pairs(self) -> None:
        """Where the flow has ended, conduct between the final places; those of a lattice stay."""
        if self.domain.surface.moves:
            super()._update_resting_pairs()
        self.has_moved = False

    def _restore_numbers(self, numbers: Mapping[str, float]) -> None:
        super()._restore_numbers(numbers)
        self._size_bodies()
