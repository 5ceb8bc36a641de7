"""`EulerianPool`: a pool whose particles rest, and whose melt passes from one to the next.

For sections (r, z). A ring that kept its mass would change its area in the plane as 1/r, so that
particles would gather or part wherever the melt flows out or in. So they stay on their lattice:

    fluxes        F_ij from v^n, without divergence; h and v that they carry         `transport`
    v*            viscosity with the hoop stress, body forces                        (68)
    p, v^(n+1)    pressure, its gradient of differences                              (69), (70)
    h^(n+1)       conduction between the same pairs as before the melt               (64)

No particle is shifted, no surface bends, and pairs are found once. For a surface that moves
particles have to follow it, which planar blocks do.
"""

from __future__ import annotations

from typing import Any

from lasersph.solvers.melt_pool.ring_block import RingBlock
from lasersph.solvers.melt_pool.solver import MeltPool
from lasersph.solvers.melt_pool.transport import Transport


class EulerianPool(MeltPool):
    """Solver of a run whose melt flows between particles that rest; arguments of `MeltPool`."""

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        self.transport = Transport(self.particles, self.flow.volume)

    def advect(self, step: float) -> None:
        """Carry h and v with the melt between particles at rest; find the operators there."""
        domain, flow, kinds = self.domain, self.flow, self.kinds
        # pairs near what flows: those of rows that no melt has come to before
        block = domain.block_for(self.position, kinds)
        assert isinstance(block, RingBlock)
        flow.set_block(block)
        block.find_new_pairs(self.position, block.find_near_fluid(self.position, kinds.fluid))
        kinds.find_walls(block)
        # h and v that fluxes carry
        self.transport.carry(flow, kinds, step)
        self.body.update_temperature()
        # viscosity and stress at the new temperatures
        flow.update_viscosity(self.particles["temperature"])
        now = self._surface_step(self.position, step)
        domain.surface.update_stress(now, block, kinds.active)

    def update_positions(self, step: float) -> None:
        """Particles rest, and conduct between the pairs of the body."""

    def illuminate(self, step: float) -> None:
        """Light of the step, on the lattice."""
        self.body.light.shine(self.state.time, self.state.time + step)

    def rearrange(self, step: float) -> None:
        """Particles at rest stay even."""

    def lay_out(self) -> None:
        """Particles lie on their lattice, below a surface that is flat."""

    def _update_resting_pairs(self) -> None:
        """Pairs of the body are those of the lattice."""
        self._has_moved = False
