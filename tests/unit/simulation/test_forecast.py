"""Forecasts: counts as the filling makes them, limits by name, warnings in words."""

import pytest

from lasersph.case import load_case
from lasersph.simulation import forecast
from lasersph.simulation.layers import lay_out


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
    assert any("within 10.5 nm, less than one spacing of 32.1 nm" in w for w in found.warnings)


def test_explicit_runs_are_bound_by_conduction() -> None:
    """0.846 dx^2 / D = 0.77 ns for aluminium at 0.25 um (1-D)."""
    found = forecast(load_case("pulsed-heating"))
    assert found.limits["conduction"] == pytest.approx(0.846 * 0.25e-6**2 / 6.89e-5, rel=1e-3)


def test_flow_of_a_cavity() -> None:
    """The lid's speed and 0.06 of the support radius per step: 62 mm times 0.06 at 1 m/s."""
    found = forecast(load_case("lid-driven-cavity", ["time.end=10 s"]))
    assert found.flow is not None and found.flow.speed == 1.0 and found.flow.layer is None
    assert found.limits["advection"] == pytest.approx(0.00372)
    assert not {"capillary", "recoil"} & set(found.limits)
    assert (found.binding, found.steps) == ("advection", 2689)


def test_flow_of_a_driven_layer_and_of_a_warm_wall() -> None:
    """The exact speed of slow flow; a fifth of sqrt(g beta dT L) = 1 m/s."""
    layer = forecast(load_case("marangoni-layer")).flow
    warm = forecast(load_case("natural-convection")).flow
    assert layer is not None and layer.speed == pytest.approx(0.01439, rel=1e-3)
    assert warm is not None and warm.speed == pytest.approx(0.2, rel=1e-3)


def test_flow_of_a_pool() -> None:
    """sqrt(nu t) = 101 nm of steel is dragged along at some m/s; coarse spacings are warned of."""
    settings = ["solver.kind=melt-pool", "particles.spacing=16nm"]
    found = forecast(load_case("dlip-steel", settings))
    assert found.flow is not None and found.flow.layer == pytest.approx(101e-9, rel=0.1)
    assert 3.0 < found.flow.speed < 15.0
    assert any("drags along" in text for text in found.warnings)
    heat = forecast(load_case("dlip-steel", [*settings, "solver.kind=conduction"]))
    assert heat.steps < found.steps < 1.5 * heat.steps
    assert heat.wall_time < found.wall_time < 4.0 * heat.wall_time
    at_rest = forecast(load_case("dlip-steel", [*settings, "solver.marangoni=false"])).flow
    assert at_rest is not None and at_rest.speed == 0.0


@pytest.mark.parametrize(
    ("name", "settings", "each"),
    [
        ("dlip-steel", ["solver.kind=conduction"], 56.0),
        ("dlip-steel", [], 100.0),
        ("dam-break", [], 24.0),
    ],
)
def test_memory_by_solver(name, settings, each) -> None:
    """400 B a particle, and for each pair more where a melt flows than where nothing is kept."""
    found = forecast(load_case(name, settings))
    assert found.memory == pytest.approx(400.0 * found.particles + each * found.pairs)


def test_a_run_that_ends_before_the_light_says_so() -> None:
    """Nothing melts, so that the finest layers hold the light only; `check` warns."""
    found = forecast(load_case("dlip-steel", ["time.end=2 ns"]))
    assert any("no light falls before time.end" in warning for warning in found.warnings)
