"""How the surface of a metal takes up light and radiates, for one wavelength or for several.

Where n and k are given, reflectivity at normal incidence and absorption coefficient follow:

    R = ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2),    alpha = 4 pi k / lambda      [Born1999, ch. 14]

Nothing is interpolated between wavelengths: light more than SAME_LIGHT away from all entries has
none. Left out: other angles of incidence, roughness, oxides.
Reference: [Born1999] Born & Wolf, Principles of Optics, 7th ed.
"""

from __future__ import annotations

from math import pi
from typing import Any

from pydantic import Field, model_validator

from lasersph.input import (
    AbsorptionCoefficient,
    Fraction,
    Length,
    Model,
    QuantityError,
    parse_quantity,
    refusal,
)
from lasersph.materials.property import Property
from lasersph.materials.sections import Sourced

SAME_LIGHT = 0.01
"""Relative difference of two wavelengths that share their optics: 1064 and 1070 nm do, 1064 and
1030 nm do not."""


class NoOptics(ValueError):
    """A material has no optics for the light of a case."""


def shares_of(optics: Optics | SpectralOptics) -> dict[str, Property[Any]]:
    """Its shares between 0 and 1 that may depend on temperature, by key."""
    return {name: given for name, given in optics if isinstance(given, Property)}


class SpectralOptics(Model):
    """Optics at one wavelength and normal incidence: n and k, or R and alpha."""

    refractive_index: float | None = Field(default=None, gt=0, description="n of n + i k")
    extinction_coefficient: float | None = Field(default=None, gt=0, description="k of n + i k")
    reflectivity: Property[Fraction] | None = Field(
        default=None, description="instead of what n and k give"
    )
    absorption_coefficient: AbsorptionCoefficient | None = Field(
        default=None, gt=0, description="instead of 4 pi k over the wavelength"
    )
    source: str = Field(min_length=1, description="source of the numbers")
    note: str = Field(default="", description="what a reader should know about the numbers")

    @model_validator(mode="after")
    def _check_pair(self) -> SpectralOptics:
        if (self.refractive_index is None) != (self.extinction_coefficient is None):
            raise ValueError("refractive_index and extinction_coefficient go together; give both")
        if self.reflectivity is None and self.refractive_index is None:
            raise ValueError("give refractive_index and extinction_coefficient, or reflectivity")
        return self

    def at(self, wavelength: float, emissivity: float | None = None) -> Optics:
        """The same as numbers for a wavelength [m]: reflectivity and absorption coefficient."""
        n, k = self.refractive_index, self.extinction_coefficient
        reflectivity, alpha = self.reflectivity, self.absorption_coefficient
        if n is not None and k is not None:
            # Fresnel's equations at normal incidence [Born1999]; what is given goes before
            alpha = alpha or 4.0 * pi * k / wavelength
            if reflectivity is None:
                share = ((n - 1.0) ** 2 + k**2) / ((n + 1.0) ** 2 + k**2)
                text = f"n = {n:g}, k = {k:g} of {self.source}"
                reflectivity = Property[Fraction](value=share, source=text, note=self.note)
        return Optics(
            reflectivity=reflectivity,
            absorption_coefficient=alpha,
            wavelength=wavelength,
            emissivity=emissivity,
            source=self.source,
        )


