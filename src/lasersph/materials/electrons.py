"""`Electrons`: what a run with two temperatures must know of the electrons of a metal.

    C_e(T_e)      heat capacity [J/(m^3 K)]: a number, a coefficient times T_e, or a table
    G(T_e)        coupling to the lattice [W/(m^3 K)]
    k_e(T_e, T_l) conductivity: a number; or that of the metal at T_l, less the lattice's share,

        k_e = (1 - s) k(T_l) (T_e / T_l) (1 + a T_l) / (1 + a T_e^2 / T_l),    a = A / B

The second form is C_e v^2 / (3 (A T_e^2 + B T_l)) with C_e ~ T_e [Ivanov2003, eq. (4)], scaled so
that both temperatures together conduct as the metal does. Left out: changes of k_e and G with the
temperature of the lattice but for that, and with magnetic order.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field, model_validator

from lasersph.input import (
    Conductivity,
    Coupling,
    Expansion,
    Fraction,
    Length,
    VolumetricHeat,
    VolumetricHeatSlope,
    refusal,
)
from lasersph.materials.property import Law
from lasersph.materials.sections import Sourced

Array = NDArray[np.float64]
QuantityT = TypeVar("QuantityT", bound=float)


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
    """Electrons of a metal, each number sourced."""

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
        if self.scattering is not None:
            raise refusal(("scattering", "says nothing beside conductivity; leave one of them out"))
        return self

    @property
    def hottest(self) -> float:
        """Highest temperature of the electrons that their heat capacity knows [K]; infinite where
        it is no table. Beyond the ends of the coupling the values there are held."""
        return self.heat_capacity.upper
