"""Vapor behind the Knudsen layer of an evaporating surface, and what ambient pressure leaves of it.

Within some mean free paths of the surface the vapor comes to an equilibrium of its own. Behind that
layer it flows off at a Mach number M, and the jump conditions of [Knight1979] for a monatomic vapor
(gamma = 5/3) give with m = M sqrt(5/6), h = m / 8

    sqrt(T_v/T_s) = sqrt(1 + pi h^2) - sqrt(pi) h
    rho_v/rho_s   = sqrt(T_s/T_v) [(m^2 + 1/2) E - m/sqrt(pi)] + T_s/(2 T_v) [1 - sqrt(pi) m E]
    recoil/p_sat  = p_v/p_sat (1 + 5/3 M^2),    E = exp(m^2) erfc(m)

Surroundings of pressure p_e hold the vapor back: below p_sat = 4.85 p_e it leaves at the M for
which p_v = p_e, so that the gauge recoil is 5/3 M^2 p_e, and flux and recoil end where p_sat = p_e;
above that M = 1 whatever the surroundings are. At M = 1 flux and recoil are those of `evaporation`
and `recoil`, 0.82 and 0.54 p_sat [Anisimov1968]: Knight's flux is taken times 0.82 / 0.8157 at
every M, and the recoil is the larger one of the two, so that both are continuous.

Left out: a gas between vapor and surroundings that a pulse compresses, which lowers M further;
condensation on a surface below saturation, and diffusion of vapor into the gas there.

References: [Knight1979] AIAA J. 17, 519; [Anisimov1968] Sov. Phys. JETP 27, 182.
"""

from __future__ import annotations

from functools import cache
from math import erfc, exp, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.vectors import interpolate, interpolation_slope
from lasersph.physics.evaporation import NET_EVAPORATION, PI

HEAT_RATIO = 5.0 / 3.0
"""c_p / c_v of the vapor. Exact: it is monatomic (tested against the table of [Knight1979])."""
NODES = 513
"""Mach numbers of the table. Accuracy: straight lines between them are within 2e-6 of the flux."""


class Vapor(NamedTuple):
    """Vapor behind its Knudsen layer, over that at saturation at the surface's temperature.

    Attributes:
        temperature, density, pressure: [1]. recoil: momentum given to the surface, over p_sat [1].
            flux: over the Hertz-Knudsen flux p_sat / sqrt(2 pi R_s T_s) [1].
    """

    temperature: float
    density: float
    pressure: float
    recoil: float
    flux: float


def vapor_behind(mach: float) -> Vapor:
    """Vapor that leaves at a Mach number from 0 to 1 [Knight1979].

    The closed form solves the balances of mass, momentum and energy of the layer to rounding.
    """
    # jump conditions of [Knight1979]: `root` is sqrt(T_v / T_s), `tail` is E
    m = mach * sqrt(0.5 * HEAT_RATIO)
    root = sqrt(1.0 + PI * (m / 8.0) ** 2) - sqrt(PI) * m / 8.0
    tail = exp(m * m) * erfc(m)
    # rho_v / rho_s: the two terms of its formula above
    density = ((m * m + 0.5) * tail - m / sqrt(PI)) / root
    density += (1.0 - sqrt(PI) * m * tail) / (2.0 * root * root)
    pressure = density * root * root
    return Vapor(
        temperature=root * root,
        density=density,
        pressure=pressure,
        recoil=pressure * (1.0 + HEAT_RATIO * mach * mach),
        flux=density * root * mach * sqrt(2.0 * PI * HEAT_RATIO),
    )


def outflow_tables() -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Nodes p_e / p_sat, rising from 0 to 1; the flux over Hertz-Knudsen and M there (k,).

    The arrays are made once, and cannot be written.
    """
    return _tables()


@cache
def _tables() -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    # from the sonic outflow into vacuum to the end of evaporation
    mach = np.linspace(1.0, 0.0, NODES)
    vapor = [vapor_behind(float(M)) for M in mach]
    # Knight's flux scaled so that M = 1 has 0.82, as `evaporation` has
    flux = np.array([one.flux for one in vapor]) * (NET_EVAPORATION / vapor[0].flux)
    flux[0] = NET_EVAPORATION
    ratio = np.array([one.pressure for one in vapor])
    tables = np.append(0.0, ratio), np.append(NET_EVAPORATION, flux), np.append(1.0, mach)
    for table in tables:
        table.flags.writeable = False
    return tables


def net_mass_flux(T, p, p_slope, R_s, p_e, ratio_nodes, flux_nodes):
    """Net evaporating mass per area and time [kg/(m^2 s)] and its slope in T [kg/(m^2 s K)].

    Args:
        p, p_slope: saturation pressure [Pa] and dp/dT [Pa/K]. p_e: of the surroundings [Pa].
        ratio_nodes, flux_nodes: of `outflow_tables`.
    """
    if p <= p_e:
        return 0.0 * p, 0.0 * p
    # Hertz-Knudsen flux times the share that the surroundings let through
    ratio, root = p_e / p, sqrt(2.0 * PI * R_s * T)
    share = interpolate(ratio, ratio_nodes, flux_nodes)
    # d/dT of p / sqrt(T), then of the share
    slope = share * (p_slope - 0.5 * p / T) / root
    # the share rises with p: d(p_e / p)/dT = -p_e / p^2 dp/dT
    slope = slope - interpolation_slope(ratio, ratio_nodes, flux_nodes) * ratio * p_slope / root
    return share * p / root, slope
