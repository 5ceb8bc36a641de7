"""A material property as a function of temperature: a constant, a table or a formula, sourced.

Every law carries the source of its numbers and the range of temperature in which the source gives
them; outside that range the value at the nearer end is held. A property may have one law for
everything or one for the solid and one for the liquid; in the melting range it is then mixed
linearly in T from the solid's value at the solidus to the liquid's at the liquidus.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Generic, Self, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field, model_validator

from lasersph.input import Model, Temperature, quantity_kind, refusal
from lasersph.materials.uncertainty import Uncertainty, checked_uncertainty

Quantity = TypeVar("Quantity", bound=float)
Array = NDArray[np.float64]


class Law(Model, Generic[Quantity]):
    """One property in one phase. Exactly one of value, table, polynomial, log10 is given."""

    value: Quantity | None = Field(default=None, description="constant value")
    table: tuple[tuple[Temperature, Quantity], ...] = Field(
        default=(),
        description="rows of temperature and value, rising in temperature; linear between",
    )
    polynomial: tuple[float, ...] = Field(
        default=(),
        description="coefficients c_n of scale * sum c_n (T / temperature_scale)^powers[n]",
    )
    powers: tuple[int, ...] = Field(
        default=(), description="powers of the polynomial; default 0, 1, 2, ..."
    )
    log10: tuple[float, float] | None = Field(
        default=None, description="a and b of scale * 10^(a + b temperature_scale / T)"
    )
    scale: Quantity | None = Field(
        default=None, description='unit of the formula, for example "1 mPa s"; needed with one'
    )
    temperature_scale: Temperature = Field(
        default=1.0, description="T is divided by it in the formula"
    )
    range: tuple[Temperature, Temperature] | None = Field(
        default=None, description="temperatures between which the source gives the law"
    )
    source: str = Field(
        default="", description="where the numbers come from", examples=["where it is from"]
    )
    note: str = Field(default="", description="what a reader should know about them")
    uncertainty: Uncertainty | None = Field(
        default=None, exclude=True, description="standard uncertainty, where the source gives one"
    )

    @model_validator(mode="after")
    def _check_form(self) -> Law[Quantity]:
        """Refuse a law with no form, with two forms, or with an impossible one."""
        forms = [name for name, _ in self._forms()]
        self._check_count(forms)
        if (self.polynomial or self.log10) and self.scale is None:
            raise ValueError('a formula needs its unit: scale = "1 <unit>"')
        if forms and not self.source.strip():
            raise ValueError('every number needs its source: source = "..."')
        if self.powers and len(self.powers) != len(self.polynomial):
            raise ValueError("powers and polynomial must have equally many entries")
        temperatures = [row[0] for row in self.table]
        if len(temperatures) == 1 or any(np.diff(temperatures) <= 0.0):
            raise ValueError("a table needs two rows or more, rising in temperature")
        if self.range is not None and self.range[0] >= self.range[1]:
            raise ValueError("a range runs from the lower to the higher temperature")
        if self.uncertainty is not None and not forms:
            text = "belongs to one law; write it into the tables solid and liquid"
            raise refusal(("uncertainty", text))
        _ = self.relative_uncertainty
        return self

    def _forms(self) -> Iterator[tuple[str, object]]:
        for name in ("value", "table", "polynomial", "log10"):
            given = getattr(self, name)
            if given is not None and given != ():
                yield name, given

    def _check_count(self, forms: list[str]) -> None:
        if len(forms) != 1:
            raise ValueError(
                "give exactly one of value, table, polynomial, log10"
                + (f", not {' and '.join(forms)}" if forms else "")
            )

    @property
    def relative_uncertainty(self) -> float | None:
        """Standard uncertainty over the value, at every temperature; None where none is stated."""
        if self.uncertainty is None:
            return None
        kind = quantity_kind(type(self), "value")
        return checked_uncertainty("uncertainty", self.uncertainty, self.value, kind)

    def scaled(self, factor: float) -> Self:
        """The same law with every value times a factor."""
        changes = {
            "value": None if self.value is None else factor * self.value,
            "table": tuple((T, factor * value) for T, value in self.table),
            "scale": None if self.scale is None else factor * self.scale,
        }
        return self.model_copy(update=changes)

    @property
    def lower(self) -> float:
        """Lowest temperature of the range [K]; 0 for a law without one."""
        if self.range is not None:
            return self.range[0]
        return self.table[0][0] if self.table else 0.0

    @property
    def upper(self) -> float:
        """Highest temperature of the range [K]; infinite for a law without one."""
        if self.range is not None:
            return self.range[1]
        return self.table[-1][0] if self.table else np.inf

    @property
    def is_constant(self) -> bool:
        """True where the value does not depend on temperature."""
        return self.value is not None

    @property
    def is_curved(self) -> bool:
        """True where straight lines between the breakpoints do not give the law."""
        return self.log10 is not None or len(self.polynomial) > 2 or bool(self.powers)

    def breakpoints(self, lower: float, upper: float) -> list[float]:
        """Temperatures strictly between lower and upper at which the law has a kink [K]."""
        kinks = {row[0] for row in self.table}
        if not self.is_constant:
            kinks |= {self.lower, self.upper}
        return sorted(kink for kink in kinks if lower < kink < upper)

    def at(self, temperature: ArrayLike) -> Array:
        """Value [SI] at temperature [K], any shape; the nearer end's outside the range."""
        # beyond the range of the source the value at its end
        T = np.clip(np.asarray(temperature, dtype=np.float64), self.lower, self.upper)
        if self.value is not None:
            return np.full(T.shape, float(self.value))
        if self.table:
            return np.interp(T, [row[0] for row in self.table], [row[1] for row in self.table])
        scale = float(self.scale or 0.0)
        t = T / self.temperature_scale
        # an Arrhenius law, or a polynomial of T over its scale
        if self.log10 is not None:
            return scale * 10.0 ** (self.log10[0] + self.log10[1] / t)
        powers = self.powers or tuple(range(len(self.polynomial)))
        terms = (c * t ** float(n) for c, n in zip(self.polynomial, powers, strict=True))
        return scale * np.sum(list(terms), axis=0)


