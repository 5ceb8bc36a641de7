"""`Surface`: what a step of a melt pool wants to know of the free surface over the melt.

A box without one has `NoSurface`, a flat one is `FlatSurface`. One that moves, z = eta(x, t), is
`MovingSurface`: it brings a pressure from its curvature and its vapor, a gradient of the pressure
and a time at which forces act, limits of the step from its capillary waves, and moves with the melt
below it. No step asks which it has.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, Protocol

import numpy as np

from lasersph.compute.array_types import Array
from lasersph.particles.neighbor_lists import NeighborList
from lasersph.particles.particles import Particles
from lasersph.surface.pressure_gradient import PressureGradient
from lasersph.surface.time_rule import TimeRule

Vector = tuple[float, ...]


def upward(dimension: int) -> Vector:
    """Outward normal of a surface as it was laid out, against beam and gravity."""
    return (0.0,) * (dimension - 1) + (1.0,)


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


class Surface(Protocol):
    """The free surface.

    Attributes:
        normal: unit vector, outward. crossing: MIRROR or TANGENT, how ghosts lie beyond it.
        top: highest place of a particle [m]. moves: whether it is no plane. largest_speed: that
            melt below it can have [m/s].
        pressure_gradient, time_rule: what a step takes from it. jump_direction: along which jumps
            of velocities point that are numbers; 1 where they are vectors.
        at_surface, near_surface: (n,) 1 for a particle that lies at the surface, within its support
            of it. depth: (n,) below the surface along the beam [m]. temperature: (n,) of the
            surface above a particle at it [K]. gradient: (n,) of that along the surface [K/m].
            ghost_velocity_jump: (n,) by how much a ghost beyond the surface is faster than its
            source along it, 2 d tau / eta [m/s]. ghosts: what those across its tangents have.
        state: what survives a step and is no field of the particles, by column.
    """

    # how it lies, and what a step takes from it
    normal: Vector
    crossing: str
    top: float
    moves: bool
    largest_speed: float
    jump_direction: float | Vector
    pressure_gradient: PressureGradient
    time_rule: TimeRule
    # fields of the particles, set anew in each step
    at_surface: Array
    near_surface: Array
    depth: Array
    temperature: Array
    gradient: Array
    ghost_velocity_jump: Array
    ghosts: SurfaceGhosts

    @property
    def state(self) -> Particles:
        """Table of the columns, with their present values."""
        ...

    @property
    def pressure(self) -> PressureCondition:
        """Condition for the pressure; an empty one for dp/dn = 0."""
        ...

    @property
    def velocity_jump(self) -> Array:
        """By how much ghosts are faster than their sources [m/s]: (n,) along a plane, (d, n)."""
        ...

    @property
    def stress_jump(self) -> Array:
        """The same as viscosity sees it."""
        ...

    def settle(self, settled: Array, relative_viscosity: Array, remaining: float) -> None:
        """Let the jump (n,) that the divergence sees follow that of the stress.

        Args:
            relative_viscosity: (n,) over that at the liquidus. remaining: part of the difference
                after the step where that is 1.
        """
        ...

    def settled_jump(self, settled: Array) -> Array:
        """`velocity_jump` as the divergence sees it."""
        ...

    def kept_at_face(self, dummy: Array) -> Array:
        """(n,) 1 for particles that are shifted along a face only; dummy: (n,) 1 for dummies."""
        ...

    def heights(self, columns: int) -> np.ndarray:
        """(columns,) mean heights [m]."""
        ...

    # the step, in the order of its calls
    def advance_first_half(self, now: SurfaceStep) -> None:
        """Follow the melt through the first half of a step; `now` is from its begin."""
        ...

    def reset(self) -> None:
        """Forget what the flow below has left at the surface, but for its heights."""
        ...

    def find(self, position: Array) -> None:
        """Set marks and depths of the particles at `position`, shape (dim, n) [m]."""
        ...

    def length_ratio(self) -> Array | None:
        """(columns,) true length of the surface over that seen from above; None for a plane."""
        ...

    def find_depth(self, position: Array, out: Array) -> None:
        """Depth below the surface along the beam [m] of particles at `position` [m]."""
        ...

    def update_stress(self, now: SurfaceStep, neighbors: SurfaceNeighbors, active: Array) -> None:
        """Set temperature, gradient, stress, jump and pressure at the advected positions.

        Args:
            active: (n,) 1 for particles within the support of fluid; elsewhere there is no stress.
        """
        ...

    def hold_thin_melt(self, position: Array, volume: Array, flows: Array) -> float:
        """Set `flows` (n,) to 0 where the melt is too thin for this surface to move; their sum.

        Args:
            volume: (n,) [m^2].
        """
        ...

    def advance_second_half(self, now: SurfaceStep) -> float:
        """Follow the melt through the second half; `now` is from the end of the step. Mass that
        leaves is taken from its particles; returns the heat that leaves with it [J/m]."""
        ...

    def confine(self, position: Array, flows: Array) -> None:
        """Keep particles that flow, (n,) 1, below a surface that is not the domain's face."""
        ...

    def validity_error(self) -> str:
        """Why the run cannot go on: "what, where; what to change"; empty where it can."""
        ...

    def time_step_limits(self) -> dict[str, float]:
        """Named limits of the next step [s]."""
        ...

    # retries and checkpoints
    def take_state(self) -> None:
        """Go on from the values of `state`."""
        ...

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers that survive a step."""
        ...

    def restore(self, numbers: Mapping[str, float]) -> None:
        """Continue from `checkpoint_scalars`."""
        ...
