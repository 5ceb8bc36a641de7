"""`Material`: all that lasersph knows about one metal, each number with unit, source and range."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field, model_validator

from lasersph.input import (
    Conductivity,
    Density,
    Diffusivity,
    Expansion,
    Fraction,
    KinematicViscosity,
    Model,
    SpecificHeat,
    SurfaceTensionSlope,
    Temperature,
    Viscosity,
    format_quantity,
    refusal,
)
from lasersph.materials.caloric_curve import CaloricCurve
from lasersph.materials.enthalpy import build_curve
from lasersph.materials.optics import NoOptics, Optics, shares_of
from lasersph.materials.property import Law, Property
from lasersph.materials.sections import Electrons, Melting, Vaporization
from lasersph.materials.surface_tension import SurfaceTensionLaw

Array = NDArray[np.float64]
Plateau = Literal["hold", "clip", "evaporate"]
POSITIVE = (
    "density",
    "heat_capacity",
    "conductivity",
    "conductivity_printed",
    "diffusivity",
    "viscosity",
    "kinematic_viscosity",
    "surface_tension",
)
"""Properties whose values must be above zero wherever their source gives them."""
VISCOSITIES = ("viscosity", "kinematic_viscosity")
"""Two names of one thing: over each other they are the density of the liquid."""
NO_ADSORPTION = (
    "lowers the surface tension by surface_tension.adsorption, which the material does not have; "
    "give saturation, segregation and enthalpy there, or leave sulfur out"
)
CONTRADICTION = 0.2
"""By how much eta / nu may differ from the density. A paper may print one average density over
solid and liquid; metals lose up to 15 % of theirs from room temperature to the liquidus."""
JUMP_WIDTH = 1e-3
"""Temperature over which a table draws a jump at the melting point [K]."""
REVERSAL_NODES = 1025
"""Nodes between which the slope of surface tension may change its sign. Accuracy: within 1 K."""


class Material(Model):
    """A metal. Property functions of temperature are `Property`; single numbers sit in sections.

    ``conductivity_printed`` and ``diffusivity`` keep what a paper prints beside the conductivity
    that is used; ``surface_tension_slope`` is d gamma/dT where the slope is known without gamma.
    """

    name: str = Field(min_length=1, description="how cases refer to the material")
    title: str = Field(default="", description="what the metal is, in words")
    composition: str = Field(default="", description="elements and their shares, in words")
    note: str = Field(default="", description="what a reader should know about the numbers")
    reference_temperature: Temperature = Field(
        default=298.15, gt=0, description="where the density of fixed particles is taken"
    )
    sulfur: Fraction = Field(
        default=0.0, ge=0, lt=0.01, description="mass fraction, which lowers the surface tension"
    )
    density: Property[Density] = Field(description="mass per volume")
    heat_capacity: Property[SpecificHeat] = Field(description="per mass, at constant pressure")
    conductivity: Property[Conductivity] = Field(
        description="of heat; in a case a constant diffusivity may stand instead"
    )
    conductivity_printed: Property[Conductivity] | None = Field(
        default=None, description="what a paper prints: compared, not computed with"
    )
    diffusivity: Property[Diffusivity] | None = Field(
        default=None, description="of heat, as printed: compared, not computed with"
    )
    viscosity: Property[Viscosity] | None = Field(
        default=None, description="dynamic, of the liquid"
    )
    kinematic_viscosity: Property[KinematicViscosity] | None = Field(
        default=None, description="viscosity over density, where a source gives this one"
    )
    surface_tension: SurfaceTensionLaw | None = Field(default=None, description="of the liquid")
    surface_tension_slope: Property[SurfaceTensionSlope] | None = Field(
        default=None, description="change of the surface tension with temperature"
    )
    expansion: Property[Expansion] | None = Field(
        default=None, description="volumetric, of the liquid"
    )
    melting: Melting | None = Field(default=None, description="where and with which heat it melts")
    vaporization: Vaporization | None = Field(default=None, description="the same of boiling")
    optics: Optics | None = Field(default=None, description="how its surface takes up light")
    electrons: Electrons | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="what a run with two temperatures must know of its electrons",
    )

    @model_validator(mode="after")
    def _check_values(self) -> Material:
        """Refuse values that no solver survives: zero or negative, or shares beyond 0..1."""
        # sulfur acts by the constants of adsorption
        gamma = self.surface_tension
        if self.sulfur > 0.0 and (gamma is None or gamma.adsorption is None):
            raise refusal(("sulfur", NO_ADSORPTION))
        shares = self._shares()
        for name, property_ in (self.properties() | shares).items():
            for phase, law in property_.laws().items():
                # each law over its own range, kinks included
                values = law.at(sample_temperatures(law))
                where = name if phase == "all" else f"{name}.{phase}"
                if not np.all(np.isfinite(values)):
                    raise ValueError(f"{where} is not finite everywhere in its range")
                if name in POSITIVE and np.any(values <= 0.0):
                    raise ValueError(f"{where} must be positive everywhere in its range")
                if name in shares and (values.min() < 0.0 or values.max() > 1.0):
                    raise ValueError(f"{where} must lie between 0 and 1 everywhere in its range")
        self._compare_viscosities()
        # phases in their order
        boiling = self.vaporization.temperature if self.vaporization else float("inf")
        if self.liquidus is not None and boiling <= self.liquidus:
            raise ValueError("the boiling temperature must lie above the liquidus")
        return self

    def _compare_viscosities(self) -> None:
        """Refuse dynamic and kinematic viscosities whose ratio is not the density of the liquid."""
        if self.viscosity is None or self.kinematic_viscosity is None:
            return
        # eta / nu is the density of the liquid
        T, ratio = self.flow_temperature, self.density_liquid
        density = float(self.density.liquid_law.at(T))
        if abs(ratio / density - 1.0) > CONTRADICTION:
            right = format_quantity(float(self.viscosity_at(T)) / density, "m^2/s")
            text = (
                f"with viscosity makes the density of the liquid {ratio:.4g} kg/m^3 at {T:g} K, "
                f'but density is {density:.4g} kg/m^3; write kinematic_viscosity = "{right}", or '
                "leave one of the two viscosities out"
            )
            raise refusal(("kinematic_viscosity", text))

    def properties(self) -> dict[str, Property[Any]]:
        """All given properties by name, shares of light and the effect of sulfur included."""
        found = {
            name: getattr(self, name)
            for name in type(self).model_fields
            if isinstance(getattr(self, name), Property)
        }
        # properties that are not fields: gamma with its sulfur, shares of light among the optics
        if self.surface_tension is not None:
            found["surface_tension"] = self.surface_tension.with_sulfur(self.sulfur)
        return found | (shares_of(self.optics) if self.optics else {})

    def _shares(self) -> dict[str, Property[Any]]:
        """Shares of light: those of the optics by name, those of single wavelengths by key."""
        found = shares_of(self.optics) if self.optics else {}
        for wavelength, one in (self.optics.by_wavelength if self.optics else {}).items():
            key = f"optics.by_wavelength.{wavelength}"
            found |= {f"{key}.{name}": share for name, share in shares_of(one).items()}
        return found

    def in_light(self, wavelength: float | None) -> Material:
        """The same metal with its optics at a wavelength [m]; None where that is not known.

        Raises:
            NoOptics: it has none for this light; see `Optics.at`.
        """
        if self.optics is None:
            return self
        try:
            return self.model_copy(update={"optics": self.optics.at(wavelength)})
        except NoOptics as error:
            raise NoOptics(f"material {self.name!r} {error}") from None

    def uncertainties(self) -> dict[str, tuple[float, str]]:
        """By key ("density.liquid", "melting.latent_heat"): relative standard uncertainty and who
        states it, of all that have one."""
        found, shares = {}, self._shares()
        for name, property_ in self.properties().items():
            # laws, then single numbers of the sections
            home = f"optics.{name}" if name in shares else name
            for phase, law in property_.laws().items():
                if law.uncertainty is not None:
                    key = home if phase == "all" else f"{home}.{phase}"
                    found[key] = (law.relative_uncertainty, law.uncertainty.source)
        for home in ("melting", "vaporization", "optics", "electrons"):
            section = getattr(self, home)
            for name, given in (section.uncertainty if section else {}).items():
                found[f"{home}.{name}"] = (section.relative_uncertainty(name), given.source)
        return found

    @property
    def solidus(self) -> float | None:
        """Temperature at which melting begins [K]; None without melting data."""
        return self.melting.solidus if self.melting else None

    @property
    def liquidus(self) -> float | None:
        """Temperature at which melting is complete [K]; None without melting data."""
        return self.melting.liquidus if self.melting else None

    @property
    def density_reference(self) -> float:
        """Density that fixed particles keep [kg/m^3]: at the reference temperature."""
        return float(self.density_at(self.reference_temperature))

    @property
    def is_liquid(self) -> bool:
        """Whether the material is liquid at any temperature: it flows and never melts."""
        has_viscosity = self.viscosity is not None or self.kinematic_viscosity is not None
        return self.melting is None and has_viscosity

    @property
    def flow_temperature(self) -> float:
        """Temperature at which constant numbers of the liquid are taken [K].

        The liquidus; the reference temperature where the material is liquid everywhere.
        Raises ValueError where there is no liquid.
        """
        if self.liquidus is not None:
            return self.liquidus
        if self.is_liquid:
            return self.reference_temperature
        raise ValueError(f"material {self.name!r} has no melting point")

    @property
    def density_liquid(self) -> float:
        """Density that the flow of the melt goes with [kg/m^3]: eta / nu at the liquidus.

        The liquid's density there; where a paper gives eta and nu but only an average density
        over solid and liquid, the density that relates eta and nu. Where the material is liquid
        everywhere, that at the reference temperature.
        Raises ValueError where there is no liquid.
        """
        T = self.flow_temperature
        if self.kinematic_viscosity is not None and self.viscosity is not None:
            return float(self.at("viscosity", T) / self.at("kinematic_viscosity", T))
        return float(self.density.liquid_law.at(T))

    @property
    def diffusivity_reference(self) -> float:
        """k / (rho c_p) at the reference temperature [m^2/s]."""
        T = self.reference_temperature
        capacity = float(self.heat_capacity_at(T))
        return float(self.conductivity_at(T)) / (self.density_reference * capacity)

    def at(self, name: str, temperature: ArrayLike) -> Array:
        """Property by name [SI] at temperature [K], any shape.

        Raises ValueError where the material does not have the property.
        """
        found = self.properties().get(name)
        if found is None:
            raise ValueError(f"material {self.name!r} has no {name.replace('_', ' ')}")
        return found.at(temperature, self.solidus, self.liquidus)

    def density_at(self, temperature: ArrayLike) -> Array:
        """Density [kg/m^3] at temperature [K], any shape."""
        return self.at("density", temperature)

    def heat_capacity_at(self, temperature: ArrayLike) -> Array:
        """Sensible specific heat capacity [J/(kg K)] at temperature [K], any shape."""
        return self.at("heat_capacity", temperature)

    def conductivity_at(self, temperature: ArrayLike) -> Array:
        """Thermal conductivity [W/(m K)] at temperature [K], any shape."""
        return self.at("conductivity", temperature)

    def viscosity_at(self, temperature: ArrayLike) -> Array:
        """Dynamic viscosity [Pa s] at temperature [K]: as given, else the liquid's nu rho."""
        if self.viscosity is None and self.kinematic_viscosity is not None:
            nu = self.at("kinematic_viscosity", temperature)
            return nu * self.density.liquid_law.at(temperature)
        return self.at("viscosity", temperature)

    def expansion_at(self, temperature: ArrayLike) -> Array:
        """Volumetric expansion [1/K] of the liquid at temperature [K]; 0 where it is not given."""
        if self.expansion is None:
            return np.zeros(np.shape(temperature))
        return self.at("expansion", temperature)

    def reflectivity_at(self, temperature: ArrayLike) -> Array:
        """Reflectivity (0 to 1) at surface temperature [K], any shape."""
        return self.at("reflectivity", temperature)

    def surface_tension_at(self, temperature: ArrayLike) -> Array:
        """Surface tension [N/m] at temperature [K], any shape."""
        return self.at("surface_tension", temperature)

    def surface_tension_slope_at(self, temperature: ArrayLike) -> Array:
        """d gamma/dT [N/(m K)] at temperature [K]: as given, else the slope of gamma(T)."""
        if self.surface_tension_slope is not None:
            return self.at("surface_tension_slope", temperature)
        # central difference over 1 K
        T, half = np.asarray(temperature, dtype=np.float64), 0.5
        return self.surface_tension_at(T + half) - self.surface_tension_at(T - half)

    def slope_reversal(self, upper: float) -> float | None:
        """Temperature between liquidus and `upper` [K] at which d gamma/dT falls through 0.

        Below it melt flows to where it is hot, above it to where it is cold. None where the slope
        has one sign, or the metal no surface tension.
        """
        given = self.surface_tension_slope is not None or self.surface_tension is not None
        if self.liquidus is None or not given:
            return None
        # the first change of sign of a fine table, linear between its nodes
        T = np.linspace(self.liquidus, upper, REVERSAL_NODES)
        slope = self.surface_tension_slope_at(T)
        changes = np.flatnonzero((slope[:-1] > 0.0) & (slope[1:] <= 0.0))
        if not changes.size:
            return None
        k = changes[0]
        return float(T[k] + (T[k + 1] - T[k]) * slope[k] / (slope[k] - slope[k + 1]))

    def kinematic_viscosity_at(self, temperature: ArrayLike) -> Array:
        """Kinematic viscosity [m^2/s] at temperature [K]: as given, else the liquid's eta / rho."""
        if self.kinematic_viscosity is not None:
            return self.at("kinematic_viscosity", temperature)
        return self.viscosity_at(temperature) / self.density.liquid_law.at(temperature)

    def table(self, name: str, lower: float, upper: float, count: int = 65) -> tuple[Array, Array]:
        """Nodes and values of a property for linear interpolation between lower and upper [K].

        The kinks of its laws, solidus and liquidus are nodes; curved laws get ``count`` more. A
        jump at the melting point is drawn over JUMP_WIDTH below it.
        """
        found = self.properties().get(name)
        if found is None:
            raise ValueError(f"material {self.name!r} has no {name.replace('_', ' ')}")
        # kinks of the laws and ends of the melting range; curved laws between them
        nodes = {lower, upper}
        if found.is_constant:
            return np.array([lower, upper]), found.at([lower, upper])
        for law in found.laws().values():
            nodes.update(law.breakpoints(lower, upper))
            if law.is_curved:
                nodes.update(np.linspace(lower, upper, count))
        for T in (self.solidus, self.liquidus):
            if T is not None and lower < T < upper:
                nodes.add(T)
        # melting point: a steep line instead of a jump
        if self.solidus is not None and self.solidus == self.liquidus:
            before = self.solidus - JUMP_WIDTH
            if lower < before and self.solidus < upper:
                nodes = {T for T in nodes if not before < T < self.solidus} | {before}
        T = np.array(sorted(nodes))
        return T, found.at(T, self.solidus, self.liquidus)

    def caloric_curve(
        self,
        initial_temperature: float,
        plateau: Plateau = "hold",
        *,
        phase_change: bool = True,
    ) -> CaloricCurve:
        """Enthalpy curve with h = 0 for the solid at ``initial_temperature`` [K].

        plateau: "hold" keeps T at the boiling point for any h above; "clip" is the same curve for
        a solver that limits h to ``enthalpy_vaporized``; "evaporate" lets the liquid go on, and so
        does a material without a boiling point whatever the plateau.
        phase_change = False leaves melting and boiling out (the solid's laws for every T).

        Raises ValueError where the initial temperature is not below the solidus.
        """
        return build_curve(
            heat_capacity=self.heat_capacity,
            conductivity=self.conductivity,
            melting=self.melting if phase_change else None,
            vaporization=self.vaporization if phase_change else None,
            initial_temperature=initial_temperature,
            plateau=plateau,
            name=self.name,
        )


def sample_temperatures(law: Law[Any], count: int = 129) -> Array:
    """Temperatures [K] over the range of a law, kinks included; 200 to 4000 K without one."""
    # laws without an end are looked at where metals melt and boil
    lower = law.lower if law.lower > 0.0 else 200.0
    upper = law.upper if np.isfinite(law.upper) else max(4000.0, 2.0 * lower)
    return np.unique(
        np.concatenate((np.linspace(lower, upper, count), [row[0] for row in law.table]))
    )
