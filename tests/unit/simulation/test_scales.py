"""Scales and dimensionless numbers against Table 4 of Demuth & Lasagni."""

import pytest

from lasersph.case import load_case
from lasersph.simulation.scales import dimensionless


def test_steel_numbers_are_those_of_table_4() -> None:
    """L = 457.8 nm, La = 37.7151, Ph = 0.119849 and 3.10367, Fo = 5 for steel at 0.6 J/cm2."""
    found = dimensionless(load_case("dlip-steel"))
    assert found["scales"]["length_m"] == pytest.approx(457.8e-9, rel=2e-4)
    assert found["scales"]["time_s"] == pytest.approx(40e-9)
    assert found["numbers"]["La"] == pytest.approx(37.7151, rel=1e-5)
    assert found["numbers"]["Fo"] == pytest.approx(5.0)
    assert found["numbers"]["Ph_solid_liquid"] == pytest.approx(0.119849, rel=1e-5)
    assert found["numbers"]["Ph_liquid_vapor"] == pytest.approx(3.10367, rel=1e-5)


def test_no_light_has_no_scales() -> None:
    """The Stefan problem has no laser, so no such numbers."""
    assert dimensionless(load_case("stefan")) == {}
