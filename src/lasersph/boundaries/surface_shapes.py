"""Heights that vary along a surface, at a place and in the mean over a column or a ring.

    wave    amplitude cos(2 pi x / period), on a body times cos(2 pi y / period_y)
    bump    amplitude exp(-r^2 / radius^2)
    cap     sqrt(R^2 - r^2) - (R - h) for r < R_0, else 0, with R = (R_0^2 + h^2)/(2 h)

r is |x|, on a body sqrt(x^2 + y^2). A column is a cell of a plane section or of a body. A ring is
one of a section (r, z), in whose mean each height counts by r. A cap is written with its curvature
c = 1/R, which has no difference of two large numbers: h - c r^2/(1 + q), q = sqrt(1 - c^2 r^2).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from itertools import product
from math import exp, inf, pi, sqrt

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
BUMP_SLOPE = sqrt(2.0) * exp(-0.5)
"""Largest slope of exp(-s^2), at s = sqrt(1/2). Derivation: where its second derivative is 0."""
SERIES = (1 / 6, 1 / 40, 1 / 112, 5 / 1152, 7 / 2816)
"""Of int 1 - sqrt(1 - u^2) du over u^3, in powers of u^2. Derivation: the binomial series."""
SERIES_BELOW = 0.1
"""u up to which it is used. Accuracy: the next term is 1e-12 of the sum there."""

NODES = 8
"""Nodes of the mean over a column, along each axis. Rounding: a wave of two columns is exact to
1e-12; of a cap's rim 1e-3 of a column is left."""


class SurfaceShape(ABC):
    """A quantity along a surface, here called its height."""

    extent = 0.0
    """Radius within which it lies about r = 0 [m]; 0 where it goes on."""

    @abstractmethod
    def at(self, x: Array, y: Array | float = 0.0) -> Array:
        """Height at x and y [m], any shape."""

    def mean_over_columns(self, places: tuple[Array, Array], widths: tuple[float, float]) -> Array:
        """Mean height over the columns of a body around places along x and y [m], any shape.

        By Gauss and Legendre with `NODES` along each axis.
        """
        node, weight = np.polynomial.legendre.leggauss(NODES)
        found = np.zeros(places[0].shape)
        for (a, b), share in zip(
            product(0.5 * node, repeat=2), np.outer(weight, weight).ravel() / 4.0, strict=True
        ):
            found += share * self.at(places[0] + a * widths[0], places[1] + b * widths[1])
        return found

    @abstractmethod
    def mean(self, low: Array, high: Array, *, is_ring: bool) -> Array:
        """Mean height over columns or rings from `low` to `high` [m], any shape."""

    @property
    @abstractmethod
    def lowest(self) -> float:
        """Least height, and no more than 0."""

    @property
    @abstractmethod
    def steepest(self) -> float:
        """Largest slope."""


@dataclass(frozen=True)
class Wave(SurfaceShape):
    """Amplitude at x = 0, period along x, and along y where it varies there [m]."""

    amplitude: float
    period: float
    period_y: float | None = None

    def at(self, x: Array, y: Array | float = 0.0) -> Array:
        """Height at x and y [m], any shape."""
        along_x = self.amplitude * np.cos(2.0 * pi * x / self.period)
        if self.period_y is None:
            return along_x + 0.0 * y
        return along_x * np.cos(2.0 * pi * y / self.period_y)

    def mean(self, low: Array, high: Array, *, is_ring: bool = False) -> Array:
        """Mean height over columns; along r there is no period."""
        # the mean of a cosine over a width is the cosine times sinc
        return np.sinc((high - low) / self.period) * self.at(0.5 * (low + high))

    @property
    def lowest(self) -> float:
        """Least height, and no more than 0."""
        return -abs(self.amplitude)

    @property
    def steepest(self) -> float:
        """Largest slope."""
        return 2.0 * pi * abs(self.amplitude) / min(self.period, self.period_y or inf)


