"""Forecasts: counts as the filling makes them, limits by name, warnings in words."""

import pytest

from lasersph.case import load_case
from lasersph.simulation import forecast
from lasersph.simulation.build import lay_out


def test_counts_are_those_of_the_layers() -> None:
    """Particles and layers are what `lay_out` gives, and memory grows with them."""
    case = load_case("dlip-steel", ["particles.spacing=32nm"])
    layers = lay_out(case)
    found = forecast(case)
    assert found.particles == layers.particle_count
    assert found.layers == layers.thickness.size
    assert found.memory > 400 * found.particles
    assert found.binding == "light"
    assert found.limits["light"] == pytest.approx(50e-12)


def test_fine_layers_hold_the_expected_pool() -> None:
    """Steel at 0.6 J/cm2 melts 296 nm; the finest layers reach that and two support radii more."""
    found = forecast(load_case("dlip-steel"))
    assert 296e-9 + 2 * 3.75 * 8e-9 < found.fine_depth < 420e-9


def test_coarse_spacing_is_warned_of() -> None:
    """Light absorbed within 10 nm is not resolved by 32 nm, and `check` says so."""
    found = forecast(load_case("dlip-steel", ["particles.spacing=32nm"]))
    assert any("absorbed within" in text for text in found.warnings)


def test_explicit_runs_are_bound_by_conduction() -> None:
    """0.846 dx^2 / D = 0.77 ns for aluminium at 0.25 um (1-D)."""
    found = forecast(load_case("pulsed-heating"))
    assert found.limits["conduction"] == pytest.approx(0.846 * 0.25e-6**2 / 6.89e-5, rel=1e-3)
