"""Stress and pressure along a surface that moves, from velocity and temperature there.

    tangential stress     P (2 mu D n) = grad_s gamma                     [Demuth2020, eq. (15)]
    shear rate            s = grad_s gamma/mu - G n,   G = P grad v
    pressure              p_b = p_e + gamma kappa - 2 mu grad_s . v,   grad_s . v = tr G

with P = I - n n and derivatives along the columns. On a line s = du_t/dn t, G n = (n . dv/ds) t and
grad_s . v = t . dv/ds, and u_r/r more in a section (r, z), whose rings widen as they go outward. On
a grid of columns, with r_x = (1, 0, eta_x), r_y = (0, 1, eta_y) and the cofactors c_ab of their
products r_a . r_b, which are not orthogonal on a slope,

    grad_s f = c_ab f_a r_b / S^2,   c = [[1 + eta_y^2, -eta_x eta_y], [-eta_x eta_y, 1 + eta_x^2]]

The recoil of the vapor is part of p_e, and mu that at the temperature of the surface. What enters
is smoothed as slope and curvature are.
"""

from __future__ import annotations

from itertools import product
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from lasersph.surface.flat_surface import surface_tension_table
from lasersph.surface.forcing import SurfaceForcing
from lasersph.surface.height_field import length_ratio
from lasersph.surface.pressure_condition import SurfaceLiquid
from lasersph.surface.smoothing import EVEN_PARITY, ODD_PARITY

HostArray = NDArray[np.float64]


def shear_rate(tau: HostArray | float, viscosity: HostArray, across: HostArray) -> HostArray:
    """du_t/dn [1/s] under a stress tau [Pa], where v changes along the surface by n . dv/ds."""
    return tau / viscosity - across


def normal_stress(viscosity: HostArray, along: HostArray) -> HostArray:
    """2 mu n . D . n [Pa], from grad_s . v [1/s]."""
    return -2.0 * viscosity * along


class Smoothed(Protocol):
    """Heights over columns that move, whose smoothed values may go on beyond them."""

    is_axisymmetric: bool

    @property
    def places(self) -> tuple[HostArray, ...]:
        """Middle of the columns along each axis [m]."""
        ...

    @property
    def support_places(self) -> tuple[HostArray, ...]:
        """Places of the smoothed values [m]."""
        ...

    @property
    def slopes(self) -> HostArray:
        """(d - 1, ...) slopes of the smoothed heights at the columns."""
        ...

    @property
    def curvature(self) -> HostArray:
        """Their curvature there [1/m]."""
        ...

    def smooth(
        self, values: HostArray, parity: Any = ..., at_pins: float | None = ...
    ) -> HostArray:
        """Smoothed values of the columns."""
        ...

    def derivative(self, smoothed: HostArray, /, parity: Any = ..., axis: int = ...) -> HostArray:
        """Derivative of smoothed values along an axis at the columns."""
        ...

    def at_columns(self, smoothed: HostArray) -> HostArray:
        """Smoothed values at the columns."""
        ...


class StressAlong(NamedTuple):
    """Values along a surface (m,), by the names of `loops.surface_values`.

    T_line, gradient: temperature [K] and its slope along the surface, on a grid the size of it
    [K/m]. shear: (d - 1, m) du_t/dn of a line, of a grid the parts of s along x and y [1/s].
    strain_rate: grad_s . v, of a plane du_t/ds [1/s]. p_b: pressure [Pa].
    """

    T_line: HostArray
    gradient: HostArray
    shear: HostArray
    strain_rate: HostArray
    p_b: HostArray


