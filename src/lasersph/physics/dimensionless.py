"""The dimensionless numbers of direct laser interference patterning [Demuth2020, eqs. (16)-(25)].

Lengths are scaled with the thermal diffusion length L = 2 sqrt(a tau), times with L^2/a = 4 tau,
temperatures as (T - T_0) / (T_v - T_0), enthalpies with c_p (T_v - T_0). All arguments and
results are floats in SI units.

The paper's text lost the minus signs of d gamma/dT, Ma and the exponents of Ra (Ra is 2.31e-8 for
steel and 1.87e-7 for aluminum). Ma needs the viscosity eta of the liquid (the paper writes
rho_0 nu, which is eta only with the liquid density, not with rho_ref).

Reference: [Demuth2020] Computation 8(1), 9; doi 10.3390/computation8010009.
"""

from __future__ import annotations

from math import sqrt


def thermal_diffusion_length(diffusivity: float, pulse_duration: float) -> float:
    """L = 2 sqrt(a tau) [m]; diffusivity a [m^2/s], pulse duration tau (FWHM) [s]."""
    return 2.0 * sqrt(diffusivity * pulse_duration)


def fourier_number(end_time: float, pulse_duration: float) -> float:
    """Fo = t_end / (4 tau), eq. (22)."""
    return end_time / (4.0 * pulse_duration)


def laser_number(
    mean_fluence: float,
    absorption_coefficient: float,
    density: float,
    heat_capacity: float,
    temperature_rise: float,
) -> float:
    """La = 2 Phi_0 alpha / (rho c_p (T_v - T_0)), eq. (22).

    mean_fluence = 2 Phi_0 [J/m^2] is the mean over the pattern, incident (reflection not taken
    off); absorption_coefficient alpha [1/m]; temperature_rise T_v - T_0 [K].
    """
    return mean_fluence * absorption_coefficient / (density * heat_capacity * temperature_rise)


def reynolds_number(speed: float, length: float, kinematic_viscosity: float) -> float:
    """Re = U L / nu; speed U [m/s] of a wall."""
    return speed * length / kinematic_viscosity


def peclet_number(speed: float, length: float, diffusivity: float) -> float:
    """Pe = U L / a = Re Pr; speed U [m/s], diffusivity a [m^2/s]."""
    return speed * length / diffusivity


def prandtl_number(kinematic_viscosity: float, diffusivity: float) -> float:
    """Pr = nu / a, eq. (23)."""
    return kinematic_viscosity / diffusivity


def rayleigh_number(
    expansion: float,
    liquid_range: float,
    gravity: float,
    length: float,
    kinematic_viscosity: float,
    diffusivity: float,
) -> float:
    """Ra = g beta (T_v - T_l) L^3 / (nu a), eq. (23); liquid_range T_v - T_l [K]."""
    return gravity * expansion * liquid_range * length**3 / (kinematic_viscosity * diffusivity)


def marangoni_number(
    surface_tension_slope: float,
    liquid_range: float,
    length: float,
    viscosity: float,
    diffusivity: float,
) -> float:
    """Ma = d gamma/dT (T_v - T_l) L / (eta a), eq. (23); negative for a clean metal."""
    return surface_tension_slope * liquid_range * length / (viscosity * diffusivity)


def phase_change_number(latent_heat: float, heat_capacity: float, temperature_rise: float) -> float:
    """Ph = L / (c_p (T_v - T_0)), eq. (25), for fusion or vaporization."""
    return latent_heat / (heat_capacity * temperature_rise)
