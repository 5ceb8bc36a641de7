"""From a case whose matter moves to its solver."""

from __future__ import annotations

import numpy as np

from lasersph.boundaries.initial_motion import Rest
from lasersph.boundaries.vessel import Vessel
from lasersph.case import Case
from lasersph.case.size import has_active_region
from lasersph.compute.backend import Backend
from lasersph.irradiation.first_hit import FirstHitLight
from lasersph.lasers import Laser
from lasersph.materials.caloric_curve import CaloricCurve
from lasersph.particles.layers import Layers
from lasersph.particles.neighbor_lists import Box
from lasersph.particles.verlet_list import VerletList
from lasersph.physics.artificial_viscosity import SOFTENING
from lasersph.solvers.ablation.active_region import ActiveRegion
from lasersph.solvers.ablation.ejecta import Vapor
from lasersph.solvers.ablation.ejection_settings import EjectionSettings
from lasersph.solvers.ablation.enthalpy_ejection import EnthalpyEjection
from lasersph.solvers.ablation.geometry import Geometry, InitialState, lay_out
from lasersph.solvers.ablation.parameters import Parameters
from lasersph.solvers.ablation.particle_state import ParticleState
from lasersph.solvers.ablation.published.ejection import PublishedEjection
from lasersph.solvers.ablation.settings import AblationSettings
from lasersph.solvers.ablation.solver import Ablation
from lasersph.solvers.conduction.walls import wall_enthalpy
from lasersph.sph.kernels import Kernel, kernel
from lasersph.sph.lattice_sums import diffusive_rate, second_moment, surface_threshold, viscous_rate
from lasersph.surface.free_surface import FreeSurface

NEVER = 1e9
"""Temperature that nothing reaches [K]. Format: higher than any table."""
DEFAULT_EJECTION = EjectionSettings.model_validate({})


def ejection_of(case: Case) -> EjectionSettings:
    """How particles of a case leave."""
    return case.ejection or DEFAULT_EJECTION


def has_latent_heats(case: Case) -> bool:
    """Whether melting and vaporization take latent heat in this case."""
    return case.solver.phase_change and (case.laser is None or ejection_of(case).has_latent_heats)


def ablation_solver(
    case: Case, settings: AblationSettings, backend: Backend, layers: Layers
) -> Ablation:
    """The solver of a case whose matter moves."""
    geometry, initial = lay_out(
        layers,
        case.boundaries,
        case.vessel or Vessel(),
        case.motion or Rest(),
        density=case.material.density_reference,
        temperature=case.initial_temperature,
        sound_speed=settings.sound_speed,
        gravity=settings.gravity,
    )
    return solver_of(case, settings, backend, geometry, initial)


def solver_of(
    case: Case,
    settings: AblationSettings,
    backend: Backend,
    geometry: Geometry,
    initial: InitialState,
) -> Ablation:
    """The solver of a case for particles that start where they have been laid out."""
    material = case.material
    curve = material.caloric_curve(
        case.initial_temperature, settings.curve_plateau, phase_change=has_latent_heats(case)
    )
    shape = kernel(case.particles.kernel, geometry.dimension)
    ratio = case.particles.support_over_spacing

    # A metal of the published rule melts without latent heat: its curve has no liquidus then, but
    # its particles still become liquid there.
    melts_without_heat = curve.liquidus is None and material.liquidus is not None
    particles = ParticleState(
        backend,
        geometry,
        initial,
        material,
        curve,
        enthalpy=wall_enthalpy(curve, initial.temperature),
        support=ratio * geometry.spacing,
        sound_speed=settings.sound_speed,
        has_tension=settings.tension,
        melts_at=(material.liquidus or NEVER) if melts_without_heat else NEVER,
    )
    light, ejection = None, None
    if case.laser is not None:
        light = _first_hit(case, case.laser, backend, particles)
        ejection = _ejection(case, backend, particles, curve, light)
    region = _region(case, backend, particles, settings)

    # Pairs within the support plus a skin, so that the list lasts for several steps.
    low, high = (tuple(corner) for corner in zip(*geometry.box, strict=True))
    pairs = VerletList(
        backend,
        particles.fields(),
        particles.half["position"],
        shape,
        Box(low, high, geometry.period),
        geometry.spacing,
        settings.skin * geometry.spacing,
    )
    return Ablation(
        particles,
        pairs,
        FreeSurface(
            backend,
            particles.now.capacity,
            geometry.dimension,
            geometry.spacing,
            surface_threshold(shape, ratio),
        ),
        parameters_of(case, settings, geometry, shape),
        case.time,
        light,
        ejection,
        region,
    )


