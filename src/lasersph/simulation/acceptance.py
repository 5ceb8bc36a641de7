"""Whether this machine can compute a case, asked at one place by all who start or check runs."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Literal

from lasersph.case import Case
from lasersph.case.checks import refuse_if_too_large
from lasersph.case.size import Size
from lasersph.case.solver_choice import computes_flow
from lasersph.compute.threads import chosen
from lasersph.input import CaseError
from lasersph.simulation.forecast import Forecast, forecast
from lasersph.simulation.recipes import Recipe
from lasersph.simulation.recipes.recipe import FEWEST_ROWS, FlowForecast, resolving_spacing

ANYWAY = "or start it all the same: lasersph run --anyway, anyway=True in Python"


def accepted_forecast(
    case: Case,
    backend: str = "cpu",
    *,
    threads: int = 1,
    recipe: Recipe[Any, Any] | None = None,
    anyway: bool = False,
) -> Forecast:
    """Forecast of a case that this machine, and its card, can hold.

    Args:
        backend: "cpu" or "cuda". threads: for the expected time. recipe: as of `forecast`.
        anyway: make a refusal the first of the warnings.

    Raises:
        CaseError: it needs more memory than there is. NoDevice: no card for "cuda".
    """
    try:
        # First the rough size, then the exact one: absurd cases are not even laid out.
        refuse_if_too_large(case, backend)  # an estimate: absurd cases are not even laid out
        expected = forecast(case, threads=threads, backend=backend, recipe=recipe)
        refuse_if_too_large(case, backend, Size(expected.particles, expected.memory))
    except CaseError as error:
        # The user insists: the refusal becomes the first warning.
        if not anyway:
            raise CaseError(error.problem, f"{error.hint}, {ANYWAY}", key=error.key) from None
        expected = forecast(case, threads=threads, backend=backend, recipe=recipe)
        return replace(expected, warnings=(str(error), *expected.warnings))
    return expected


def refuse_unresolved(flow: FlowForecast | None) -> None:
    """Refuse a flow of which layers are thinner than two spacings, with the numbers that spoils.

    Who starts one run asks for it; sweeps and studies, which compare runs, have warnings.

    Raises:
        CaseError: with the spacing that resolves the thinnest layer.
    """
    if flow is None or not flow.unresolved:
        return
    finer = resolving_spacing(min(flow.layers.values()), FEWEST_ROWS)
    raise CaseError(
        "; ".join(flow.unresolved),
        f'write spacing = "{finer}" or less, {ANYWAY}; --quick says it itself',
        key="particles.spacing",
    )


def check(
    case: Case, *, threads: int | None = None, backend: Literal["cpu", "cuda"] = "cpu"
) -> Forecast:
    """Needs of a case before anything runs: particles, memory, steps, time, warnings.

        cost = lasersph.check(lasersph.load_case("dlip-steel"))
        print(cost)  # as `lasersph check`
        cost.particles, cost.wall_time, cost.warnings

    Args:
        threads: for the expected time; all processors if not given.
        backend: where to compute.

    Raises:
        CaseError: it needs more memory than there is.
        NoDevice: no card for "cuda".
    """
    expected = accepted_forecast(case, backend, threads=chosen(threads))
    # of a flow in 3-D also what half the spacing would cost, some twenty times as much
    if case.solver.dimensions == 3 and computes_flow(case.solver):
        finer = case.particles.model_copy(update={"spacing": 0.5 * case.particles.spacing})
        half = case.model_copy(update={"particles": finer})
        expected = replace(expected, half=forecast(half, threads=expected.threads))
    return expected