@dataclass(frozen=True)
class Bump(SurfaceShape):
    """Amplitude at r = 0, and radius [m] at which it has fallen to 1/e."""

    amplitude: float
    radius: float

    @property
    def extent(self) -> float:
        """Radius within which most of it lies [m]."""
        return self.radius

    def at(self, x: Array, y: Array | float = 0.0) -> Array:
        """Height at x and y [m], any shape."""
        return (
            self.amplitude * np.exp(-((x / self.radius) ** 2)) * np.exp(-((y / self.radius) ** 2))
        )

    def mean(self, low: Array, high: Array, *, is_ring: bool) -> Array:
        """Mean height over columns or rings from `low` to `high` [m], any shape."""
        a, b = low / self.radius, high / self.radius
        # int exp(-s^2) 2 s ds of a ring, int exp(-s^2) ds of a column
        if is_ring:
            share = np.exp(-(a**2)) * -np.expm1(a**2 - b**2) / (b**2 - a**2)
        else:
            from scipy.special import erf  # reading a case needs no SciPy

            share = 0.5 * sqrt(pi) * (erf(b) - erf(a)) / (b - a)
        return self.amplitude * share

    @property
    def lowest(self) -> float:
        """Least height, and no more than 0."""
        return min(self.amplitude, 0.0)

    @property
    def steepest(self) -> float:
        """Largest slope."""
        return BUMP_SLOPE * abs(self.amplitude) / self.radius


@dataclass(frozen=True)
class Cap(SurfaceShape):
    """Height at r = 0 [m], negative for a hollow, and radius of the disc below it [m], larger."""

    height: float
    radius: float

    @property
    def extent(self) -> float:
        """Radius of its disc [m]."""
        return self.radius

    @property
    def curvature(self) -> float:
        """c = 1/R of the sphere [1/m], with the sign of the height."""
        return 2.0 * self.height / (self.radius**2 + self.height**2)

    def at(self, x: Array, y: Array | float = 0.0) -> Array:
        """Height at x and y [m], any shape."""
        r, c = np.minimum(np.hypot(x, y), self.radius), self.curvature
        return self.height - c * r**2 / (1.0 + np.sqrt(1.0 - (c * r) ** 2))

    def mean(self, low: Array, high: Array, *, is_ring: bool) -> Array:
        """Mean height over columns or rings from `low` to `high` [m], any shape."""
        # of what lies over the disc, spread over the whole column or ring
        a, b = np.clip(low, -self.radius, self.radius), np.clip(high, -self.radius, self.radius)
        if is_ring:
            return (self._over_disc(b) - self._over_disc(a)) / (high**2 - low**2)
        return (self._over_line(b) - self._over_line(a)) / (high - low)

    def _over_disc(self, r: Array) -> Array:
        """Integral of the height with 2 r dr from the axis to r [m^3]."""
        c = self.curvature
        q = np.sqrt(1.0 - (c * r) ** 2)
        return self.height * r**2 - c * r**4 * (1.0 + 2.0 * q) / (3.0 * (1.0 + q) ** 2)

    def _over_line(self, x: Array) -> Array:
        """Integral of the height with dx from the axis to x [m^2]."""
        c = self.curvature
        u = c * x
        # int 1 - sqrt(1 - u^2) du, by its series where the closed form would be a difference
        if abs(c) * self.radius < SERIES_BELOW:
            terms = np.polynomial.polynomial.polyval(u**2, SERIES)
            return self.height * x - c * x**3 * terms
        sagged = u - 0.5 * (u * np.sqrt(1.0 - u**2) + np.arcsin(u))
        return self.height * x - sagged / c**2

    @property
    def lowest(self) -> float:
        """Least height, and no more than 0."""
        return min(self.height, 0.0)

    @property
    def steepest(self) -> float:
        """Largest slope, at the rim."""
        slope = abs(self.curvature) * self.radius
        return slope / sqrt(1.0 - slope**2)
