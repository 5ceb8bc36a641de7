"""From a case whose matter moves to its solver."""

from __future__ import annotations

import numpy as np

from lasersph.boundaries.initial_motion import Rest
from lasersph.boundaries.vessel import Vessel
from lasersph.case import Case
from lasersph.case.sleeping import sleeps
from lasersph.compute.backend import Backend
from lasersph.lasers import Laser
from lasersph.materials.caloric_curve import CaloricCurve
from lasersph.particles.layers import Layers
from lasersph.physics.artificial_viscosity import SOFTENING
from lasersph.simulation.build_flow import wall_enthalpy
from lasersph.solvers.ablation.active import ActiveRegion
from lasersph.solvers.ablation.columns import Columns
from lasersph.solvers.ablation.departure import Vapor
from lasersph.solvers.ablation.ejection_settings import EjectionSettings
from lasersph.solvers.ablation.enthalpy_ejection import EnthalpyEjection
from lasersph.solvers.ablation.exposure import Exposure
from lasersph.solvers.ablation.layout import Layout, Start, lay_out
from lasersph.solvers.ablation.matter import Matter
from lasersph.solvers.ablation.numbers import Numbers
from lasersph.solvers.ablation.pairs import Pairs
from lasersph.solvers.ablation.published_ejection import PublishedEjection
from lasersph.solvers.ablation.settings import AblationSettings
from lasersph.solvers.ablation.solver import Ablation
from lasersph.solvers.conduction.body import SUPPORT
from lasersph.sph.kernels import Kernel, kernel
from lasersph.sph.lattice_sums import diffusive_rate, second_moment, surface_threshold, viscous_rate

NEVER = 1e9
"""Temperature that nothing reaches [K]."""
DEFAULT_EJECTION = EjectionSettings.model_validate({})


def ejection_of(case: Case) -> EjectionSettings:
    """How particles of a case leave."""
    return case.ejection or DEFAULT_EJECTION


def has_latent_heats(case: Case) -> bool:
    """Whether melting and vaporization take latent heat in this case."""
    return case.solver.phase_change and (case.laser is None or ejection_of(case).has_latent_heats)


def ablation(case: Case, backend: Backend, layers: Layers) -> Ablation:
    """The solver of a case whose matter moves."""
    settings = case.solver
    assert isinstance(settings, AblationSettings)
    layout, start = lay_out(
        layers,
        case.boundaries,
        case.vessel or Vessel(),
        case.motion or Rest(),
        density=case.material.density_reference,
        temperature=case.initial_temperature,
        sound_speed=settings.sound_speed,
        gravity=settings.gravity,
    )
    return solver_of(case, backend, layout, start)


def solver_of(case: Case, backend: Backend, layout: Layout, start: Start) -> Ablation:
    """The solver of a case for particles that start where they have been laid out."""
    settings, material = case.solver, case.material
    assert isinstance(settings, AblationSettings)
    curve = material.caloric_curve(
        case.initial_temperature, settings.plateau, phase_change=has_latent_heats(case)
    )
    shape = kernel(case.particles.kernel, layout.dimension)
    ratio = case.particles.support_ratio or SUPPORT[case.particles.kernel]
    melts_without_heat = curve.liquidus is None and material.liquidus is not None
    matter = Matter(
        backend,
        layout,
        start,
        material,
        curve,
        enthalpy=wall_enthalpy(curve, start.temperature),
        support=ratio * layout.spacing,
        sound_speed=settings.sound_speed,
        has_tension=settings.tension,
        melts_at=(material.liquidus or NEVER) if melts_without_heat else NEVER,
    )
    columns, ejection = None, None
    if case.laser is not None:
        columns = _columns(case, case.laser, backend, matter)
        ejection = _ejection(case, backend, matter, curve, columns)
    region = _region(case, backend, matter, settings)
    return Ablation(
        matter,
        Pairs(matter, shape, settings.skin, None if region is None else region.find_pairs),
        Exposure(
            backend,
            matter.total,
            layout.dimension,
            layout.spacing,
            surface_threshold(shape, ratio),
        ),
        numbers_of(case, layout, shape, ratio),
        case.time,
        columns,
        ejection,
        region,
    )


