"""Surface tension of a melt, and how sulfur dissolved in it lowers it.

    gamma = gamma_pure(T) - R T Gamma_s ln(1 + K a),    K = k_1 exp(-H / (R T))

    d gamma/dT = d gamma_pure/dT - R Gamma_s ln(1 + K a) - K a / (1 + K a) Gamma_s H / T

[Sahoo1988], a the sulfur in percent of the mass. H < 0: heat drives sulfur from
the surface, so that the last term is positive and turns the slope of a pure metal around below a
temperature that rises with the sulfur.

Left out: other surface-active elements (oxygen above all), activities other than the content, the
time that sulfur takes to reach a fresh surface.
Reference: [Sahoo1988] Sahoo, DebRoy & McNallan, Metall. Trans. B 19 (1988) 483.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field, PrivateAttr

from lasersph.input import Model, MolarEnergy, SurfaceConcentration, SurfaceTension
from lasersph.materials.property import Property
from lasersph.materials.sections import GAS_CONSTANT

PERCENT = 100.0
"""Percent of the mass in a mass fraction of 1: the unit of the activity."""


class SulfurAdsorption(Model):
    """How sulfur gathers at the surface: constants of [Sahoo1988]."""

    saturation: SurfaceConcentration = Field(
        gt=0, description="most sulfur that the surface holds, Gamma_s"
    )
    segregation: float = Field(
        gt=0, description="entropy factor k_1 of adsorption, per percent of the mass"
    )
    enthalpy: MolarEnergy = Field(lt=0, description="standard heat of adsorption H")
    source: str = Field(min_length=1, description="where the numbers come from")
    note: str = Field(default="", description="what a reader should know about the numbers")

    def tension_loss(self, temperature: ArrayLike, content: float) -> NDArray[np.float64]:
        """By how much `content` (mass fraction above 0) lowers the surface tension [N/m] at
        temperature [K], any shape."""
        T = np.asarray(temperature, dtype=np.float64)
        exponent = np.log(self.segregation * PERCENT * content) - self.enthalpy / GAS_CONSTANT / T
        # ln(1 + exp(..)) without the overflow of K in a cold solid
        return GAS_CONSTANT * T * self.saturation * np.logaddexp(0.0, exponent)


class SurfaceTensionLaw(Property[SurfaceTension]):
    """Surface tension of the pure metal, and what sulfur takes from it."""

    adsorption: SulfurAdsorption | None = Field(
        default=None, description="of sulfur, whose content is the material's key sulfur"
    )
    _sulfur: float = PrivateAttr(default=0.0)

    def with_sulfur(self, content: float) -> SurfaceTensionLaw:
        """The law of a melt with that mass fraction of sulfur."""
        law = self.model_copy()
        law._sulfur = content
        return law

    @property
    def is_constant(self) -> bool:
        """True where the value does not depend on temperature."""
        return super().is_constant and self._sulfur == 0.0

    @property
    def is_curved(self) -> bool:
        """True where straight lines between the breakpoints do not give the law."""
        return super().is_curved or self._sulfur > 0.0

    def at(
        self, temperature: ArrayLike, solidus: float | None = None, liquidus: float | None = None
    ) -> NDArray[np.float64]:
        """Surface tension [N/m] at temperature [K], any shape; see `Property.at`."""
        pure = super().at(temperature, solidus, liquidus)
        if self.adsorption is None or self._sulfur == 0.0:
            return pure
        return pure - self.adsorption.tension_loss(temperature, self._sulfur)
