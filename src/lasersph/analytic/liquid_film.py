"""Small deformation of a liquid film with a free surface, exact in time and in wave number.

Film -d < z < 0 over a wall, at rest at t = 0, no gravity; surface z = a(t) cos kx, n upward:

    wall           u = w = 0
    tangential     eta (du/dz + dw/dx) = d gamma/dx = -gamma' A k sin kx,     T_s = T_m + A cos kx
    normal         p - 2 eta dw/dz = gamma k^2 a cos kx + p_e cos kx
    kinematic      da/dt = w - m/rho,     m cos kx the mass flux that leaves

Transformed in time, w = W(z) cos kx, u = -W'/k sin kx, with q^2 = k^2 + s rho/eta:

    W = c_1 e^(kz) + c_2 e^(-k(z + d)) + c_3 e^(qz) + c_4 e^(-q(z + d))
    s a - a_0 = W(0) - m/(rho s)

and the pressure is that of the part in k, P = rho s U_k/k. The four conditions give c; Talbot's
contour goes back to time. Linear: a k and a/d are small. A drive that ends is the difference of two
that do not.

[Prosperetti1981] poses the problem, [Trefethen2006] gives the contour.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
NODES = 64
"""Of the contour: more let rounding grow, fewer see fewer waves; 1e-8 of the largest is left."""
LARGEST_PHASE = 20.0
"""Of a wave of the film without viscosity that the nodes resolve [rad], three periods; found by
comparison with 80 nodes."""


@dataclass(frozen=True)
class Drive:
    """Loads on the surface, each times cos kx, from `start` to `end` [s].

    Args:
        temperature: A [K]. pressure: p_e [Pa]. mass_flux: m [kg/(m^2 s)].
    """

    temperature: float = 0.0
    pressure: float = 0.0
    mass_flux: float = 0.0
    start: float = 0.0
    end: float = np.inf


@dataclass(frozen=True)
class LiquidFilm:
    """One film.

    Args:
        depth: d [m]. period: 2 pi/k [m]. density: [kg/m^3]. viscosity: dynamic, eta [Pa s].
        surface_tension: gamma [N/m]. surface_tension_slope: gamma' [N/(m K)].

    Raises:
        ValueError: depth, period, density or viscosity not positive.
    """

    depth: float
    period: float
    density: float
    viscosity: float
    surface_tension: float
    surface_tension_slope: float = 0.0

    def __post_init__(self):
        if not min(self.depth, self.period, self.density, self.viscosity) > 0.0:
            raise ValueError("depth, period, density and viscosity must be positive")

    @property
    def wave_number(self) -> float:
        """k = 2 pi/period [1/m]."""
        return 2.0 * np.pi / self.period

    @property
    def natural_frequency(self) -> float:
        """Of a wave without viscosity, omega^2 = gamma k^3 tanh(k d)/rho [1/s]."""
        k = self.wave_number
        return float(np.sqrt(self.surface_tension * k**3 * np.tanh(k * self.depth) / self.density))

    def amplitude(
        self, times: ArrayLike, drive: Drive | None = None, initial: float = 0.0
    ) -> Array:
        """a(t) [m], shape of `times` [s], from a wave of the amplitude `initial` [m] at rest.

        Raises:
            ValueError: a time at which a wave that swings has a phase beyond `LARGEST_PHASE`.
        """
        return self._in_time(times, drive, initial, lambda s, c, a: a)

    def velocity(
        self, times: ArrayLike, z: float, drive: Drive | None = None, initial: float = 0.0
    ) -> Array:
        """u at x = period/4 and height z [m] (0 at the surface, -d at the wall) [m/s]."""
        k = self.wave_number

        def at_height(s: NDArray, c: NDArray, a: NDArray) -> NDArray:
            return -np.sum(self._derivatives(s, z)[1] * c, axis=1) / k

        return self._in_time(times, drive, initial, at_height)

    def steady_amplitude(self, temperature: float) -> float:
        """a of a film under a lasting wave of temperature A [K], any B = kd, slow flow [m]."""
        B = self.wave_number * self.depth
        scale = self.surface_tension_slope * temperature / self.surface_tension / self.wave_number
        return scale * 2.0 * B**2 / (np.sinh(2.0 * B) - 2.0 * B)

    def levelling_rate(self) -> float:
        """Rate at which a wave levels without inertia [1/s] [Orchard1963]."""
        k, B = self.wave_number, self.wave_number * self.depth
        share = (np.sinh(B) * np.cosh(B) - B) / (np.cosh(B) ** 2 + B**2)
        return self.surface_tension * k / (2.0 * self.viscosity) * share

    def _in_time(self, times, drive, initial, of):
        drive, times = drive or Drive(), np.asarray(times, float)
        frequency, diffusion = self.natural_frequency, self.viscosity / self.density
        # a film whose viscosity damps the first wave does not swing
        is_wave = frequency > diffusion * (0.5 * np.pi / self.depth) ** 2
        if is_wave and frequency * np.max(times, initial=0.0) > LARGEST_PHASE:
            raise ValueError(f"times must be at most {LARGEST_PHASE / frequency:.3g} s")
        values = np.zeros(times.shape)

        # a drive that ends: the same drive from its start, less that from its end
        for switch, sign in ((drive.start, 1.0), (drive.end, -1.0)):
            late = times > switch
            s, weights = talbot(times[late] - switch)
            c, a = self._transform(s.ravel(), drive, 0.0)
            values[late] += (
                sign * np.sum(weights * of(s.ravel(), c, a).reshape(s.shape), axis=1).real
            )
        # the wave at the start by itself, without a drive
        if initial:
            late = times > 0.0
            s, weights = talbot(times[late])
            c, a = self._transform(s.ravel(), Drive(), initial)
            values[late] += np.sum(weights * of(s.ravel(), c, a).reshape(s.shape), axis=1).real
        return values

    def _derivatives(self, s: NDArray, z: float) -> list[NDArray]:
        """The four parts of W at z and their first and second derivatives, (nodes, 4) each."""
        k, d = self.wave_number, self.depth
        # W = c_1 e^(kz) + c_2 e^(-k(z + d)) + c_3 e^(qz) + c_4 e^(-q(z + d))
        q = np.sqrt(k**2 + s * self.density / self.viscosity)
        k = np.full_like(q, k)
        rate = np.stack([k, -k, q, -q], axis=1)
        height = np.array([z, z + d, z, z + d])
        part = np.exp(rate * height)
        return [part, rate * part, rate**2 * part]

    def _transform(self, s: NDArray, drive: Drive, initial: float) -> tuple[NDArray, NDArray]:
        """Coefficients c (nodes, 4) and a (nodes,) of the transform."""
        k, mu, rho = self.wave_number, self.viscosity, self.density
        gamma = self.surface_tension * k**2
        # rows of the four conditions: W = 0 and W' = 0 at the wall, tangential, normal
        wall, top = self._derivatives(s, -self.depth), self._derivatives(s, 0.0)
        # eta (U' - k W) = tau, with U = -W'/k
        tangential = -mu * (top[2] / k + k * top[0])
        # p of the part in k, less the shares of viscosity and surface, s a = a_0 + W - m/(rho s)
        pressure = np.where([True, True, False, False], -rho * s[:, None] * top[1] / k**2, 0.0)
        normal = pressure - 2.0 * mu * top[1] - gamma * top[0] / s[:, None]
        tau = -self.surface_tension_slope * k * drive.temperature / s
        prescribed = (initial - drive.mass_flux / (rho * s)) / s
        right = np.stack([0.0 * s, 0.0 * s, tau, drive.pressure / s + gamma * prescribed], axis=1)
        matrix = np.stack([wall[0], wall[1], tangential, normal], axis=1)
        # rows of one size, since their units differ by orders of magnitude
        scale = np.max(np.abs(matrix), axis=2)
        c = np.linalg.solve(matrix / scale[:, :, None], (right / scale)[:, :, None])[:, :, 0]
        return c, np.sum(top[0] * c, axis=1) / s + prescribed


def talbot(times: Array) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Nodes s and weights, (times, nodes): f(t) = Re sum weights F(s) [Trefethen2006]."""
    theta = np.pi * (2.0 * np.arange(NODES) + 1.0) / NODES - np.pi
    a, b = 0.6407, 0.2645
    # the cotangent contour with the constants of [Trefethen2006] and its derivative
    contour = 0.5017 * theta / np.tan(a * theta) - 0.6122 + 1j * b * theta
    slope = 0.5017 / np.tan(a * theta) - 0.5017 * a * theta / np.sin(a * theta) ** 2 + 1j * b
    s = NODES / np.asarray(times, float)[:, None] * contour
    return s, np.exp(NODES * contour) * slope * s / (1j * contour) / NODES
