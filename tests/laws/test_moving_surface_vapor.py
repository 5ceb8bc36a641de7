"""Vapor over a surface that moves: its recoil is a pressure, the mass that leaves its volume."""

import numpy as np
import pytest
from law_runs import solver_of

from lasersph.physics.evaporation import saturation_pressure, vapor_constants
from lasersph.physics.knudsen_layer import gauge_recoil_pressure, outflow_tables

FILM = (
    *("solver.kind=melt-pool", "initial_temperature=3500 K", "particles.spacing=40 nm"),
    *("boundaries.surface=adiabatic", "boundaries.surface_temperature="),
    *("boundaries.surface_temperature_wave=", "solver.vaporization=flux", "solver.marangoni=false"),
    'material.vaporization={ temperature = "3086.7 K", latent_heat = "7.41 MJ/kg", '
    'molar_mass = "55.34 g/mol", critical_temperature = "9250 K" }',
)


@pytest.mark.parametrize("pressure", ["1 atm", "0 Pa"])
def test_recoil_presses_and_mass_leaves(pressure):
    """A film of liquid at 3500 K: the pressure at its surface is the gauge recoil, and its volume
    shrinks by the mass that heat says has evaporated, to rounding of the displaced volume."""
    case, solver = solver_of("moving-film", *FILM, f"boundaries.ambient_pressure={pressure}")
    surface, line = solver.domain.surface, solver.domain.surface.line
    for _ in range(4):
        T = surface._line_temperature
        solver.step(2e-10)
    constants, (ratio, _, mach) = vapor_constants(case.material.vaporization), outflow_tables()
    ambient = case.boundaries.pressure_of_surroundings
    T = surface._line_temperature
    recoil = [
        gauge_recoil_pressure(saturation_pressure(float(t), **constants), ambient, ratio, mach)
        for t in T
    ]
    assert np.min(recoil) > 1e4
    # nothing bends a flat surface, and a film that sinks evenly is at rest
    assert surface._line_pressure == pytest.approx(np.array(recoil), rel=1e-3)
    gone = surface._followed / surface.liquid.density
    assert np.all(gone > 1e-13)
    assert line.height.sum() == pytest.approx(-gone.sum(), rel=1e-10)
    assert surface.flux_loss == pytest.approx(gone.sum() * line.width, rel=1e-10)


def test_no_recoil_where_the_plateau_holds():
    """The papers' rule leaves line and pressure alone."""
    settings = [one for one in FILM if "vaporization=flux" not in one and "3500" not in one]
    _, solver = solver_of("moving-film", *settings)
    solver.step(2e-10)
    surface = solver.domain.surface
    assert surface.drives.recoil is None and surface.flux_loss == 0.0
