"""A closed box of liquid: center lines and, of a section, its stream function.

The lines of a block lie half way between front and back, or in the one of them that is a plane of
symmetry: in the middle of the whole.

Interpolating from particles takes about as long as a step, so it is done in every `EVERY`-th step
and at the end; between, the history repeats the last value.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from lasersph.input.key_units import suffix
from lasersph.observers.box_sections import (
    Box,
    center_lines,
    extremum,
    stream_function,
)
from lasersph.observers.flow_speed import flow_of
from lasersph.observers.observer import Observer, Row
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View

EVERY = 50
LINE = 129
"""Points of a center line, from wall to wall."""
KEPT = 4
"""Every fourth of them goes to the summary."""
NODES = 41
"""Nodes of the stream function's grid along each side."""
CENTER = {
    "u_max": "largest u at half the width",
    "u_min": "smallest u at half the width",
    "w_max": "largest w at half the height",
    "w_min": "smallest w at half the height",
}
EDDIES = {"max": "largest stream function", "min": "smallest stream function"}


class BoxFlow(Observer):
    """Observes center lines and stream function of a box."""

    title = "box, at the end"
    note = "u = dpsi/dz, w = -dpsi/dx, psi = 0 at the bottom; evaluated in every 50th step."
    columns = (
        *(Quantity(f"box_{name}_m_s", "m/s", words) for name, words in CENTER.items()),
        *(
            Quantity(f"box_stream_function_{name}_m2_s", "m^2/s", words)
            for name, words in EDDIES.items()
        ),
    )
    results = (
        Quantity("box.time_s", "s", "time of these values"),
        Quantity("box.width_m", "m", "width"),
        Quantity("box.height_m", "m", "height"),
        *(
            Quantity(
                f"box.center.{name}_m_s",
                "m/s",
                words,
                at=(f"box.center.{name}_at_{'z' if name[0] == 'u' else 'x'}_m",),
            )
            for name, words in CENTER.items()
        ),
        *(
            Quantity(f"box.lines.{name}{suffix(unit)}", unit, f"{name} on a center line")
            for name, unit in (("z", "m"), ("u", "m/s"), ("x", "m"), ("w", "m/s"))
        ),
        *(
            Quantity(
                f"box.stream_function.{name}_m2_s",
                "m^2/s",
                words,
                at=(f"box.stream_function.{name}_x_m", f"box.stream_function.{name}_z_m"),
            )
            for name, words in EDDIES.items()
        ),
    )
    # centers and eddies of the last measurement go into a checkpoint
    kept = ("edges", "found")

    def __init__(self, dimension: int = 2) -> None:
        """
        Args:
            dimension: 2 or 3; a flow of three dimensions has no stream function.
        """
        if dimension == 3:
            self.columns = self.columns[: len(CENTER)]
        super().__init__()
        self.edges: list[float] = []
        self.found: dict[str, Any] = {}
        self.unseen: View | None = None

    def observe(self, view: View) -> Row:
        """Extrema on the center lines [m/s] and of the stream function [m^2/s]."""
        # the box is that of the first view: particles move, its walls do not
        if not self.edges:
            box = Box.around(view.position, view.width)
            self.edges = box.edges
        self.unseen = view
        if view.step % EVERY:
            return dict(self.last)
        self._measure()
        center, eddies = self.found["center"], self.found.get("stream_function")
        values = (
            # history: the last measurement until the next one
            *(center[f"{name}_m_s"] for name in CENTER),
            *(eddies[f"{name}_m2_s"] for name in EDDIES if eddies),
        )
        return self.record(view.time, values)

    def _measure(self) -> None:
        """Evaluate the last state, if that is not done."""
        view, self.unseen = self.unseen, None
        if view is None:
            return
        box = Box(*self.edges, mirror=flow_of(view).mirror)
        self.found = {
            "time_s": view.time,
            "width_m": box.width,
            "height_m": box.height,
            **lines_of(view, box),
        }
        if view.dimension == 2:
            self.found["stream_function"] = eddies_of(view, box)

    def summary(self) -> dict[str, Any]:
        """`box`: size, center lines and their extrema, stream function; at the end."""
        self._measure()
        return {"box": self.found} if self.found else {}

    def state(self) -> dict[str, Any]:
        # a checkpoint must not change when the run measures next
        """State for `restore`; `found` as if the run ended here."""
        ahead = BoxFlow()
        ahead.edges, ahead.unseen, ahead.found = self.edges, self.unseen, self.found
        ahead._measure()
        return {**super().state(), "found": ahead.found}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Continue from a state."""
        super().restore(state)
        self.unseen = None


def lines_of(view: View, box: Box) -> dict[str, Any]:
    """The center lines and where their extrema lie."""
    shares = np.linspace(0.0, 1.0, LINE)
    lines = center_lines(view.position, flow_of(view).velocity, box, shares)
    center: dict[str, float] = {}
    # u along the upright line, w along the level one
    for name in CENTER:
        upward = name.startswith("u")
        places, values = (lines.z, lines.u) if upward else (lines.x, lines.w)
        place, value = extremum(places, values, 1.0 if name.endswith("max") else -1.0)
        center[f"{name}_m_s"] = value
        center[f"{name}_at_{'z' if upward else 'x'}_m"] = place
    kept = {"z_m": lines.z, "u_m_s": lines.u, "x_m": lines.x, "w_m_s": lines.w}
    return {"center": center, "lines": {name: a[::KEPT].tolist() for name, a in kept.items()}}


def eddies_of(view: View, box: Box) -> dict[str, float]:
    """Largest and smallest value of the stream function and where they lie."""
    x, z, psi = stream_function(view.position, flow_of(view).velocity, box, NODES)
    found: dict[str, float] = {}
    for name, k in (("max", int(np.argmax(psi))), ("min", int(np.argmin(psi)))):
        # row and column of the largest and the smallest node
        row, column = divmod(k, NODES)
        found[f"{name}_m2_s"] = float(psi[row, column])
        found[f"{name}_x_m"], found[f"{name}_z_m"] = float(x[column]), float(z[row])
    return found
