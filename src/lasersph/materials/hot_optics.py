"""Reflectivity and depth of light in a metal whose electrons are hot.

Free electrons that collide more often take up more light. Of the permittivity of the cold metal,
(n + i k)^2, only their Drude part changes [Eidmann2000; Rakic1998, eqs. (2), (3)]:

    eps(nu) = (n + i k)^2 + D(nu) - D(nu_0),    D(nu) = -w_p^2 / (w^2 + i w nu)
    nu = B (T_l + a T_e^2) <= nu_max,           nu_0 = nu(300 K)
    R = |(sqrt(eps) - 1)/(sqrt(eps) + 1)|^2,    depth = c / (2 w Im sqrt(eps))

with the frequency w of the light, and R of normal incidence. Electrons whose free path would be
shorter than from atom to atom collide as often as that, nu_max [Eidmann2000]. Left out: transitions
between bands, which change with T_e where the light is near their edge, a density of free electrons
that changes, and melting.

References: [Eidmann2000] Phys. Rev. E 62, 1202; [Rakic1998] Appl. Opt. 37, 5271.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lasersph.materials.material import Material
from lasersph.materials.sections import COLD_METAL, Electrons

Array = NDArray[np.float64]
SPEED_OF_LIGHT = 299792458.0
"""[m/s] (SI)."""
NODES = 513
"""Nodes of the table over nu. Accuracy: R within 1e-5 between them."""
LEAST, MOST = 0.01, 100.0
"""Ends of the table, over nu_0 and over the frequency of the light. Format: R changes no more."""


@dataclass(frozen=True, eq=False)
class HotOptics:
    """R and depth of one light over the rate of collisions, linear between nodes.

    Attributes:
        electrons: whose collisions count. rate: (nodes,) nu [1/s]. reflectivity: (nodes,) R.
            depth: (nodes,) in which the light falls to 1/e [m].
    """

    electrons: Electrons
    rate: Array
    reflectivity: Array
    depth: Array

    def at(self, T_e: ArrayLike, T_l: ArrayLike) -> tuple[Array, Array]:
        """R and depth [m] at temperatures of electrons and lattice [K], any shape."""
        nu = self.electrons.collisions_at(T_e, T_l)
        return np.interp(nu, self.rate, self.reflectivity), np.interp(nu, self.rate, self.depth)

    def with_range(self, reach: float) -> HotOptics:
        """The same, with light carried deeper by a range of electrons [m]."""
        return replace(self, depth=self.depth + reach)

    def in_depth(self, depth: float) -> HotOptics:
        """The same with a depth that does not change [m]."""
        return replace(self, depth=np.full(self.rate.shape, depth))


def hot_optics(material: Material, wavelength: float | None) -> HotOptics | None:
    """Table of a metal for light of a wavelength [m]; None where it has not both n and k and what
    hot electrons change of them."""
    electrons, optics = material.electrons, material.optics
    refraction = None if optics is None else optics.refraction_at(wavelength)
    if electrons is None or electrons.plasma_frequency is None or refraction is None:
        return None
    assert wavelength is not None
    omega = 2.0 * pi * SPEED_OF_LIGHT / wavelength
    # from rates that change nothing to those of electrons that hit every atom
    cold = float(electrons.collisions_at(COLD_METAL, COLD_METAL))
    top = min(electrons.highest_collision_rate or np.inf, max(MOST * omega, 2.0 * cold))
    rate = np.geomspace(LEAST * cold, top, NODES)
    index = refraction_of(rate, cold, refraction, omega, electrons.plasma_frequency)
    reflectivity = np.abs((index - 1.0) / (index + 1.0)) ** 2
    depth = SPEED_OF_LIGHT / (2.0 * omega * index.imag)
    return HotOptics(electrons, rate, reflectivity, depth)


def refraction_of(
    rate: Array, cold: float, refraction: complex, omega: float, plasma_frequency: float
) -> NDArray[np.complex128]:
    """n + i k at rates of collisions [1/s], any shape; exactly that of the cold metal at `cold`.

    Args:
        cold: rate of the cold metal [1/s]. refraction: its n + i k. omega: of the light [rad/s].
            plasma_frequency: of the free electrons [rad/s].
    """

    def drude(nu: ArrayLike) -> NDArray[np.complex128]:
        """D(nu)."""
        return -(plasma_frequency**2) / (omega**2 + 1j * omega * np.asarray(nu))

    return np.sqrt(refraction**2 + (drude(rate) - drude(cold)))
