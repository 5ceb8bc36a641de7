"""A caloric curve beyond its ends, with slopes that Newton's method does not cycle on."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
FARTHEST = 1e8
"""To which the last segment of a short curve goes on [J/kg]: ten times what makes metal vapor."""


class ExtendedCurve:
    """Piecewise-linear functions of enthalpy, their end segments extended, to `most` at least.

    Args:
        enthalpy, temperature, potential, melt_fraction: (n,) nodes [J/kg, K, W/m, 1].

    Attributes:
        nodes: with the end of the last segment [J/kg].
    """

    def __init__(
        self,
        enthalpy: ArrayLike,
        temperature: ArrayLike,
        potential: ArrayLike,
        melt_fraction: ArrayLike,
        most: float = FARTHEST,
    ) -> None:
        h = np.asarray(enthalpy, float)
        theta = _slanted(np.asarray(potential, float))
        far = h[-1] + max(1e3 * (h[-1] - h[0]), most)
        self.nodes = np.append(h, far)
        self.columns: dict[str, Array] = {}
        for name, values in (("T", temperature), ("theta", theta), ("f", melt_fraction)):
            v = np.asarray(values, float)
            last = v[-1] + (v[-1] - v[-2]) / (h[-1] - h[-2]) * (far - h[-1])
            self.columns[name] = np.append(v, last if name != "f" else v[-1])
        self.slope = self._slopes(self.columns["theta"])
        self.heating = self._slopes(self.columns["T"])

    def temperature(self, h: Array) -> Array:
        """T at enthalpies [K]."""
        return np.interp(h, self.nodes, self.columns["T"])

    def potential(self, h: Array) -> Array:
        """Theta there [W/m]."""
        return np.interp(h, self.nodes, self.columns["theta"])

    def melt_fraction(self, h: Array) -> Array:
        """Fraction that is liquid there."""
        return np.interp(h, self.nodes, self.columns["f"])

    def potential_slope(self, h: Array) -> Array:
        """d theta/dh there [kg/(m s)]."""
        return self.slope[self.nodes.searchsorted(h, side="right")]

    def temperature_slope(self, h: Array) -> Array:
        """dT/dh there [K kg/J]."""
        return self.heating[self.nodes.searchsorted(h, side="right")]

    def _slopes(self, values: Array) -> Array:
        """Slope of each segment after its first node, and before the first and after the last."""
        inside = np.diff(values) / np.diff(self.nodes)
        return np.concatenate([inside[:1], inside, inside[-1:]])


def _slanted(potential: Array, share: float = 0.02) -> Array:
    """The potential with flat inner segments given a slight slope, as over a narrow melting range:
    Newton's method cycles on isothermal melting. A flat last segment (boiling) stays."""
    theta = potential.copy()
    for k in range(1, theta.size - 2):
        if potential[k + 1] == potential[k]:
            theta[k] -= share * (potential[k] - potential[k - 1])
            theta[k + 1] += share * (potential[k + 2] - potential[k + 1])
    return theta
