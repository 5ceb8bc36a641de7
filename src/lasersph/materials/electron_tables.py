"""Tables of the electrons and of the lattice that they leave, for the loops of a run.

    e(T_e) = int_{T_0}^{T_e} C_e dT / rho,       h_l(T) = h(T) - e(T)

A measured heat capacity is that of both, so that the lattice has the metal's enthalpy less the
electrons' at the same temperature: where both are equal, all is as with one temperature. Where C_e
would take more than half of it (far above boiling), the lattice keeps the other half. Of the heat
potential P the lattice has the share that the metal's file states.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lasersph.materials.caloric_curve import CaloricCurve
from lasersph.materials.material import Material
from lasersph.materials.sections import Electrons

Array = NDArray[np.float64]

WIDEST = 25.0
"""Widest segment of the lattice's curve [K]. Accuracy: e(T) bends by 0.01 K there."""
TOP = 2.0e4
"""Temperature up to which the lattice's curve is cut so, where nothing holds it below [K]."""
LEAST_SHARE = 0.5
"""Share of the heat capacity that the lattice keeps, at least. Guard: C_e of iron would take all
of it at 10 000 K, where the metal is no liquid any more."""
FINEST = 129
"""Nodes of a law that is a formula."""


@dataclass(frozen=True, eq=False)
class ElectronTables:
    """Nodes between which C_e, G, T and k are linear.

    Attributes:
        temperature, capacity, energy: (nodes,) T_e [K], C_e/rho [J/(kg K)] and e [J/kg].
        coupling_temperature, coupling: nodes of G(T_e) [K], [W/(m^3 K)].
        enthalpy, lattice_temperature, potential, melt_fraction, vapor_fraction: of the lattice's
            curve, as those of `CaloricCurve`; the potential is the lattice's part.
        conductivity: (nodes of the curve,) of the electrons where both temperatures are equal
            [W/(m K)]. hottest: highest temperature that the laws know [K].
    """

    temperature: Array
    capacity: Array
    energy: Array
    coupling_temperature: Array
    coupling: Array
    enthalpy: Array
    lattice_temperature: Array
    potential: Array
    melt_fraction: Array
    vapor_fraction: Array
    conductivity: Array
    hottest: float

    def energy_at(self, temperature: Array | float) -> Array:
        """e [J/kg] at electron temperatures [K], any shape."""
        T = np.asarray(temperature, dtype=np.float64)
        # the segment around T; C_e is linear in it, and e a parabola
        low = np.clip(np.searchsorted(self.temperature, T, "right") - 1, 0, self.energy.size - 2)
        step = T - self.temperature[low]
        slope = np.diff(self.capacity)[low] / np.diff(self.temperature)[low]
        return self.energy[low] + step * (self.capacity[low] + 0.5 * slope * step)


def electron_tables(material: Material, curve: CaloricCurve) -> ElectronTables:
    """Tables of a metal with electrons, from its caloric curve.

    Raises:
        ValueError: the metal has no electrons.
    """
    electrons = material.electrons
    if electrons is None:
        raise ValueError(f'material "{material.name}" has no electrons')
    # C_e(T_e) and its integral from T_0 on
    T_e, C_e = _heat_nodes(electrons, material.density_reference)
    energy = np.concatenate([[0.0], np.cumsum(0.5 * (C_e[1:] + C_e[:-1]) * np.diff(T_e))])
    raw = ElectronTables(T_e, C_e, energy, *(np.zeros(0),) * 8, hottest=np.inf)
    energy = energy - float(raw.energy_at(curve.initial_temperature))
    electron = ElectronTables(T_e, C_e, energy, *(np.zeros(0),) * 8, hottest=np.inf)

    # lattice: segments of the curve, cut so that e(T) is straight in them
    h, T, P, f_m, f_v = _cut(curve)
    rise = np.diff(h)
    left = np.maximum(rise - np.diff(electron.energy_at(T)), LEAST_SHARE * rise)
    share = electrons.lattice_share or 0.0
    coupling = _nodes(electrons.coupling)
    return ElectronTables(
        temperature=T_e,
        capacity=C_e,
        energy=energy,
        coupling_temperature=coupling,
        coupling=electrons.coupling.at(coupling),
        enthalpy=np.concatenate([[0.0], np.cumsum(left)]),
        lattice_temperature=T,
        potential=share * P,
        melt_fraction=f_m,
        vapor_fraction=f_v,
        conductivity=_conductivity(material, T, f_m) * (1.0 - share),
        hottest=electrons.hottest,
    )


def _heat_nodes(electrons: Electrons, density: float) -> tuple[Array, Array]:
    """Temperatures from 0 on and C_e per mass, linear between them."""
    law = electrons.heat_capacity
    T = np.concatenate([[0.0], _nodes(law)])
    return T, law.at(T) / density


def _nodes(law: object) -> Array:
    """Temperatures between which a law of T_e is straight [K]."""
    table, is_curved = getattr(law, "table", ()), getattr(law, "is_curved", False)
    if table:
        return np.array([row[0] for row in table])
    upper = min(getattr(law, "upper", np.inf), 1e5)
    lower = max(getattr(law, "lower", 1.0), 1.0)
    return np.linspace(lower, upper, FINEST if is_curved else 2)


def _cut(curve: CaloricCurve) -> tuple[Array, ...]:
    """Nodes h, T, P, f_m, f_v of a curve, no segment wider than WIDEST."""
    state = curve.enthalpy, curve.temperature, curve.potential
    rows = np.stack([*state, curve.melt_fraction, curve.vapor_fraction])
    # the last segment goes on where nothing holds the temperature
    last, before = rows[:, -1], rows[:, -2]
    if last[1] > before[1] and last[1] < TOP:
        step = (TOP - last[1]) / (last[1] - before[1])
        rows = np.append(rows, (last + step * (last - before))[:, None], axis=1)
        rows[3:, -1] = last[3:]
    # cuts of each segment, at equal steps of h
    parts = np.maximum(1, np.ceil(np.diff(rows[1]) / WIDEST)).astype(int)
    place = np.concatenate(
        [k + np.arange(count) / count for k, count in enumerate(parts)] + [[float(parts.size)]]
    )
    h, T, P, f_m, f_v = (np.interp(place, np.arange(parts.size + 1), row) for row in rows)
    return h, T, P, f_m, f_v


def _conductivity(material: Material, T: Array, melt_fraction: Array) -> Array:
    """k of the electrons at equal temperatures [W/(m K)], mixed by the melt; before the share."""
    electrons, law = material.electrons, material.conductivity
    assert electrons is not None
    if electrons.conductivity is not None:
        share = 1.0 - (electrons.lattice_share or 0.0)
        return np.full(T.shape, float(electrons.conductivity.at(300.0)) / share)
    # at a melting point the solid's and the liquid's stand side by side
    solidus, liquidus = material.solidus or np.inf, material.liquidus or 0.0
    solid = law.solid_law.at(np.minimum(T, solidus))
    liquid = law.liquid_law.at(np.maximum(T, liquidus))
    return (1.0 - melt_fraction) * solid + melt_fraction * liquid
