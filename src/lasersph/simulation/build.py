"""From a case to layers and a solver, and from a solver to what observers see."""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.analytic.melt_depth import melt_depth
from lasersph.case import Case
from lasersph.compute.backend import Backend
from lasersph.irradiation.light import COLDEST, HOTTEST
from lasersph.lasers import InterferenceBeam
from lasersph.materials.caloric_curve import CaloricCurve
from lasersph.observers.view import View
from lasersph.particles.layers import Layers, stack
from lasersph.simulation.ablation_view import ablation_view_of
from lasersph.simulation.build_ablation import ablation
from lasersph.simulation.build_flow import with_flow
from lasersph.simulation.flow_view import flow_view_of, taking
from lasersph.simulation.spot_edges import halves_spot
from lasersph.solvers.ablation.settings import AblationSettings
from lasersph.solvers.ablation.solver import Ablation
from lasersph.solvers.conduction.body import SUPPORT, assemble
from lasersph.solvers.conduction.settings import ConductionSettings
from lasersph.solvers.conduction.solver import Conduction
from lasersph.solvers.heat_settings import HeatSettings
from lasersph.solvers.melt_pool.settings import MeltPoolSettings
from lasersph.solvers.melt_pool.solver import MeltPool

ESTIMATE_COLUMNS = 8
LEAST_FINE_LAYERS = 8
ABSORPTION_LENGTHS = 12.0
"""Depth of the finest layers in units of 1/alpha, at least: light of exp(-12) goes deeper."""


def caloric_curve(case: Case) -> CaloricCurve:
    """Enthalpy curve of the case's material with the case's plateau rule."""
    return case.material.caloric_curve(
        case.initial_temperature, case.solver.plateau, phase_change=case.solver.phase_change
    )


def support_ratio(case: Case) -> float:
    """Support radius over spacing."""
    return case.particles.support_ratio or SUPPORT[case.particles.kernel]


def lay_out(case: Case) -> Layers:
    """Layers of the case; where graded and not given, the fine depth follows from an estimate."""
    fine = case.particles.fine_depth or 0.0
    if case.particles.arrangement == "graded" and not fine:
        fine = fine_depth(case)
    return stack(case.domain, case.particles, case.solver.dimensions, fine)


def fine_depth(case: Case) -> float:
    """Depth of the finest layers [m]: expected melt plus two support radii, and all the light."""
    spacing = case.particles.spacing
    least = LEAST_FINE_LAYERS * spacing
    laser = case.laser
    if laser is None:
        return least
    alpha = laser.absorption_coefficient(case.material)
    least = max(least, ABSORPTION_LENGTHS / alpha)
    if not case.solver.phase_change or case.material.melting is None:
        return least
    width = case.domain.width
    columns, column_width = 1, None
    is_pattern = isinstance(laser.beam, InterferenceBeam)
    if width is not None and laser.is_even and is_pattern:
        columns, column_width = ESTIMATE_COLUMNS, 0.5 * width / ESTIMATE_COLUMNS
    fluence = np.array([laser.peak_fluence])
    if column_width is not None:
        faces = np.arange(columns + 1) * column_width
        pulse = laser.pulse
        share = float(pulse.delivered(-np.inf, np.inf)) or 1.0
        density = laser.energy_density(faces[None, :-1], faces[None, 1:], -np.inf, np.inf)
        fluence = density / share
    curve = caloric_curve(case)
    T, R = laser.reflectivity_table(case.material, COLDEST, HOTTEST)
    estimate = melt_depth(
        enthalpy=curve.enthalpy,
        temperature=curve.temperature,
        potential=curve.potential,
        melt_fraction=curve.melt_fraction,
        density=case.material.density_reference,
        absorption_coefficient=alpha,
        reflectivity=lambda surface: np.interp(surface, T, R),
        fluence=fluence,
        delivered=lambda start, end: float(laser.pulse.delivered(start, end)),
        end_time=case.time.end,
        column_width=column_width,
    )
    if estimate.depth == 0.0:
        return least
    return max(least, estimate.safe_depth + 2.0 * support_ratio(case) * spacing)


Solver = Conduction | MeltPool | Ablation


def build(case: Case, backend: Backend) -> tuple[Layers, Solver]:
    """Particles and solver of a case."""
    layers = lay_out(case)
    if isinstance(case.solver, AblationSettings):
        return layers, ablation(case, backend, layers)
    body = assemble(
        backend,
        lattice=case.particles,
        layers=layers,
        boundaries=case.boundaries,
        material=case.material,
        laser=case.laser,
        curve=caloric_curve(case),
        use_second_moment=case.solver.weights == "second-moment",
    )
    heat = Conduction(body, _heat_settings(case), case.time, case.laser)
    if isinstance(case.solver, MeltPoolSettings):
        return layers, with_flow(case, layers, heat)
    return layers, heat


def _heat_settings(case: Case) -> ConductionSettings:
    """How heat is computed: as the case says, or implicitly below a flow."""
    if isinstance(case.solver, ConductionSettings):
        return case.solver
    names = set(HeatSettings.model_fields) - {"kind"}
    common = {name: getattr(case.solver, name) for name in names}
    return ConductionSettings(**common)


def view_of(case: Case, solver: Any, step: int, limit: str) -> View:
    """The state for observers."""
    if isinstance(solver, Ablation):
        return ablation_view_of(case, solver, step, limit)
    body, state, backend = solver.body, solver.state, solver.body.backend
    particles = solver.particles
    count, surface = body.count, body.filling.surface
    position, flow = backend.shown(body.filling.position[:, :count]), None
    take = taking(case, backend)
    melt_fraction = take(particles["melt_fraction"])
    if isinstance(solver, MeltPool):
        flow = flow_view_of(case, solver)
        position = take(solver.position)
        if flow.surface.size:
            surface = flow.surface
        elif flow.box:
            surface = np.flatnonzero(position[1] > -solver.domain.spacing)
        if flow.box:
            melt_fraction = np.ones(count)
    evaporated = None
    if case.solver.plateau == "evaporate":
        mass = backend.look(particles["evaporated_mass"])[surface]
        evaporated = mass / case.material.density_reference
    return View(
        time=state.time,
        step=step,
        time_step=state.time_step,
        position=position,
        width=backend.shown(body.filling.width[:, :count]),
        volume=backend.shown(body.filling.volume[:count]),
        temperature=take(particles["temperature"]),
        enthalpy=take(particles["enthalpy"]),
        melt_fraction=melt_fraction,
        vapor_fraction=take(particles["vapor_fraction"]),
        surface=surface,
        symmetry_factor=case.domain.symmetry_factor,
        halves_spot=halves_spot(case),
        energy=dict(state.energy),
        iterations=solver.iterations,
        limit=limit,
        solidus=body.curve.solidus,
        liquidus=body.curve.liquidus,
        vaporization=body.curve.vaporization,
        evaporated=evaporated,
        flow=flow,
    )
