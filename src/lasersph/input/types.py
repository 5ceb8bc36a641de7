"""Pydantic types of every kind of quantity; the value of a field is a float in SI units.

From a file (`strict_units` in the validation context) a quantity is text with a unit and a bare
number is refused; from Python a bare number means SI and text with a unit works as well. Defaults
are SI numbers and not validated again.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from numbers import Real
from typing import Annotated, Any, get_args

from pydantic import BaseModel, Field, GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationInfo
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from lasersph.input.quantity import KINDS, QuantityError, parse_quantity


@dataclass(frozen=True)
class Quantity:
    """Annotation that makes a float field read quantities of one kind."""

    kind: str

    def __get_pydantic_core_schema__(
        self, _source: Any, _handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Read the text first, then require a finite float."""
        return core_schema.with_info_before_validator_function(
            _reader(self.kind), core_schema.float_schema(allow_inf_nan=False, strict=False)
        )

    def __get_pydantic_json_schema__(
        self, _schema: CoreSchema, _handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """Text with a unit (a fraction may also be a number)."""
        kind = KINDS[self.kind]
        text = {"type": "string", "pattern": r"^\s*[+-]?(\d|\.\d)", "examples": [kind.example]}
        if self.kind != "fraction":
            return text | {"x-kind": self.kind, "x-unit": kind.unit}
        return {"anyOf": [{"type": "number"}, text], "x-kind": self.kind, "x-unit": "1"}


def _reader(kind: str) -> Callable[[Any, ValidationInfo], Any]:
    example = KINDS[kind].example

    def read(value: Any, info: ValidationInfo) -> float:
        # Files need units, Python may give SI numbers.
        number = read_number(value, bool(info.context) and bool(info.context.get("strict_units")))
        if kind == "temperature" and number < 0:
            raise _refusal(f'"{value}" is below absolute zero')
        return number

    def read_number(value: Any, needs_unit: bool) -> float:
        # Text with a unit, or a number that is one: true and "3" are none.
        if isinstance(value, str):
            try:
                return parse_quantity(value, kind)
            except QuantityError as error:
                raise _refusal(str(error)) from None
        if isinstance(value, bool) or not isinstance(value, Real):
            what = f"{str(value).lower()} is" if isinstance(value, bool) else "is"
            raise _refusal(f'{what} not {KINDS[kind].words}; write e.g. "{example}"')
        # An integer of hundreds of digits has no float.
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
        if not math.isfinite(number):
            raise _refusal(f'{value} is not a finite number; write e.g. "{example}"')
        if needs_unit and kind != "fraction":
            raise _refusal(f'{value} has no unit; write e.g. "{example}"')
        return number

    return read


def _refusal(message: str) -> PydanticCustomError:
    return PydanticCustomError("quantity", "{message}", {"message": message})


def quantity_kind(model: type[BaseModel], name: str) -> str:
    """Kind of quantity that a field of a model reads ("density"); empty where it reads none."""
    # Marks stand beside the type, or inside one of its alternatives.
    field = model.model_fields[name]
    marks = [*field.metadata, *_marks(field.annotation)]
    return next((mark.kind for mark in marks if isinstance(mark, Quantity)), "")


def _marks(annotation: Any) -> Iterator[Any]:
    """Annotations of a type and of its alternatives, however deep."""
    yield from getattr(annotation, "__metadata__", ())
    for part in get_args(annotation):
        yield from _marks(part)


Length = Annotated[float, Quantity("length")]
Time = Annotated[float, Quantity("time")]
Temperature = Annotated[float, Quantity("temperature")]
TemperatureDifference = Annotated[float, Quantity("temperature_difference")]
Fluence = Annotated[float, Quantity("fluence")]
Intensity = Annotated[float, Quantity("intensity")]
HeatFlux = Annotated[float, Quantity("heat_flux")]
Power = Annotated[float, Quantity("power")]
Energy = Annotated[float, Quantity("energy")]
Angle = Annotated[float, Quantity("angle")]
AbsorptionCoefficient = Annotated[float, Quantity("absorption_coefficient")]
Density = Annotated[float, Quantity("density")]
SpecificHeat = Annotated[float, Quantity("specific_heat")]
VolumetricHeat = Annotated[float, Quantity("volumetric_heat")]
VolumetricHeatSlope = Annotated[float, Quantity("volumetric_heat_slope")]
Coupling = Annotated[float, Quantity("coupling")]
Conductivity = Annotated[float, Quantity("conductivity")]
Diffusivity = Annotated[float, Quantity("diffusivity")]
SpecificEnergy = Annotated[float, Quantity("specific_energy")]
Viscosity = Annotated[float, Quantity("viscosity")]
KinematicViscosity = Annotated[float, Quantity("kinematic_viscosity")]
SurfaceTension = Annotated[float, Quantity("surface_tension")]
SurfaceTensionSlope = Annotated[float, Quantity("surface_tension_slope")]
Expansion = Annotated[float, Quantity("expansion")]
MolarMass = Annotated[float, Quantity("molar_mass")]
MolarEnergy = Annotated[float, Quantity("molar_energy")]
SurfaceConcentration = Annotated[float, Quantity("surface_concentration")]
Velocity = Annotated[float, Quantity("velocity")]
Acceleration = Annotated[float, Quantity("acceleration")]
MassFlux = Annotated[float, Quantity("mass_flux")]
Pressure = Annotated[float, Quantity("pressure")]
HeatTransferCoefficient = Annotated[float, Quantity("heat_transfer_coefficient")]
Frequency = Annotated[float, Quantity("frequency")]
AngularFrequency = Annotated[float, Quantity("angular_frequency")]
CollisionRate = Annotated[float, Quantity("collision_rate")]
Fraction = Annotated[float, Quantity("fraction")]
Count = Annotated[int, Field(strict=True, ge=1)]
