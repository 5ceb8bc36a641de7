"""Craters in 3-D: as round along the diagonals of the lattice as along its axes, and heat that
spreads sideways as from an exact disc."""

from dataclasses import replace

import numpy as np
import pytest
from law_runs import imbalance
from moving_matter import go, host, moving

from lasersph import compute
from lasersph.analytic.half_space import step_rise
from lasersph.boundaries.initial_motion import Rest
from lasersph.boundaries.vessel import Vessel
from lasersph.case import load_case
from lasersph.observers import Crater, Ejecta, MeltPool
from lasersph.particles.kinds import EJECTED
from lasersph.simulation.layers import lay_out
from lasersph.simulation.recipes import recipe_of
from lasersph.simulation.recipes.ablation.build import solver_of
from lasersph.solvers.ablation.geometry import lay_out as lay_out_particles

BLOCK = (
    "solver.dimensions=3", "boundaries.sides=wall", "boundaries.bottom=wall", "traces=",
    "laser.pulse={kind='square', duration='10 ns'}", "time.step=",
)  # fmt: skip


SPOT = (
    *BLOCK, "boundaries.sides=free", "boundaries.bottom=free", "domain.width=5.4 um",
    "domain.depth=2.4 um", "particles.spacing=0.2 um", "laser.fluence_kind=peak",
    "laser.beam={kind='gaussian', radius_1e2='2 um'}", "laser.fluence=20 J/cm^2", "time.end=7 ns",
)  # fmt: skip
SPACING = 0.2e-6


@pytest.fixture(scope="module")
def along_the_lattice():
    """The crater of a Gaussian beam on rows along x and y."""
    _, solver = moving("ablation-depth", *SPOT)
    go(solver, end=7e-9)
    return solver


def turned(case, angle):
    """Geometry and initial state of a block cut from a lattice turned about z."""
    wide = case.model_copy(
        update={"domain": case.domain.model_copy(update={"width": 45 * SPACING})}
    )
    layout, start = lay_out_particles(
        lay_out(wide), case.boundaries, Vessel(), Rest(), temperature=case.initial_temperature,
        density=case.material.density_reference, sound_speed=1000.0, gravity=0.0,
    )  # fmt: skip
    x, y, z = start.position
    position = np.array(
        [np.cos(angle) * x - np.sin(angle) * y, np.sin(angle) * x + np.cos(angle) * y, z]
    )
    half = 0.5 * case.domain.width
    stays = (np.abs(position[:2]) < half).all(axis=0) & (np.arange(x.size) < layout.count)
    side = (-half, half)
    layout = replace(
        layout, count=int(stays.sum()), total=int(stays.sum()),
        surface_count=int(stays[: layout.surface_count].sum()),
        bounds=(side, side, layout.bounds[2]), box=(side, side, layout.box[2]),
    )  # fmt: skip
    kept = {name: values[..., stays] for name, values in vars(start).items()}
    return layout, replace(start, **kept | {"position": position[:, stays]})


def depth_at(solver, points):
    """Depth of the crater at points (2, n) [m]: that of the layers whose particle nearest to a
    point has left."""
    count = solver.body.geometry.surface_count
    start = solver.backend.to_host(solver.pairs.listed)[:2, :count]
    has_left = host(solver, "kind").reshape(-1, count) >= EJECTED
    distance = np.hypot(*(points[:, :, None] - start[:, None, :]))
    return SPACING * has_left.sum(axis=0)[distance.argmin(axis=1)]


def test_crater_of_a_gaussian_beam_is_round(along_the_lattice):
    """Its depth follows from the distance to the axis alone, within one layer, whether along the
    rows of the lattice or along its diagonals."""
    solver = along_the_lattice
    depth = -solver.light.column_tops()
    r = np.hypot(*solver.light.center)
    assert depth.max() > 0.5e-6
    along = np.abs(np.abs(solver.light.center[0]) - np.abs(solver.light.center[1]))
    axis = np.abs(solver.light.center[1]) < 0.11e-6
    order = np.argsort(r[axis])
    expected = np.interp(r, r[axis][order], depth[axis][order])
    is_inside = r < r[axis].max()
    assert np.abs(depth - expected)[is_inside].max() < 0.21e-6
    diagonal = (along < 0.01e-6) & is_inside
    rows = axis & is_inside
    widths = [r[chosen & (depth > 0.1e-6)].max() for chosen in (rows, diagonal)]
    assert widths[0] == pytest.approx(widths[1], abs=0.25e-6)


