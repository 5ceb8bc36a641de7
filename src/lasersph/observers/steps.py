"""Time, time step, what limited it, and how many iterations each step took."""

from __future__ import annotations

from lasersph.observers.observer import Observer, Row
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View


class Steps(Observer):
    """Observes the time stepping. The view of the initial state counts as step 0."""

    title = "steps"
    columns = (
        Quantity("time_s", "s", "time", end="time_s"),
        Quantity("step", "", "number of the step", end="steps"),
        Quantity("time_step_s", "s", "time step"),
        Quantity("limit", "", "limit that bound the time step"),
        Quantity("iterations_<name>", "", "iterations of newton, linear, ..."),
    )
    results = (
        Quantity("time_step.min_s", "s", "smallest time step"),
        Quantity("time_step.max_s", "s", "largest time step"),
        Quantity("time_step.limits", "", "how often each limit bound the time step"),
        Quantity("iterations", "", "iterations of all steps, by part of the solver"),
    )
    kept = ("iterations", "limits", "smallest", "largest")

    def __init__(self, iterations: tuple[str, ...] = ()) -> None:
        """`iterations`: names of the solver parts that count iterations."""
        *always, counted = type(self).columns
        self.columns = (*always, *(counted.of(name) for name in iterations))
        super().__init__()
        self.iterations = dict.fromkeys(iterations, 0)
        self.limits: dict[str, int] = {}
        self.smallest: float | None = None
        self.largest: float | None = None

    def observe(self, view: View) -> Row:
        """Time [s], step number, time step [s], binding limit, iterations."""
        counts = {name: int(view.iterations.get(name, 0)) for name in self.iterations}
        step = float(view.time_step)
        if view.step > 0:
            self.limits[view.limit] = self.limits.get(view.limit, 0) + 1
            self.iterations = {name: n + counts[name] for name, n in self.iterations.items()}
        if view.step > 0 and step > 0.0:  # no pause between pulses that was jumped over
            self.smallest = step if self.smallest is None else min(self.smallest, step)
            self.largest = step if self.largest is None else max(self.largest, step)
        values = (float(view.time), int(view.step), step, view.limit, *counts.values())
        return self.record(view.time, values)

    def values(self) -> dict[str, object]:
        """Range of the time step, how often each limit bound it, iterations."""
        return {
            "time_step.min_s": self.smallest,
            "time_step.max_s": self.largest,
            "time_step.limits": dict(self.limits),
            "iterations": dict(self.iterations),
        }
