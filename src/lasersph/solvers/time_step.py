"""Time steps: the settings, and the choice of the smallest of named limits."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np
from pydantic import Field

from lasersph.input import Model, TemperatureDifference, Time


class TimeSettings(Model):
    """How long to compute and in which steps."""

    end: Annotated[Time, Field(gt=0)] = Field(description="of the simulated time, from 0")
    step: Annotated[Time, Field(gt=0)] | None = Field(
        default=None,
        description="largest step while the laser is on, without laser always; default: a 200th of "
        "the pulse (implicit), no limit beside stability (explicit)",
    )
    is_fixed: bool = Field(
        default=False, description="take `step` always, also where it is unstable (for studies)"
    )
    temperature_change: Annotated[TemperatureDifference, Field(gt=0)] = Field(
        default=50.0, description="aimed at per step, by the fastest particle (implicit)"
    )
    cooling: Annotated[float, Field(gt=0, le=1)] = Field(
        default=0.005,
        description="largest step after a pulse, over the time since its light (implicit)",
    )
    growth: Annotated[float, Field(gt=1, le=10)] = Field(
        default=1.25, description="of the step, at most, from one to the next"
    )
    steady: Annotated[float, Field(gt=0, lt=1)] | None = Field(
        default=None,
        description="stop before the end once the flow is steady: range of its kinetic energy over "
        "the mean, while the fastest particle crosses the width five times",
    )


TARGETS = ("end", "pulse edge", "snapshot")
"""Limits that are times to be hit; the others bound the step itself."""
ROUNDING = 1e-9
"""Share of a step by which it is stretched to hit a time, so that sums of steps may round."""


def choose(limits: Mapping[str, float]) -> tuple[str, float, float]:
    """Name of the binding limit, the step [s], and the pace: the step without times to be hit.

    The way to a target is split evenly where one step falls short of it but two would not, so that
    no sliver of a step remains.
    """
    bounds = {key: value for key, value in limits.items() if key not in TARGETS}
    if not bounds:
        name, step = binding(limits)
        return name, step, step
    bound, pace = binding(bounds)
    targets = {key: limits[key] for key in TARGETS if key in limits}
    aim, target = binding(targets) if targets else ("", float("inf"))
    if pace * (1.0 + ROUNDING) >= target:
        return aim, target, pace
    return bound, 0.5 * target if 2.0 * pace > target else pace, pace


def next_edge(pulse: Any, time: float, end: float) -> float | None:
    """Time until the next edge of a pulse train before `end` [s]; None where there is none."""
    marks = np.asarray(pulse.breakpoints(time, end))
    ahead = marks[marks > time * (1 + 1e-12)]
    return float(ahead.min()) - time if ahead.size else None


def name_of_longest(has_light: bool) -> str:
    """Name of the limit that `TimeSettings.step` sets."""
    return "light" if has_light else "largest step"


def binding(limits: Mapping[str, float]) -> tuple[str, float]:
    """Name and value [s] of the smallest limit; the first one of equals."""
    name = min(limits, key=lambda key: limits[key])
    return name, limits[name]
