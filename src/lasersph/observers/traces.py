"""History of single particles: temperature, speed, height, as in Figs. 20 and 23 of
[Alshaer2017].

A trace follows the particle that lies closest to a point at the start. The published regions are
between its times:

    temperature (Fig. 20)  I up to boiling, II up to leaving, III after
    speed (Fig. 23)        I at rest, II the jump at boiling, III rising up to leaving, IV after

The published acceleration is the mean one of region III of the speed; where a particle leaves in
the step in which it starts to move, it is the speed over that step.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from lasersph.input.key_units import suffix
from lasersph.observers.ablation_view import CONDENSED, EJECTED, AblationView
from lasersph.observers.crater import ablation_of
from lasersph.observers.observer import Observer, Row
from lasersph.observers.probes import weights_at
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View
from lasersph.output.settings import Trace

AT_BOILING = 1e-9
"""Relative distance below T_v that counts as T_v."""


@dataclass
class Life:
    """History of a particle so far; times [s] are None before."""

    particle: int
    start: list[float]
    temperature_end: float
    speed: float = 0.0
    height: float = 0.0
    stage: int = CONDENSED
    temperature_max: float = 0.0
    melted_at: float | None = None
    boiled_at: float | None = None
    moved_at: float | None = None
    speed_moved: float = 0.0
    step_moved: float = 0.0
    left_at: float | None = None
    temperature_left: float | None = None
    speed_left: float | None = None
    vapor_pressure: float | None = None

    def update(self, view: View, seen: AblationView) -> None:
        """Look at the particle once more; one that the view leaves out has stayed as it was."""
        # a list of particles in flight may leave this one out
        k = self.particle
        if k >= view.temperature.size:
            return
        self.temperature_end = float(view.temperature[k])
        self.speed = float(np.linalg.norm(seen.velocity[:, k]))
        self.height = float(view.position[-1, k])
        self.stage = int(seen.stage[k])
        # largest temperature, and the first melt of the particle
        self.temperature_max = max(self.temperature_max, self.temperature_end)
        if self.melted_at is None and view.melt_fraction[k] > 0.0:
            self.melted_at = view.time

        # first at the boiling point, or on its way from the surface
        boils = view.vaporization is not None and self.temperature_end >= view.vaporization * (
            1.0 - AT_BOILING
        )
        if self.boiled_at is None and (boils or self.stage != CONDENSED):
            self.boiled_at = view.time
        # first of the velocity of the vapor
        if self.moved_at is None and self.stage != CONDENSED:
            self.moved_at, self.speed_moved = view.time, self.speed
            self.step_moved = view.time_step
        # leaves what is condensed
        if self.left_at is None and self.stage >= EJECTED:
            self.left_at, self.temperature_left = view.time, self.temperature_end
            self.speed_left = self.speed
            self.vapor_pressure = float(seen.vapor_pressure[k])

    @property
    def acceleration(self) -> float | None:
        """Mean acceleration in region III [m/s^2]; None before the particle has left."""
        if self.left_at is None or self.moved_at is None or self.speed_left is None:
            return None

        # mean over region III; over one step where it began and ended in the same one
        lasted = self.left_at - self.moved_at
        if lasted > 0.0:
            return (self.speed_left - self.speed_moved) / lasted
        return self.speed_left / self.step_moved if self.step_moved > 0.0 else None


RESULTS = {
    "start": ("m", "place at the start"),
    "melted_at": ("s", "melted"),
    "boiled_at": ("s", "boiled"),
    "moved_at": ("s", "took on the velocity of the vapor"),
    "left_at": ("s", "left"),
    "temperature_max": ("K", "largest temperature"),
    "temperature_left": ("K", "temperature when it left"),
    "temperature_end": ("K", "temperature at the end"),
    "speed_moved": ("m/s", "speed when it began to move"),
    "speed_left": ("m/s", "speed when it left"),
    "acceleration": ("m/s^2", "acceleration between both"),
    "vapor_pressure": ("Pa", "vapor pressure when it left"),
}
"""Attributes of a `Life` that the summary gives, with unit and words."""


class Traces(Observer):
    """Observes named particles."""

    title = "traced particles"
    columns = (
        Quantity("trace_<name>_temperature_K", "K", "temperature"),
        Quantity("trace_<name>_speed_m_s", "m/s", "speed"),
        Quantity("trace_<name>_z_m", "m", "height"),
        Quantity("trace_<name>_stage", "", "0 body, 1 leaving, 2 in flight, 3 beyond the box"),
    )
    results = tuple(
        Quantity(f"traces.<name>.{name}{suffix(unit)}", unit, words)
        for name, (unit, words) in RESULTS.items()
    )

    def __init__(self, traces: tuple[Trace, ...]) -> None:
        """Raises ValueError where two traces have the same name."""
        self.traces = traces
        # names make keys of history and summary
        if len({trace.name for trace in traces}) < len(traces):
            raise ValueError("two traces have the same name")
        self.columns = tuple(one.of(t.name) for t in traces for one in type(self).columns)
        super().__init__()
        self.lives: list[Life] = []

    def observe(self, view: View) -> Row:
        """Temperature [K], speed [m/s], height z [m] and stage of each particle."""
        seen = ablation_of(view)
        if not self.lives:
            self.lives = [life_at_start(trace, view) for trace in self.traces]
        values: list[float] = []
        for life in self.lives:
            life.update(view, seen)
            values += [life.temperature_end, life.speed, life.height, float(life.stage)]
        return self.record(view.time, values)

    def values(self) -> dict[str, object]:
        """Where each particle began and when it melted, boiled and left."""
        return {
            f"traces.{trace.name}.{name}{suffix(unit)}": getattr(life, name)
            for trace, life in zip(self.traces, self.lives, strict=True)
            for name, (unit, _) in RESULTS.items()
        }

    def state(self) -> dict[str, Any]:
        """State for `restore`."""
        return {**super().state(), "lives": [asdict(life) for life in self.lives]}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Continue from a state."""
        super().restore(state)
        self.lives = [Life(**values) for values in state["lives"]]


def life_at_start(trace: Trace, view: View) -> Life:
    """The particle of a trace, as it is in the first view."""
    particles, _ = weights_at(view.position, trace.place(view.dimension), "nearest")
    k = int(particles[0])
    return Life(
        particle=k,
        start=[float(value) for value in view.position[:, k]],
        temperature_end=float(view.temperature[k]),
        height=float(view.position[-1, k]),
    )
