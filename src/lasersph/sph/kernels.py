"""Smoothing kernels, written with the support radius l.

    W(r, l) = sigma / l^d * f(s),    dW/dr = sigma / l^(d+1) * f'(s),    s = r / l

f is zero from s = 1 on. The papers' smoothing length h relates to l by l = 2 h (cubic spline and
Wendland C2) and l = 3 h (quintic spline).

References: cubic spline [Monaghan1992], normalized as in the corrected eq. (11) of [Alshaer2017];
quintic spline [Morris1996; Demuth2020, eqs. (39)-(41)]; Wendland C2 [Wendland1995; Dehnen2012].
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi

from lasersph.particles.lattice import KernelName


@dataclass(frozen=True)
class Kernel:
    """A kernel in a number of dimensions.

    Attributes:
        sigma: normalization, so that W integrates to 1.
        shape, slope: f(s) and f'(s) [1], plain functions for s >= 0.
        support_ratio: usual l / spacing of this kernel.
    """

    name: str
    dimension: int
    sigma: float
    shape: Callable[[float], float]
    slope: Callable[[float], float]
    support_ratio: float

    def value(self, r: float, support: float) -> float:
        """W [1/m^d] at distance r [m] for the support radius `support` [m]."""
        return self.sigma / support**self.dimension * self.shape(r / support)

    def derivative(self, r: float, support: float) -> float:
        """dW/dr [1/m^(d+1)] at distance r [m] for the support radius `support` [m]."""
        return self.sigma / support ** (self.dimension + 1) * self.slope(r / support)


def cubic_spline(s):
    """f(s) = 1 - 6 s^2 + 6 s^3 for s < 1/2, 2 (1 - s)^3 below 1: q = 2 s in the usual notation."""
    outer = max(1.0 - s, 0.0)
    inner = max(0.5 - s, 0.0)
    return 2.0 * outer**3 - 8.0 * inner**3


def cubic_spline_slope(s):
    """Derivative of `cubic_spline`."""
    outer = max(1.0 - s, 0.0)
    inner = max(0.5 - s, 0.0)
    return -6.0 * outer**2 + 24.0 * inner**2


def quintic_spline(s):
    """f(s) = (1 - s)_+^5 - 6 (2/3 - s)_+^5 + 15 (1/3 - s)_+^5 [Demuth2020, eq. (39)]."""
    outer = max(1.0 - s, 0.0)
    middle = max(2.0 / 3.0 - s, 0.0)
    inner = max(1.0 / 3.0 - s, 0.0)
    return outer**5 - 6.0 * middle**5 + 15.0 * inner**5


def quintic_spline_slope(s):
    """Derivative of `quintic_spline` [Demuth2020, eq. (41) with the minus sign that print lost]."""
    outer = max(1.0 - s, 0.0)
    middle = max(2.0 / 3.0 - s, 0.0)
    inner = max(1.0 / 3.0 - s, 0.0)
    return -5.0 * (outer**4 - 6.0 * middle**4 + 15.0 * inner**4)


def wendland_c2(s):
    """f(s) = (1 - s)^4 (1 + 4 s) in 2-D and 3-D."""
    outer = max(1.0 - s, 0.0)
    return outer**4 * (1.0 + 4.0 * s)


def wendland_c2_slope(s):
    """Derivative of `wendland_c2`."""
    outer = max(1.0 - s, 0.0)
    return -20.0 * s * outer**3


def wendland_c2_line(s):
    """f(s) = (1 - s)^3 (1 + 3 s), the C2 function of the family in 1-D."""
    outer = max(1.0 - s, 0.0)
    return outer**3 * (1.0 + 3.0 * s)


def wendland_c2_line_slope(s):
    """Derivative of `wendland_c2_line`."""
    outer = max(1.0 - s, 0.0)
    return -12.0 * s * outer**2


# sigma by dimension, so that the integral of W over its support is 1
_CUBIC = {1: 4.0 / 3.0, 2: 40.0 / (7.0 * pi), 3: 8.0 / pi}
_QUINTIC = {1: 243.0 / 40.0, 2: 15309.0 / (478.0 * pi), 3: 2187.0 / (40.0 * pi)}
_WENDLAND = {1: 5.0 / 4.0, 2: 7.0 / pi, 3: 21.0 / (2.0 * pi)}


def kernel(name: KernelName, dimension: int) -> Kernel:
    """Kernel by name in 1, 2 or 3 dimensions.

    Raises:
        ValueError: an unknown name or dimension.
    """
    if dimension not in (1, 2, 3):
        raise ValueError(f"dimension must be 1, 2 or 3, not {dimension}")
    # the last number is the usual support over the spacing: h = 1.5 dx, quintic h = 1.25 dx
    if name == "cubic-spline":
        sigma = _CUBIC[dimension]
        return Kernel(name, dimension, sigma, cubic_spline, cubic_spline_slope, 3.0)
    if name == "quintic-spline":
        sigma = _QUINTIC[dimension]
        return Kernel(name, dimension, sigma, quintic_spline, quintic_spline_slope, 3.75)
    if name == "wendland-c2":
        # the C2 function of the family depends on the dimension
        line = dimension == 1
        shape = wendland_c2_line if line else wendland_c2
        slope = wendland_c2_line_slope if line else wendland_c2_slope
        return Kernel(name, dimension, _WENDLAND[dimension], shape, slope, 3.0)
    raise ValueError(f"no kernel {name!r}; there are cubic-spline, quintic-spline, wendland-c2")
