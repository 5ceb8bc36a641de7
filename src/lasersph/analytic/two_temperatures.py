"""Electrons and lattice with constant coefficients, or C_e = gamma T_e without space.

    C_e dT_e/dt = k T_e'' - G (T_e - T_l) + S,    C_l dT_l/dt = G (T_e - T_l)      [Anisimov1974]

Without space and with constant capacities the difference decays with the rate G (1/C_e + 1/C_l).
With C_e = gamma T_e the time is a closed function of T_e. In a half space with an insulated surface
and S = F alpha exp(-alpha z) g(t) the Laplace transform of the electrons' rise is

    T_e = g F alpha / (p - k alpha^2) [exp(-alpha z) - alpha/q exp(-q z)],   T_l = T_e/(1 + s C_l/G)
    p = s (C_e + C_l/(1 + s C_l/G)),    q = sqrt(p/k)

inverted in two ways: along the imaginary axis, where the transform of a Gaussian pulse decays as
one (`pulse_rise`), and that of an instant pulse along Talbot's contour, folded with the pulse
(`folded_rise`) [Trefethen2006]. Left out: a conducting lattice, phase change.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

Array = NDArray[np.float64]

CONTOUR = 48
"""Points of Talbot's contour: more lose digits to rounding, fewer to the contour."""
DECAYED = 8.0
"""Standard deviations of a Gaussian beyond which it is nothing, 1e-14."""


def constant_exchange(
    time: ArrayLike, T_e: float, T_l: float, C_e: float, C_l: float, coupling: float
) -> tuple[Array, Array]:
    """T_e and T_l [K] after times [s] of exchange alone, both capacities constant.

    Args:
        T_e, T_l: at the start [K]. C_e, C_l: [J/(m^3 K)]. coupling: G [W/(m^3 K)].
    """
    # the mean stays, the difference decays
    mean = (C_e * T_e + C_l * T_l) / (C_e + C_l)
    decay = np.exp(-coupling * (1.0 / C_e + 1.0 / C_l) * np.asarray(time, np.float64))
    left = (T_e - T_l) * decay
    return mean + C_l / (C_e + C_l) * left, mean - C_e / (C_e + C_l) * left


def linear_exchange(
    time: ArrayLike, T_e: float, T_l: float, gamma: float, C_l: float, coupling: float
) -> tuple[Array, Array]:
    """The same with C_e = gamma T_e, from electrons hotter than the lattice.

    t = (2 C_l/G) / (r + q) { r ln[(T_0 - r)/(T - r)] + q ln[(T_0 + q)/(T + q)] }

    with the final temperature r and q = r + 2 C_l/gamma, which are the roots of T_e = T_l at the
    energy U = gamma T_0^2/2 + C_l T_l.

    Args:
        gamma: [J/(m^3 K^2)]. The others as in `constant_exchange`.
    """
    energy = 0.5 * gamma * T_e * T_e + C_l * T_l
    root = np.sqrt((C_l / gamma) ** 2 + 2.0 * energy / gamma)
    r, q = root - C_l / gamma, root + C_l / gamma

    def elapsed(excess: float) -> float:
        """Time at which T_e is above its end by exp(excess)."""
        T = r + np.exp(excess)
        logs = r * (np.log(T_e - r) - excess) + q * np.log((T_e + q) / (T + q))
        return 2.0 * C_l / coupling / (r + q) * logs

    # the root for each time, in the logarithm of what is left
    start = np.log(T_e - r)
    found = [
        r + np.exp(_root(lambda x, t=t: elapsed(x) - t, start - 200.0, start)) if t > 0.0 else T_e
        for t in np.ravel(np.asarray(time, np.float64))
    ]
    hot = np.reshape(np.array(found), np.shape(time))
    return hot, (energy - 0.5 * gamma * hot * hot) / C_l


def _root(function: Callable[[float], float], low: float, high: float) -> float:
    """Root of a function between two places of different sign, to rounding."""
    return float(brentq(function, low, high, xtol=1e-14))  # pyright: ignore[reportArgumentType]


