"""From a case that flows to its solver."""

from __future__ import annotations

from dataclasses import replace

from lasersph.case import Case
from lasersph.materials.viscosity import relative_viscosity_table
from lasersph.particles.fields import FIELDS
from lasersph.particles.layers import Layers
from lasersph.simulation.recipes.melt_pool.surfaces import (
    face_conditions,
    mean_heights,
    surface_of,
)
from lasersph.solvers.conduction.body import Body, weighing_of
from lasersph.solvers.conduction.solver import Conduction
from lasersph.solvers.conduction.walls import wall_enthalpy, wall_potential
from lasersph.solvers.melt_pool.block_layers import StaticParticleData
from lasersph.solvers.melt_pool.domain import PoolDomain
from lasersph.solvers.melt_pool.eulerian_pool import EulerianPool
from lasersph.solvers.melt_pool.flow import Flow
from lasersph.solvers.melt_pool.flow_terms import PLANE, RINGS
from lasersph.solvers.melt_pool.liquid import Liquid
from lasersph.solvers.melt_pool.settings import MeltPoolSettings
from lasersph.solvers.melt_pool.solver import MeltPool
from lasersph.surface.moving_surface import MovingSurface


def with_flow(case: Case, settings: MeltPoolSettings, layers: Layers, heat: Conduction) -> MeltPool:
    """The solver of heat, and the flow of the melt or of a box around it."""
    body, is_box = heat.body, case.flow is not None
    backend, curve = body.backend, body.curve

    # Particles of the start, the faces, the surface, and volumes that may change.
    static = static_data(case, settings, layers, body)
    conditions, liquid = face_conditions(case, layers), liquid_of(case, settings)
    support = float(static.support.min())
    surface = surface_of(case, settings, layers, liquid, support, backend, body.count)
    if isinstance(surface, MovingSurface):
        _raise_particles(case, body, static, surface.line.widths)
    _add_volumes(case, settings, body, static)

    # Domain, flow, and the solver of both.
    domain = PoolDomain(
        *(backend, layers, static, conditions, surface),
        lambda T: wall_potential(curve, T),
        lambda T: wall_enthalpy(curve, T),
        body.particles["volume"],
        body.free,
        rests=settings.rests,
    )
    is_section = case.geometry.is_axisymmetric
    bodies = backend.zeros(body.count) if is_section else body.particles["volume"]
    terms = RINGS if is_section else PLANE
    flow = Flow(
        *(body.particles, liquid, surface, settings, layers.spacing, bodies, terms), is_box=is_box
    )
    pool = EulerianPool if settings.rests else MeltPool
    solver = pool(heat, flow, domain, settings, case.pause)

    # A box starts with the velocity of its case; a block is laid out below its first surface.
    if case.flow is not None:
        position = body.filling.position[:, : body.count]
        flow.set_initial_velocity(case.flow.initial.velocity(position, conditions.box))
    elif case.initial_surface is not None:
        solver.lay_out()
    return solver


def static_data(
    case: Case, settings: MeltPoolSettings, layers: Layers, body: Body
) -> StaticParticleData:
    """Support, volume, layer and weights of each particle, which no step changes."""
    filling, count = body.filling, body.count
    weighing = weighing_of(
        case.particles, layers, use_second_moment=settings.weights == "second-moment"
    )
    return StaticParticleData(
        geometry=case.geometry,
        position=filling.position[:, :count],
        support=weighing.ratio * filling.width[-1, :count],
        volume=filling.volume[:count].copy(),
        layer=filling.layer[:count],
        layers=layers.thickness.size,
        weighing=weighing,
        additions=body.additions,
    )


def _raise_particles(
    case: Case, body: Body, static: StaticParticleData, widths: tuple[float, ...]
) -> None:
    """Stretch the columns of particles of a box, of these widths [m], to the surface at the start.

    They become longer in proportion, so that volume and mass do with them.
    """
    if case.initial_surface is None or case.flow is None:
        return
    count, depth = body.count, case.domain.depth
    *places, z = body.filling.position[:, :count]
    length_ratio = 1.0 + mean_heights(case, tuple(places), widths) / depth
    z[:] = length_ratio * (z + depth) - depth
    static.volume[:] *= length_ratio
    body.particles.set("mass", body.backend.to_host(body.particles["mass"]) * length_ratio)


def _add_volumes(
    case: Case, settings: MeltPoolSettings, body: Body, static: StaticParticleData
) -> None:
    """Add the volumes, which checkpoints keep where particles are laid out anew or lose mass."""
    loses_mass = case.boundaries.surface_mass_flux_wave is not None or settings.evaporates
    is_rearranged = case.flow is None and (case.initial_surface or case.pause != "compute")
    changes = case.surface_moves and (loses_mass or case.geometry.is_axisymmetric)
    volume = FIELDS["volume"]
    if is_rearranged or changes:
        volume = replace(volume, is_kept=True)
    if volume.is_kept:
        body.particles.keep("mass")
    body.particles.add(volume)
    body.particles.set("volume", static.volume)


def liquid_of(case: Case, settings: MeltPoolSettings) -> Liquid:
    """Numbers of the melt at its liquidus, and how viscous it is elsewhere."""
    material = case.material
    T = material.flow_temperature
    # Curves of a free surface need gamma; without it they have none.
    gamma = 0.0
    if material.surface_tension is not None:
        gamma = float(material.surface_tension_at(T))
    return Liquid(
        viscosity=float(material.kinematic_viscosity_at(T)),
        relative_viscosity=relative_viscosity_table(material),
        density=material.density_liquid,
        expansion=float(material.expansion_at(T)),
        reference_temperature=T if case.flow is None else case.initial_temperature,
        gravity=settings.gravity,
        diffusivity=material.diffusivity_reference,
        surface_tension=gamma,
    )
