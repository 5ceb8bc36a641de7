"""Tait's equation of state of condensed matter that is nearly incompressible.

    P = B ((rho/rho_0)^7 - 1),    B = rho_0 c_0^2 / 7                [Alshaer2017, eq. (26)]

rho_0 is the material's own density (2705 kg/m^3 for aluminum; the paper prints 1000, with which
the lattice would explode) and c_0 the speed of sound at rho_0, an input: flows need only
c_0 >> v, and the time step falls with it. Condensed matter holds no tension here unless asked to:
below rho_0 the pressure is 0, since a surface layer that leaves lowers the density of the one below
and tension of GPa would tear it off. Left out: any dependence on temperature.
"""

from __future__ import annotations

EXPONENT = 7.0
"""Exponent of the equation of state. Source: [Alshaer2017, eq. (26)]."""


def pressure(rho, rho_0, c_0):
    """Pressure [Pa], negative below rho_0: B ((rho/rho_0)^7 - 1) [Alshaer2017, eq. (26)].

    Args:
        rho: density [kg/m^d]. rho_0: at rest. c_0: speed of sound there [m/s].
    """
    return rho_0 * c_0 * c_0 / EXPONENT * ((rho / rho_0) ** 7 - 1.0)


def condensed_pressure(rho, rho_0, c_0, has_tension):
    """Pressure [Pa], at least 0 unless `has_tension` is 1."""
    P = pressure(rho, rho_0, c_0)
    return P if has_tension > 0.0 else max(P, 0.0)


def density_under(P, rho_0, c_0):
    """Density [kg/m^d] under a pressure P >= 0 [Pa]: rho_0 (1 + P/B)^(1/7)."""
    return rho_0 * (1.0 + EXPONENT * P / (rho_0 * c_0 * c_0)) ** (1.0 / EXPONENT)
