"""Cost of a case before anything runs: particles, memory, steps, limits, resolution."""

from __future__ import annotations

from typing import Any

from lasersph.case import Case
from lasersph.case.size import active_share, memory_of, neighbor_count
from lasersph.simulation.case_forecast import Forecast
from lasersph.simulation.case_warnings import absorption_length, penetration_depth, run_warnings
from lasersph.simulation.heating import heating_forecast
from lasersph.simulation.progress import Span
from lasersph.simulation.recipes import Recipe, StepCost, StepForecast, recipe_of
from lasersph.solvers.step_control import binding_limit

PAIRS_PER_SECOND = 2.0e8
"""Pairs of one thread [1/s]. Forecast: the expected time only."""


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
    # Graded layers grow from the finest one downward.
    is_fine = layers.thickness <= spacing * (1.0 + 1e-9)
    return Forecast(
        case=case,
        particles=count,
        layers=layers.thickness.size,
        pairs=pairs,
        memory=memory_of(case.solver, count, pairs),
        spacing=spacing,
        fine_depth=float(layers.thickness[is_fine].sum()),
        fine_width=layers.fine_bounds[0][1] if layers.beside else None,
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
    # Heat reaches only a part of the block; in it each particle has the neighbors of a lattice.
    share = active_share(case, case.particles.support_over_spacing * layers.spacing)
    dimensions = case.solver.dimensions
    neighbors = neighbor_count(case.particles, dimensions)
    # a cell of coarse columns has one beyond each of its faces
    coarse = 2.0 * dimensions * (layers.particle_count - layers.fine_count)
    return share * (layers.fine_count * neighbors + coarse)


def spans_of(recipe: Recipe[Any, Any], steps: StepForecast, threads: int) -> tuple[Span, ...]:
    """Expected cost of each stage of a run on some threads."""
    # Seconds of one product of the matrix of all pairs with a vector.
    product = active_pairs(recipe) / PAIRS_PER_SECOND / max(1, threads)

    def seconds(cost: StepCost) -> float:
        return cost.products * product + cost.seconds

    stages = steps.stages
    return tuple(Span(one.name, one.end, one.steps * seconds(one.cost)) for one in stages)
