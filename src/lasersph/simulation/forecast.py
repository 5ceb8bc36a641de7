"""What a case will cost, before anything runs: particles, memory, steps, limits, resolution."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from lasersph.case import Case
from lasersph.case.size import active_share, memory_of, neighbor_count
from lasersph.input.text_table import text_table
from lasersph.simulation.case_warnings import absorption_length, penetration_depth, run_warnings
from lasersph.simulation.heating import HeatingForecast, heating_forecast
from lasersph.simulation.progress import Span
from lasersph.simulation.recipes import FlowForecast, Recipe, StepForecast, recipe_of
from lasersph.solvers.step_control import binding_limit

PAIRS_PER_SECOND = 2.0e8
"""Pairs of one thread [1/s]. Forecast: the expected time only."""
SECONDS_PER_STEP = 3e-3
"""Besides the products [s]: calls of loops, observers, files. Forecast:
`benchmarks/small_steps.py`."""


@dataclass(frozen=True)
class Forecast:
    """What a case will cost; printed, the rows of `lasersph check` and its warnings.

    Attributes:
        case: what was asked about.
        particles, layers: counts. pairs: estimate, of what is active. memory: peak [bytes].
        spacing: finest, as used [m]. fine_depth: of the finest layers [m].
        limits: time-step limits [s] while the light is on. binding: name of the smallest.
        steps: estimate. wall_time: rough estimate [s] on `threads` threads.
        absorption_length, penetration: 1/alpha and sqrt(D t_p) [m], None where there is no light.
        warnings: what a user should think about, a sentence each. flow: of what flows, if anything
            does. heating: what the light does to the surface, if there is any.
        threads, backend: "cpu" or "cuda", for which the time and the memory were asked.
    """

    case: Case = field(repr=False)
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
    heating: HeatingForecast | None = None
    threads: int = 1
    backend: str = "cpu"

    def __str__(self) -> str:
        """Rows and warnings, as `lasersph check` prints them."""
        from lasersph.simulation.forecast_text import forecast_rows

        return "\n".join(
            [text_table(forecast_rows(self)), *(f"warning: {text}" for text in self.warnings)]
        )


def forecast(
    case: Case,
    *,
    threads: int = 1,
    backend: str = "cpu",
    recipe: Recipe[Any, Any] | None = None,
) -> Forecast:
    """Forecast of a case, without allocating its particles.

    Args:
        threads: for the expected time. backend: for which it is asked.
        recipe: of the case, where there is one already: its estimates are not made again.
    """
    recipe = recipe_of(case) if recipe is None else recipe
    layers, steps = recipe.layers, recipe.step_forecast()
    spacing, count = layers.spacing, layers.particle_count
    pairs = active_pairs(recipe)
    heating = heating_forecast(case, recipe.heating)
    is_fine = layers.thickness <= spacing * (1.0 + 1e-9)
    return Forecast(
        case=case,
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
        absorption_length=None if case.laser is None else absorption_length(case),
        penetration=None if case.laser is None else penetration_depth(case),
        warnings=(*run_warnings(case, layers, recipe.curve, heating), *recipe.warnings()),
        flow=recipe.flow,
        heating=heating,
        threads=threads,
        backend=backend,
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