@dataclass(frozen=True)
class HalfSpace:
    """A half space with constant coefficients under light.

    Attributes:
        C_e, C_l: [J/(m^3 K)]. coupling: G [W/(m^3 K)]. conductivity: of the electrons [W/(m K)].
        alpha: absorption coefficient [1/m]. fluence: absorbed [J/m^2]. fwhm, center: of the
            Gaussian pulse [s].
    """

    C_e: float
    C_l: float
    coupling: float
    conductivity: float
    alpha: float
    fluence: float
    fwhm: float
    center: float

    @property
    def sigma(self) -> float:
        """Standard deviation of the pulse [s]."""
        return self.fwhm / (2.0 * np.sqrt(2.0 * np.log(2.0)))

    def transforms(self, depth: float, s: NDArray[Any]) -> tuple[NDArray, NDArray]:
        """Laplace transforms of the rises of T_e and T_l by an instant pulse at t = 0 [K s]."""
        delay = 1.0 + s * self.C_l / self.coupling
        p = s * (self.C_e + self.C_l / delay)
        q = np.sqrt(p / self.conductivity)
        profile = np.exp(-self.alpha * depth) - self.alpha / q * np.exp(-q * depth)
        electrons = self.fluence * self.alpha / (p - self.conductivity * self.alpha**2) * profile
        return electrons, electrons / delay


def pulse_rise(depth: float, time: ArrayLike, body: HalfSpace, points: int = 40001) -> tuple:
    """Rises of T_e and T_l [K] at a depth [m], shape of `time` [s]: along a line beside the
    imaginary axis, where the pulse's transform is exp(-s t_0 + s^2 sigma^2/2)."""
    t = np.atleast_1d(np.asarray(time, np.float64))
    # the line lies to the right of the pole at 0 by a tenth of the time that is looked at
    shift = 1.0 / max(float(np.max(t)), body.sigma)
    omega = np.linspace(0.0, DECAYED / body.sigma, points)
    s = shift + 1j * omega
    pulse = np.exp(-s * body.center + 0.5 * (s * body.sigma) ** 2)
    weight = np.full(points, omega[1])
    weight[[0, -1]] *= 0.5
    kernel = np.exp(np.outer(t, s)) * pulse * weight / np.pi
    return tuple(
        np.reshape((kernel @ part).real, np.shape(time)) for part in body.transforms(depth, s)
    )


def folded_rise(depth: float, time: ArrayLike, body: HalfSpace, points: int = 400) -> tuple:
    """The same rises: those by an instant pulse, along Talbot's contour, folded with the pulse."""
    found = np.array([_folded(depth, float(t), body, points) for t in np.ravel(time)])
    return tuple(np.reshape(column, np.shape(time)) for column in found.T)


def _folded(depth: float, time: float, body: HalfSpace, points: int) -> tuple[float, float]:
    """Both rises at one time."""
    # what came `elapsed` ago, in its square root: the rise of T_e begins steeply
    longest = time - body.center + DECAYED * body.sigma
    if longest <= 0.0:
        return 0.0, 0.0
    x, w = np.polynomial.legendre.leggauss(points)
    root = 0.5 * np.sqrt(longest) * (x + 1.0)
    elapsed, weight = root**2, np.sqrt(longest) * w * root
    power = np.exp(-0.5 * ((time - elapsed - body.center) / body.sigma) ** 2)
    power /= np.sqrt(2.0 * np.pi) * body.sigma
    # Talbot's contour N/t (0.5017 theta cot(0.6407 theta) - 0.6122 + 0.2645 i theta)
    theta = (2.0 * np.arange(CONTOUR) + 1.0) * np.pi / CONTOUR - np.pi
    cotangent, sine = 1.0 / np.tan(0.6407 * theta), np.sin(0.6407 * theta)
    shape = 0.5017 * theta * cotangent - 0.6122 + 0.2645j * theta
    slope = 0.5017 * cotangent - 0.5017 * 0.6407 * theta / sine**2 + 0.2645j
    scale = CONTOUR / elapsed[:, None]
    kernel = np.exp(CONTOUR * shape) * slope * scale / (1j * CONTOUR)
    parts = body.transforms(depth, scale * shape)
    rises = [(kernel * part).sum(axis=1).real for part in parts]
    return tuple(float(np.sum(weight * power * rise)) for rise in rises)  # type: ignore[return-value]
