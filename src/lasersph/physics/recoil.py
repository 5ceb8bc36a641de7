"""Recoil of the vapor that leaves a surface: into vacuum, and against surroundings.

    p_recoil = 0.54 p_sat(T)                              into vacuum [Anisimov1968]
    p_recoil - p_e = max(5/3 M^2 p_e, 0.54 p_sat - p_e)   against p_e, M behind the Knudsen layer

The second is what pushes a surface that moves; it ends where p_sat = p_e. A flat surface feels
none, and shows it beside its own pressure. The recoil moves the melt of a pool of radius r once it
exceeds its capillary pressure, 0.54 p_sat(T) = 2 gamma / r. Saturation pressure: `evaporation`;
M: `knudsen_layer`.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from lasersph.compute.vectors import interpolate
from lasersph.materials.sections import Vaporization
from lasersph.physics.ablation_estimates import temperature_at_pressure
from lasersph.physics.evaporation import saturation_pressure, vapor_constants
from lasersph.physics.knudsen_layer import HEAT_RATIO, outflow_tables

Array = NDArray[np.float64]
RECOIL_FACTOR = 0.54
"""Recoil pressure over saturation pressure. Source: [Anisimov1968]; [Knight1979] gives 0.550
(tested)."""
TABLE_START = 300.0
"""Lowest temperature of the table of recoil [K]. Format: no metal evaporates there."""
TABLE_NODES = 4097
"""Nodes of that table. Accuracy: 2 K from node to node; the recoil, which doubles in 200 K, is
within 1e-5."""
KEPT_TABLES = 16
"""Tables that a process keeps. Format: those of the metals of a study; each is some ten kB."""


def recoil_pressure(p):
    """Pressure of the leaving vapor on the surface [Pa]: 0.54 p [Anisimov1968]."""
    return RECOIL_FACTOR * p


def gauge_recoil_pressure(p, p_e, ratio_nodes, mach_nodes):
    """Recoil pressure beyond that of the surroundings [Pa] at saturation pressure p [Pa].

    max(5/3 M^2 p_e, 0.54 p - p_e); 0 where nothing evaporates.
    """
    if p <= p_e:
        return 0.0 * p
    # behind the layer p_v = p_e: subsonic, 5/3 M^2 p_e; sonic, 0.54 p - p_e
    M = interpolate(p_e / p, ratio_nodes, mach_nodes)
    return max(HEAT_RATIO * M * M * p_e, RECOIL_FACTOR * p - p_e)


def recoil_at(T: NDArray[np.floating], metal: Vaporization, ambient: float | None) -> Array:
    """Recoil [Pa] of the vapor at temperatures (n,) [K].

    Args:
        ambient: pressure of the surroundings p_e [Pa], beyond which the recoil counts; None for all
            of the recoil into vacuum.

    Raises:
        ValueError: the metal has no molar mass.
    """
    return _recoil(T, vapor_constants(metal), ambient)


def _recoil(T: NDArray[np.floating], constants: dict[str, float], ambient: float | None) -> Array:
    """See `recoil_at`, with `evaporation.vapor_constants`."""
    # most surfaces are colder than where vapor exceeds the surroundings: their hottest place tells
    if ambient is not None and saturation_pressure(float(np.max(T)), **constants) <= ambient:
        return np.zeros(T.shape)
    pressure = [saturation_pressure(float(one), **constants) for one in T]
    if ambient is None:
        return np.array([recoil_pressure(p) for p in pressure])
    ratio, _, mach = outflow_tables()
    return np.array([gauge_recoil_pressure(p, ambient, ratio, mach) for p in pressure])


def tabulated_recoil(metal: Vaporization, ambient: float) -> Callable[[Array], Array]:
    """Gauge recoil [Pa] as a function of temperatures [K] of any shape, up to the critical one.

    Raises:
        ValueError: the metal has no molar mass.
    """
    T, recoil = _table(ambient, **vapor_constants(metal))
    return lambda found: np.interp(found, T, recoil)


@lru_cache(maxsize=KEPT_TABLES)
def _table(ambient: float, **constants: float) -> tuple[Array, Array]:
    """Temperatures [K] and gauge recoil [Pa], made once in a process."""
    T = np.linspace(TABLE_START, constants["T_c"], TABLE_NODES)
    return T, _recoil(T, constants, ambient)


def recoil_moves_melt_at(radius: float, surface_tension: float, vapor: dict[str, float]) -> float:
    """Temperature at which the recoil pressure exceeds the capillary pressure 2 gamma / r [K].

    Args:
        radius: of the pool [m]. surface_tension: [N/m]. vapor: `evaporation.vapor_constants`.
    """
    # 0.54 p = 2 gamma / r
    pressure = 2.0 * surface_tension / (radius * RECOIL_FACTOR)
    return temperature_at_pressure(pressure, **vapor)