class Optics(Sourced):
    """How the surface takes up light and radiates, at normal incidence.

    Numbers beside `wavelength` hold there; without it at every wavelength.
    """

    reflectivity: Property[Fraction] | None = Field(
        default=None, description="share of the light that does not enter"
    )
    absorption_coefficient: AbsorptionCoefficient | None = Field(
        default=None, gt=0, description="one over the depth in which light falls to 1/e"
    )
    wavelength: Length | None = Field(default=None, gt=0, description="for which the numbers hold")
    emissivity: Fraction | None = Field(
        default=None, ge=0, le=1, description="total, of the surface"
    )
    by_wavelength: dict[str, SpectralOptics] = Field(
        default={},
        exclude_if=lambda given: not given,
        description='tables named by their wavelength, as in [optics.by_wavelength."1064 nm"]; '
        "laser.wavelength of the case chooses",
    )

    @model_validator(mode="before")
    @classmethod
    def _take_source(cls, data: Any) -> Any:
        """Tables by wavelength have sources of their own: beside them none is needed here."""
        if isinstance(data, dict) and "source" not in data and data.get("by_wavelength"):
            return {**data, "source": {}}
        return data

    @model_validator(mode="after")
    def _check_wavelengths(self) -> Optics:
        known: dict[float, str] = {}
        for name in self.by_wavelength:
            try:
                wavelength = parse_quantity(name, "length")
            except QuantityError as error:
                raise refusal((f"by_wavelength.{name}", f"names no wavelength: {error}")) from None
            if wavelength <= 0.0:
                raise refusal((f"by_wavelength.{name}", 'must be positive; write e.g. "1064 nm"'))
            # one light has one entry
            twin = next((old for old in known if is_same_light(old, wavelength)), None)
            if twin is not None:
                text = f'is the light of "{known[twin]}" already; leave one of the two out'
                raise refusal((f"by_wavelength.{name}", text))
            known[wavelength] = name
        return self

    def wavelengths(self) -> list[float]:
        """All wavelengths [m] that numbers are given for, longest first."""
        own = [self.wavelength] if self.wavelength is not None else []
        return sorted([*own, *(parse_quantity(n, "length") for n in self.by_wavelength)])[::-1]

    def refraction_at(self, wavelength: float | None) -> complex | None:
        """n + i k at a wavelength [m]; None where they are not given, or R goes before them."""
        own = self.wavelength
        # numbers for every wavelength, or for this light, go before the tables
        if wavelength is None or (self.reflectivity is not None and own is None):
            return None
        if own is not None and is_same_light(own, wavelength):
            return None
        for name, light in self.by_wavelength.items():
            if is_same_light(parse_quantity(name, "length"), wavelength):
                n, k = light.refractive_index, light.extinction_coefficient
                if n is None or k is None or light.reflectivity is not None:
                    return None
                return complex(n, k)
        return None

    def at(self, wavelength: float | None) -> Optics:
        """The numbers for light of a wavelength [m]; None: those that name none, or their own.

        A reflectivity or absorption coefficient that names no wavelength goes before the tables.

        Raises:
            NoOptics: there are none for this light, or it has to be known and is not.
        """
        shown = [in_nanometers(one) for one in self.wavelengths()]
        listed = "has optics at " + ", ".join(f'"{one}"' for one in shown)
        example = f'wavelength = "{shown[0]}" in [laser]' if shown else ""
        if wavelength is None:
            # numbers that hold for every wavelength, or the only ones
            if not self.by_wavelength or self.wavelength is not None or self.reflectivity:
                return self
            raise NoOptics(f"{listed}; write e.g. {example}")
        if self.wavelength is not None and is_same_light(self.wavelength, wavelength):
            return self
        for name, optics in self.by_wavelength.items():
            if not is_same_light(parse_quantity(name, "length"), wavelength):
                continue
            found = optics.at(wavelength, self.emissivity)
            if self.wavelength is None:
                # numbers that name no wavelength go before those of the table
                own = {"reflectivity": self.reflectivity}
                own |= {"absorption_coefficient": self.absorption_coefficient}
                found = found.model_copy(update={k: v for k, v in own.items() if v is not None})
            return found
        if not shown:
            return self
        raise NoOptics(
            f'{listed}, not at "{in_nanometers(wavelength)}"; write e.g. {example}, or '
            "reflectivity in [laser] and absorption_coefficient in [laser.absorption]"
        )


def is_same_light(one: float, other: float) -> bool:
    """Whether two wavelengths [m] are so close that they share their optics."""
    return abs(one - other) <= SAME_LIGHT * max(one, other)


def in_nanometers(wavelength: float) -> str:
    """A wavelength [m] as it is spoken of: "1064 nm"."""
    return f"{1e9 * wavelength:.6g} nm"
