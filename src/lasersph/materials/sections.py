"""Groups of single numbers of a material: melting and vaporization, each number sourced."""

from __future__ import annotations

from typing import Any

from pydantic import ConfigDict, Field, model_validator

from lasersph.input import (
    Model,
    MolarMass,
    SpecificEnergy,
    Temperature,
    quantity_kind,
    refusal,
)
from lasersph.materials.uncertainty import Uncertainty, checked_uncertainty

GAS_CONSTANT = 8.314462618
"""Molar gas constant [J/(mol K)] (CODATA 2018)."""


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
