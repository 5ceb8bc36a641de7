"""Time steps: the settings, and the choice of the smallest of named limits."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated

from pydantic import Field

from lasersph.reading import Model, TemperatureDifference, Time


class TimeSettings(Model):
    """How long to compute and in which steps."""

    end: Annotated[Time, Field(gt=0)] = Field(description="of the simulated time, from 0")
    step: Annotated[Time, Field(gt=0)] | None = Field(
        None,
        description="largest step while the laser is on; default: a 200th of the pulse (implicit), "
        "no limit beside stability (explicit)",
    )
    is_fixed: bool = Field(
        False, description="take `step` always, also where it is unstable (for studies)"
    )
    temperature_change: Annotated[TemperatureDifference, Field(gt=0)] = Field(
        50.0, description="aimed at per step, by the fastest particle (implicit)"
    )
    cooling: Annotated[float, Field(gt=0, le=1)] = Field(
        0.005, description="largest step after a pulse, over the time since its light (implicit)"
    )
    growth: Annotated[float, Field(gt=1, le=10)] = Field(
        1.25, description="of the step, at most, from one to the next"
    )


def binding(limits: Mapping[str, float]) -> tuple[str, float]:
    """Name and value [s] of the smallest limit; the first one of equals."""
    name = min(limits, key=lambda key: limits[key])
    return name, limits[name]
