"""Scales and dimensionless numbers of a run [Demuth2020, eqs. (16)-(25)], for its summary.

A number of the run divided by its scale is the paper's starred quantity: x* = x / length,
t* = t / time, T* = (T - T_0) / temperature, h* = h / enthalpy, v* = v / velocity.
"""

from __future__ import annotations

from lasersph.case import Case
from lasersph.physics.dimensionless import (
    fourier_number,
    laser_number,
    phase_change_number,
    thermal_diffusion_length,
)


def dimensionless(case: Case) -> dict[str, dict[str, float]]:
    """Scales [SI] and numbers of a case; empty without pulse or boiling point."""
    material, laser = case.material, case.laser
    if laser is None or material.vaporization is None:
        return {}
    duration = laser.pulse.on_time or 100.0 * laser.pulse.resolution
    diffusivity = material.diffusivity_reference
    length = thermal_diffusion_length(diffusivity, duration)
    rise = material.vaporization.temperature - case.initial_temperature
    capacity = float(material.heat_capacity_at(material.reference_temperature))
    numbers = {
        "Fo": fourier_number(case.time.end, duration),
        "Ph_liquid_vapor": phase_change_number(material.vaporization.latent_heat, capacity, rise),
    }
    alpha = laser.absorption_coefficient(material)
    if alpha < float("inf"):
        density = material.density_reference
        numbers["La"] = laser_number(laser.mean_fluence, alpha, density, capacity, rise)
    if material.melting is not None:
        numbers["Ph_solid_liquid"] = phase_change_number(
            material.melting.latent_heat, capacity, rise
        )
    scales = {
        "length_m": length,
        "time_s": 4.0 * duration,
        "temperature_K": rise,
        "enthalpy_J_kg": capacity * rise,
        "velocity_m_s": diffusivity / length,
    }
    return {"scales": scales, "numbers": numbers}