@pytest.mark.parametrize("angle", [30.0, 45.0])
def test_crater_does_not_know_the_lattice(along_the_lattice, angle):
    """On a lattice turned about the axis, against the columns of the light too, the depth along
    rays in all directions is the same within one layer, and what boils within 1 %."""
    case = load_case("ablation-depth", SPOT)
    across = solver_of(case, case.solver, compute.cpu(threads=2), *turned(case, np.radians(angle)))
    go(across, end=7e-9)
    r, phi = np.meshgrid(np.arange(0.0, 2.5e-6, 0.1e-6), np.radians(np.arange(0, 360, 15)))
    rays = np.array([(r * np.cos(phi)).ravel(), (r * np.sin(phi)).ravel()])
    one, other = (depth_at(solver, rays) for solver in (along_the_lattice, across))
    assert one.max() > 0.5e-6
    assert np.abs(other - one).max() < 1.05 * SPACING
    assert np.abs(other - one).mean() < 0.3 * SPACING
    assert boiled(across) == pytest.approx(boiled(along_the_lattice), rel=0.01)


def boiled(solver):
    """Particles that have left, and the shares of their heat that others have taken up."""
    share = solver.backend.to_host(solver.particles["vapor_fraction"])[: solver.body.count]
    return solver.state.ejecta.number + share[host(solver, "kind") < EJECTED].sum()


def test_half_a_spot_is_enough():
    """Where the axis of the beam lies on an adiabatic side, widths of crater and melt are those of
    the whole spot within a column at each end, and so are volumes, masses and energies."""
    found = []
    for width, x in (("6 um", "0 um"), ("3 um", "-1.5 um")):
        case, solver = moving(
            "ablation-depth", *BLOCK, "solver.dimensions=2", "boundaries.sides=adiabatic",
            f"domain.width={width}", "domain.depth=2.4 um", "particles.spacing=0.1 um",
            f"laser.position=['{x}', '0 um']", "laser.fluence_kind=peak",
            "laser.beam={kind='gaussian', radius_1e2='1.5 um'}", "laser.fluence=20 J/cm^2",
        )  # fmt: skip
        go(solver, end=7e-9)
        view = recipe_of(case).view(solver, 1, "")
        pool, crater = MeltPool(2), Crater(2, axis=(float(x.removesuffix(" um")) * 1e-6, 0.0))
        ejecta = Ejecta(2).observe(view)
        found.append(pool.observe(view) | crater.observe(view) | ejecta | view.energy)
    whole, half = found
    assert whole["crater_width_m"] > 1e-6 and whole["melt_width_m"] > whole["crater_width_m"]
    for name in ("melt_width_m", "melt_width_half_m", "crater_width_m"):
        assert half[name] == pytest.approx(whole[name], abs=0.21e-6)
    for name in ("incident", "absorbed", "removed"):
        assert half[name] == pytest.approx(whole[name], rel=0.03)
    for name in ("melt_volume_m3", "crater_removed_volume_m2", "ejected_mass_kg"):
        assert half[name] == pytest.approx(whole[name], rel=0.05, abs=0.0)


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
    x = solver.backend.to_host(matter.now["position"])[:, : matter.count]
    T = solver.backend.to_host(matter.now["temperature"])[: matter.count] - 300.0
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
    case, solver = moving(
        "ablation-depth", "solver.dimensions=2", "domain.width=6 um", "domain.depth=0.4 um",
        "particles.spacing=0.1 um", "boundaries.bottom=free", "traces=", "time.step=",
        "laser.beam={kind='gaussian', radius_1e2='1.5 um'}", "laser.fluence_kind=peak",
        "laser.fluence=20 J/cm^2", "laser.reflectivity=0.75",
    )  # fmt: skip
    go(solver, end=7e-9)
    is_empty = np.isnan(solver.light.column_tops())
    assert 0 < is_empty.sum() < 60
    assert np.abs(solver.light.center[0, is_empty]).max() < 1e-6
    energy = solver.state.energy
    assert energy["transmitted"] > 0.1 * energy["incident"]
    met = energy["incident"] - energy["transmitted"]
    assert energy["reflected"] == pytest.approx(0.75 * met, rel=1e-12)
    assert energy["absorbed"] == pytest.approx(0.25 * met, rel=1e-12)
    assert imbalance(case, solver) < 1e-12
