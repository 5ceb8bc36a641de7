"""Flow of a run after a step, for observers: host arrays, SI, never changed by the observer.

Speeds at the surface are extrapolated to it: a row of particles lies half a spacing below, where
the speed already is smaller by depth * tau / eta, the Marangoni stress tau over the viscosity.
[Demuth2020, eq. (15)]
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np

from lasersph.particles.faces import LATERAL


def side_images(side: str, images: int) -> int:
    """How many times the computed part of a side makes up the whole, of a box of `images` parts.

    Half of a box ends at x = 0, a quarter at y = 0 as well; a side is whole along its own normal.
    """
    mirrored = {1: (), 2: (LATERAL[0],), 4: LATERAL}[images]
    return 2 ** sum(side not in pair for pair in mirrored)


@dataclass(frozen=True)
class FlowView:
    """Flow of a run after a step; n particles, s of them at the flat surface.

    Attributes:
        velocity: (dim, n) [m/s], 0 where nothing flows.
        pressure: (n,) dynamic pressure [Pa], 0 where nothing flows.
        flows: (n,) whether a particle flows (f_m = 1).
        surface: (s,) indices of the particles at the surface in order of x, flowing or not; empty
            where a box has no free surface.
        surface_temperature: (s,) temperature of the surface above them [K]; where a surface that
            moves is solid, that of the particle itself, half a spacing below.
        surface_gradient: (s,) its derivative dT/dx; in 3-D the size of its gradient along the
            surface, 0 where nothing flows near it [K/m].
        surface_velocity: (s,) horizontal velocity extrapolated to the surface, in 3-D (2, s) along
            x and y [m/s]; 0 on solid.
        surface_pressure: (s,) dynamic pressure at the surface [Pa].
        divergence_rms, divergence_max: of the velocity of flowing particles after the projection
            [1/s].
        spacing_min: smallest distance of two particles [m].
        density, viscosity: of the liquid at the liquidus [kg/m^3], [Pa s].
        surface_tension_slope: d gamma/dT [N/(m K)], 0 where there is none.
        recoil: recoil pressure [Pa] of the vapor on a free surface at temperatures (n,) [K]; None
            where the material has no data of its vapor.
        box: whether this is a closed box that is all fluid, from a `[solver.flow]` table. mirror:
            its front or back, about which it is mirrored.
        conductivity: of the liquid [W/(m K)]; boxes report heat fluxes with it.
        wall_temperature: of each side of a box with a given one [K], by the name of the side:
            left, right, bottom, surface.
        conducting_sides: names of the sides of a box that heat crosses: those with a given
            temperature or flux.
        wall_heat, wall_impulse, wall_pressing: of each side of a box, since the start: heat that
            has entered [J/m], momentum that it has given to the liquid along itself, and that with
            which the liquid has pressed on it [N s/m], as the steps exchanged them, in 3-D [J] and
            [N s], with momentum by side and axis, as surface_x; nothing presses where the surface
            moves. Heat through level sides is that of the whole where half a box is computed, all
            else that of the half.
        full_step: step before it was cut to end at a given time [s].
    """

    velocity: np.ndarray
    pressure: np.ndarray
    flows: np.ndarray
    surface: np.ndarray
    surface_temperature: np.ndarray
    surface_gradient: np.ndarray
    surface_velocity: np.ndarray
    surface_pressure: np.ndarray
    divergence_rms: float
    divergence_max: float
    spacing_min: float
    density: float
    viscosity: float
    surface_tension_slope: float = 0.0
    recoil: Callable[[np.ndarray], np.ndarray] | None = None
    box: bool = False
    mirror: str = ""
    conductivity: float = 0.0
    wall_temperature: Mapping[str, float] = field(default_factory=dict)
    conducting_sides: tuple[str, ...] = ()
    wall_heat: Mapping[str, float] = field(default_factory=dict)
    wall_impulse: Mapping[str, float] = field(default_factory=dict)
    wall_pressing: Mapping[str, float] = field(default_factory=dict)
    full_step: float = 0.0

    @property
    def surface_speed(self) -> np.ndarray:
        """(s,) size of the horizontal velocity at the surface [m/s]."""
        if self.surface_velocity.ndim == 1:
            return np.abs(self.surface_velocity)
        return np.sqrt(np.sum(self.surface_velocity**2, axis=0))

    @property
    def recoil_pressure(self) -> np.ndarray | None:
        """(s,) recoil pressure of a free surface [Pa]; None where nothing is known of the vapor."""
        return None if self.recoil is None else self.recoil(self.surface_temperature)

    def of_whole(self, images: int) -> Self:
        """The same with the heat through level sides of a computed half and its mirror image."""
        heat = {side: side_images(side, images) * heat for side, heat in self.wall_heat.items()}
        return replace(self, wall_heat=heat)