def parameters_of(
    case: Case, settings: AblationSettings, geometry: Geometry, shape: Kernel
) -> Parameters:
    """Constants of the solver."""
    material = case.material
    ratio = case.particles.support_over_spacing
    spacing = geometry.spacing
    solid, liquid = viscosities(case, settings)
    # The box is high enough for ejecta to fly in, and no higher than they are followed.
    height = settings.ejecta_height or case.domain.depth
    low, high = (tuple(ends) for ends in zip(*geometry.box, strict=True))
    viscous, diffusive = decay_rates(case, settings, spacing)
    return Parameters(
        smoothing=0.5 * ratio * spacing,
        sound_speed=settings.sound_speed,
        gravity=settings.gravity,
        courant=settings.courant_number,
        alpha_solid=solid,
        alpha_liquid=liquid,
        viscous_rate=viscous,
        diffusive_rate=diffusive,
        weight_factor=1.0 if settings.weights == "plain" else 1.0 / second_moment(shape, ratio),
        surroundings=case.boundaries.surroundings(material, case.initial_temperature),
        low=low,
        high=(*high[:-1], max(high[-1], height)),
    )


def viscosities(case: Case, settings: AblationSettings) -> tuple[float, float]:
    """alpha of solid and liquid; what is liquid everywhere is nowhere solid."""
    liquid = settings.viscosity_liquid
    return liquid if case.material.is_liquid else settings.viscosity_solid, liquid


def decay_rates(case: Case, settings: AblationSettings, spacing: float) -> tuple[float, float]:
    """Rates at which alternating layers of given spacing [m] stop and cool [1/s]."""
    shape = kernel(case.particles.kernel, settings.dimensions)
    ratio = case.particles.support_over_spacing
    # The stiffest pair of particles sets the rate: alpha c / dx.
    stiffest = max(viscosities(case, settings)) * settings.sound_speed / spacing
    diffusive = diffusive_rate(shape, ratio) * _diffusivity(case) / spacing**2
    # The weights of second moments scale every sum of heat.
    if settings.weights == "second-moment":
        diffusive /= second_moment(shape, ratio)
    return viscous_rate(shape, ratio, SOFTENING) * stiffest, diffusive


def _diffusivity(case: Case) -> float:
    """Largest k/(rho c_p) of the case [m^2/s]."""
    curve = case.material.caloric_curve(
        case.initial_temperature, "hold", phase_change=has_latent_heats(case)
    )
    # Slope of the heat-flux potential, dPhi/dh = k/c_p, at its steepest.
    slopes = np.diff(curve.potential) / np.diff(curve.enthalpy)
    return float(np.max(slopes)) / case.material.density_reference


def _first_hit(
    case: Case, laser: Laser, backend: Backend, particles: ParticleState
) -> FirstHitLight:
    """The light; a preset of the published rule brings its reflectivity."""
    reflectivity = ejection_of(case).reflectivity
    if reflectivity is not None and not laser.has_own_reflectivity:
        laser = laser.model_copy(update={"reflectivity": reflectivity})
    geometry = particles.geometry
    return FirstHitLight(
        backend,
        laser,
        case.material,
        geometry.bounds[:-1],
        geometry.spacing,
        [width > 0.0 for width in geometry.period[:-1]],
        particles.now["absorbed_light"],
    )


def _region(
    case: Case, backend: Backend, particles: ParticleState, settings: AblationSettings
) -> ActiveRegion | None:
    """Active region: where light falls on matter at rest, only what heat reaches is computed."""
    if not has_active_region(case):
        return None
    geometry = particles.geometry
    # Heat reaches one support and the skin further in the life of a pair list.
    support = (
        float(backend.host_view(particles.now["support"])[0]) + settings.skin * geometry.spacing
    )
    lit = backend.asarray(np.arange(geometry.surface_count), "index")
    return ActiveRegion(backend, particles.now["position"], support, geometry.period, lit)


def _ejection(
    case: Case,
    backend: Backend,
    particles: ParticleState,
    curve: CaloricCurve,
    light: FirstHitLight,
) -> EnthalpyEjection | PublishedEjection:
    """The rule of leaving."""
    rule = ejection_of(case)
    is_published = rule.model == "published"
    vapor = Vapor(
        backend,
        case.material,
        is_effusion=rule.velocity == "effusion",
        is_published=is_published,
    )
    spacing = particles.geometry.spacing
    if not is_published:
        return EnthalpyEjection(backend, vapor, curve, light, particles.now.capacity, spacing)
    # The published rule removes what lies above a depth of its own.
    support = float(backend.to_host(particles.now["support"])[0])
    particles.now.add("lift")
    return PublishedEjection(
        backend, vapor, particles.now.capacity, spacing, rule.left_after(spacing, support)
    )
