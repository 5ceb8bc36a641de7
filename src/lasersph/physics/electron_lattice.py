"""How long electrons are hotter than the lattice that they heat: where one temperature is enough.

Light heats the electrons, which pass heat on to the lattice by G (T_e - T_l). With heat capacities
C_e = gamma T_e and C_l both meet within [Anisimov1974]

    tau = C_e C_l / ((C_e + C_l) G)

after a pulse shorter than that. All that the electrons give makes the heat u that the lattice then
has, so that they begin at gamma (T_e^2 - T_0^2)/2 = u.

gamma and G are those of [Medvedev2020], of stainless steel of [Medvedev2025], at T_e = 5000 K and a
cold lattice, from the tables that the author publishes with them. There gamma and G change by up
to twice from 5000 to 10 000 K, so that tau says an order of magnitude.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt


@dataclass(frozen=True)
class Electrons:
    """gamma of C_e = gamma T_e [J/(m^3 K^2)] and G [W/(m^3 K)]."""

    capacity_slope: float
    coupling: float


ELECTRONS = {
    "aluminium": Electrons(93.5, 2.54e17),
    "copper": Electrons(209.6, 1.40e17),
    "gold": Electrons(108.2, 1.67e16),
    "iron": Electrons(545.3, 3.81e18),
    "nickel": Electrons(316.6, 5.17e17),
    "silver": Electrons(70.3, 3.60e16),
    "steel": Electrons(334.2, 3.71e17),
    "titanium": Electrons(353.0, 1.46e17),
    "tungsten": Electrons(270.4, 1.05e17),
}
"""C_e(5000 K)/5000 K and G(5000 K)."""
SLOWEST = ELECTRONS["gold"]
"""Taken for a metal that has no numbers here: none of the others couples as weakly."""
OTHERS_SAY = {
    "steel-304": "its electrons are those computed for Fe-Cr-Ni; with those of iron, which couple "
    "ten times as strongly, 150 fs melt it from 0.67 of the fluence on, and at twice that its "
    "surface is 1.4 times as hot and its melt as deep within 2 %"
}
"""Changes by other numbers of the electrons, by metal: `python benchmarks/other_electrons.py`."""
ALLOYS = {"inconel": "nickel", "ti": "titanium"}
"""Metals that make up most of an alloy, by the first word of its name."""


def electrons_of(metal: str) -> Electrons | None:
    """Numbers of a metal by its name, as "steel-304"; None where there are none."""
    word = metal.split("-")[0]
    return ELECTRONS.get(ALLOYS.get(word, word))


def coupling_time(electrons: Electrons, heat: float, lattice: float, cold: float) -> float:
    """tau [s] of electrons that begin with all the heat.

    Args:
        heat: u that the metal has afterwards [J/m^3]. lattice: C_l [J/(m^3 K)]. cold: T_0 [K].
    """
    # all heat in the electrons: gamma (T_e^2 - T_0^2) / 2 = u
    hot = sqrt(cold**2 + 2.0 * heat / electrons.capacity_slope)
    # C_e = gamma T_e, and tau of two capacities that exchange heat
    capacity = electrons.capacity_slope * hot
    return capacity * lattice / ((capacity + lattice) * electrons.coupling)


def surface_excess(
    electrons: Electrons, conductivity: float, diffusivity: float, depth: float, duration: float
) -> float:
    """Share of the rise of a surface by which its electrons are hotter than the lattice in a long
    pulse [1].

        (T_e - T_l)/rise = l^2/(l + d) / (2 sqrt(a t/pi)),    l = sqrt(k/G)

    Of light q/d exp(-z/d) that electrons carry on over l: k (u'' - u/l^2) = -q/d exp(-z/d) with
    u'(0) = 0 has u(0) = (q/k) l^2/(l + d), and one temperature rises by 2 (q/k) sqrt(a t/pi)
    [Carslaw1959]. Within a factor of 2.5 of what `benchmarks/short_pulses.py` computes with both
    temperatures, nine metals from 7 ps to 30 ns.

    Args:
        conductivity, diffusivity: of the metal [W/(m K)], [m^2/s]. depth: of the light d [m].
        duration: of the pulse t [s].
    """
    length = sqrt(conductivity / electrons.coupling)
    return length**2 / (length + depth) / (2.0 * sqrt(diffusivity * duration / pi))
