"""What a case will cost, before anything runs: particles, memory, steps, limits, resolution."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import sqrt
from typing import Any

from lasersph.case import Case
from lasersph.case.quick import what_is_not_shown
from lasersph.case.size import active_share, memory_of, neighbor_count
from lasersph.input import format_quantity
from lasersph.particles.layers import Layers
from lasersph.simulation.progress import Span
from lasersph.simulation.recipes import FlowForecast, Recipe, StepForecast, recipe_of
from lasersph.solvers.step_control import binding_limit

PAIRS_PER_SECOND = 2.0e8
"""Of one thread; for the expected time only."""
SECONDS_PER_STEP = 3e-3
"""Besides the products: calls of loops, observers, files."""


@dataclass(frozen=True)
class Forecast:
    """Numbers of `lasersph check`.

    Attributes:
        particles, layers: counts. pairs: estimate, of what is active. memory: peak [bytes].
        spacing: finest, as used [m]. fine_depth: of the finest layers [m].
        limits: time-step limits [s] while the light is on. binding: name of the smallest.
        steps: estimate. wall_time: rough estimate [s] on `threads` threads.
        absorption_length, penetration: 1/alpha and sqrt(D t_p) [m], None where there is no light.
        warnings: what a user should think about. flow: of what flows, if anything does.
    """

    particles: int
    layers: int
    pairs: float
    memory: float
    spacing: float
    fine_depth: float
    limits: dict[str, float]
    binding: str
    steps: int
    wall_time: float
    absorption_length: float | None
    penetration: float | None
    warnings: tuple[str, ...] = field(default=())
    flow: FlowForecast | None = None


def forecast(case: Case, *, threads: int = 1) -> Forecast:
    """Forecast of a case, without allocating its particles."""
    recipe = recipe_of(case)
    layers, steps = recipe.layers, recipe.step_forecast()
    spacing, count = layers.spacing, layers.particle_count
    pairs = active_pairs(recipe)
    length, penetration = _lengths(case)
    is_fine = layers.thickness <= spacing * (1.0 + 1e-9)
    return Forecast(
        particles=count,
        layers=layers.thickness.size,
        pairs=pairs,
        memory=memory_of(case.solver, count, pairs),
        spacing=spacing,
        fine_depth=float(layers.thickness[is_fine].sum()),
        limits=steps.limits,
        binding=binding_limit(steps.limits)[0],
        steps=steps.steps,
        wall_time=sum(span.seconds for span in spans_of(recipe, steps, threads)),
        absorption_length=length,
        penetration=penetration,
        warnings=(*_warnings(case, layers, length, penetration), *recipe.warnings()),
        flow=recipe.flow,
    )


def active_pairs(recipe: Recipe[Any, Any]) -> float:
    """Estimated number of pairs of particles that are computed."""
    case, layers = recipe.case, recipe.layers
    share = active_share(case, case.particles.support_over_spacing * layers.spacing)
    neighbors = neighbor_count(case.particles, case.solver.dimensions)
    return share * layers.particle_count * neighbors


def spans_of(recipe: Recipe[Any, Any], steps: StepForecast, threads: int) -> tuple[Span, ...]:
    """What each phase of a run is expected to cost on some threads."""
    product = active_pairs(recipe) / PAIRS_PER_SECOND / max(1, threads)
    return tuple(
        Span(phase.name, phase.end, phase.steps * (phase.products * product + SECONDS_PER_STEP))
        for phase in steps.phases
    )


def _lengths(case: Case) -> tuple[float | None, float | None]:
    """Absorption length and thermal penetration of a pulse [m] [Alshaer2017, eq. (34)]."""
    if case.laser is None:
        return None, None
    alpha = case.laser.absorption_coefficient(case.material)
    duration = case.laser.pulse.on_time or 100.0 * case.laser.pulse.resolution
    return 1.0 / alpha, sqrt(case.material.diffusivity_reference * duration)


def _warnings(
    case: Case, layers: Layers, length: float | None, penetration: float | None
) -> list[str]:
    found = [text] if (text := what_is_not_shown(case)) else []
    spacing = layers.spacing
    if abs(spacing - case.particles.spacing) > 1e-2 * case.particles.spacing:
        found.append(
            f"spacing {format_quantity(case.particles.spacing, 'm')} is rounded to "
            f"{format_quantity(spacing, 'm')} so that whole cells fill the domain"
        )
    if penetration is not None and spacing > penetration / 3.0:
        found.append(
            f"the heat of a pulse reaches {format_quantity(penetration, 'm', 3)}, less than 3 "
            f"spacings of {format_quantity(spacing, 'm', 3)}: take a finer spacing"
        )
    if length and spacing > length:
        found.append(
            f"the light is absorbed within {format_quantity(length, 'm', 3)}, less than one"
            f" spacing of {format_quantity(spacing, 'm', 3)}: its profile is not resolved, though"
            " its energy is exact"
        )
    if penetration is not None and layers.thickness.sum() < 5.0 * penetration:
        found.append("the domain is thinner than 5 penetration depths: the bottom will be felt")
    if case.laser is not None and not case.laser.pulse.delivered(0.0, case.time.end) > 0.0:
        found.append("no light falls before time.end: nothing will be heated")
    changes = case.solver.phase_change and (case.laser is not None or case.material.melting)
    if changes and case.material.vaporization is None:
        found.append(
            f'"{case.material.name}" has no boiling point: its temperature rises without limit; '
            "give temperature and latent_heat in [material.vaporization]"
        )
    if case.time.is_fixed:
        found.append("the time step is fixed: it may be unstable")
    return found