class Property(Law[Quantity], Generic[Quantity]):
    """A law for everything, or one for the solid and one for the liquid."""

    solid: Law[Quantity] | None = Field(default=None, description="the law of the solid")
    liquid: Law[Quantity] | None = Field(default=None, description="the law of the melt")

    def _check_count(self, forms: list[str]) -> None:
        phases = [name for name in ("solid", "liquid") if getattr(self, name) is not None]
        if not phases:
            super()._check_count(forms)
        elif forms:
            raise ValueError(f"give either one law ({forms[0]}) or laws for solid and liquid")

    def scaled(self, factor: float) -> Self:
        """The same property with every value of its law, or of both laws, times a factor."""
        both = {"solid": self.solid, "liquid": self.liquid}
        laws = {name: law and law.scaled(factor) for name, law in both.items()}
        return super().scaled(factor).model_copy(update=laws)

    @property
    def solid_law(self) -> Law[Quantity]:
        """The law of the solid; the liquid's where the solid has none of its own."""
        return self.solid or self.liquid or self

    @property
    def liquid_law(self) -> Law[Quantity]:
        """The law of the liquid; the solid's where the liquid has none of its own."""
        return self.liquid or self.solid or self

    def laws(self) -> dict[str, Law[Quantity]]:
        """The laws by phase: "solid", "liquid", or "all" where there is one for both."""
        given = {"solid": self.solid, "liquid": self.liquid}
        return {name: law for name, law in given.items() if law is not None} or {"all": self}

    def at(
        self, temperature: ArrayLike, solidus: float | None = None, liquidus: float | None = None
    ) -> Array:
        """Value [SI] at temperature [K], any shape.

        Solid below the solidus, liquid from the liquidus on, mixed linearly in T between them.
        Without solidus and liquidus the solid's law is used.
        """
        T = np.asarray(temperature, dtype=np.float64)
        if self.solid is None and self.liquid is None:
            return super().at(T)
        if solidus is None or liquidus is None:
            return self.solid_law.at(T)
        solid = self.solid_law.at(np.minimum(T, solidus))
        liquid = self.liquid_law.at(np.maximum(T, liquidus))
        # melting range, or a jump at the melting point
        if liquidus > solidus:
            share = np.clip((T - solidus) / (liquidus - solidus), 0.0, 1.0)
        else:
            share = np.where(liquidus <= T, 1.0, 0.0)
        return (1.0 - share) * solid + share * liquid
