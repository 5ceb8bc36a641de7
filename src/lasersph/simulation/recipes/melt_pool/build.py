"""From a case that flows to its solver."""

from __future__ import annotations

from lasersph.boundaries.flat_surface import FlatSurface, ImposedTemperature
from lasersph.boundaries.settings import DIRICHLET
from lasersph.case import Case
from lasersph.particles.layers import Layers
from lasersph.solvers.conduction.body import weighing_of
from lasersph.solvers.conduction.solver import Conduction
from lasersph.solvers.conduction.walls import wall_enthalpy, wall_potential
from lasersph.solvers.melt_pool.block import StaticParticleData
from lasersph.solvers.melt_pool.domain import PoolDomain
from lasersph.solvers.melt_pool.face_conditions import FaceConditions
from lasersph.solvers.melt_pool.flow import Flow, Liquid
from lasersph.solvers.melt_pool.settings import MeltPoolSettings
from lasersph.solvers.melt_pool.solver import MeltPool


def with_flow(case: Case, settings: MeltPoolSettings, layers: Layers, heat: Conduction) -> MeltPool:
    """The solver of heat, and the flow of the melt or of a box around it."""
    body = heat.body
    backend, count = body.backend, body.count
    filling, curve = body.filling, body.curve
    weighing = weighing_of(
        case.particles, layers, use_second_moment=settings.weights == "second-moment"
    )
    static = StaticParticleData(
        support=weighing.ratio * filling.width[-1, :count],
        volume=filling.volume[:count],
        layer=filling.layer[:count],
        layers=layers.thickness.size,
        weighing=weighing,
    )
    (x,) = case.domain.lateral(2)
    box = (x, (-float(layers.thickness.sum()), 0.0))
    conditions = FaceConditions(box, case.boundaries, case.flow, case.initial_temperature)
    liquid = liquid_of(case, settings)
    surface = None
    if conditions.flow_kind("surface") == "free-surface":
        surface = FlatSurface(
            backend,
            count,
            plane=0.0,
            spacing=layers.spacing,
            support=float(static.support.min()),
            material=case.material,
            viscosity=liquid.viscosity * liquid.density,
            has_stress=settings.marangoni,
            given=_given_temperature(case),
        )
    domain = PoolDomain(
        backend,
        layers,
        static,
        conditions,
        surface,
        lambda T: wall_potential(curve, T),
        lambda T: wall_enthalpy(curve, T),
    )
    flow = Flow(body.particles, liquid, surface, settings, layers.spacing)
    body.particles.set("volume", static.volume)
    if case.flow is not None:
        start = case.flow.initial.velocity(filling.position[:, :count], box)
        flow.begin(start)
    return MeltPool(heat, flow, domain, settings)


def liquid_of(case: Case, settings: MeltPoolSettings) -> Liquid:
    """Numbers of the melt at its liquidus; of a box at its initial temperature."""
    material = case.material
    T = material.flow_temperature
    gamma = 0.0
    if material.surface_tension is not None:
        gamma = float(material.surface_tension_at(T))
    return Liquid(
        viscosity=float(material.kinematic_viscosity_at(T)),
        density=material.density_liquid,
        expansion=float(material.expansion_at(T)),
        reference_temperature=T if case.flow is None else case.initial_temperature,
        gravity=settings.gravity,
        diffusivity=material.diffusivity_reference,
        surface_tension=gamma,
    )


def _given_temperature(case: Case) -> ImposedTemperature | None:
    if case.boundaries.kind_of("surface") not in DIRICHLET:
        return None
    mean = case.boundaries.temperature_of("surface", case.initial_temperature)
    return ImposedTemperature(mean, case.boundaries.surface_temperature_wave)
