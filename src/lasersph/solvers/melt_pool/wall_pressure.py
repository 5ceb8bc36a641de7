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
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import matvec
from lasersph.solvers.melt_pool.block import Block


def difference_term(p_i, p_j, G_ij):
    """Term of the gradient of a pressure [Pa/m]."""
    return (p_j - p_i) * G_ij


def pressure_acceleration(total, C, density):
    """grad p/rho [m/s^2]."""
    return matvec(C, total) / density


class WallPressure:
    """grad p/rho of the particles near faces, found once a step.

    Args:
        density: [kg/m^3]. viscosity: nu at the liquidus [m^2/s]. relative: (n,) viscosity of the
            particles over that.
    """

    def __init__(self, backend: Backend, density: float, viscosity: float, relative: Array) -> None:
        self.backend, self.density, self.viscosity = backend, density, viscosity
        self._relative, count = relative, relative.shape[0]
        self._a = backend.zeros((2, count))

    def find(self, block: Block, pressure: Array, C: Array) -> None:
        """Take the pressure (n,) [Pa] at the present positions.

        Args:
            C: (2, 2, count) corrections of the gradient.
        """
        p = block.ghosts.extend_pressure(pressure) if block.ghosts.has_still_walls else None
        if p is None:
            return
        fields = {"p": p, "G_ij": block.gradient, "C": C}
        self.backend.pair_sum(
            difference_term,
            block.pairs,
            fields,
            self._a,
            finish=pressure_acceleration,
            rows=block.ghosts.particles.near,
            density=self.density,
        )

    def add_to(self, v: Array, block: Block, step: float) -> Array:
        """Velocities (2, M) with those of ghosts beyond walls as above [m/s].

        Args:
            step: from v^n to what viscosity sees [s].
        """
        if block.ghosts.has_still_walls:
            block.ghosts.add_at_walls(v, self._a, self._relative, step, self.viscosity)
        return v
