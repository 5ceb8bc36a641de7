"""The speed that `check` expects is within a factor of 2 of that of the run, for all that flows."""

import numpy as np
import pytest

from lasersph.analytic.melt_depth import SurfaceHistory
from lasersph.case import available_cases, load_case
from lasersph.case.solver_choice import computes_flow
from lasersph.simulation import forecast
from lasersph.simulation.recipes.melt_pool.driven_speed import (
    BELOW_LID,
    BELOW_MOVING_SURFACE,
    driven_speed,
)
from lasersph.simulation.recipes.melt_pool.forecast import crossing_speed

COMPUTED = {
    ("dlip-steel", ""): 6.006,  # docs/validation/dlip-steel.json, as the next four
    ("dlip-steel", "0.4 J/cm^2"): 1.606,
    ("dlip-steel", "1.0 J/cm^2"): 14.67,
    ("dlip-aluminium", ""): 17.14,  # docs/validation/dlip-aluminium.json, as the next two
    ("dlip-aluminium", "0.6 J/cm^2"): 7.326,
    ("dlip-aluminium", "1.2 J/cm^2"): 20.20,
    ("texture-steel", ""): 22.31,  # lasersph run texture-steel: largest speed at the surface
    ("texture-aluminium", ""): 29.46,  # the same with particles.spacing=32nm
    ("texture-dots-steel", ""): 14.35,  # the same with particles.spacing=64nm --anyway
    ("texture-hexagons-steel", ""): 13.46,  # the same
    # lasersph run texture-steel-10ps with 16 nm, to 4 ns: largest speed at the surface
    ("texture-steel-10ps", ""): 1.785,
    ("spot-steel", ""): 11.1,  # lasersph run spot-steel: largest speed at the surface
    ("spot-weld", ""): 2.666,  # lasersph run spot-weld: largest speed at the surface
    ("moving-film", ""): 1.146,  # lasersph run moving-film --quick
    ("spot-film", ""): 0.48,  # lasersph run spot-film
    ("natural-convection", ""): 0.2977,  # lasersph run natural-convection --quick: any particle
    ("heated-cube", ""): 0.2605,  # lasersph run heated-cube: any particle
    ("marangoni-layer", ""): 0.01445,  # docs/validation/marangoni-layer.json
    ("lid-driven-cavity", ""): 1.0,  # of the lid
    ("lid-driven-cube", ""): 1.0,  # of the lid
    ("taylor-green", ""): 1.0,  # at the start, from which it decays
}
"""Largest speed [m/s] of runs, of the shipped case or at another fluence."""


def test_every_case_that_flows_is_here():
    """A new shipped case needs its computed speed."""
    flowing = {name for name in available_cases() if computes_flow(load_case(name).solver)}
    assert flowing == {name for name, _ in COMPUTED}


@pytest.mark.parametrize(("name", "fluence"), COMPUTED)
def test_within_a_factor_of_two(name, fluence):
    """Of the computed one, whatever moves the liquid."""
    settings = [f"laser.fluence={fluence}"] if fluence else []
    flow = forecast(load_case(name, settings)).flow
    assert flow is not None
    assert 0.5 < flow.speed / COMPUTED[name, fluence] < 2.0


def steady(time, **given):
    """Speed after a time [s] of two columns 100 K apart, 1 um wide, water-like numbers."""
    times = np.linspace(time / 400, time, 400)
    surface = SurfaceHistory(
        times, np.tile([1100.0, 1000.0], (400, 1)), np.full((400, 2), 1e-7), 1e-6
    )
    usual = {
        "length": 1e-6,
        "cold": 900.0,
        "density": 1e3,
        "viscosity": lambda T: np.full_like(T, 1e-6),
        "slope": np.zeros_like,
        "pressure": np.zeros_like,
        "confinement": BELOW_LID,
    }
    return driven_speed(surface, **usual | given)


def test_layers_under_a_steady_stress():
    """tau d/(4 eta) below a lid, tau d/eta below an open surface; at first that of Stokes."""
    tau, eta, depth = 1e-4 * 1e8, 1e-3, 1e-7
    drawn = {"slope": lambda T: np.full_like(T, -1e-4)}
    late = 20.0 * depth**2 / 1e-6
    lid = steady(late, confinement=BELOW_LID, **drawn)
    assert lid == pytest.approx(0.25 * tau * depth / eta, rel=1e-3)
    open_layer = steady(late, confinement=BELOW_MOVING_SURFACE, **drawn)
    assert open_layer == pytest.approx(tau * depth / eta, rel=1e-3)
    early = 1e-4 * depth**2 / 1e-6
    stokes = 2.0 * tau * np.sqrt(early / (np.pi * 1e-6)) / 1e3
    assert steady(early, **drawn) == pytest.approx(stokes, rel=2e-2)


def test_a_layer_under_a_steady_pressure():
    """4 d^2/(pi^2 nu) times the acceleration of a gradient of 1e9 Pa/m over 1000 kg/m^3."""
    pushed = steady(2e-7, pressure=lambda T: 10.0 * T)
    assert pushed == pytest.approx(1e6 * 4.0 * 1e-14 / (np.pi**2 * 1e-6), rel=1e-2)


def test_speed_on_the_way_across():
    """2 tau/rho = 2 m^2/s^2, 2 m, pi nu = 1 m^2/s: the cube root of 8."""
    assert crossing_speed(1.0, 2.0, 1.0, np.full(3, 1.0 / np.pi)) == pytest.approx(2.0)
