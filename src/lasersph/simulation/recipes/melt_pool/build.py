"""From a case that flows to its solver."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lasersph.boundaries.flow_conditions import FREE
from lasersph.boundaries.initial_surface import InitialSurface
from lasersph.boundaries.settings import DIRICHLET
from lasersph.case import Case
from lasersph.materials.viscosity import relative_viscosity_table
from lasersph.particles.fields import FIELDS
from lasersph.particles.layers import Layers
from lasersph.physics.recoil import tabulated_recoil
from lasersph.solvers.conduction.body import Body, weighing_of
from lasersph.solvers.conduction.solver import Conduction
from lasersph.solvers.conduction.walls import wall_enthalpy, wall_potential
from lasersph.solvers.melt_pool.block_layers import StaticParticleData
from lasersph.solvers.melt_pool.domain import PoolDomain
from lasersph.solvers.melt_pool.face_conditions import FaceConditions
from lasersph.solvers.melt_pool.flow import Flow
from lasersph.solvers.melt_pool.flow_terms import PLANE, RINGS
from lasersph.solvers.melt_pool.liquid import Liquid
from lasersph.solvers.melt_pool.ring_pool import RingPool
from lasersph.solvers.melt_pool.settings import MeltPoolSettings
from lasersph.solvers.melt_pool.solver import MeltPool
from lasersph.surface.flat_surface import FlatSurface, ImposedTemperature
from lasersph.surface.forcing import SurfaceForcing
from lasersph.surface.height_field import HeightField, cutoff_of
from lasersph.surface.moving_surface import MovingSurface
from lasersph.surface.pressure_condition import SurfaceLiquid
from lasersph.surface.pressure_gradient import DifferenceGradient, SymmetricGradient
from lasersph.surface.riding_surface import RidingSurface
from lasersph.surface.smoothing import End, Ends
from lasersph.surface.surface import Surface


def with_flow(case: Case, settings: MeltPoolSettings, layers: Layers, heat: Conduction) -> MeltPool:
    """The solver of heat, and the flow of the melt or of a box around it."""
    body = heat.body
    backend, count = body.backend, body.count
    filling, curve = body.filling, body.curve
    is_section = case.geometry.is_axisymmetric

    # What flow needs of each particle and does not change: support, volume, layer, weights.
    weighing = weighing_of(
        case.particles, layers, use_second_moment=settings.weights == "second-moment"
    )
    static = StaticParticleData(
        geometry=case.geometry,
        position=filling.position[:, :count],
        support=weighing.ratio * filling.width[-1, :count],
        volume=filling.volume[:count].copy(),
        layer=filling.layer[:count],
        layers=layers.thickness.size,
        weighing=weighing,
        additions=body.additions,
    )
    conditions = face_conditions(case, layers)

    # The surface: a line that moves, a flat free one, or none below a lid.
    liquid = liquid_of(case, settings)
    surface: Surface
    support = float(static.support.min())
    if case.surface_moves:
        line = surface_line(case, layers)
        _raise_particles(case, body, static, line)
        moving = RidingSurface if is_section else MovingSurface
        surface = moving(
            backend,
            count,
            line=line,
            bottom=-layers.fine_depth,
            spacing=layers.spacing,
            support=support,
            liquid=SurfaceLiquid(
                liquid.density,
                case.material.density_reference,
                liquid.viscosity * liquid.density,
                liquid.relative_viscosity,
                case.material,
            ),
            has_stress=settings.marangoni,
            forcing=SurfaceForcing(
                _given_temperature(case),
                case.boundaries.pressure_drive,
                case.boundaries.surface_mass_flux_wave,
                recoil_of(case),
            ),
        )
    elif conditions.flow_kind("surface") in FREE:
        surface = FlatSurface(
            backend,
            count,
            dimension=layers.dimension,
            plane=0.0,
            spacing=layers.spacing,
            support=support,
            material=case.material,
            viscosity=liquid.viscosity * liquid.density,
            has_stress=settings.marangoni,
            given=_given_temperature(case),
            pressure_gradient=DifferenceGradient() if is_section else SymmetricGradient(),
        )
    else:
        surface = Surface(backend, count, 0.0, layers.dimension)

    # Volumes belong into checkpoints where particles are laid out anew or lose mass.
    volume = FIELDS["volume"]
    loses_mass = case.boundaries.surface_mass_flux_wave is not None or settings.evaporates
    is_rearranged = case.flow is None and (case.initial_surface or case.pause != "compute")
    if is_rearranged or (case.surface_moves and (loses_mass or is_section)):
        volume = replace(volume, is_kept=True)
    if volume.is_kept:
        body.particles.keep("mass")
    body.particles.add(volume)
    body.particles.set("volume", static.volume)

    # Domain, flow, and the solver of both.
    domain = PoolDomain(
        backend,
        layers,
        static,
        conditions,
        surface,
        lambda T: wall_potential(curve, T),
        lambda T: wall_enthalpy(curve, T),
        body.particles["volume"],
        body.free,
    )
    bodies = backend.zeros(count) if is_section else body.particles["volume"]
    terms = RINGS if is_section else PLANE
    flow = Flow(
        *(body.particles, liquid, surface, settings, layers.spacing, bodies, terms),
        is_box=case.flow is not None,
    )

    # A box starts with the velocity of its case; a block is laid out below its first surface.
    if case.flow is not None:
        start = case.flow.initial.velocity(filling.position[:, :count], conditions.box)
        flow.set_initial_velocity(start)
    pool = RingPool if is_section else MeltPool
    solver = pool(heat, flow, domain, settings, case.pause)
    if case.flow is None and case.initial_surface is not None:
        solver.lay_out()
    return solver


def face_conditions(case: Case, layers: Layers) -> FaceConditions:
    """Heat and flow at the faces of what may flow, which stays among the fine columns."""
    box = (*layers.fine_bounds, (-float(layers.thickness.sum()), 0.0))
    return FaceConditions(
        box,
        case.boundaries,
        case.flow,
        case.initial_temperature,
        has_axis=case.geometry.is_axisymmetric,
    )


def surface_line(case: Case, layers: Layers) -> HeightField:
    """Columns of a surface below which melt flows, at their heights at the start.

    It goes on as the flow does beyond its ends; at walls it is pinned at its height there.
    """
    conditions = face_conditions(case, layers)
    shape = tuple(map(int, layers.fine_only.columns[:, 0]))
    sides = conditions.box[:-1]
    widths = tuple((high - low) / n for (low, high), n in zip(sides, shape, strict=True))
    kinds: dict[str, End] = {"symmetry": "mirror", "free-slip": "mirror", "periodic": "periodic"}
    ends: tuple[Ends, ...] = tuple(
        (kinds.get(conditions.flow_kind(a), "pinned"), kinds.get(conditions.flow_kind(b), "pinned"))
        for a, b in conditions.faces[:-1]
    )
    line = HeightField(
        *(tuple(low for low, _ in sides), widths, shape, ends, cutoff_of(max(widths))),
        is_axisymmetric=case.geometry.is_axisymmetric,
    )
    start = case.initial_surface
    # Heights at the start; at walls the ends stay where they are.
    if start is not None:
        line.height = _mean_heights(case, line.places, widths)
        line.pins = tuple(
            (_heights_at(start, line, axis, low), _heights_at(start, line, axis, high))
            for axis, (low, high) in enumerate(sides)
        )
    return line


def _heights_at(
    start: InitialSurface, line: HeightField, axis: int, end: float
) -> float | NDArray[np.float64]:
    """Heights at an end of an axis [m], one for each line of columns that ends there."""
    if len(line.shape) == 1:
        return float(start.at(np.array(end)))
    along = line.centers(1 - axis)
    places = [along, along]
    places[axis] = np.full(along.size, end)
    return start.shape_at(places[0], places[1])


def _mean_heights(
    case: Case, places: tuple[NDArray[np.float64], ...], widths: tuple[float, ...]
) -> NDArray[np.float64]:
    """Heights at the start in the mean over columns around places [m]."""
    start = case.initial_surface
    assert start is not None
    if len(places) == 1:
        return start.at(places[0], widths[0], is_ring=case.geometry.is_axisymmetric)
    return start.mean_over_columns((places[0], places[1]), (widths[0], widths[1]))


def _raise_particles(case: Case, body: Body, static: StaticParticleData, line: HeightField) -> None:
    """Stretch the columns of particles of a box to the surface at the start."""
    if case.initial_surface is None or case.flow is None:
        return
    count, depth = body.count, case.domain.depth
    # Columns become longer in proportion, so that volume and mass do with them.
    *places, z = body.filling.position[:, :count]
    length_ratio = 1.0 + _mean_heights(case, tuple(places), line.widths) / depth
    z[:] = length_ratio * (z + depth) - depth
    static.volume[:] *= length_ratio
    body.particles.set("mass", body.backend.to_host(body.particles["mass"]) * length_ratio)


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


def recoil_of(case: Case) -> Callable[[NDArray[np.float64]], NDArray[np.float64]] | None:
    """Gauge recoil [Pa] of the vapor at temperatures [K], where vapor leaves the surface."""
    vapor = case.material.vaporization
    if vapor is None or not case.solver.has_vapor_flux:
        return None
    return tabulated_recoil(vapor, case.boundaries.pressure_of_surroundings)


def _given_temperature(case: Case) -> ImposedTemperature | None:
    if case.boundaries.kind_of("surface") not in DIRICHLET:
        return None
    mean = case.boundaries.temperature_of("surface", case.initial_temperature)
    return ImposedTemperature(mean, case.boundaries.temperature_drive)
