"""Tables 4 and 5 of [Demuth2020]: dimensionless numbers and the depth of the fine zone."""

from __future__ import annotations

from lasersph.case import load_case
from lasersph.physics import dimensionless as number
from lasersph.simulation import forecast
from lasersph.validation.dlip_reference import PAPER, Metal
from lasersph.validation.verdict import Row, judged, shown

GRAVITY = 9.81
FLUENCE = 6000.0
"""Mean fluence of Table 4 [J/m2], 2 x 0.3 J/cm2."""


def table_rows(label: str, metal: Metal, *, quick: bool) -> list[Row]:
    """Tables 4 and 5 within 0.2 %, the rounding of Table 3; fine zones shown."""
    case = load_case(metal.case)
    material = case.material
    melting, vaporization = material.melting, material.vaporization
    needed = (material.diffusivity, material.expansion, material.surface_tension_slope)
    if melting is None or vaporization is None or None in needed or case.laser is None:
        raise ValueError(f"{metal.case} lacks data of Table 3")
    pulse = 10e-9
    T0, Tl, Tv = case.initial_temperature, melting.liquidus, vaporization.temperature
    a = float(material.at("diffusivity", T0))
    nu = float(material.kinematic_viscosity_at(Tl))
    c, rho = float(material.heat_capacity_at(T0)), material.density_reference
    alpha = case.laser.absorption_coefficient(material)
    L = number.thermal_diffusion_length(a, pulse)
    beta = float(material.at("expansion", Tl))
    slope = float(material.at("surface_tension_slope", Tl))
    eta = float(material.viscosity_at(Tl))
    values = (
        L,
        number.laser_number(FLUENCE, alpha, rho, c, Tv - T0),
        number.phase_change_number(melting.latent_heat, c, Tv - T0),
        number.phase_change_number(vaporization.latent_heat, c, Tv - T0),
        number.prandtl_number(nu, a),
        number.rayleigh_number(beta, Tv - Tl, GRAVITY, L, nu, a),
        abs(number.marangoni_number(slope, Tv - Tl, L, eta, a)),
    )
    names = ("L", "La", "Ph_s/l", "Ph_l/v", "Pr", "Ra", "|Ma|")
    rows = [
        judged(f"{label}: {name} of Table 4", "m" if name == "L" else "1", value, printed,
               2e-3 * printed, published=printed, source=f"{PAPER}, Table 4, eqs. (16)-(25)")
        for name, value, printed in zip(names, values, metal.table_4, strict=True)
    ]  # fmt: skip
    for fluence, printed in zip(metal.fluences, metal.laser_numbers, strict=True):
        value = number.laser_number(1e4 * fluence, alpha, rho, c, Tv - T0)
        rows.append(
            judged(f"{label}: La at {fluence} J/cm2, Table 5", "1", value, printed, 2e-3 * printed,
                   published=printed, source=f"{PAPER}, Table 5")
        )  # fmt: skip
    for fluence, printed in () if quick else zip(metal.fluences, metal.fine_zones, strict=True):
        settings = [f"laser.fluence={fluence} J/cm^2", "particles.spacing=3.97 nm"]
        depth = forecast(load_case(metal.case, settings)).fine_depth
        rows.append(
            shown(f"{label}: fine zone at {fluence} J/cm2, Table 5", "nm", 1e9 * depth,
                  published=printed, source=f"{PAPER}, Table 5; ours follows from expected melt")
        )  # fmt: skip
    return rows
