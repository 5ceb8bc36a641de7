"""Buoyancy of the melt: density differences act on the weight only (Boussinesq).

    b = beta (T - T_l) g e_z                                [Demuth2020, eqs. (9), (12), (51)]

Hot fluid goes up. beta is the volumetric expansion of the liquid and T_l the temperature at which
its reference density is taken.
"""

from __future__ import annotations


def buoyancy(T, beta, T_l, g, up):
    """Acceleration [m/s^2] of fluid at temperature T [K].

    Args:
        beta: [1/K]. T_l: [K]. g: [m/s^2]. up: unit vector against gravity.
    """
    return beta * (T - T_l) * g * up