def cofactors(slopes: HostArray) -> HostArray:
    """(d - 1, d - 1, m) cofactors of r_a . r_b from slopes (d - 1, m); 1 of a line."""
    if len(slopes) == 1:
        return np.ones((1, *slopes.shape))
    x, y = slopes
    return np.array([[1.0 + y * y, -x * y], [-x * y, 1.0 + x * x]])


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
        self, line: Smoothed, interval: tuple[float, float], velocity: HostArray, T: HostArray
    ) -> tuple[StressAlong, float]:
        """Stress along a part that moves, and the largest surface tension there [N/m].

        Args:
            interval: begin and end of the step [s]. velocity: (d, m) of the melt at the surface of
                its columns [m/s]. T: (m,) there [K].
        """
        S, c = length_ratio(line.slopes), cofactors(line.slopes)
        along, across = velocity_gradients(line, velocity, S, c)
        T = self._temperature(line, interval, T)
        T_here = line.at_columns(T)
        viscosity = self.liquid.viscosity * self.liquid.relative_viscosity_at(T_here)
        shear = self._shear(line, T, viscosity, across, S, c)
        tension = self.liquid.material.surface_tension_at(T_here)
        pressure = tension * line.curvature + normal_stress(viscosity, along)
        found = StressAlong(
            T_line=T_here,
            gradient=gradient_size(line, T, S, c).reshape(T_here.shape),
            shear=shear,
            strain_rate=along,
            p_b=self._add_imposed(pressure, line, interval, T_here),
        )
        return found, float(np.max(tension))

    def _temperature(
        self, line: Smoothed, interval: tuple[float, float], T: HostArray
    ) -> HostArray:
        """Smoothed temperature of the surface [K]: that of the melt, or a given one."""
        T = line.smooth(T)
        if (given := self.forcing.temperature) is not None:
            T = np.full(T.shape, given.mean)
            if given.drive is not None:
                T = T + given.drive.mean_over(line.support_places, *interval)
        return T

    def _shear(
        self,
        line: Smoothed,
        T: HostArray,
        viscosity: HostArray,
        across: list[HostArray],
        S: HostArray,
        c: HostArray,
    ) -> HostArray:
        """s from grad gamma/S and n . v_a/S, along the axes of a grid [1/s]."""
        gamma = np.interp(T, *self._gamma_table) if self.has_stress else 0.0 * T
        shear = np.array(
            [
                shear_rate(line.derivative(gamma, axis=a) / S, viscosity, lean)
                for a, lean in enumerate(across)
            ]
        )
        return shear if len(across) == 1 else np.einsum("abm,bm->am", c, shear) / S

    def _add_imposed(
        self, pressure: HostArray, line: Smoothed, interval: tuple[float, float], T: HostArray
    ) -> HostArray:
        """gamma kappa - 2 mu grad_s . v and p_e, with recoil in it [Pa]."""
        if (drive := self.forcing.pressure) is not None:
            pressure = pressure + drive.mean_over(line.places, *interval)
        if self.forcing.recoil is not None:
            pressure = pressure + self.forcing.recoil(T)
        return pressure


def velocity_gradients(
    line: Smoothed, velocity: HostArray, S: HostArray, c: HostArray
) -> tuple[HostArray, list[HostArray]]:
    """grad_s . v = c_ab r_b . v_a/S^2, and n . v_a/S along each axis a [1/s].

    Args:
        S, c: length ratio and `cofactors` of the line.
    """
    slopes = line.slopes
    axes = range(len(slopes))
    # derivatives of the smoothed velocity along each axis, [a][b] of the part b
    parities = [tuple(ODD_PARITY if a == b else EVEN_PARITY for a in axes) for b in (*axes, -1)]
    smoothed = [line.smooth(v, one, 0.0) for v, one in zip(velocity, parities, strict=True)]
    change = [
        [line.derivative(v, one, axis) for v, one in zip(smoothed, parities, strict=True)]
        for axis in axes
    ]

    along = np.zeros(S.shape)
    for a, b in product(axes, axes):
        along = along + c[a, b] * (change[a][b] + slopes[b] * change[a][-1])
    along = along / S**2
    # u_r/r more where rings widen as they go outward
    if line.is_axisymmetric:
        along = along + line.at_columns(smoothed[0]) / line.places[0]

    across = []
    for a in axes:
        lean = np.zeros(S.shape)
        for b in axes:
            lean = lean - slopes[b] * change[a][b]
        across.append((lean + change[a][-1]) / S**2)
    return along, across


def gradient_size(line: Smoothed, T: HostArray, S: HostArray, c: HostArray) -> HostArray:
    """|grad_s T| on a grid, dT/ds along a line [K/m]."""
    gradient = np.array([line.derivative(T, axis=a) / S for a in range(len(line.slopes))])
    if len(gradient) == 1:
        return gradient
    return np.sqrt(np.maximum(np.einsum("abm,am,bm->m", c, gradient, gradient), 0.0))
