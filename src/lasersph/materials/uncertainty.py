"""Standard uncertainty of a material's number or law, with the place that states it.

A source gives it in one of three ways: as a standard deviation; as an interval that holds 95 %,
whose half width is divided by 2 [GUM2008, 4.3.4]; or as limits +-a without a probability, which are
divided by sqrt(3) [GUM2008, 4.3.7]. The file holds the result, and `source` says how it came about.

[GUM2008] JCGM 100:2008, Guide to the expression of uncertainty in measurement.
"""

from __future__ import annotations

from pydantic import Field

from lasersph.input import Model, QuantityError, parse_quantity, refusal


class Uncertainty(Model):
    """One standard deviation of what is known about a number, as its source states it."""

    standard: str = Field(
        description='one standard deviation: in percent of the value ("2 %") or, of a constant, '
        'in its unit ("462 K")',
        examples=["2 %"],
    )
    source: str = Field(min_length=1, description="who states it, and how it was converted")

    def relative_to(self, value: float | None, kind: str) -> float:
        """Standard uncertainty over the value; None: a law whose value depends on temperature.

        Raises:
            QuantityError: no percentage and no quantity of the kind, in a unit beside a law, or not
                between 0 and the value.
        """
        return relative_uncertainty(self.standard, value, kind)


def relative_uncertainty(text: str, value: float | None, kind: str) -> float:
    """A standard uncertainty ("2 %", "462 K") over the value it belongs to, between 0 and 1.

    Raises:
        QuantityError: see `Uncertainty.relative_to`.
    """
    if text.strip().endswith("%"):
        relative = parse_quantity(text, "fraction")
    elif value is None:
        raise QuantityError(f'"{text}" stands beside a law; write it in percent, e.g. "2 %"')
    elif value == 0.0:
        raise QuantityError("0 has no uncertainty that could be told in parts of it; leave it out")
    else:
        # 5 deg C of uncertainty are 5 K
        of_difference = "temperature_difference" if kind == "temperature" else kind
        relative = parse_quantity(text, of_difference) / abs(value)
    if not 0.0 < relative < 1.0:
        raise QuantityError(f'"{text}" must lie above 0 and below the value; write e.g. "2 %"')
    return relative


def checked_uncertainty(key: str, given: Uncertainty, value: float | None, kind: str) -> float:
    """The same for a model's validator: a mistake is reported at `key` of the model."""
    try:
        return given.relative_to(value, kind)
    except QuantityError as error:
        raise refusal((f"{key}.standard", str(error))) from None
