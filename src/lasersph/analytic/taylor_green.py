"""Decaying vortices of Taylor and Green: an exact solution of the Navier-Stokes equations.

Square cells of counter-rotating vortices, of period `period` in both directions, k = 2 pi/period:

    u =  U sin(k x) cos(k z) exp(-2 nu k^2 t)
    w = -U cos(k x) sin(k z) exp(-2 nu k^2 t)
    p =  rho U^2/4 (cos(2 k x) + cos(2 k z)) exp(-4 nu k^2 t)

The convective terms are balanced by the pressure, so the vortices keep their shape. No fluid
crosses the lines x, z = n period/2, along which there is no shear either: a box of any whole number
of half periods from there has periodic or free-slip sides.

Taylor & Green, Proc. R. Soc. Lond. A 158 (1937) 499-521, in two dimensions.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class TaylorGreen:
    """Vortices of one amplitude and size.

    Args:
        speed: largest speed at t = 0, U [m/s]. period: of both directions [m].
        viscosity: kinematic, nu [m^2/s]. density: rho [kg/m^3].

    Raises:
        ValueError: a period or density that is not positive, or a negative viscosity.
    """

    speed: float
    period: float
    viscosity: float
    density: float = 1.0

    def __post_init__(self):
        if not (self.period > 0.0 and self.density > 0.0 and self.viscosity >= 0.0):
            raise ValueError("period and density must be positive, the viscosity not negative")

    @property
    def wave_number(self) -> float:
        """k = 2 pi/period [1/m]."""
        return 2.0 * np.pi / self.period

    @property
    def decay_rate(self) -> float:
        """Rate 2 nu k^2 at which velocities decay [1/s]; energies decay twice as fast."""
        return 2.0 * self.viscosity * self.wave_number**2

    @property
    def reynolds_number(self) -> float:
        """U period/nu; infinite without viscosity."""
        return self.speed * self.period / self.viscosity if self.viscosity else np.inf

    def velocity(self, position: ArrayLike, time: float = 0.0) -> Array:
        """u, w [m/s] at positions x, z (2, n) [m], (2, n)."""
        x, z = self.wave_number * np.asarray(position, float)
        # the derivatives of a stream function: free of divergence
        u, w = np.sin(x) * np.cos(z), -np.cos(x) * np.sin(z)
        return self.speed * np.exp(-self.decay_rate * time) * np.stack([u, w])

    def pressure(self, position: ArrayLike, time: float = 0.0) -> Array:
        """Pressure [Pa] of mean 0 at positions x, z (2, n) [m], (n,)."""
        x, z = 2.0 * self.wave_number * np.asarray(position, float)
        amplitude = 0.25 * self.density * self.speed**2 * np.exp(-2.0 * self.decay_rate * time)
        return amplitude * (np.cos(x) + np.cos(z))

    def kinetic_energy(self, time: ArrayLike) -> Array:
        """Kinetic energy of a volume, averaged over a period, rho U^2/4 at t = 0 [J/m^3]."""
        decay = np.exp(-2.0 * self.decay_rate * np.asarray(time, float))
        return 0.25 * self.density * self.speed**2 * decay
