"""Scales and dimensionless numbers against Table 4 of Demuth & Lasagni."""

import pytest

from lasersph.case import load_case
from lasersph.simulation.recipes import recipe_of


def test_steel_numbers_are_those_of_table_4() -> None:
    """L = 457.8 nm, La = 37.7151, Ph = 0.119849 and 3.10367, Fo = 5 for steel at 0.6 J/cm2."""
    found = recipe_of(load_case("dlip-steel")).dimensionless()
    assert found["scales"]["length_m"] == pytest.approx(457.8e-9, rel=2e-4)
    assert found["scales"]["time_s"] == pytest.approx(40e-9)
    assert found["numbers"]["La"] == pytest.approx(37.7151, rel=1e-5)
    assert found["numbers"]["Fo"] == pytest.approx(5.0)
    assert found["numbers"]["Ph_solid_liquid"] == pytest.approx(0.119849, rel=1e-5)
    assert found["numbers"]["Ph_liquid_vapor"] == pytest.approx(3.10367, rel=1e-5)


def test_no_light_has_no_scales() -> None:
    """The Stefan problem has no laser, so no such numbers."""
    assert recipe_of(load_case("stefan")).dimensionless() == {}


def test_flow_numbers_are_those_of_table_4() -> None:
    """Pr, Ra and Ma of steel; Ma is negative, and zero without Marangoni stress."""
    settings = ['solver.kind="melt-pool"']
    numbers = recipe_of(load_case("dlip-steel", settings)).dimensionless()["numbers"]
    assert numbers["Ra"] == pytest.approx(2.31e-8, rel=3e-3)
    assert numbers["Pr"] == pytest.approx(0.1947, rel=1e-3)
    assert numbers["Ma"] == pytest.approx(-8.29744, rel=1e-3)
    still = load_case("dlip-steel", [*settings, "solver.marangoni=false"])
    assert recipe_of(still).dimensionless()["numbers"]["Ma"] == 0.0


def test_numbers_of_boxes() -> None:
    """Re = 100 of the cavity, Ra = 1e4 and Pr = 0.71 of the heated box."""
    cavity = recipe_of(load_case("lid-driven-cavity")).dimensionless()["numbers"]
    assert cavity["Re"] == pytest.approx(100.0)
    assert "Ra" not in cavity
    heated = recipe_of(load_case("natural-convection")).dimensionless()["numbers"]
    assert heated["Ra"] == pytest.approx(1e4, rel=1e-6)
    assert heated["Pr"] == pytest.approx(0.71, rel=1e-6)
    assert "Re" not in heated
