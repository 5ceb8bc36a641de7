"""Tables 4 and 5 of [Demuth2020]: dimensionless numbers and the depth of the fine zone.

The tables were computed before Table 3 was rounded. For steel the rounded values give them to all
printed digits. For aluminium they miss La by 0.17 % and Ph, Ra, Ma by 0.03-0.04 %; three values of
more digits, each of which rounds to the printed one, give all eleven numbers within 1e-4:

    c_p,ref = 1076.718 J/(kg K)  (printed 1077), from Ph_l/v = L_v / (c_p (T_v - T_0))
    a_ref   = 5.7548e-5 m^2/s    (printed 5.75e-5), from Ra ~ a^(1/2); Ma ~ a^(-1/2) then agrees too
    alpha   = 4 pi k / lambda = 1.52212e8 1/m  (printed 1.52e8), extinction coefficient k = 4.30

So the tables are judged with these, and the shipped material, which keeps Table 3 as published, is
shown beside them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from decimal import Decimal
from typing import Any

from lasersph.case import load_case
from lasersph.physics import dimensionless as number
from lasersph.simulation import forecast
from lasersph.validation.comparison import Words
from lasersph.validation.study import Study

GRAVITY = 9.81
PULSE = 10e-9
"""[s]"""
FLUENCE = 6000.0
"""Mean fluence of Table 4 [J/m2], 2 x 0.3 J/cm2."""
AGREEMENT = 1e-4
NAMES = ("L", "La", "Ph_s/l", "Ph_l/v", "Pr", "Ra", "|Ma|")


@dataclass(frozen=True)
class Table3:
    """Properties of Table 3 that Tables 4 and 5 need, SI."""

    initial: float
    liquidus: float
    vaporization: float
    latent_heat: float
    vaporization_heat: float
    density: float
    heat_capacity: float
    diffusivity: float
    viscosity: float
    kinematic_viscosity: float
    expansion: float
    surface_tension_slope: float
    absorption: float

    @classmethod
    def of(cls, case_name: str) -> Table3:
        """Those of a shipped case."""
        case = load_case(case_name)
        material, T0 = case.material, case.initial_temperature
        melting, vaporization = material.melting, material.vaporization
        needed = (material.diffusivity, material.expansion, material.surface_tension_slope)
        if melting is None or vaporization is None or None in needed or case.laser is None:
            raise ValueError(f"{case_name} lacks data of Table 3")
        Tl = melting.liquidus
        return cls(
            initial=T0,
            liquidus=Tl,
            vaporization=vaporization.temperature,
            latent_heat=melting.latent_heat,
            vaporization_heat=vaporization.latent_heat,
            density=material.density_reference,
            heat_capacity=float(material.heat_capacity_at(T0)),
            diffusivity=float(material.at("diffusivity", T0)),
            viscosity=float(material.viscosity_at(Tl)),
            kinematic_viscosity=float(material.kinematic_viscosity_at(Tl)),
            expansion=float(material.at("expansion", Tl)),
            surface_tension_slope=float(material.at("surface_tension_slope", Tl)),
            absorption=case.laser.absorption_coefficient(material),
        )

    def laser_number(self, fluence: float) -> float:
        """La of a mean fluence [J/m2]."""
        rise = self.vaporization - self.initial
        return number.laser_number(fluence, self.absorption, self.density, self.heat_capacity, rise)

    def table_4(self) -> tuple[float, ...]:
        """The numbers of `NAMES`."""
        rise, hot = self.vaporization - self.initial, self.vaporization - self.liquidus
        a, nu = self.diffusivity, self.kinematic_viscosity
        L = number.thermal_diffusion_length(a, PULSE)
        slope = self.surface_tension_slope
        return (
            L,
            self.laser_number(FLUENCE),
            number.phase_change_number(self.latent_heat, self.heat_capacity, rise),
            number.phase_change_number(self.vaporization_heat, self.heat_capacity, rise),
            number.prandtl_number(nu, a),
            number.rayleigh_number(self.expansion, hot, GRAVITY, L, nu, a),
            abs(number.marangoni_number(slope, hot, L, self.viscosity, a)),
        )


def half_digit(printed: str) -> float:
    """Half a unit of the last printed digit."""
    return 0.5 * 10.0 ** int(Decimal(printed).as_tuple().exponent)


def add_tables(study: Study, label: str, metal: dict[str, Any]) -> None:
    """Tables 4 and 5 within 1e-4 or half a printed digit; fine zones shown."""
    shipped = Table3.of(metal["case"])
    finer = metal["unrounded"]
    exact = replace(shipped, **{name: value for name, (_, value, _) in finer.items()})
    for name, (printed, value, unit) in finer.items():
        study.add(
            "unrounded",
            value,
            float(printed),
            published=printed,
            share=half_digit(printed),
            label=label,
            name=name,
            unit=unit,
        )
    values = zip(NAMES, metal["table_4"], exact.table_4(), shipped.table_4(), strict=True)
    for name, printed, value, rounded in values:
        unit, table = "m" if name == "L" else "1", "Table 4, eqs. (16)-(25)"
        words: Words = {"label": label, "name": f"{name} of Table 4", "unit": unit, "table": table}
        add_number(study, printed, value, rounded, words)
    for fluence, printed in zip(metal["fluences"], metal["laser_numbers"], strict=True):
        value, rounded = (one.laser_number(1e4 * fluence) for one in (exact, shipped))
        name = f"La at {fluence} J/cm2, Table 5"
        words: Words = {"label": label, "name": name, "unit": "1", "table": "Table 5"}
        add_number(study, printed, value, rounded, words)
    if not study.quick:
        for fluence, printed in zip(metal["fluences"], metal["fine_zones"], strict=True):
            settings = [f"laser.fluence={fluence} J/cm^2", "particles.spacing=3.97 nm"]
            depth = 1e9 * forecast(load_case(metal["case"], settings)).fine_depth
            study.add("fine_zone", depth, published=printed, label=label, fluence=fluence)


def add_number(study: Study, printed: str, value: float, rounded: float, words: Words) -> None:
    """A printed number beside ours, and beside that of the rounded Table 3 where they differ."""
    reference = float(printed)
    allowed = max(AGREEMENT * reference, half_digit(printed))
    study.add("table", value, reference, published=printed, share=allowed, **words)
    if rounded != value:
        study.add("table_rounded", rounded, published=printed, **words)
