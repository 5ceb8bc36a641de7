"""`Boundaries`: what holds at the faces of the domain, named by face.

    adiabatic           no heat crosses; dummy particles mirror the ones inside
    periodic            what leaves on one side enters on the other (sides only)
    free                no particles beyond: the support is cut off, no heat crosses [Alshaer2017]
    fixed-temperature   the face itself has the given temperature
    wall                particles of fixed temperature lie beyond (dynamic boundary particles)

`convection` and `emissivity` let the surface lose heat to the surroundings [Alshaer2017, eq. (2)].
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from lasersph.reading import Fraction, HeatTransferCoefficient, Model, Temperature, refusal

Face = Literal["adiabatic", "free", "fixed-temperature", "wall"]
Side = Literal["adiabatic", "periodic", "free", "fixed-temperature", "wall"]
HELD = ("fixed-temperature", "wall")


class Boundaries(Model):
    """Conditions at surface, bottom and sides."""

    surface: Face = Field("adiabatic", description="at z = 0; the laser heats it in any case")
    surface_temperature: Temperature | None = None
    bottom: Face = "adiabatic"
    bottom_temperature: Temperature | None = Field(
        None, description="default: the initial temperature"
    )
    sides: Side = Field("adiabatic", description="at both ends of x and y")
    side_temperature: Temperature | None = Field(
        None, description="default: the initial temperature"
    )
    convection: Annotated[HeatTransferCoefficient, Field(ge=0)] = Field(
        0.0, description="heat transfer coefficient of the surface"
    )
    emissivity: Annotated[Fraction, Field(ge=0, le=1)] = Field(
        0.0, description="of the surface, for radiation"
    )
    ambient_temperature: Temperature | None = Field(
        None, description="of the surroundings; default: the initial temperature"
    )

    @model_validator(mode="after")
    def _check_temperatures(self) -> Boundaries:
        problems = []
        for face, key in (
            ("surface", "surface_temperature"),
            ("bottom", "bottom_temperature"),
            ("sides", "side_temperature"),
        ):
            kind = getattr(self, face)
            if getattr(self, key) is not None and kind not in HELD:
                problems.append(
                    (
                        key,
                        f'says nothing where {face} = "{kind}"; leave it out, or set {face} to '
                        '"fixed-temperature" or "wall"',
                    )
                )
        if self.surface in HELD and self.surface_temperature is None:
            problems.append(("surface_temperature", "is missing for a surface that is held at it"))
        if problems:
            raise refusal(*problems)
        return self

    def temperature_of(self, face: str, initial: float) -> float:
        """Temperature of "surface", "bottom" or "sides" where it is held [K]."""
        key = {"surface": self.surface_temperature, "bottom": self.bottom_temperature,
               "sides": self.side_temperature}  # fmt: skip
        given = key[face]
        return initial if given is None else given
