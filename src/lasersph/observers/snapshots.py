"""When snapshots of all particles are written, and what they hold."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from lasersph.input import Model, Time
from lasersph.observers.view import View
from lasersph.particles.fields import FIELDS

DEFAULT_COUNT = 40
LARGEST_COUNT = 100_000
NAMES = (
    *("temperature", "enthalpy", "melt_fraction", "vapor_fraction", "width", "surface"),
    *("velocity", "speed", "pressure", "flows", "surface_temperature", "surface_gradient"),
    *("surface_velocity", "lid_pressure", "density", "vapor_pressure", "normal", "stage"),
)
"""Fields of a snapshot; each solver writes those that it has."""
UNITS = {name: FIELDS[name].unit for name in NAMES}
"""Their units."""


class SnapshotPlan(Model):
    """When to write snapshots: at every multiple of `interval` and at the listed `times`.

    The initial and the final state are always written. Without an interval there are
    40 evenly spaced ones.
    """

    interval: Annotated[Time, Field(gt=0.0)] | None = Field(
        default=None, description="from one snapshot to the next; default: a fortieth of the run"
    )
    times: tuple[Annotated[Time, Field(ge=0.0)], ...] = Field(
        default=(), description="further snapshots"
    )


class SnapshotSchedule:
    """The times of a run's snapshots, which time steps must hit, and which is next.

    Attributes:
        times: sorted, the first 0, the last the end of the run [s].
    """

    def __init__(self, plan: SnapshotPlan, end: float) -> None:
        """Raises ValueError where the plan asks for more than 100 000 snapshots."""
        interval = plan.interval or end / DEFAULT_COUNT
        if end / interval > LARGEST_COUNT:
            raise ValueError(
                f"{end / interval:.0f} snapshots are too many:"
                f" give an interval of at least {end / LARGEST_COUNT:.3g} s"
            )
        multiples = interval * np.arange(int(end / interval) + 1)
        wanted = np.concatenate([multiples, np.array(plan.times), [end]])
        wanted = np.unique(wanted[wanted <= end])
        apart = np.concatenate([np.diff(wanted) > 1e-9 * end, [True]])
        self.times = wanted[apart]
        self.written = 0

    @property
    def next_time(self) -> float:
        """Time of the next snapshot [s], infinite after the last."""
        return float(self.times[self.written]) if self.written < len(self.times) else float("inf")

    def due(self, time: float) -> bool:
        """Whether a snapshot is to be written at `time` [s]; the caller then writes it."""
        if time < self.next_time:
            return False
        self.written = int(np.searchsorted(self.times, time, side="right"))
        return True

    def state(self) -> dict[str, int]:
        """What `restore` needs."""
        return {"written": self.written}

    def restore(self, state: dict[str, int]) -> None:
        """Continue from a state."""
        self.written = state["written"]


def snapshot_fields(view: View) -> dict[str, np.ndarray]:
    """What a snapshot holds beside the positions, in single precision: see `UNITS`.

    The history and the checkpoints keep double precision. With flow the fields of the surface
    above the particles (`surface_temperature`, ...) are 0 for particles that do not lie at it. With
    ablation `stage` tells ejecta from the body, see `AblationView`.
    """
    count = view.temperature.size
    surface = np.zeros(count, dtype=np.uint8)
    surface[view.surface] = 1
    fields = {
        "temperature": view.temperature,
        "enthalpy": view.enthalpy,
        "melt_fraction": view.melt_fraction,
        "vapor_fraction": view.vapor_fraction,
        "width": view.width,
    }
    marks = {"surface": surface}
    if view.flow is not None:
        flow = view.flow
        fields["velocity"] = flow.velocity
        fields["speed"] = np.sqrt(np.sum(flow.velocity * flow.velocity, axis=0))
        fields["pressure"] = flow.pressure
        at_surface = {
            "surface_temperature": flow.surface_temperature,
            "surface_gradient": flow.surface_gradient,
            "surface_velocity": flow.surface_velocity,
            "lid_pressure": flow.surface_pressure,
        }
        for name, values in at_surface.items():
            fields[name] = np.zeros(count)
            fields[name][flow.surface] = values
        marks["flows"] = flow.flows.astype(np.uint8)
    if view.ablation is not None:
        seen = view.ablation
        fields["velocity"], fields["pressure"] = seen.velocity, seen.pressure
        fields["speed"] = np.sqrt(np.sum(seen.velocity * seen.velocity, axis=0))
        fields["density"], fields["vapor_pressure"] = seen.density, seen.vapor_pressure
        fields["normal"] = seen.normal
        marks["stage"] = seen.stage.astype(np.uint8)
    return {**{name: a.astype(np.float32) for name, a in fields.items()}, **marks}
