"""Estimates beside an ablation, for its summary: one value with its unit under each key.

Heat without phase change is that of the half-space [Alshaer2017, eqs. (34), (A.1)-(A.4)] with the
properties at the reference temperature; top-hat and Gaussian beams lose heat sideways as a uniform
disc of their radius does.
"""

from __future__ import annotations

from math import inf, pi, sqrt
from typing import Any

from lasersph.analytic.half_space import pulse_train_temperature, thermal_penetration
from lasersph.case import Case
from lasersph.lasers import Laser, SquarePulse
from lasersph.physics.ablation_estimates import (
    PHASE_EXPLOSION,
    VAPOR_ABSORPTION,
    absorbed_by_vapor,
    depth_of_light,
    evaporating_temperature,
    light_left,
)
from lasersph.physics.evaporation import (
    effusion_velocity,
    mean_normal_velocity,
    vapor_constants,
)
from lasersph.physics.recoil import recoil_moves_melt_at
from lasersph.simulation.heating import reflectivity_at

NEARLY_ALL = 0.05
"""Share of the light that is left where nearly all is absorbed. Source: [Alshaer2017, eq. (4)]."""


def ablation_estimates(case: Case) -> dict[str, Any]:
    """Estimates of a case whose laser ablates, SI; empty without laser or boiling point."""
    laser, material = case.laser, case.material
    if laser is None or material.vaporization is None:
        return {}
    reflectivity = reflectivity_at(case, case.initial_temperature)
    return {
        "absorption": absorption(case, laser),
        "conduction": conduction(case, laser, reflectivity),
        "vapor": vapor(case),
        "left_out": left_out(case, laser, reflectivity),
    }


def absorption(case: Case, laser: Laser) -> dict[str, float]:
    """How deep the light goes, and what is left below the first layer of particles."""
    alpha = laser.absorption_coefficient(case.material)
    # Light that is absorbed at the surface may still have a depth in the optics of the metal.
    if alpha == float("inf") and case.material.optics is not None:
        alpha = case.material.optics.absorption_coefficient or alpha
    if alpha == float("inf"):
        return {}
    return {
        "coefficient_1_m": alpha,
        "depth_95_percent_m": depth_of_light(NEARLY_ALL, alpha),
        "left_below_first_layer": light_left(case.particles.spacing, alpha),
    }


def conduction(case: Case, laser: Laser, reflectivity: float) -> dict[str, float]:
    """Penetration of heat in a pulse, temperatures without phase change, loss to the sides."""
    duration, material = on_time(laser), case.material
    diffusivity = material.diffusivity_reference

    # Half-space under the flux at the center of the beam.
    given: dict[str, Any] = {
        "flux": (1.0 - reflectivity) * laser.peak_fluence / duration,
        "pulse_duration": duration,
        "conductivity": float(material.conductivity_at(material.reference_temperature)),
        "diffusivity": diffusivity,
    }
    cold = case.initial_temperature
    rise = float(pulse_train_temperature(0.0, duration, **given))
    found = {
        "penetration_m": thermal_penetration(diffusivity, duration),
        "absorbed_flux_W_m2": given["flux"],
        "surface_temperature_K": cold + rise,
    }
    radius, pulse = radius_of(laser), laser.pulse

    # A train: the temperature at the end of the last pulse, with heat that leaves sideways.
    if isinstance(pulse, SquarePulse) and pulse.count > 1 and pulse.period is not None:
        train = {"count": pulse.count, "off_time": pulse.period - duration, "disc_radius": radius}
        last = (pulse.count - 1) * pulse.period + duration
        found["surface_temperature_last_K"] = cold + float(
            pulse_train_temperature(0.0, last, **train, **given)
        )

    # One pulse on a disc: how much less than the half-space it gets.
    if radius is not None:
        disc = float(pulse_train_temperature(0.0, duration, disc_radius=radius, **given))
        found["surface_temperature_disc_K"] = cold + disc
        found["lateral_loss_relative"] = 1.0 - disc / rise
    return found


def vapor(case: Case) -> dict[str, float]:
    """Velocities of the vapor at the boiling point, and what it takes from the light."""
    boiling = case.material.vaporization
    found = {
        "absorption_coefficient_1_m": VAPOR_ABSORPTION,
        "absorbed_over_two_h": absorbed_by_vapor(3.0 * case.particles.spacing),
    }
    if boiling is None or boiling.molar_mass is None:
        return found
    constant = boiling.specific_gas_constant
    return found | {
        "effusion_velocity_m_s": effusion_velocity(boiling.temperature, constant),
        "mean_normal_velocity_m_s": mean_normal_velocity(boiling.temperature, constant),
    }


def left_out(case: Case, laser: Laser, reflectivity: float) -> dict[str, float | None]:
    """From which temperature what the model leaves out matters, and how hot the surface gets.

    None where the material has no data for it.
    """
    material, boiling = case.material, case.material.vaporization
    names = ("evaporating_K", "recoil_from_K", "phase_explosion_from_K", "shielding_from_K")
    found: dict[str, float | None] = dict.fromkeys(names)
    if boiling is None:
        return found
    # Above these temperatures the model leaves out what matters.
    if boiling.critical_temperature is not None:
        found["phase_explosion_from_K"] = PHASE_EXPLOSION * boiling.critical_temperature
        found["shielding_from_K"] = boiling.critical_temperature
    if boiling.molar_mass is None:
        return found
    constants = vapor_constants(boiling)
    # Landau's balance: the temperature at which vapor carries all of the absorbed flux away.
    found["evaporating_K"] = evaporating_temperature(
        (1.0 - reflectivity) * laser.peak_fluence / on_time(laser),
        T_0=case.initial_temperature,
        c_p=float(material.heat_capacity_at(material.reference_temperature)),
        L_m=material.melting.latent_heat if material.melting is not None else 0.0,
        **constants,
    )
    # Recoil moves the melt above the capillary pressure of the spot, 2 gamma / r.
    if material.surface_tension is not None and (radius := radius_of(laser)) is not None:
        tension = float(material.surface_tension_at(boiling.temperature))
        moves = recoil_moves_melt_at(radius, tension, constants)
        found["recoil_from_K"] = moves if moves < inf else None
    return found


def radius_of(laser: Laser) -> float | None:
    """Radius of a uniform disc with the power and the peak of the beam [m]; None if unbounded."""
    return None if laser.beam.area is None else sqrt(laser.beam.area / pi)


def on_time(laser: Laser) -> float:
    """Time over which a pulse delivers its energy at its mean power [s]."""
    return laser.pulse.on_time or 100.0 * laser.pulse.resolution
