"""`Surface`: what a step of a melt pool wants to know of the free surface over the melt.

Here is what holds for a top that stays where it is, as that of a box without a free surface does:
nothing of it moves, wears or survives a step; the step is a whole one, the gradient of the pressure
the symmetric one. A free surface that stays flat is `FlatSurface`. One that moves, z = eta(x, t),
is `MovingSurface`: it brings a pressure from its curvature and its vapor, a gradient of the
pressure and a time at which forces act, limits of the step from its capillary waves, and moves with
the melt below it.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import inf
from typing import NamedTuple, Protocol

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.compute.backend import Backend
from lasersph.compute.vectors import dot, same
from lasersph.particles.ghosts import MIRROR
from lasersph.particles.neighbor_lists import NeighborList
from lasersph.particles.particles import Particles
from lasersph.surface.pressure_gradient import SymmetricGradient
from lasersph.surface.time_rule import WholeStep

Vector = tuple[float, ...]
MIN_PLANE_DISTANCE = 1e-30
"""Least distance from a plane that counts [m]. Guard: no division by 0 for a particle that lies on
one."""


def upward(dimension: int) -> Vector:
    """Outward normal of a surface as it was laid out, against beam and gravity."""
    return (0.0,) * (dimension - 1) + (1.0,)


def depth_below(x, n, plane):
    """Depth of a particle below the surface [m]."""
    return plane - dot(x, n)


def settle(settled, jump, m, remaining):
    """Jump that the divergence sees [m/s], a vector; at once the present one where there was none.

    Ghosts beyond a stressed surface continue the profile of u, and where they do so unevenly their
    divergence is that of the profile. A stress that changes at once has no profile yet: its
    divergence would have to be undone within the step, by a pressure that grows as 1 / dt. So the
    jump follows within the time l^2 / nu in which momentum crosses a support, nu of the particle.
    Under a given pressure at the surface nothing is to be undone: it is seen at once.

    Args:
        m: relative viscosity. remaining: part of the difference after the step, exp(-dt nu / l^2)
            where m is 1.
    """
    if dot(settled, settled) == 0.0:
        return 1.0 * jump
    return settled + (1.0 - remaining**m) * (jump - settled)


class PressureCondition(NamedTuple):
    """Boundary condition of the pressure equation at a surface, arrays (n,) or None for none.

    coefficient: cross-section over distance a [m^(d-2)]. value: p_b [Pa].
    """

    coefficient: Array | None = None
    value: Array | None = None


class SurfaceGhosts(NamedTuple):
    """Ghosts across the local tangent of a surface, by their sources; of a plane all are 0.

    distance: (n,) from the tangent [m]. pressure: (n,) p_b at the surface [Pa]. min_distance: least
    distance that counts [m]. normal: (d, n) of the surface, outward. shift: (d, n) from source to
    ghost [m].
    """

    distance: Array
    pressure: Array
    min_distance: float
    normal: Array
    shift: Array


class SurfaceStep(NamedTuple):
    """The particles below a surface in a step: temperature [K], volume [m^2], mass [kg/m], enthalpy
    [J/kg]; what has evaporated since the start per area seen from above [kg/m^2], in the first
    entries by column; position [m], velocity [m/s], 1 where they flow, all (..., n); begin and end
    of the step [s]."""

    T: Array
    volume: Array
    mass: Array
    enthalpy: Array
    evaporated: Array
    position: Array
    velocity: Array
    flows: Array
    interval: tuple[float, float]


class SurfaceNeighbors(Protocol):
    """The particles below a surface with their ghosts and pairs.

    Attributes:
        weights: (pairs,) g_ij; viscous_weights: those with which viscosity counts.
    """

    pairs: NeighborList
    weights: Array
    viscous_weights: Array

    @property
    def V(self) -> Array:
        """(M,) volumes of the particles and their ghosts [m^2]."""
        ...

    @property
    def across(self) -> Array:
        """(M,) 1 for ghosts beyond the surface."""
        ...

    def gather(self, field: Array) -> Array:
        """A field of all particles on those of the pairs."""
        ...

    def mirror(self, a: Array) -> Array:
        """A vector field of all particles on those of the pairs, as planes between mirror it."""
        ...


class Surface:
    """A top that stays where it is, and the members of every other one.

    Args:
        count: particles of the whole body. top: z of the plane [m]. dimension: d.
        pressure_gradient: below it; None for that of the class.

    Attributes:
        normal: unit vector, outward. crossing: MIRROR or TANGENT, how ghosts lie beyond it.
        top: highest place of a particle [m]. moves: whether it is no plane. largest_speed: that
            melt below it can have [m/s].
        pressure_gradient, time_rule: what a step takes from it.
        at_surface, near_surface: (n,) 1 for a particle that lies at the surface, within its support
            of it. depth: (n,) below the surface along the beam [m]. temperature: (n,) of the
            surface above a particle at it [K]. gradient: (d, n) of that along the surface [K/m].
            ghost_velocity_jump: (d, n) by how much a ghost beyond the surface is faster than its
            source along it, 2 d tau / eta [m/s]. velocity_jump, stress_jump: (d, n) that jump for
            the flow, and as viscosity sees it. ghosts: what those across its tangents have.
    """

    crossing = MIRROR
    moves = False
    largest_speed = inf
    pressure_gradient = SymmetricGradient()
    time_rule = WholeStep()

    def __init__(
        self,
        backend: Backend,
        count: int,
        top: float,
        dimension: int = 2,
        min_distance: float = MIN_PLANE_DISTANCE,
        pressure_gradient: SymmetricGradient | None = None,
    ) -> None:
        self.backend, self.top = backend, top
        if pressure_gradient is not None:
            self.pressure_gradient = pressure_gradient
        self.normal = upward(dimension)
        self.pressure = PressureCondition()

        # fields of the particles, set anew in each step
        self.at_surface, self.near_surface = backend.zeros(count), backend.zeros(count)
        self.depth, self.temperature = backend.zeros(count), backend.zeros(count)
        self.gradient = backend.zeros((dimension, count))
        self.ghost_velocity_jump = backend.zeros((dimension, count))
        self.velocity_jump = self.stress_jump = self.ghost_velocity_jump
        # beyond a plane ghosts mirror their sources: nothing is shifted, no pressure is given
        self.ghosts = SurfaceGhosts(
            distance=backend.zeros(count),
            pressure=backend.zeros(count),
            min_distance=min_distance,
            normal=backend.zeros((dimension, count)),
            shift=backend.zeros((dimension, count)),
        )
        self._no_state = Particles(backend, 0, 1)

    # jumps of velocity beyond it
    def settle(self, settled: Array, relative_viscosity: Array, remaining: float) -> None:
        """Let the jump (d, n) that the divergence sees follow that of the stress.

        Args:
            relative_viscosity: (n,) over that at the liquidus. remaining: part of the difference
                after the step where that is 1.
        """
        fields = {"settled": settled, "jump": self.ghost_velocity_jump, "m": relative_viscosity}
        self.backend.pointwise(settle, fields, settled, remaining=remaining)

    def settled_jump(self, settled: Array) -> Array:
        """`velocity_jump` as the divergence sees it."""
        return settled

    def shifted_along(self, dummy: Array) -> Array:
        """(n,) 1 for particles shifted along the surface only; dummy: (n,) 1 for dummies."""
        return dummy

    # the step, in the order of its calls
    def hold_thin_melt(self, position: Array, volume: Array, flows: Array) -> float:
        """Set `flows` (n,) to 0 where the melt is too thin for this surface to move; their sum.

        Args:
            volume: (n,) [m^2].
        """
        return self.backend.pointwise(same, {"value": flows}, (None,), reduce=("sum",))[0]

    def advance_first_half(self, now: SurfaceStep) -> None:
        """Follow the melt through the first half of a step; `now` is from its begin."""

    def find(self, position: Array) -> None:
        """Set marks and depths of the particles at `position`, shape (d, n) [m]."""

    def update_stress(self, now: SurfaceStep, neighbors: SurfaceNeighbors, active: Array) -> None:
        """Set temperature, gradient, jump and pressure at the advected positions.

        Args:
            active: (n,) 1 for particles within the support of fluid; elsewhere there is no stress.
        """

    def advance_second_half(self, now: SurfaceStep) -> float:
        """Follow the melt through the second half; `now` is from the end of the step. Mass that
        leaves is taken from its particles; returns the heat that leaves with it [J/m]."""
        return 0.0

    def confine(self, position: Array, flows: Array) -> None:
        """Keep particles that flow, (n,) 1, below a surface that is not the domain's face."""

    # where it lies
    def find_depth(self, position: Array, out: Array) -> None:
        """Depth below the surface along the beam [m] of particles at `position` [m]."""
        fields = {"x": position}
        self.backend.pointwise(depth_below, fields, out, n=self.normal, plane=self.top)

    def length_ratio(self) -> Array | None:
        """(columns,) true length of the surface over that seen from above; None for a plane."""
        return None

    def heights(self, columns: int) -> np.ndarray:
        """(columns,) mean heights [m]."""
        return np.zeros(columns)

    def validity_error(self) -> str:
        """Why the run cannot go on: "what, where; what to change"; empty where it can."""
        return ""

    def time_step_limits(self) -> dict[str, float]:
        """Named limits of the next step [s]."""
        return {}

    # retries and checkpoints
    @property
    def state(self) -> Particles:
        """Table of the columns, with what survives a step and is no field of the particles."""
        return self._no_state

    def take_state(self) -> None:
        """Go on from the values of `state`."""

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers that survive a step."""
        return {}

    def restore(self, numbers: Mapping[str, float]) -> None:
        """Continue from `checkpoint_scalars`."""

    def reset(self) -> None:
        """Forget what the flow below has left at the surface, but for its heights."""
