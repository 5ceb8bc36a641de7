"""Scales and dimensionless numbers of a run [Demuth2020, eqs. (16)-(25)], for its summary.

A number of the run divided by its scale is the paper's starred quantity: x* = x / length,
t* = t / time, T* = (T - T_0) / temperature, h* = h / enthalpy, v* = v / velocity.

Boxes have the numbers of their walls instead: with the speed U of the fastest one and the width,
or the difference dT of two opposite ones of given temperature and their distance,

    Re = U width / nu,    Ra = g beta dT L^3 / (nu a),    Pr = nu / a.
"""

from __future__ import annotations

from lasersph.boundaries.flow_conditions import FlowConditions
from lasersph.boundaries.settings import DIRICHLET
from lasersph.case import Case
from lasersph.physics.dimensionless import (
    fourier_number,
    laser_number,
    marangoni_number,
    phase_change_number,
    prandtl_number,
    rayleigh_number,
    reynolds_number,
    thermal_diffusion_length,
)
from lasersph.solvers.melt_pool.settings import MeltPoolSettings


def heat_scales(case: Case) -> dict[str, dict[str, float]]:
    """Scales [SI] and numbers of a case; empty without pulse or boiling point."""
    material, laser = case.material, case.laser
    if laser is None or material.vaporization is None:
        return {}

    # Scales: length sqrt(D t_p), rise to the boiling point, velocity D/length.
    duration = laser.pulse.on_time or 100.0 * laser.pulse.resolution
    diffusivity = material.diffusivity_reference
    length = thermal_diffusion_length(diffusivity, duration)
    rise = material.vaporization.temperature - case.initial_temperature
    capacity = float(material.heat_capacity_at(material.reference_temperature))

    # Fo and Ph, and La where the light has a depth.
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


def melt_numbers(case: Case, settings: MeltPoolSettings, length: float) -> dict[str, float]:
    """Pr, Ra and Ma of a melt [Demuth2020, eq. (23)], with the properties of its liquidus.

    Args:
        length: thermal diffusion length [m].
    """
    material = case.material
    if material.vaporization is None:
        return {}
    diffusivity = material.diffusivity_reference
    T = material.flow_temperature
    hot = material.vaporization.temperature - T
    nu = float(material.kinematic_viscosity_at(T))
    expansion = float(material.expansion_at(T))
    slope = float(material.surface_tension_slope_at(T)) if settings.marangoni else 0.0
    viscosity = float(material.viscosity_at(T))
    return {
        "Pr": prandtl_number(nu, diffusivity),
        "Ra": rayleigh_number(expansion, hot, settings.gravity, length, nu, diffusivity),
        "Ma": marangoni_number(slope, hot, length, viscosity, diffusivity),
    }


def box_numbers(case: Case, flow: FlowConditions, settings: MeltPoolSettings) -> dict[str, float]:
    """Pr, and Re and Ra where a wall moves or two opposite ones differ in temperature."""
    material = case.material
    if case.domain.width is None:
        return {}

    # Pr always, Re of the fastest wall, Ra of the larger difference of opposite walls.
    T = material.flow_temperature
    nu, a = float(material.kinematic_viscosity_at(T)), material.diffusivity_reference
    numbers = {"Pr": prandtl_number(nu, a)}
    fastest = max(abs(side.velocity) for side in flow.faces.values())
    if fastest > 0.0:
        numbers["Re"] = reynolds_number(fastest, case.domain.width, nu)
    difference, length = wall_temperature_difference(case)
    expansion = float(material.expansion_at(T))
    if difference > 0.0 and expansion > 0.0:
        gravity = settings.gravity
        numbers["Ra"] = rayleigh_number(expansion, difference, gravity, length, nu, a)
    return numbers


def wall_temperature_difference(case: Case) -> tuple[float, float]:
    """Largest difference of two opposite sides of given temperature [K], and their distance [m]."""
    boundaries, initial = case.boundaries, case.initial_temperature
    found = [(0.0, 0.0)]
    for one, other, length in (
        ("left", "right", case.domain.width or 0.0),
        ("bottom", "surface", case.domain.depth),
    ):
        if all(boundaries.kind_of(side) in DIRICHLET for side in (one, other)):
            pair = [boundaries.temperature_of(side, initial) for side in (one, other)]
            found.append((abs(pair[0] - pair[1]), length))
    return max(found)
