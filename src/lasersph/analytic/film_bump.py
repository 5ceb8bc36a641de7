"""Small deformation of a liquid film around an axis: a bump, or what a bump of temperature raises.

A bump exp(-r^2/w^2) is a sum of waves J_0(kr), each of which moves as cos kx does [LiquidFilm]:

    exp(-r^2/w^2) = int (w^2/2) exp(-k^2 w^2/4) J_0(kr) k dk
    eta(r, t) = int (w^2/2) exp(-k^2 w^2/4) a_k(t) J_0(kr) k dk

with a_k the height of a wave under a drive, or from a height, of amplitude 1 cos kx.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lasersph.analytic.liquid_film import Drive, LiquidFilm

Array = NDArray[np.float64]
WAVES = 48
"""Wave numbers of the integral. Accuracy: 24 change no height by 1e-6 of the largest."""
LARGEST = 7.0
"""Largest wave number times w. Accuracy: exp(-49/4) is 5e-6."""


@dataclass(frozen=True)
class FilmBump:
    """A film whose surface a bump of radius w drives, or starts from.

    Args:
        film: the liquid and its depth; its period is not used. radius: w [m].
    """

    film: LiquidFilm
    radius: float

    def heights(
        self,
        r: ArrayLike,
        times: ArrayLike,
        drive: Drive | None = None,
        initial: float = 0.0,
    ) -> Array:
        """eta [m], shape (times, r), at distances r from the axis [m].

        Args:
            times: (times,) [s]. drive: amplitudes of bumps in place of waves. initial: height of
                the bump at rest at the start [m].

        Raises:
            ValueError: a time at which the shortest wave is not resolved.
        """
        from scipy.special import j0

        # Gauss and Legendre between k = 0 and where nothing is left of the bump
        nodes, weights = np.polynomial.legendre.leggauss(WAVES)
        k = 0.5 * LARGEST / self.radius * (nodes + 1.0)
        weights = 0.5 * LARGEST / self.radius * weights

        # share of each wave, its height in time, and where it stands
        w = self.radius
        share = weights * 0.5 * w**2 * np.exp(-0.25 * (k * w) ** 2) * k
        films = (replace(self.film, period=2.0 * np.pi / one) for one in k)
        height = np.array([one.amplitude(times, drive, initial) for one in films])
        return np.einsum("k,kt,kr->tr", share, height, j0(np.outer(k, np.asarray(r, float))))
