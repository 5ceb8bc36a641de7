"""Laws of a property: values by hand, ranges held, phases mixed, bad ones refused."""

from __future__ import annotations

import numpy as np
import pytest
from pydantic import ValidationError

from lasersph.input import Conductivity, Density, Fraction, Viscosity
from lasersph.materials import Law, Property

SOURCE = "made up for the test"


def test_table_is_linear_and_held_outside() -> None:
    """Between rows linear, outside the nearer row's value."""
    law = Law[Density](table=((300.0, 10.0), (400.0, 30.0)), source=SOURCE)
    np.testing.assert_allclose(law.at([200.0, 300.0, 325.0, 400.0, 9e3]), [10, 10, 15, 30, 30])


def test_polynomial_with_unit_and_powers() -> None:
    """1 g/cm^3 * (2 + 3 t - 4 / t^2), t = T / 1000 K, at 500 K: -12.5 g/cm^3."""
    law = Law[Density](
        polynomial=(2.0, 3.0, -4.0),
        powers=(0, 1, -2),
        scale="1 g/cm^3",  # type: ignore[arg-type]
        temperature_scale=1000.0,
        source=SOURCE,
    )
    assert law.at(500.0) == pytest.approx(-12.5e3)


def test_logarithmic_law_by_hand() -> None:
    """1 mPa s * 10^(-0.7324 + 803.49 K / T) is 1.3439 mPa s at 933.47 K."""
    law = Law[Viscosity](
        log10=(-0.7324, 803.49),
        scale="1 mPa s",  # type: ignore[arg-type]
        source=SOURCE,
    )
    assert law.at(933.47) == pytest.approx(1.3439e-3, rel=1e-4)


def test_range_clamps_a_formula() -> None:
    """Outside its range a formula keeps the value of the nearer end."""
    law = Law[Density](polynomial=(0.0, 1.0), scale=1.0, range=(300.0, 500.0), source=SOURCE)
    np.testing.assert_allclose(law.at([100.0, 400.0, 900.0]), [300.0, 400.0, 500.0])


def test_phases_are_mixed_over_the_melting_range() -> None:
    """Solid 10 and liquid 20: 15 in the middle between solidus and liquidus."""
    k = Property[Conductivity](
        solid=Law[Conductivity](value=10.0, source=SOURCE),
        liquid=Law[Conductivity](value=20.0, source=SOURCE),
    )
    np.testing.assert_allclose(
        k.at([900, 1000, 1050, 1100, 1200], 1000.0, 1100.0), [10, 10, 15, 20, 20]
    )


def test_melting_point_makes_a_jump() -> None:
    """Eq. (78): the liquid's value holds from T_m on, the solid's just below it."""
    R = Property[Fraction](
        solid=Law[Fraction](value=0.7, source=SOURCE),
        liquid=Law[Fraction](value=0.65, source=SOURCE),
    )
    np.testing.assert_array_equal(R.at([932.9999, 933.0], 933.0, 933.0), [0.7, 0.65])


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"source": SOURCE}, "exactly one of"),
        ({"value": 1.0, "table": ((1.0, 1.0), (2.0, 2.0)), "source": SOURCE}, "value and table"),
        ({"value": 1.0}, "needs its source"),
        ({"polynomial": (1.0,), "source": SOURCE}, "needs its unit"),
        ({"polynomial": (1.0,), "powers": (0, 1), "scale": 1.0, "source": SOURCE}, "equally many"),
        ({"table": ((2.0, 1.0), (1.0, 2.0)), "source": SOURCE}, "rising"),
        ({"table": ((2.0, 1.0),), "source": SOURCE}, "two rows"),
        ({"value": 1.0, "range": (500.0, 300.0), "source": SOURCE}, "lower to the higher"),
    ],
)
def test_impossible_laws_are_refused(given: dict, words: str) -> None:
    """Each mistake with the words that lead out of it."""
    with pytest.raises(ValidationError, match=words):
        Law[Density](**given)


def test_one_law_or_two_but_not_both() -> None:
    """A property with a law for the liquid has none for everything."""
    with pytest.raises(ValidationError, match="either one law"):
        Property[Density](value=1.0, source=SOURCE, liquid=Law[Density](value=1.0, source=SOURCE))
