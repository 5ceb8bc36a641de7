"""Control of steps, shared by all solvers: the members of a solver, limits, retries, failures.

The time loop asks a solver for its limits, chooses the step from them and lets the solver take it.
Where a step fails, half of it is tried, and so on; a step that fails however short ends the run.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from lasersph.compute.search import EscapedParticle
from lasersph.lasers.pulses import PulseTrain
from lasersph.solvers.time_settings import TimeSettings

if TYPE_CHECKING:
    from lasersph.compute.backend import Backend

TARGETS = ("end", "pulse edge", "snapshot")
"""Limits that are times to be hit; the others bound the step itself."""
PAUSE = "pause"
"""Limit of a step that jumps over a pause between pulses; a solver names no other beside it."""
ROUNDING = 1e-9
"""Share of a step by which it is stretched to hit a time. Rounding: of sums of steps."""
RETRIES = 8
"""How often a step is halved before it counts as failed. Guard: a 256th of it is the last one
tried."""


class StepFailed(RuntimeError):
    """A step cannot be computed, whatever its length."""


class NotConverged(StepFailed):
    """A step did not converge; a shorter one may."""


class State(Protocol):
    """Part of a state that all solvers have: times [s] and energies exchanged [J]."""

    time: float
    time_step: float
    energy: dict[str, float]


class Solver(Protocol):
    """Members of a solver that the time loop calls."""

    @property
    def backend(self) -> Backend:
        """Where the arrays lie and the loops run."""
        ...

    @property
    def particle_count(self) -> int:
        """Particles of the body, without walls."""
        ...

    @property
    def state(self) -> State:
        """Time and energies; the time loop sets the time to that of an event that was hit."""
        ...

    @property
    def fields(self) -> dict[str, Any]:
        """Arrays of the particles that a checkpoint keeps, by name."""
        ...

    def checkpoint_scalars(self) -> dict[str, float]:
        """Numbers that survive a step and that a checkpoint keeps beside `fields`."""
        ...

    def restore(self, arrays: Mapping[str, np.ndarray], scalars: Mapping[str, float], /) -> None:
        """Continue from the arrays of `fields` and from `checkpoint_scalars`."""
        ...

    def time_step_limits(self) -> dict[str, float]:
        """Named limits of the next step [s]; the smallest one wins and is reported."""
        ...

    def step(self, step: float, unclipped_step: float | None = None) -> float:
        """Advance by `step` [s], or by less where that fails; returns the step taken [s].

        Args:
            unclipped_step: the step that would be taken were no time to be hit [s]; growth goes
                from it.

        Raises:
            StepFailed: not even the shortest step succeeds; the state is as before.
        """
        ...

    @property
    def iterations(self) -> dict[str, int]:
        """Iterations of the last step, by name; columns of history.csv."""
        ...

    @property
    def is_steady(self) -> bool:
        """Whether nothing changes any more, where the case asks to stop then."""
        ...


def retry_step(
    attempt: Callable[[float, float | None], None],
    step: float,
    unclipped_step: float | None = None,
    *,
    undo: Callable[[], None] = lambda: None,
) -> float:
    """Attempt a step [s], and where it fails its half, down to a 256th; returns the one taken.

    Args:
        attempt: takes `step` and `unclipped_step`, see `Solver.step`.
        undo: sets the state back after a failed attempt, where the attempt does not itself.

    Raises:
        NotConverged: the shortest step fails too; the state is as before.
    """
    for tries in range(RETRIES + 1):
        try:
            attempt(step, unclipped_step)
            break
        except (NotConverged, EscapedParticle) as error:
            undo()
            if tries == RETRIES:
                raise NotConverged(str(error)) from error
            step = unclipped_step = 0.5 * step
    return step


def common_limits(time: TimeSettings, now: float, pulse: PulseTrain | None) -> dict[str, float]:
    """Limits that all solvers have [s]: the end, and a fixed step or else the next pulse edge."""
    limits = {"end": time.end - now}
    if time.fixed_step is not None:
        return limits | {"fixed step": time.fixed_step}
    edge = None if pulse is None else time_to_edge(pulse, now, time.end)
    return limits if edge is None else limits | {"pulse edge": edge}


def time_to_edge(pulse: PulseTrain, now: float, end: float) -> float | None:
    """Time until the next edge of a pulse train before `end` [s]; None where there is none."""
    marks = np.asarray(pulse.breakpoints(now, end))
    ahead = marks[marks > now * (1 + 1e-12)]
    return float(ahead.min()) - now if ahead.size else None


def choose_step(limits: Mapping[str, float]) -> tuple[str, float, float]:
    """Name of the binding limit, the step, and the unclipped step: without times to be hit [s].

    The way to a target is split evenly where one step falls short of it but two would not, so that
    no sliver of a step remains.
    """
    bounds = {key: value for key, value in limits.items() if key not in TARGETS}
    if not bounds:
        name, step = binding_limit(limits)
        return name, step, step
    bound, unclipped_step = binding_limit(bounds)
    targets = {key: limits[key] for key in TARGETS if key in limits}
    aim, target = binding_limit(targets) if targets else ("", float("inf"))
    if unclipped_step * (1.0 + ROUNDING) >= target:
        return aim, target, unclipped_step
    return bound, 0.5 * target if 2.0 * unclipped_step > target else unclipped_step, unclipped_step


def name_of_longest(has_light: bool) -> str:
    """Name of the limit that `TimeSettings.step` sets."""
    return "light" if has_light else "largest step"


def binding_limit(limits: Mapping[str, float]) -> tuple[str, float]:
    """Name and value [s] of the smallest limit; the first one of equals."""
    name = min(limits, key=lambda key: limits[key])
    return name, limits[name]
