"""`WallPressure`: what the pressure does along walls on which no liquid slips.

A ghost beyond such a wall has the velocity of its source turned around. Two things make that wrong,
both known from a = grad p/rho along the wall:

    u* = dt a on the wall before the projection, which then takes dt a away        [Kim1985]
    nu d2u/dn2 = a on the wall, where nothing accelerates: u is not odd about it

so that a ghost at the distance d has -u_s + (2 dt + d^2/nu) a; dt is that up to the velocity from
which viscosity is found, in the middle of the step. Without that a film of five rows
over a wall flows 3 % too fast under a pressure, and liquid slips by dt a. a is that of the step
before. Only below a surface that moves.
"""

from __future__ import annotations

from lasersph.compute.array_types import Array
from lasersph.compute.vectors import matvec
from lasersph.particles.particles import Particles
from lasersph.solvers.melt_pool.block import Block
from lasersph.solvers.melt_pool.liquid import Liquid
from lasersph.surface.surface import Surface


def difference_term(p_i, p_j, G_ij):
    """Term of the gradient of a pressure [Pa/m]."""
    return (p_j - p_i) * G_ij


def pressure_acceleration(total, C, density):
    """grad p/rho [m/s^2]."""
    return matvec(C, total) / density


class WallPressure:
    """grad p/rho of the particles near faces, found once a step.

    Args:
        particles: with their pressure. relative: (n,) viscosity of the particles over that at the
            liquidus.
    """

    def __init__(
        self, particles: Particles, liquid: Liquid, surface: Surface, relative: Array
    ) -> None:
        self.backend, self.liquid = particles.backend, liquid
        self._pressure, self._relative = particles["pressure"], relative
        self._a = self.backend.zeros(particles["velocity"].shape)
        # the symmetric gradient is adjoint to a divergence that mirrors the velocity as it is
        self._acts = not surface.pressure_gradient.is_symmetric

    def find(self, block: Block) -> None:
        """Find it from the pressure at the present positions."""
        if not (self._acts and block.ghosts.has_still_walls):
            return
        p = block.ghosts.extend_pressure(self._pressure)
        self.backend.pair_sum(
            difference_term,
            block.pairs,
            {"p": p, "G_ij": block.gradient, "C": block.correction},
            self._a,
            finish=pressure_acceleration,
            rows=block.ghosts.particles.near,
            density=self.liquid.density,
        )

    def add_to(self, v: Array, block: Block, step: float) -> Array:
        """Velocities (d, M) with those of ghosts beyond walls as above [m/s].

        Args:
            step: from v^n to what viscosity sees [s].
        """
        if self._acts and block.ghosts.has_still_walls:
            block.ghosts.add_at_walls(v, self._a, self._relative, step, self.liquid.viscosity)
        return v
