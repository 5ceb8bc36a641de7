"""Groups of numbers of a material: melting, vaporization, electrons; each number sourced.

Electrons have a heat capacity C_e(T_e) [J/(m^3 K)], a coupling G(T_e) to the lattice [W/(m^3 K)]
and a conductivity: a number, or that of the metal at T_l less the share s of the lattice,

    k_e = (1 - s) k(T_l) (T_e / T_l) (1 + a T_l) / (1 + a T_e^2 / T_l),    a = A / B

that is C_e v^2 / (3 (A T_e^2 + B T_l)) with C_e ~ T_e [Ivanov2003, eq. (4)], scaled so that both
temperatures together conduct as the metal does. They collide at the rate

    nu = A T_e^2 + B T_l = B (T_l + a T_e^2),    at most nu_max

which takes light up in `hot_optics`. Left out: other changes of k_e and G with the temperature of
the lattice, and with magnetic order.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import ConfigDict, Field, model_validator

from lasersph.input import (
    AngularFrequency,
    CollisionRate,
    Conductivity,
    Coupling,
    Expansion,
    Fraction,
    Frequency,
    Length,
    Model,
    MolarMass,
    SpecificEnergy,
    Temperature,
    VolumetricHeat,
    VolumetricHeatSlope,
    quantity_kind,
    refusal,
)
from lasersph.materials.property import Law
from lasersph.materials.uncertainty import Uncertainty, checked_uncertainty

Array = NDArray[np.float64]
GAS_CONSTANT = 8.314462618
"""Molar gas constant [J/(mol K)] (CODATA 2018)."""
COLD_METAL = 300.0
"""Temperature of a cold metal [K]. Format: at which n and k are measured."""


class Sourced(Model):
    """Numbers with their sources: one text for all, or a table with one for each number."""

    source: str | dict[str, str] = Field(
        description="source of all numbers, or one for each", examples=["where they are from"]
    )
    note: str = Field(default="", description="what a reader should know about the numbers")
    uncertainty: dict[str, Uncertainty] = Field(
        default={}, exclude=True, description="standard uncertainty of each number that has one"
    )

    @model_validator(mode="after")
    def _check_sources(self) -> Sourced:
        """Refuse a number without a source and a source without a number."""
        # every number has a source, and every source and uncertainty a number
        numbers = {
            name for name in type(self).model_fields if isinstance(getattr(self, name), float)
        }
        if isinstance(self.source, str):
            sources = {name: self.source for name in numbers}
        else:
            sources = self.source
        missing = sorted(name for name in numbers if not sources.get(name, "").strip())
        if missing:
            raise ValueError(f"no source for {', '.join(missing)}; add it to source")
        surplus = sorted(set(sources) - numbers)
        if surplus:
            raise ValueError(f"a source for {', '.join(surplus)}, which is not given here")
        for name in self.uncertainty:
            if name not in numbers:
                raise refusal((f"uncertainty.{name}", "is not given here; leave it out"))
            _ = self.relative_uncertainty(name)
        return self

    def relative_uncertainty(self, name: str) -> float | None:
        """Standard uncertainty of a number over its value; None where none is stated."""
        given = self.uncertainty.get(name)
        if given is None:
            return None
        kind = quantity_kind(type(self), name)
        return checked_uncertainty(f"uncertainty.{name}", given, getattr(self, name), kind)

    def source_of(self, name: str) -> str:
        """Source of one number; empty where the number is not given."""
        return self.source if isinstance(self.source, str) else self.source.get(name, "")


def _make_liquidus_optional(schema: dict[str, Any]) -> None:
    """Say in the JSON Schema of `Melting` that a solidus alone will do."""
    schema["required"].remove("liquidus")


class Melting(Sourced):
    """Melting range, or melting point where solidus and liquidus are equal."""

    solidus: Temperature = Field(
        gt=0, description="temperature at which melting begins", examples=["1300 K"]
    )
    liquidus: Temperature = Field(
        gt=0,
        description="temperature at which melting is complete; default: the solidus",
        examples=["1300 K"],
    )
    latent_heat: SpecificEnergy = Field(gt=0, description="latent heat of fusion")

    model_config = ConfigDict(json_schema_extra=_make_liquidus_optional)

    @model_validator(mode="before")
    @classmethod
    def _take_solidus(cls, data: Any) -> Any:
        """A melting point: the liquidus is the solidus where none is given, with its source."""
        if not isinstance(data, dict) or "liquidus" in data or "solidus" not in data:
            return data
        source = data.get("source")
        if isinstance(source, dict) and "solidus" in source:  # one for each number
            data = {**data, "source": {"liquidus": source["solidus"], **source}}
        return {**data, "liquidus": data["solidus"]}

    @model_validator(mode="after")
    def _check_order(self) -> Melting:
        if self.solidus > self.liquidus:
            raise ValueError(
                f"the solidus ({self.solidus:g} K) is above the liquidus ({self.liquidus:g} K)"
            )
        return self


class Vaporization(Sourced):
    """Boiling point and what evaporation needs."""

    temperature: Temperature = Field(
        gt=0, description="boiling temperature at 1 atm", examples=["3000 K"]
    )
    latent_heat: SpecificEnergy = Field(gt=0, description="latent heat at the boiling temperature")
    molar_mass: MolarMass | None = Field(default=None, gt=0, description="molar mass of the vapor")
    critical_temperature: Temperature | None = Field(
        default=None, gt=0, description="above which liquid and vapor are one"
    )

    @model_validator(mode="after")
    def _check_order(self) -> Vaporization:
        if self.critical_temperature is not None and self.critical_temperature <= self.temperature:
            raise ValueError("the critical temperature must lie above the boiling temperature")
        return self

    @property
    def specific_gas_constant(self) -> float:
        """R_s = R / M of the vapor [J/(kg K)]; ValueError where the molar mass is not given."""
        if self.molar_mass is None:
            raise ValueError("evaporation needs vaporization.molar_mass of the material")
        return GAS_CONSTANT / self.molar_mass


class ElectronHeat(Law[VolumetricHeat]):
    """Heat capacity of the electrons as a law of their temperature."""

    coefficient: VolumetricHeatSlope | None = Field(
        default=None, gt=0, description="of the temperature, instead of a value or a table"
    )

    def _forms(self) -> Iterator[tuple[str, object]]:
        yield from super()._forms()
        if self.coefficient is not None:
            yield "coefficient", self.coefficient

    def at(self, temperature: ArrayLike) -> Array:
        """C_e [J/(m^3 K)] at electron temperatures [K], any shape."""
        if self.coefficient is None:
            return super().at(temperature)
        return self.coefficient * np.asarray(temperature, dtype=np.float64)

    def scaled(self, factor: float) -> ElectronHeat:
        """The same law with every value times a factor."""
        changes = super().scaled(factor)
        if self.coefficient is None:
            return changes
        return changes.model_copy(update={"coefficient": factor * self.coefficient})


class Electrons(Sourced):
    """Electrons of a metal, for runs with two temperatures."""

    heat_capacity: ElectronHeat = Field(
        description="of the electrons, per volume: a number, a coefficient of their temperature, "
        "or a table"
    )
    coupling: Law[Coupling] = Field(
        description="heat that they pass on to the lattice, per volume and difference of "
        "temperature: a number, or a table of their temperature"
    )
    conductivity: Law[Conductivity] | None = Field(
        default=None,
        description="of the electrons, a number; default: that of the metal at the temperature of "
        "the lattice, times the ratio of the two temperatures",
    )
    scattering: Expansion | None = Field(
        default=None,
        ge=0,
        description="rate of collisions between electrons over that with the lattice, A/B, which "
        "bounds the default conductivity at high temperatures of the electrons",
    )
    collision_rate: CollisionRate | None = Field(
        default=None,
        gt=0,
        description="rate of collisions with the lattice over its temperature, B; with "
        "plasma_frequency hot electrons change how much light n and k of the metal take up",
    )
    plasma_frequency: AngularFrequency | None = Field(
        default=None, gt=0, description="of the free electrons, without transitions between bands"
    )
    highest_collision_rate: Frequency | None = Field(
        default=None,
        gt=0,
        description="of electrons that collide from atom to atom; default: none",
        examples=["1.1e16 1/s"],
    )
    lattice_share: Fraction | None = Field(
        default=None,
        ge=0,
        lt=1,
        description="of the metal's conductivity that the lattice has; default: none",
    )
    ballistic_range: Length | None = Field(
        default=None,
        gt=0,
        description="to which electrons carry light before they collide, beside its depth",
    )

    @model_validator(mode="after")
    def _check_laws(self) -> Electrons:
        """Refuse laws that no step survives: zero, negative, or of two kinds at once."""
        for name in ("heat_capacity", "coupling"):
            law: Law[Any] = getattr(self, name)
            rows = [row[0] for row in law.table] or [300.0, 3e4]
            if np.any(law.at(rows) <= 0.0):
                raise refusal((name, "must be positive at every temperature"))
        if self.conductivity is None:
            return self
        if not self.conductivity.is_constant:
            raise refusal(
                ("conductivity", "is a number here; leave it out for one that follows the metal's")
            )
        if self.scattering is not None and self.collision_rate is None:
            raise refusal(("scattering", "says nothing beside conductivity; leave one of them out"))
        return self

    @model_validator(mode="after")
    def _check_collisions(self) -> Electrons:
        """Refuse half of what the optics of hot electrons need."""
        rate, frequency = self.collision_rate, self.plasma_frequency
        if (rate is None) != (frequency is None):
            raise ValueError("collision_rate and plasma_frequency go together; give both")
        highest = self.highest_collision_rate
        if highest is None:
            return self
        if rate is None:
            text = "says nothing without collision_rate and plasma_frequency; leave it out"
            raise refusal(("highest_collision_rate", text))
        # the rate at room temperature is that of the cold metal
        cold = rate * (COLD_METAL + (self.scattering or 0.0) * COLD_METAL**2)
        if highest <= cold:
            text = f"must lie above the {cold:.3g} 1/s of the metal at {COLD_METAL:.0f} K"
            raise refusal(("highest_collision_rate", text))
        return self

    def collisions_at(self, T_e: ArrayLike, T_l: ArrayLike) -> Array:
        """Rate of collisions nu [1/s] at temperatures [K] of electrons and lattice, any shape; 0
        without `collision_rate`."""
        hot, cold = np.asarray(T_e, dtype=np.float64), np.asarray(T_l, dtype=np.float64)
        rate = (self.collision_rate or 0.0) * (cold + (self.scattering or 0.0) * hot**2)
        return np.minimum(rate, self.highest_collision_rate or np.inf)

    @property
    def hottest(self) -> float:
        """Highest temperature of the electrons that their heat capacity knows [K]; infinite where
        it is no table. Beyond the ends of the coupling the values there are held."""
        return self.heat_capacity.upper
