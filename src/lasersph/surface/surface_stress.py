"""Stress and pressure along a surface that moves, from velocity and temperature there.

    tangential stress     tau = t . (2 mu D) . n = d gamma/ds             [Demuth2020, eq. (15)]
    shear rate            du_t/dn = tau/mu - n . dv/ds
    pressure              p_b = p_e + gamma kappa - 2 mu grad_s . v

with grad_s . v = t . dv/ds, and u_r/r more in a section (r, z), whose rings widen as they go
outward; with the recoil of the vapor in p_e, and mu that at the temperature of the surface. What
enters is smoothed as slope and curvature are.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lasersph.surface.flat_surface import surface_tension_table
from lasersph.surface.forcing import SurfaceForcing
from lasersph.surface.height_field import HeightField, length_ratio
from lasersph.surface.pressure_condition import SurfaceLiquid
from lasersph.surface.smoothing import EVEN_PARITY, ODD_PARITY

HostArray = NDArray[np.float64]


def shear_rate(tau: HostArray | float, viscosity: HostArray, across: HostArray) -> HostArray:
    """du_t/dn [1/s] under a stress tau [Pa], where v changes along the surface by n . dv/ds."""
    return tau / viscosity - across


def normal_stress(viscosity: HostArray, along: HostArray) -> HostArray:
    """2 mu n . D . n [Pa], from grad_s . v [1/s]."""
    return -2.0 * viscosity * along


class StressAlong(NamedTuple):
    """Values along a line (m,), by the names of `loops.surface_values`.

    T_line, gradient: temperature [K] and its slope along the surface [K/m]. shear, strain_rate:
    du_t/dn and grad_s . v, of a plane du_t/ds [1/s]. p_b: pressure [Pa].
    """

    T_line: HostArray
    gradient: HostArray
    shear: HostArray
    strain_rate: HostArray
    p_b: HostArray


PARITIES = {
    "T_line": EVEN_PARITY,
    "gradient": ODD_PARITY,
    "shear": ODD_PARITY,
    "strain_rate": EVEN_PARITY,
    "p_b": EVEN_PARITY,
}
"""How each goes on beyond a plane of symmetry."""


class SurfaceStress:
    """Stress of a liquid under what a case imposes.

    Args:
        has_stress: whether gamma(T) drives the flow.
    """

    def __init__(self, liquid: SurfaceLiquid, forcing: SurfaceForcing, *, has_stress: bool) -> None:
        self.liquid = liquid
        self.forcing = forcing
        self.has_stress = has_stress
        if has_stress:
            self._gamma_table = surface_tension_table(liquid.material)

    def along(
        self,
        line: HeightField,
        x: HostArray,
        interval: tuple[float, float],
        velocity: HostArray,
        T: HostArray,
    ) -> tuple[StressAlong, float]:
        """Stress along a part that moves, and the largest surface tension there [N/m].

        Args:
            x: (m,) places of its columns [m]. interval: begin and end of the step [s].
            velocity: (2, m) of the melt at the surface [m/s]. T: (m,) there [K].
        """
        liquid, forcing = self.liquid, self.forcing

        # grad_s . v and n . dv/ds of the smoothed velocity
        u = line.smooth(velocity[0], ODD_PARITY, 0.0)
        w = line.smooth(velocity[1], EVEN_PARITY, 0.0)
        (slope,) = slopes = line.slopes
        S = length_ratio(slopes)
        u_x, w_x = line.derivative(u, ODD_PARITY), line.derivative(w)
        along = (u_x + slope * w_x) / S**2
        across = (-slope * u_x + w_x) / S**2
        if line.is_axisymmetric:
            along = along + u / line.centers()

        # temperature of the surface: that of the melt, or a given one
        T = line.smooth(T)
        if (given := forcing.temperature) is not None:
            T = np.full(x.size, given.mean)
            T = T if given.drive is None else T + given.drive.mean_over(x, *interval)

        # tau = d gamma/ds
        tau: HostArray | float = 0.0
        if self.has_stress:
            tau = line.derivative(np.interp(T, *self._gamma_table)) / S

        # p_b = gamma kappa - 2 mu t . dv/ds + p_e, with recoil in p_e
        tension = liquid.material.surface_tension_at(T)
        viscosity = liquid.viscosity * liquid.relative_viscosity_at(T)
        pressure = tension * line.curvature + normal_stress(viscosity, along)
        if (drive := forcing.pressure) is not None:
            pressure = pressure + drive.mean_over(x, *interval)
        if forcing.recoil is not None:
            pressure = pressure + forcing.recoil(T)
        found = StressAlong(
            T_line=T,
            gradient=line.derivative(T) / S,
            shear=shear_rate(tau, viscosity, across),
            strain_rate=along,
            p_b=pressure,
        )
        return found, float(np.max(tension))
