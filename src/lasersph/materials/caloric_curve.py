"""Temperature, melt and vapor fraction and heat potential as functions of specific enthalpy.

    h = int_{T_0}^{T} c_p dT' + f_m L_f + f_v L_v,    P = int_{T_0}^{T} k dT'   (Kirchhoff)

stored as nodes between which T, P, f_m and f_v are linear in h. With constant properties the
nodes are the corners of [Demuth2020, eqs. (24)-(28)] and the curve is exact; else it is the
integral of c_p(T) and k(T) with ``temperature_error`` stated. Above the last and below the first
node the end segments continue; the last one is flat where T is held at the boiling point.

Left out: superheating and undercooling, pressure dependence.
Reference: [Demuth2020] Computation 8(1), 9.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class CaloricCurve:
    """Nodes of the curve (float64, shape (nodes,)) and what it was made from.

    ``plateau`` says what happens at the boiling point: "hold" and "clip" (T held there; "clip"
    only adds that a solver limits h to ``enthalpy_vaporized``) or "evaporate" (the liquid
    goes on). ``solidus``, ``liquidus``, ``vaporization`` [K] are None where there is no such
    change in this curve. ``temperature_error`` [K] bounds the distance between the polyline and
    the integral of c_p(T), for T and (as the distance in T that it is worth) for the potential.
    ``latent_heats`` of melting and of the vaporization plateau [J/kg], 0 where there is none.
    """

    enthalpy: Array
    temperature: Array
    potential: Array
    melt_fraction: Array
    vapor_fraction: Array
    initial_temperature: float
    plateau: str
    solidus: float | None
    liquidus: float | None
    vaporization: float | None
    enthalpy_vaporizing: float | None
    enthalpy_vaporized: float | None
    temperature_error: float
    latent_heats: tuple[float, float]

    def __post_init__(self) -> None:
        """Check that the nodes are usable and make them read-only."""
        arrays = (
            self.enthalpy,
            self.temperature,
            self.potential,
            self.melt_fraction,
            self.vapor_fraction,
        )
        if len({array.shape for array in arrays}) != 1 or self.enthalpy.size < 2:
            raise ValueError("a caloric curve needs at least two nodes, equally many everywhere")
        if np.any(np.diff(self.enthalpy) <= 0.0):
            raise ValueError("the enthalpy of a caloric curve must increase from node to node")
        for array in arrays:
            array.flags.writeable = False

    @property
    def tables(self) -> dict[str, Array]:
        """Nodes by the names that loops give them."""
        return {
            "h_nodes": self.enthalpy,
            "T_nodes": self.temperature,
            "P_nodes": self.potential,
            "m_nodes": self.melt_fraction,
            "v_nodes": self.vapor_fraction,
        }

    def temperature_at(self, enthalpy: ArrayLike) -> Array:
        """Temperature [K] at specific enthalpy [J/kg], any shape."""
        return self._linear(self.temperature, enthalpy)

    def potential_at(self, enthalpy: ArrayLike) -> Array:
        """Kirchhoff potential int_{T_0}^{T} k dT [W/m] at specific enthalpy [J/kg], any shape."""
        return self._linear(self.potential, enthalpy)

    def melt_fraction_at(self, enthalpy: ArrayLike) -> Array:
        """Molten mass fraction, 0 to 1, at specific enthalpy [J/kg], any shape; eq. (26)."""
        return np.clip(self._linear(self.melt_fraction, enthalpy), 0.0, 1.0)

    def vapor_fraction_at(self, enthalpy: ArrayLike) -> Array:
        """Share of L_v taken up, 0 to 1, at specific enthalpy [J/kg], any shape; eq. (27)."""
        return np.clip(self._linear(self.vapor_fraction, enthalpy), 0.0, 1.0)

    def enthalpy_at(self, temperature: ArrayLike) -> Array:
        """Specific enthalpy [J/kg] at temperature [K], any shape.

        On a plateau (melting point, boiling point) this is the lowest enthalpy of that
        temperature. Raises ValueError above a boiling point at which T is held.
        """
        values = np.asarray(temperature, dtype=np.float64)
        # above a boiling point that is held no temperature exists
        holds = self.vaporization is not None and self.plateau != "evaporate"
        if holds and np.any(values > self.temperature[-1]):
            raise ValueError(
                f"no enthalpy belongs to {np.max(values):g} K: the curve holds the boiling "
                f"temperature of {self.temperature[-1]:g} K (plateau = {self.plateau!r})"
            )
        # "left" finds the lower end of a plateau; beyond the last rise its segment goes on
        right = np.searchsorted(self.temperature, values, side="left")
        rising = np.flatnonzero(np.diff(self.temperature) > 0.0)
        right = np.clip(right, 1, rising[-1] + 1)
        low, high = self.temperature[right - 1], self.temperature[right]
        share = (values - low) / (high - low)
        left = self.enthalpy[right - 1]
        return left + share * (self.enthalpy[right] - left)

    def _linear(self, values: Array, enthalpy: ArrayLike) -> Array:
        """Interpolate node values in h, the end segments continued."""
        h = np.asarray(enthalpy, dtype=np.float64)
        # the segment around h, the first or last one beyond the ends
        right = np.clip(np.searchsorted(self.enthalpy, h, side="right"), 1, values.size - 1)
        low, high = self.enthalpy[right - 1], self.enthalpy[right]
        share = (h - low) / (high - low)
        return values[right - 1] + share * (values[right] - values[right - 1])
