"""Time, time step, what limited it, and how many iterations each step took."""

from __future__ import annotations

from typing import Any

from lasersph.observers.view import View


class Steps:
    """Observes the time stepping. The view of the initial state counts as step 0."""

    def __init__(self, iterations: tuple[str, ...] = ()) -> None:
        """`iterations`: names of the solver parts that count iterations."""
        self.iterations = dict.fromkeys(iterations, 0)
        self.limits: dict[str, int] = {}
        self.count = 0
        self.time = 0.0
        self.smallest: float | None = None
        self.largest: float | None = None

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the history columns."""
        counts = (f"iterations_{name}" for name in self.iterations)
        return ("time_s", "step", "time_step_s", "limit", *counts)

    def observe(self, view: View) -> dict[str, Any]:
        """Time [s], step number, time step [s], binding limit, iterations."""
        if view.step > 0:
            self.limits[view.limit] = self.limits.get(view.limit, 0) + 1
            for name in self.iterations:
                self.iterations[name] += view.iterations.get(name, 0)
            step = float(view.time_step)
            self.smallest = step if self.smallest is None else min(self.smallest, step)
            self.largest = step if self.largest is None else max(self.largest, step)
        self.count, self.time = int(view.step), float(view.time)
        counts = {f"iterations_{n}": int(view.iterations.get(n, 0)) for n in self.iterations}
        return {
            "time_s": self.time,
            "step": self.count,
            "time_step_s": float(view.time_step),
            "limit": view.limit,
            **counts,
        }

    def summary(self) -> dict[str, Any]:
        """Steps, end time, range of the time step, how often each limit bound it."""
        return {
            "steps": self.count,
            "time_s": self.time,
            "time_step": {"min_s": self.smallest, "max_s": self.largest, "limits": self.limits},
            "iterations": dict(self.iterations),
        }

    def state(self) -> dict[str, Any]:
        """What `restore` needs."""
        return {
            "iterations": dict(self.iterations),
            "limits": dict(self.limits),
            "count": self.count,
            "time": self.time,
            "smallest": self.smallest,
            "largest": self.largest,
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Continue from a state."""
        self.iterations = dict(state["iterations"])
        self.limits = dict(state["limits"])
        self.count, self.time = state["count"], state["time"]
        self.smallest, self.largest = state["smallest"], state["largest"]