def numbers_of(case: Case, layout: Layout, shape: Kernel, ratio: float) -> Numbers:
    """Constants of the solver."""
    settings = case.solver
    assert isinstance(settings, AblationSettings)
    spacing, ambient = layout.spacing, case.boundaries.ambient_temperature
    solid, liquid = viscosities(case)
    height = settings.ejecta_height or case.domain.depth
    low, high = (tuple(ends) for ends in zip(*layout.box, strict=True))
    viscous, diffusive = decay_rates(case, spacing)
    return Numbers(
        smoothing=0.5 * ratio * spacing,
        sound_speed=settings.sound_speed,
        gravity=settings.gravity,
        courant=settings.courant_number,
        alpha_solid=solid,
        alpha_liquid=liquid,
        viscous_rate=viscous,
        diffusive_rate=diffusive,
        weight_factor=1.0 if settings.weights == "plain" else 1.0 / second_moment(shape, ratio),
        ambient={
            "T_a": case.initial_temperature if ambient is None else ambient,
            "h_c": case.boundaries.convection,
            "eps": case.boundaries.emissivity,
        },
        low=low,
        high=(*high[:-1], max(high[-1], height)),
    )


def viscosities(case: Case) -> tuple[float, float]:
    """alpha of solid and liquid; what is liquid everywhere is nowhere solid."""
    settings = case.solver
    assert isinstance(settings, AblationSettings)
    liquid = settings.viscosity_liquid
    return liquid if case.material.is_liquid else settings.viscosity_solid, liquid


def decay_rates(case: Case, spacing: float) -> tuple[float, float]:
    """Rates at which alternating layers of given spacing [m] stop and cool [1/s]."""
    settings = case.solver
    assert isinstance(settings, AblationSettings)
    shape = kernel(case.particles.kernel, settings.dimensions)
    ratio = case.particles.support_ratio or SUPPORT[case.particles.kernel]
    stiffest = max(viscosities(case)) * settings.sound_speed / spacing
    diffusive = diffusive_rate(shape, ratio) * _diffusivity(case) / spacing**2
    if settings.weights == "second-moment":
        diffusive /= second_moment(shape, ratio)
    return viscous_rate(shape, ratio, SOFTENING) * stiffest, diffusive


def _diffusivity(case: Case) -> float:
    """Largest k/(rho c_p) of the case [m^2/s]."""
    curve = case.material.caloric_curve(
        case.initial_temperature, "hold", phase_change=has_latent_heats(case)
    )
    slopes = np.diff(curve.potential) / np.diff(curve.enthalpy)
    return float(np.max(slopes)) / case.material.density_reference


def _columns(case: Case, laser: Laser, backend: Backend, matter: Matter) -> Columns:
    """The light; a preset of the published rule brings its reflectivity."""
    reflectivity = ejection_of(case).reflectivity
    if reflectivity is not None and laser.reflectivity is None:
        laser = laser.model_copy(update={"reflectivity": reflectivity})
    layout = matter.layout
    return Columns(
        backend,
        laser,
        case.material,
        layout.bounds[:-1],
        layout.spacing,
        [width > 0.0 for width in layout.period[:-1]],
        matter.E,
    )


def _region(
    case: Case, backend: Backend, matter: Matter, settings: AblationSettings
) -> ActiveRegion | None:
    """What is computed: where light falls on matter at rest only what heat reaches."""
    if not sleeps(case):
        return None
    layout = matter.layout
    support = float(backend.look(matter.support)[0]) + settings.skin * layout.spacing
    lit = backend.asarray(np.arange(layout.surface_count), "index")
    return ActiveRegion(backend, matter.now.x, support, layout.period, lit)


def _ejection(
    case: Case, backend: Backend, matter: Matter, curve: CaloricCurve, columns: Columns
) -> EnthalpyEjection | PublishedEjection:
    """The rule of leaving."""
    rule = ejection_of(case)
    vapor = Vapor(backend, case.material, is_effusion=rule.velocity == "effusion")
    spacing = matter.layout.spacing
    if rule.model == "enthalpy":
        return EnthalpyEjection(backend, vapor, curve, columns, matter.total, spacing)
    support = float(backend.to_host(matter.support)[0])
    return PublishedEjection(
        backend, vapor, matter.total, spacing, rule.left_after(spacing, support)
    )
