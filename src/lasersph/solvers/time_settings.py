"""`TimeSettings`: the `[time]` table of a case."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from lasersph.input import Model, TemperatureDifference, Time


class TimeSettings(Model):
    """How long to compute and in which steps."""

    end: Annotated[Time, Field(gt=0)] = Field(
        description="of the simulated time, from 0", examples=["100 ns"]
    )
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
    """[K]. Accuracy: errors are proportional to it. `dlip-steel` of heat alone (32 nm, `time.step`
    1 ns) melts 2.579, 2.597, 2.606, 2.610 and 2.612 e-13 m2 with 200, 100, 50, 25 and 12.5 K, 0.3 %
    too little at 50 K; shipped cases limit the step by a time beside it."""
    cooling: Annotated[float, Field(gt=0, le=1)] = Field(
        default=0.005,
        description="largest step after a pulse, over the time since its light (implicit)",
    )
    """Accuracy: temperatures fall as t^-1/2, so that 0.5 % of the time is 0.25 % of the rise."""
    growth: Annotated[float, Field(gt=1, le=10)] = Field(
        default=1.25, description="of the step, at most, from one to the next"
    )
    """Cost: first guesses extrapolate the last two steps, and a smooth course is guessed well."""

    pause: Literal["compute", "spread", "remove"] | None = Field(
        default=None,
        exclude_if=lambda given: given is None,
        description="between the pulses of a melt pool, from when all is solid: computed like all "
        "else, or jumped over, with the heat that is left spread evenly or removed; default: "
        "remove where a surface moves, else compute",
    )

    @property
    def fixed_step(self) -> float | None:
        """The step of a study that takes the same one always [s]; None elsewhere."""
        return self.step if self.is_fixed else None
