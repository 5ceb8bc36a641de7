"""Kinds of physical quantity: what tells a fluence from a surface tension of the same dimension.

A kind has a dimension, its SI unit, an example for messages and, where other quantities share the
dimension, the sort of unit it must be written with: J/m^2 and N/m are both kg/s^2, but only the
first is a fluence.
"""

from __future__ import annotations

from dataclasses import dataclass

from lasersph.input.units import ENERGY, FORCE, NONE, POWER, Dimension, Unit, dimension


@dataclass(frozen=True)
class Kind:
    """One kind of quantity; `needs_one_of` and `refuses` are dimensions of the symbols used."""

    name: str
    unit: str
    example: str
    dimension: Dimension
    needs_one_of: frozenset[Dimension] = frozenset()
    refuses: frozenset[Dimension] = frozenset()

    @property
    def words(self) -> str:
        """Name with its article, for messages: "a surface tension", "an energy"."""
        name = self.name.replace("_", " ")
        return f"{'an' if name[0] in 'aeiou' else 'a'} {name}"

    def accepts(self, unit: Unit) -> bool:
        """Whether a number with this unit is a quantity of this kind."""
        if unit.dimension != self.dimension or unit.parts & self.refuses:
            return False
        return not self.needs_one_of or bool(unit.parts & self.needs_one_of)


_LIGHT = {"needs_one_of": frozenset({ENERGY, POWER}), "refuses": frozenset({FORCE})}
_DIFFUSION = dimension(m=2, s=-1)
_KELVIN = dimension(K=1)

_ALL = (
    Kind("length", "m", "8 nm", dimension(m=1)),
    Kind("time", "s", "10 ns", dimension(s=1)),
    Kind("temperature", "K", "298.15 K", _KELVIN),
    Kind("temperature_difference", "K", "5 K", _KELVIN),
    Kind("fluence", "J/m^2", "0.6 J/cm^2", dimension(kg=1, s=-2), **_LIGHT),
    Kind("intensity", "W/m^2", "9.6e11 W/m^2", dimension(kg=1, s=-3), **_LIGHT),
    Kind("heat_flux", "W/m^2", "1e6 W/m^2", dimension(kg=1, s=-3), **_LIGHT),
    Kind("power", "W", "20 W", POWER, refuses=frozenset({FORCE})),
    Kind("energy", "J", "1 mJ", ENERGY, refuses=frozenset({FORCE})),
    Kind("angle", "rad", "0.071 rad", dimension(rad=1)),
    Kind("absorption_coefficient", "1/m", "9.58e7 1/m", dimension(m=-1)),
    Kind("density", "kg/m^3", "2700 kg/m^3", dimension(m=-3, kg=1)),
    Kind("specific_heat", "J/(kg K)", "900 J/(kg K)", dimension(m=2, s=-2, K=-1)),
    Kind("conductivity", "W/(m K)", "167 W/(m K)", dimension(m=1, kg=1, s=-3, K=-1)),
    Kind("diffusivity", "m^2/s", "5.3e-6 m^2/s", _DIFFUSION),
    Kind("specific_energy", "J/kg", "397 kJ/kg", dimension(m=2, s=-2), frozenset({ENERGY})),
    Kind("viscosity", "Pa s", "1.3 mPa s", dimension(m=-1, kg=1, s=-1)),
    Kind("kinematic_viscosity", "m^2/s", "5e-7 m^2/s", _DIFFUSION),
    Kind("surface_tension", "N/m", "0.87 N/m", dimension(kg=1, s=-2)),
    Kind("surface_tension_slope", "N/(m K)", "-0.43 mN/(m K)", dimension(kg=1, s=-2, K=-1)),
    Kind("expansion", "1/K", "2.3e-5 1/K", dimension(K=-1)),
    Kind("molar_mass", "kg/mol", "26.98 g/mol", dimension(kg=1, mol=-1)),
    Kind("velocity", "m/s", "10 m/s", dimension(m=1, s=-1)),
    Kind("acceleration", "m/s^2", "9.81 m/s^2", dimension(m=1, s=-2)),
    Kind("pressure", "Pa", "101325 Pa", dimension(m=-1, kg=1, s=-2), refuses=frozenset({ENERGY})),
    Kind("heat_transfer_coefficient", "W/(m^2 K)", "20 W/(m^2 K)", dimension(kg=1, s=-3, K=-1)),
    Kind("frequency", "Hz", "10 kHz", dimension(s=-1)),
    Kind("fraction", "1", "25 %", NONE),
)
KINDS: dict[str, Kind] = {kind.name: kind for kind in _ALL}


def kind_of(unit: Unit) -> Kind | None:
    """The first kind that a unit can stand for, to say what was given instead."""
    return next((kind for kind in _ALL if kind.accepts(unit)), None)
