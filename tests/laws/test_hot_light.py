"""Light that hot electrons take up: nothing is lost or made, all dimensions agree, and electrons
whose collisions change nothing take what cold metal does."""

import numpy as np
import pytest
from short_pulses import case_of, go, host, solver_of

from lasersph.irradiation.hot_light import HotLight, hot_share
from lasersph.irradiation.light import energies
from lasersph.observers import EnergyBudget
from lasersph.simulation.recipes import recipe_of

COPPER = (
    "material=copper", "laser.absorption.absorption_coefficient=", "laser.reflectivity=",
    "laser.wavelength=1064 nm", "laser.fluence=0.8 J/cm^2", "solver.phase_change=true",
    "domain.depth=1 um", "particles.spacing=5 nm", "time.end=20 ps",
)  # fmt: skip
FLAT = ("particles.fine_depth=100 nm", "particles.spacing=10 nm", "time.growth=2")


def energy_of(solver):
    """Heat of the particles [J]."""
    return float(np.sum(host(solver, "enthalpy") * host(solver, "mass")))


def test_two_cells_by_hand():
    """Cells of 10 nm under light of 20 nm depth: 1 - exp(-1/2), and exp(-1/2) of that."""
    alphas = [5e7]
    first = hot_share(5e-9, 5e-9, 2.0, 0, alphas)
    assert first == pytest.approx(2.0 * (1.0 - np.exp(-0.5)))
    assert hot_share(15e-9, 5e-9, 2.0, 0, alphas) == pytest.approx(np.exp(-0.5) * first)


def test_books_of_a_reflectivity_that_falls(tmp_path):
    """Copper takes up 2.5 times what it takes up cold, and that is what its particles hold."""
    case = case_of(tmp_path, *COPPER)
    solver = solver_of(case)
    budget, recipe = EnergyBudget(1), recipe_of(case)
    budget.observe(recipe.view(solver, 0, ""))
    for time in (0.4e-12, 0.5e-12, 0.6e-12, 2e-12, 20e-12):
        go(solver, time)
        row = budget.observe(recipe.view(solver, 1, ""))
        assert row["energy_imbalance_relative"] < 1e-6
    seen = solver.state.energy
    assert seen["incident"] == pytest.approx(8000.0, rel=1e-9)
    assert seen["absorbed"] + seen["reflected"] + seen["transmitted"] == pytest.approx(
        seen["incident"], rel=1e-9
    )
    assert energy_of(solver) == pytest.approx(seen["absorbed"], rel=1e-9)
    assert seen["absorbed"] > 2.5 * (1.0 - 0.9725) * 8000.0


def test_on_every_backend(tmp_path, backend):
    """What the particles take of the light, summed, is what enters and does not pass."""
    solver = solver_of(case_of(tmp_path, *COPPER, *FLAT), backend=backend)
    light = solver.body.light
    light.shine(0.45e-12, 0.5e-12)
    rates = backend.asarray(np.full(solver.body.count, 1e15))
    absorbed = float(light.absorb(rates))
    lost = energies(light, absorbed)["unassigned"]
    assert lost == pytest.approx(0.0, abs=1e-6 * light.incident)
    assert absorbed == pytest.approx(float(backend.to_host(light.deposit).sum()), rel=1e-6)
    assert 0.1 < absorbed / light.incident < 0.2


def test_electrons_that_change_nothing(tmp_path):
    """With next to no free electrons, light is that of cold metal: the run with R of its n and k,
    to rounding."""
    found = []
    R = ((0.352 - 1.0) ** 2 + 7.047**2) / ((0.352 + 1.0) ** 2 + 7.047**2)
    for change in ("material.electrons.plasma_frequency=1 rad/s", f"laser.reflectivity={R!r}"):
        solver = solver_of(case_of(tmp_path, *COPPER, "laser.fluence=3 J/cm^2", change))
        assert isinstance(solver.body.light, HotLight) is ("1 rad" in change)
        go(solver, 1e-12)
        found.append([host(solver, name) for name in ("electron_temperature", "temperature")])
    for hot, cold in zip(*found, strict=True):
        assert hot == pytest.approx(cold, rel=1e-11)


def test_steps_are_of_second_order(tmp_path):
    """With R of the surface at the start of each part: halving the step quarters the error."""
    found = []
    for step in (8.0, 4.0, 2.0):
        fixed = ("time.is_fixed=true", "solver.step_error=0.49", f"time.step={step} fs")
        solver = solver_of(case_of(tmp_path, *COPPER, *fixed, "solver.phase_change=false"))
        go(solver, 0.8e-12)
        found.append(host(solver, "electron_temperature"))
    errors = [np.abs(found[k] - found[k + 1]).max() for k in (0, 1)]
    assert 1.6 < np.log2(errors[0] / errors[1]) < 2.6


@pytest.mark.parametrize("space", ["plane", "rings"])
def test_dimensions_agree(tmp_path, space):
    """Uniform light on a plane or a section (r, z): the share absorbed in 1-D."""
    rings = ("solver.geometry=axisymmetric",) if space == "rings" else ()
    shares = []
    plane = ("solver.dimensions=2", "domain.width=0.1 um", *rings)
    for settings in (("solver.dimensions=1",), plane):
        solver = solver_of(case_of(tmp_path, *COPPER, *FLAT, *settings))
        go(solver, 1e-12)
        seen = solver.state.energy
        shares.append(seen["absorbed"] / seen["incident"])
        assert energy_of(solver) == pytest.approx(seen["absorbed"], rel=1e-8, abs=0.0)
    assert shares[1] == pytest.approx(shares[0], rel=2e-3)


def test_particles_that_have_moved(tmp_path):
    """Melt that lies elsewhere takes all the light of its columns, whatever its collisions."""
    case = case_of(
        tmp_path, *COPPER, *FLAT, "solver.kind=melt-pool", "solver.dimensions=2",
        "solver.flow.surface=flat", "domain.width=0.2 um", "domain.depth=2 um",
        "particles.arrangement=uniform", "particles.fine_depth=", "particles.coarsest=",
        "particles.ratio=",
    )  # fmt: skip
    solver = solver_of(case)
    backend, light = solver.backend, solver.body.light
    assert isinstance(light, HotLight)
    rates = backend.asarray(np.linspace(1e14, 9e15, solver.body.count))
    light.shine(0.45e-12, 0.5e-12)
    on_lattice = float(light.absorb(rates))
    assert energies(light, on_lattice)["unassigned"] == pytest.approx(
        0.0, abs=1e-12 * light.incident
    )
    # in cells, where they have not moved: each what it takes on the lattice
    lattice = np.array(backend.to_host(light.deposit))
    solver.advect(0.0)
    solver.state.time = 0.45e-12
    solver.illuminate(0.05e-12)
    light.absorb(rates)
    found = np.array(backend.to_host(light.deposit))
    assert found == pytest.approx(lattice, rel=1e-9, abs=1e-12 * lattice.max())
    place = np.array(backend.to_host(solver.position))
    moved = np.random.default_rng(1).uniform(-4e-9, 4e-9, place.shape)
    x, z = place + moved * (place[-1] > -1e-7)
    low, high = place[0].min(), place[0].max()
    place = np.array([np.clip(x, low, high), np.minimum(z, -1e-9)])
    backend.copy(backend.asarray(place), solver.position)
    solver.state.time = 0.45e-12
    solver.illuminate(0.05e-12)
    absorbed = float(light.absorb(rates))
    assert energies(light, absorbed)["unassigned"] == pytest.approx(0.0, abs=1e-9 * light.incident)
    assert 0.0 < absorbed < light.incident
