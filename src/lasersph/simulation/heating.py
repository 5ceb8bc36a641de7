"""Effect of light on the surface of a case before it runs: heat taken in, temperature, vapor.

The estimate is that of `analytic.melt_depth`: heat in columns, no flow. Where vapor leaves the
surface it takes its heat and its metal along.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from lasersph.analytic.melt_depth import MeltEstimate, Vapor
from lasersph.case import Case
from lasersph.irradiation.light import COLDEST, HOTTEST
from lasersph.physics.evaporation import saturation_pressure, vapor_constants
from lasersph.physics.knudsen_layer import outflow_tables
from lasersph.physics.losses import evaporation_loss
from lasersph.simulation.hot_electrons import mean_reflectivity, optics_of_hot_electrons
from lasersph.simulation.layers import KEPT_ESTIMATES, expected_heating

TABLE_START = 300.0
"""Lowest temperature of the table of what evaporates [K]. Format: no metal does there."""
TABLE_END = 4.0
"""Highest one over the boiling point. Format: of a metal without a critical temperature."""
TABLE_NODES = 1025
"""Nodes of the table. Accuracy: 10 K from node to node, where the flux doubles in 200 K: within
2e-4."""


@dataclass(frozen=True)
class HeatingForecast:
    """Heat that light brings to the surface, and what comes of it.

    Attributes:
        cold, temperature: before and at its hottest [K]; the latter nan where a spot moves along
            the surface, which the columns of the estimate do not follow.
        reflectivity: at both. of_pulse: with hot electrons, in the mean over the light of a pulse;
            else None. absorbed_mean, absorbed_peak: fluence [J/m^2] with that, else that of `cold`.
        sideways: whether heat that flows out of the spot is left out, so that it gets less hot.
        melts, boils: whether it gets as hot as that; None for a metal without the temperature, and
            where how hot it gets is not known.
        held: metal that the heat kept at the boiling point would turn into vapor [m].
        evaporated: metal that leaves as vapor in a pulse where most does [m].
    """

    cold: float
    temperature: float
    reflectivity: tuple[float, float]
    absorbed_mean: float
    absorbed_peak: float
    sideways: bool
    melts: bool | None
    boils: bool | None
    held: float
    evaporated: float
    of_pulse: float | None = None


def heating_forecast(case: Case, estimate: MeltEstimate | None) -> HeatingForecast | None:
    """Forecast of a case from the estimate of its heat; None without a laser."""
    laser, cold = case.laser, case.initial_temperature
    if laser is None:
        return None
    hottest = float("nan") if estimate is None else estimate.temperature
    R = reflectivity_at(case, cold)
    optics = optics_of_hot_electrons(case)
    of_pulse = None if optics is None else mean_reflectivity(case, optics)
    taken = 1.0 - (R if of_pulse is None else of_pulse)
    # Without phase change there is nothing to melt or boil.
    marks = (case.material.melting, case.material.vaporization)
    is_known = case.solver.phase_change and estimate is not None
    melting, boiling = marks if is_known else (None, None)
    return HeatingForecast(
        cold,
        hottest,
        (R, R if estimate is None else reflectivity_at(case, hottest)),
        taken * laser.mean_fluence,
        taken * laser.peak_fluence,
        laser.is_bounded,
        None if melting is None else hottest > melting.solidus,
        None if boiling is None else hottest >= boiling.temperature * (1.0 - 1e-9),
        0.0 if estimate is None else estimate.held,
        0.0 if estimate is None else estimate.evaporated_most,
        of_pulse,
    )


def reflectivity_at(case: Case, temperature: float) -> float:
    """Reflectivity of the surface [1]; that of a preset of the published rule of ejection."""
    assert case.laser is not None
    # The published rule of ejection brings a reflectivity of its own; else that of the metal at T.
    if case.ejection is not None and case.ejection.reflectivity is not None:
        return case.ejection.reflectivity
    T, R = case.laser.reflectivity_table(case.material, COLDEST, HOTTEST)
    return float(np.interp(temperature, T, R))


def estimate_with_vapor(case: Case, without: MeltEstimate | None) -> MeltEstimate | None:
    """The estimate of the heat with what evaporates; None without light, and where a spot moves.

    Args:
        without: the estimate without vapor, where it is known already.
    """
    if case.laser is None or case.laser.path is not None:
        return None
    found = expected_heating(case) if without is None else without
    vapor = case.material.vaporization
    if found is None or vapor is None or not case.solver.evaporates:
        return found
    # Vapor leaves where its saturation pressure exceeds that of the surroundings.
    ambient = ambient_pressure(case)
    hottest = saturation_pressure(found.temperature, **vapor_constants(vapor))
    return expected_heating(case, vapor_of(case)) if hottest > ambient else found


def ambient_pressure(case: Case) -> float:
    """Pressure against which vapor leaves [Pa]: 0 under plateau = "evaporate"."""
    return case.boundaries.pressure_of_surroundings if case.solver.has_vapor_flux else 0.0


def vapor_of(case: Case) -> Vapor:
    """Mass and heat that leave the surface, of its temperatures."""
    metal = case.material.vaporization
    assert metal is not None
    constants = vapor_constants(metal)
    hottest = min(constants["T_c"], TABLE_END * metal.temperature)
    return _tabulated(tuple(constants.items()), ambient_pressure(case), hottest)


@lru_cache(maxsize=KEPT_ESTIMATES)
def _tabulated(constants: tuple[tuple[str, float], ...], ambient: float, hottest: float) -> Vapor:
    """The same of a metal's constants and a pressure [Pa], up to a temperature [K]."""
    # Table of m(T) and q(T), since the estimate asks for them in every cell and step.
    T, (ratio, flux, _) = np.linspace(TABLE_START, hottest, TABLE_NODES), outflow_tables()
    given = dict(constants) | {"p_e": ambient, "ratio_nodes": ratio, "flux_nodes": flux}
    heat, _, mass = np.array([evaporation_loss(float(t), **given) for t in T]).T
    return lambda at: (np.interp(at, T, mass), np.interp(at, T, heat))
