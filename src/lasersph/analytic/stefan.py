"""Melting of a half-space whose surface is held above the melting temperature (Neumann's solution).

    liquid 0 < z < s(t), solid z > s(t);  T(0) = T_s > T_m,  T(s) = T_m,  T(infinity) = T_0 <= T_m
    rho L ds/dt = -k_l dT/dz(s-) + k_s dT/dz(s+),    s = 2 lambda sqrt(D_l t)

With St = c_l (T_s - T_m)/L, lambda is the only root of

    exp(-lambda^2)/erf(lambda) - C exp(-mu^2)/erfc(mu) = sqrt(pi) lambda / St,
    mu = lambda sqrt(D_l/D_s),   C = k_s/k_l sqrt(D_l/D_s) (T_m - T_0)/(T_s - T_m)

One phase (T_0 = T_m) drops the second term: lambda exp(lambda^2) erf(lambda) = St/sqrt(pi).
Left out: a melting range, a change of density on melting.

Carslaw & Jaeger, Conduction of Heat in Solids (1959), 11.2; Alexiades & Solomon, Mathematical
Modeling of Melting and Freezing Processes (1993), 2.1 and 2.2.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq
from scipy.special import erf, erfc, erfcx

Array = NDArray[np.float64]


@dataclass(frozen=True)
class PhaseProperties:
    """Constant properties of one phase: k [W/(m K)], c [J/(kg K)]."""

    conductivity: float
    specific_heat: float


@dataclass(frozen=True)
class Melting:
    """Neumann's solution for melting from a hot surface, all in SI.

    Args:
        surface_temperature: T_s [K]. melting_temperature: T_m [K]. initial_temperature: T_0 [K].
        latent_heat: L [J/kg]. density: rho of both phases [kg/m^3]. liquid, solid: properties;
            solid None takes those of the liquid.

    Raises:
        ValueError: T_s <= T_m, T_0 > T_m or L <= 0.
    """

    surface_temperature: float
    melting_temperature: float
    initial_temperature: float
    latent_heat: float
    density: float
    liquid: PhaseProperties
    solid: PhaseProperties | None = None

    def __post_init__(self):
        if not self.surface_temperature > self.melting_temperature >= self.initial_temperature:
            raise ValueError(
                "melting from the surface needs surface > melting >= initial temperature, not "
                f"{self.surface_temperature}, {self.melting_temperature}, "
                f"{self.initial_temperature} K"
            )
        if not self.latent_heat > 0.0:
            raise ValueError(f"the latent heat must be positive, not {self.latent_heat} J/kg")

    def diffusivity(self, phase: PhaseProperties) -> float:
        """D = k/(rho c) [m^2/s]."""
        return phase.conductivity / (self.density * phase.specific_heat)

    @property
    def stefan_number(self) -> float:
        """St = c_l (T_s - T_m)/L."""
        superheat = self.surface_temperature - self.melting_temperature
        return self.liquid.specific_heat * superheat / self.latent_heat

    @cached_property
    def front_constant(self) -> float:
        """lambda in s = 2 lambda sqrt(D_l t)."""
        solid = self.solid or self.liquid
        # C of the equation for lambda, with sqrt(D_l / D_s)
        contrast = np.sqrt(self.diffusivity(self.liquid) / self.diffusivity(solid))
        cooling = (
            solid.conductivity
            / self.liquid.conductivity
            * contrast
            * (self.melting_temperature - self.initial_temperature)
            / (self.surface_temperature - self.melting_temperature)
        )

        def imbalance(x: float) -> float:
            # exp(-y^2)/erfc(y) = 1/erfcx(y), which neither over- nor underflows
            heating = np.exp(-(x**2)) / erf(x) - cooling / erfcx(x * contrast)
            return float(heating - np.sqrt(np.pi) * x / self.stefan_number)

        root: Any = brentq(imbalance, 1e-12, 26.0, xtol=1e-15)
        return float(root)

    def front(self, time: ArrayLike) -> Array:
        """Depth of the melting front s(t) [m]."""
        time = np.asarray(time, float)
        return 2.0 * self.front_constant * np.sqrt(self.diffusivity(self.liquid) * time)

    def temperature(self, depth: ArrayLike, time: ArrayLike) -> Array:
        """Temperature [K] at depths [m] and times > 0 [s], broadcast against each other."""
        depth, time = np.asarray(depth, float), np.asarray(time, float)
        solid = self.solid or self.liquid
        d_liquid, d_solid = self.diffusivity(self.liquid), self.diffusivity(solid)
        x = self.front_constant
        superheat = self.surface_temperature - self.melting_temperature
        subcooling = self.melting_temperature - self.initial_temperature
        # error functions between T_s and T_m in the liquid, between T_m and T_0 in the solid
        in_liquid = self.surface_temperature - superheat * erf(
            depth / (2.0 * np.sqrt(d_liquid * time))
        ) / erf(x)
        in_solid = self.initial_temperature + subcooling * erfc(
            depth / (2.0 * np.sqrt(d_solid * time))
        ) / erfc(x * np.sqrt(d_liquid / d_solid))
        return np.where(depth < self.front(time), in_liquid, in_solid)
