"""Slow flow in a liquid layer whose surface temperature varies like a cosine.

Layer -b < z < 0 over a wall, flat free surface z = 0 at T_s = mean + dT cos(k x), no inertia:

    u = w = 0 at z = -b;   w = 0 and eta du/dz = gamma' dT_s/dx at z = 0;   gamma' = dgamma/dT

With the stream function psi = f(z) sin(k x), u = f' sin(k x), w = -k f cos(k x), f'''' - 2 k^2 f''
+ k^4 f = 0 gives, B = k b,

    f = c z cosh(k z) + (d + a z) sinh(k z)
    a = -gamma' dT/(2 eta),  c = a sinh^2 B/(sinh B cosh B - B),  d = b (a - c coth B)
    u(0) = U_s sin(k x),   U_s = -(gamma' dT/eta) (sinh^2 B - B^2)/(sinh 2B - 2B)
    p = -2 eta k (c cosh(k z) + a sinh(k z)) cos(k x)

Deep layer: U_s -> -gamma' dT/(2 eta); shallow: U_s -> -gamma' dT B/(4 eta), the flow of a closed
channel under a uniform gradient. Left out: inertia, a gas above, a surface that yields.

The limit of one layer of Pendse & Esmaeeli, Int. J. Therm. Sci. 49 (2010) 1147-1155.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ThermocapillaryLayer:
    """Flow of one layer.

    Args:
        depth: b [m]. period: of the temperature, 2 pi/k [m]. amplitude: dT [K], hot at x = 0.
        surface_tension_slope: gamma' = dgamma/dT [N/(m K)]. viscosity: dynamic, eta [Pa s].

    Raises:
        ValueError: depth, period or viscosity not positive.
    """

    depth: float
    period: float
    amplitude: float
    surface_tension_slope: float
    viscosity: float

    def __post_init__(self):
        if not (self.depth > 0.0 and self.period > 0.0 and self.viscosity > 0.0):
            raise ValueError("depth, period and viscosity must be positive")

    @property
    def wave_number(self) -> float:
        """k = 2 pi/period [1/m]."""
        return 2.0 * np.pi / self.period

    @property
    def surface_speed(self) -> float:
        """U_s [m/s]: u(x, 0) = U_s sin(k x); positive where warm fluid is pulled to the cold."""
        _, c, d = self._constants()
        return c + self.wave_number * d

    def velocity(self, position: ArrayLike) -> Array:
        """u, w [m/s] at positions x, z (2, n) [m], (2, n)."""
        k = self.wave_number
        x, z = np.asarray(position, float)
        a, c, d = self._constants()
        sinh, cosh = np.sinh(k * z), np.cosh(k * z)
        # u = f' sin(k x), w = -k f cos(k x)
        f = c * z * cosh + (d + a * z) * sinh
        slope = (c + k * d) * cosh + a * sinh + k * z * (c * sinh + a * cosh)
        return np.stack([slope * np.sin(k * x), -k * f * np.cos(k * x)])

    def pressure(self, position: ArrayLike) -> Array:
        """Pressure [Pa] of mean 0 at positions x, z (2, n) [m], (n,)."""
        k = self.wave_number
        x, z = np.asarray(position, float)
        a, c, _ = self._constants()
        return -2.0 * self.viscosity * k * (c * np.cosh(k * z) + a * np.sinh(k * z)) * np.cos(k * x)

    def _constants(self) -> tuple[float, float, float]:
        """a, c [m/s] and d [m^2/s] of f(z) = c z cosh + (d + a z) sinh."""
        B = self.wave_number * self.depth
        sinh, cosh = np.sinh(B), np.cosh(B)
        # stress at the surface gives a; no flow at the wall c and d
        a = -self.surface_tension_slope * self.amplitude / (2.0 * self.viscosity)
        c = a * sinh**2 / (sinh * cosh - B)
        return a, c, self.depth * (a - c * cosh / sinh)
