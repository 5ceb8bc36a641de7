"""Steady recession of a surface that evaporates under a constant flux absorbed at it (Landau).

In the frame of the surface the solid moves toward it at the speed v, and nothing changes:

    q = rho v [c (T_s - T_0) + L_m + L_v(T_s)],      rho v = m(T_s)
    k dT/dz = -rho v h(T),    h = c (T - T_0), plus L_m where it is molten

so that h falls as exp(-v z/D) with depth, in the melt and below it, and the melting point lies at
(D/v) ln[h(T_s)/h_l]. Neither T_s nor v depends on the conductivity; a run from cold comes near them
in some times D/v^2.

Left out: a melting range, properties that depend on temperature, a vapor that absorbs light.
Reference: [Landau1950] Quart. Appl. Math. 8, 81.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class SteadyRecession:
    """A metal under a constant flux.

    Attributes:
        flux: absorbed at the surface [W/m^2]. density, heat_capacity, conductivity: [SI].
        melting: latent heat of melting [J/kg]. melting_temperature, initial_temperature: [K].
        mass_flux: m(T) of the surface [kg/(m^2 s)]. latent_heat: L_v(T) [J/kg].
        hottest: a temperature at which more heat would leave than comes [K].
    """

    flux: float
    density: float
    heat_capacity: float
    conductivity: float
    melting: float
    melting_temperature: float
    initial_temperature: float
    mass_flux: Callable[[float], float]
    latent_heat: Callable[[float], float]
    hottest: float

    @cached_property
    def surface_temperature(self) -> float:
        """T_s [K]. Raises ValueError where not even the hottest surface carries the flux away."""
        from scipy.optimize import brentq

        # Landau's balance of energy at the surface
        def surplus(T: float) -> float:
            heat = self._sensible(T) + self.melting + self.latent_heat(T)
            return self.mass_flux(T) * heat - self.flux

        root = brentq(surplus, self.melting_temperature, self.hottest, xtol=1e-9)
        return float(root)  # pyright: ignore[reportArgumentType]  # the root alone, by default

    @property
    def speed(self) -> float:
        """v [m/s]."""
        return self.mass_flux(self.surface_temperature) / self.density

    @property
    def thermal_length(self) -> float:
        """D/v [m]."""
        return self.conductivity / (self.density * self.heat_capacity * self.speed)

    @property
    def time(self) -> float:
        """D/v^2, the time in which a run from cold settles [s]."""
        return self.thermal_length / self.speed

    @property
    def melt_depth(self) -> float:
        """Depth of the melting point below the surface [m]."""
        hot = self._sensible(self.surface_temperature) + self.melting
        # exp(-v z / D) takes the enthalpy from that of the surface to that of the liquid at T_m
        front = self._sensible(self.melting_temperature) + self.melting
        return self.thermal_length * float(np.log(hot / front))

    def temperature(self, depth: ArrayLike) -> NDArray[np.float64]:
        """Temperature [K] at depths below the surface [m], any shape."""
        z = np.asarray(depth, dtype=float)
        hot = self._sensible(self.surface_temperature) + self.melting
        # enthalpy in the melt less the latent heat; below the front the solid goes on from T_m
        melt = hot * np.exp(-z / self.thermal_length) - self.melting
        below = (z - self.melt_depth) / self.thermal_length
        solid = self._sensible(self.melting_temperature) * np.exp(-np.maximum(below, 0.0))
        heat = np.where(z < self.melt_depth, melt, solid)
        return self.initial_temperature + heat / self.heat_capacity

    def _sensible(self, T: float) -> float:
        return self.heat_capacity * (T - self.initial_temperature)
