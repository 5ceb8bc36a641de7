"""Craters in 3-D: as round along the diagonals of the lattice as along its axes, and heat that
spreads sideways as from an exact disc."""

import numpy as np
import pytest
from moving_matter import go, host, mass, moving

from lasersph.analytic.half_space import step_rise
from lasersph.observers.energy_budget import relative_imbalance
from lasersph.physics.ejection import EJECTED

BLOCK = (
    "solver.dimensions=3", "boundaries.sides=wall", "boundaries.bottom=wall", "traces=",
    "laser.pulse={kind='square', duration='10 ns'}", "time.step=",
)  # fmt: skip


def test_crater_of_a_gaussian_beam_is_round():
    """Its depth follows from the distance to the axis alone, within one layer, whether along the
    rows of the lattice or along its diagonals."""
    _, solver = moving(
        "ablation-depth", *BLOCK, "domain.width=5.4 um", "domain.depth=2.4 um",
        "particles.spacing=0.2 um", "laser.beam={kind='gaussian', radius_1e2='2 um'}",
        "laser.fluence_kind=peak", "laser.fluence=20 J/cm^2", "time.end=7 ns",
    )  # fmt: skip
    go(solver, end=7e-9)
    solver.find_surface()
    depth = -solver.columns.tops()
    r = np.hypot(*solver.columns.center)
    assert depth.max() > 0.5e-6
    along = np.abs(np.abs(solver.columns.center[0]) - np.abs(solver.columns.center[1]))
    axis = np.abs(solver.columns.center[1]) < 0.11e-6
    order = np.argsort(r[axis])
    expected = np.interp(r, r[axis][order], depth[axis][order])
    is_inside = r < r[axis].max()
    assert np.abs(depth - expected)[is_inside].max() < 0.21e-6
    diagonal = (along < 0.01e-6) & is_inside
    rows = axis & is_inside
    widths = [r[chosen & (depth > 0.1e-6)].max() for chosen in (rows, diagonal)]
    assert widths[0] == pytest.approx(widths[1], abs=0.25e-6)


def test_heat_spreads_sideways_as_from_a_disc():
    """Below the middle of a top-hat spot the rise is that of a uniform disc of its radius."""
    spacing, radius, end = 0.25e-6, 1.5e-6, 1e-8
    _, solver = moving(
        "ablation-depth", *BLOCK, f"domain.width={31 * spacing} m",
        f"domain.depth={14 * spacing} m", f"particles.spacing={spacing} m",
        f"laser.beam={{kind='top-hat', radius='{radius} m'}}",
        "laser.fluence=1 J/cm^2", "laser.reflectivity=0.75", "solver.phase_change=false",
        "ejection={model='published'}",
    )  # fmt: skip
    go(solver, end=end)
    matter = solver.body
    x = solver.backend.to_host(matter.now.x)[:, : matter.count]
    T = solver.backend.to_host(matter.now.T)[: matter.count] - 300.0
    below = np.flatnonzero(np.hypot(x[0], x[1]) < 0.1 * spacing)
    material = matter.material
    exact = step_rise(
        -x[2, below], end, flux=0.25 * 1e4 / end,
        conductivity=float(material.conductivity_at(300.0)),
        diffusivity=material.diffusivity_reference, disc_radius=radius,
    )  # fmt: skip
    wide = step_rise(
        -x[2, below], end, flux=0.25 * 1e4 / end,
        conductivity=float(material.conductivity_at(300.0)),
        diffusivity=material.diffusivity_reference,
    )  # fmt: skip
    assert exact[4] < 0.9 * wide[4]
    assert T[below][2:8] == pytest.approx(exact[2:8], abs=0.03 * exact[0])


def test_light_goes_through_a_foil_burnt_through():
    """Where columns are empty the light is transmitted, neither absorbed nor reflected, and the
    balance closes to rounding; the foil is gone in the middle of the beam alone."""
    _, solver = moving(
        "ablation-depth", "solver.dimensions=2", "domain.width=6 um", "domain.depth=0.4 um",
        "particles.spacing=0.1 um", "boundaries.bottom=free", "traces=", "time.step=",
        "laser.beam={kind='gaussian', radius_1e2='1.5 um'}", "laser.fluence_kind=peak",
        "laser.fluence=20 J/cm^2", "laser.reflectivity=0.75",
    )  # fmt: skip
    go(solver, end=7e-9)
    solver.find_surface()
    is_empty = np.isnan(solver.columns.tops())
    assert 0 < is_empty.sum() < 60
    assert np.abs(solver.columns.center[0, is_empty]).max() < 1e-6
    energy = solver.state.energy
    assert energy["transmitted"] > 0.1 * energy["incident"]
    met = energy["incident"] - energy["transmitted"]
    assert energy["reflected"] == pytest.approx(0.75 * met, rel=1e-12)
    assert energy["absorbed"] == pytest.approx(0.25 * met, rel=1e-12)
    stays = host(solver, "stage") < EJECTED
    stored = float(mass(solver)[stays] @ host(solver, "enthalpy")[stays])
    assert relative_imbalance(energy | {"stored": stored}) < 1e-12
