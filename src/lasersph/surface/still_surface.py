"""Tops of a melt that stay where they are: `NoSurface`, and what a flat one shares with it.

Nothing of them moves, wears or survives a step; the step is a whole one, the gradient of the
pressure the symmetric one. What a stress beyond the top adds to the velocity of ghosts is seen by
the divergence only as it settles, see `settle`.
"""

from __future__ import annotations

from math import inf

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import dot
from lasersph.particles.ghosts import MIRROR
from lasersph.particles.particles import Particles
from lasersph.surface.pressure_gradient import PressureGradient, SymmetricGradient
from lasersph.surface.surface import (
    PressureCondition,
    SurfaceGhosts,
    SurfaceNeighbors,
    SurfaceStep,
    Vector,
    upward,
)
from lasersph.surface.time_rule import TimeRule, WholeStep

MIN_PLANE_DISTANCE = 1e-30
"""Least distance from a plane that counts [m]. Guard: no division by 0 for a particle that lies on
one."""


def depth_below(x, n, plane):
    """Depth of a particle below the surface [m]."""
    return plane - dot(x, n)


def settle(settled, jump, m, remaining):
    """Jump that the divergence sees [m/s]; at once the present one where there was none.

    Ghosts beyond a stressed surface continue the profile of u, and where they do so unevenly their
    divergence is that of the profile. A stress that changes at once has no profile yet: its
    divergence would have to be undone within the step, by a pressure that grows as 1 / dt. So the
    jump follows within the time l^2 / nu in which momentum crosses a support, nu of the particle.
    Under a given pressure at the surface nothing is to be undone: it is seen at once.

    Args:
        m: relative viscosity. remaining: part of the difference after the step, exp(-dt nu / l^2)
            where m is 1.
    """
    if settled == 0.0:
        return 1.0 * jump
    return settled + (1.0 - remaining**m) * (jump - settled)


class StillSurface:
    """Top that stays where it is, as a step sees it, see `Surface`.

    Args:
        count: particles of the whole body. top: z of the plane [m]. dimension: d.
    """

    crossing = MIRROR
    moves = False
    largest_speed = inf
    pressure = PressureCondition()
    pressure_gradient: PressureGradient = SymmetricGradient()
    time_rule: TimeRule = WholeStep()

    def __init__(self, backend: Backend, count: int, top: float, dimension: int = 2) -> None:
        self.backend = backend
        self.top = top
        self.normal: Vector = upward(dimension)
        self.jump_direction: float | Vector = (1.0,) + (0.0,) * (dimension - 1)
        self.at_surface = backend.zeros(count)
        self.near_surface = backend.zeros(count)
        self.depth = backend.zeros(count)
        self.temperature = backend.zeros(count)
        self.gradient = backend.zeros(count)
        self.ghost_velocity_jump = backend.zeros(count)
        # ghosts mirror their sources: nothing is shifted, no pressure is given
        nothing, still = backend.zeros(count), backend.zeros((dimension, count))
        self.ghosts = SurfaceGhosts(nothing, nothing, MIN_PLANE_DISTANCE, still, still)
        self.state = Particles(backend, 0, 1)

    @property
    def velocity_jump(self) -> Array:
        """(n,) along the plane."""
        return self.ghost_velocity_jump

    @property
    def stress_jump(self) -> Array:
        """The same for viscosity."""
        return self.ghost_velocity_jump

    def settle(self, settled: Array, relative_viscosity: Array, remaining: float) -> None:
        """Let the jump that the divergence sees follow that of the stress."""
        fields = {"settled": settled, "jump": self.ghost_velocity_jump, "m": relative_viscosity}
        self.backend.pointwise(settle, fields, settled, remaining=remaining)

    def settled_jump(self, settled: Array) -> Array:
        """The jump that has settled."""
        return settled

    def kept_at_face(self, dummy: Array) -> Array:
        """Dummies alone are shifted along the face only."""
        return dummy

    def heights(self, columns: int) -> NDArray[np.float64]:
        """A plane at 0."""
        return np.zeros(columns)

    def find(self, position: Array) -> None:
        """No particle lies at a surface."""

    def find_depth(self, position: Array, out: Array) -> None:
        """Depth below the plane [m] of particles at `position` [m]."""
        fields, place = {"x": position}, {"n": self.normal, "plane": self.top}
        self.backend.pointwise(depth_below, fields, out, **place)

    def length_ratio(self) -> Array | None:
        """A plane is seen at its true length."""
        return None

    def update_stress(self, now: SurfaceStep, neighbors: SurfaceNeighbors, active: Array) -> None:
        """There is no stress."""

    def hold_thin_melt(self, position: Array, volume: Array, flows: Array) -> float:
        """All that is molten flows; their number."""
        (count,) = self.backend.pointwise(mark_of, {"mark": flows}, (None,), reduce=("sum",))
        return count

    def advance_first_half(self, now: SurfaceStep) -> None:
        """It stays where it is."""

    def advance_second_half(self, now: SurfaceStep) -> float:
        """It stays where it is, and keeps its mass."""
        return 0.0

    def confine(self, position: Array, flows: Array) -> None:
        """The domain's face does that."""

    def reset(self) -> None:
        """Nothing outlives the flow below."""

    def take_state(self) -> None:
        """There is none."""

    def validity_error(self) -> str:
        """Nothing can be wrong with it."""
        return ""

    def time_step_limits(self) -> dict[str, float]:
        """None: it has no waves."""
        return {}

    def checkpoint_scalars(self) -> dict[str, float]:
        """None: what it has follows from the particles."""
        return {}

    def restore(self, numbers: object) -> None:
        """There is nothing to restore."""


def mark_of(mark):
    """The mark itself, for its sum."""
    return 1.0 * mark


class NoSurface(StillSurface):
    """The top of a box whose faces are walls, planes of symmetry or periodic."""
