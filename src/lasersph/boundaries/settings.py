"""`Boundaries`: what holds for heat at the faces of the domain, named by face.

    adiabatic           no heat crosses; dummy particles mirror the ones inside
    periodic            what leaves on one side enters on the other (opposite faces in pairs)
    free                no particles beyond: the support is cut off, no heat crosses [Alshaer2017]
    fixed-temperature   the face itself has the given temperature
    wall                particles of fixed temperature lie beyond (dynamic boundary particles)
    prescribed-flux     a given heat flux enters (leaves, where negative)

`convection` and `emissivity` let the surface lose heat to the surroundings [Alshaer2017, eq. (2)].
The emissivity is the metal's where none is given here.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Annotated, Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from lasersph.boundaries.surface_drives import (
    MassFluxWave,
    PressureBump,
    PressureWave,
    TemperatureBump,
    TemperatureWave,
)
from lasersph.input import (
    Fraction,
    HeatFlux,
    HeatTransferCoefficient,
    Model,
    Pressure,
    Temperature,
    refusal,
)
from lasersph.materials import Material
from lasersph.particles.faces import SURFACE, VERTICAL, face_pairs

Array = NDArray[np.float64]
Face = Literal["adiabatic", "periodic", "free", "fixed-temperature", "wall", "prescribed-flux"]
DIRICHLET = ("fixed-temperature", "wall")
"""Kinds of faces whose temperature is given."""
NEUMANN = "prescribed-flux"
"""The kind of faces whose heat flux is given."""
STANDARD_ATMOSPHERE = 101325.0
"""Pressure of the surroundings [Pa]. Exact: by its definition."""
KEYS = {
    face: face.removesuffix("s") if face == "sides" else face
    for face in ("surface", "bottom", "sides", "left", "right", "front", "back")
}
"""Each face and how the keys of its temperature and flux begin."""


def _of_body(description: str) -> Any:
    """Field of a face that blocks alone have, which cases of fewer dimensions do not store."""
    return Field(default=None, exclude_if=lambda given: given is None, description=description)


class Surroundings(NamedTuple):
    """Surroundings that take heat from a surface: their temperature T_a [K], the heat transfer
    coefficient h_c [W/(m^2 K)], and the emissivity eps of the surface."""

    temperature: float
    convection: float
    emissivity: float

    @property
    def take_heat(self) -> bool:
        """Whether any heat leaves to them."""
        return self.convection > 0.0 or self.emissivity > 0.0

    @property
    def table(self) -> Array:
        """The numbers as `physics.losses.surface_loss` reads them."""
        return np.array([self.temperature, self.convection, self.emissivity])


class Boundaries(Model):
    """Conditions for heat at surface, bottom and sides."""

    surface: Face = Field(
        default="adiabatic", description="at z = 0; the laser heats it in any case"
    )
    surface_temperature: Temperature | None = Field(
        default=None, description="of a surface of fixed temperature, which needs it"
    )
    surface_temperature_wave: TemperatureWave | None = Field(
        default=None, description="added to surface_temperature"
    )
    surface_temperature_bump: TemperatureBump | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="added to surface_temperature, instead of a wave",
    )
    surface_pressure_wave: PressureWave | None = Field(
        default=None, description="a pressure on a surface that moves"
    )
    surface_pressure_bump: PressureBump | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="a pressure on a surface that moves, instead of a wave",
    )
    surface_mass_flux_wave: MassFluxWave | None = Field(
        default=None,
        description="mass that leaves a surface that moves, per its true area",
    )
    surface_flux: HeatFlux | None = Field(default=None, description="into the body")
    bottom: Face = Field(default="adiabatic", description="at the smallest z")
    bottom_temperature: Temperature | None = Field(
        default=None, description="where it is given; default: the initial temperature"
    )
    bottom_flux: HeatFlux | None = Field(default=None, description="into the body")
    sides: Face = Field(default="adiabatic", description="at both ends of x and y")
    side_temperature: Temperature | None = Field(
        default=None, description="where it is given; default: the initial temperature"
    )
    side_flux: HeatFlux | None = Field(default=None, description="into the body")
    left: Face | None = Field(default=None, description="at the smaller x; default: as sides")
    left_temperature: Temperature | None = Field(
        default=None,
        description="where it is given; default: side_temperature, else the initial temperature",
    )
    left_flux: HeatFlux | None = Field(default=None, description="into the body")
    right: Face | None = Field(default=None, description="at the larger x; default: as sides")
    right_temperature: Temperature | None = Field(
        default=None,
        description="where it is given; default: side_temperature, else the initial temperature",
    )
    right_flux: HeatFlux | None = Field(default=None, description="into the body")
    front: Face | None = _of_body("at the smaller y; 3-D; default: as sides")
    front_temperature: Temperature | None = _of_body("as left_temperature")
    front_flux: HeatFlux | None = _of_body("into the body")
    back: Face | None = _of_body("at the larger y; 3-D; default: as sides")
    back_temperature: Temperature | None = _of_body("as left_temperature")
    back_flux: HeatFlux | None = _of_body("into the body")
    convection: Annotated[HeatTransferCoefficient, Field(ge=0)] = Field(
        default=0.0, description="heat transfer coefficient of the surface"
    )
    emissivity: Annotated[Fraction, Field(ge=0, le=1)] | None = Field(
        default=None,
        description="of the surface, for radiation; default: optics.emissivity of the metal, 0 "
        "where it has none",
    )
    ambient_temperature: Temperature | None = Field(
        default=None, description="of the surroundings; default: the initial temperature"
    )
    ambient_pressure: Annotated[Pressure, Field(ge=0)] | None = Field(
        default=None,
        description='against which vapor leaves the surface; default: 1 atm; "0 Pa" for vacuum',
    )

    @model_validator(mode="after")
    def _check(self) -> Boundaries:
        problems = [*self._contradictions(), *self._halves_of_periods()]
        if problems:
            raise refusal(*problems)
        return self

    def _contradictions(self) -> Iterator[tuple[str, str]]:
        """Temperatures and fluxes that say nothing, or are missing."""
        for face, stem in KEYS.items():
            kind = getattr(self, face)
            shown = f'{face} = "{kind}"' if kind else f"{face} is not given"
            # a temperature without a face that takes it
            if getattr(self, f"{stem}_temperature") is not None and kind not in DIRICHLET:
                yield (
                    f"{stem}_temperature",
                    f"says nothing where {shown}; leave it out, or set {face} to "
                    '"fixed-temperature" or "wall"',
                )
            # a flux without a face that takes it, and such a face without a flux
            given = getattr(self, f"{stem}_flux") is not None
            if given and kind != NEUMANN:
                yield (
                    f"{stem}_flux",
                    f'says nothing where {shown}; leave it out, or set {face} to "{NEUMANN}"',
                )
            if kind == NEUMANN and not given:
                yield (
                    f"{stem}_flux",
                    f'is missing; write e.g. {stem}_flux = "1e6 W/m^2", positive into the body',
                )
        # the surface has no default: the initial temperature would heat nothing
        if self.surface in DIRICHLET and self.surface_temperature is None:
            yield (
                "surface_temperature",
                f'is missing where surface = "{self.surface}"; write e.g. surface_temperature = '
                '"1000 K"',
            )
        for what in ("temperature", "pressure"):
            yield from self._contradictory_drives(what)

    def _contradictory_drives(self, what: str) -> Iterator[tuple[str, str]]:
        """A wave and a bump of the same quantity, and a variation of what is not given."""
        wave, bump = f"surface_{what}_wave", f"surface_{what}_bump"
        given = [key for key in (wave, bump) if getattr(self, key) is not None]
        if len(given) > 1:
            yield bump, f"contradicts {wave}; leave one of them out"
        if what == "temperature" and given and self.surface not in DIRICHLET:
            yield (
                given[0],
                f'says nothing where surface = "{self.surface}"; write '
                'surface = "fixed-temperature"',
            )

    def _halves_of_periods(self) -> Iterator[tuple[str, str]]:
        for one, other in face_pairs(3)[::-1]:
            # a period joins two faces, so both say so
            kinds = {face: self.kind_of(face) for face in (one, other)}
            if list(kinds.values()).count("periodic") == 1:
                face = one if kinds[one] == "periodic" else other
                partner = other if face == one else one
                yield (
                    face if getattr(self, face) else "sides",
                    f'periodic on one side only; write {partner} = "periodic" too, or another '
                    "kind here",
                )

    def kind_of(self, face: str) -> Face:
        """Kind of a face: surface, bottom, left, right, front or back (the sides)."""
        if face in VERTICAL:
            return getattr(self, face)
        return getattr(self, face, None) or self.sides

    def temperature_of(self, face: str, initial: float) -> float:
        """Temperature of a face where it is given [K], without what varies along the surface."""
        given = self._given(face, "temperature")
        return initial if given is None else given

    def temperature_along(
        self,
        face: str,
        places: Sequence[Array],
        initial: float,
        interval: tuple[float, float] = (0.0, 0.0),
    ) -> Array:
        """Given temperature of a face [K] at places along x, and y where there is one [m].

        Averaged over an interval of time [s].
        """
        mean = np.full(np.shape(places[0]), self.temperature_of(face, initial))
        drive = self.temperature_drive
        if drive is None or face != SURFACE:
            return mean
        return mean + drive.mean_over(places, *interval)

    @property
    def temperature_drive(self) -> TemperatureWave | TemperatureBump | None:
        """How a given temperature of the surface varies along it; None where it does not."""
        return self.surface_temperature_wave or self.surface_temperature_bump

    @property
    def pressure_drive(self) -> PressureWave | PressureBump | None:
        """Pressure on a surface that moves; None without."""
        return self.surface_pressure_wave or self.surface_pressure_bump

    def flux_of(self, face: str) -> float:
        """Heat flux into the body through a face of prescribed flux [W/m^2], 0 at others."""
        return self._given(face, "flux") or 0.0 if self.kind_of(face) == NEUMANN else 0.0

    def emissivity_of(self, material: Material) -> float:
        """Emissivity of the surface: as given here, else the metal's where the surface lies open.

        A surface of given temperature and one that is periodic radiate only where told to.
        """
        if self.emissivity is not None:
            return self.emissivity
        if self.surface in DIRICHLET or self.surface == "periodic" or material.optics is None:
            return 0.0
        return material.optics.emissivity or 0.0

    @property
    def pressure_of_surroundings(self) -> float:
        """Against which vapor leaves the surface [Pa]: 1 atm where the case does not say."""
        return STANDARD_ATMOSPHERE if self.ambient_pressure is None else self.ambient_pressure

    def surroundings(self, material: Material, initial: float) -> Surroundings:
        """Surroundings of the surface of a metal; initial: temperature at the start [K]."""
        ambient = initial if self.ambient_temperature is None else self.ambient_temperature
        return Surroundings(ambient, self.convection, self.emissivity_of(material))

    def _given(self, face: str, what: str) -> float | None:
        # the faces' own key before that of all sides
        own = getattr(self, f"{face}_{what}", None)
        is_lateral = face not in VERTICAL
        return getattr(self, f"side_{what}") if own is None and is_lateral else own
