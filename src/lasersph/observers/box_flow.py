"""A closed box of liquid: center lines, stream function, heat through the walls.

Heat flows into the box through a side at -k <dT/dn>, n into the box, and

    Nu = |<dT/dn>| L / |T_side - T_opposite|

with the distance L and the mean temperatures of the two opposite sides that drive the flow: those
that are both held at a temperature, else those that heat crosses both; of two such pairs, those
that differ most. Without such sides there is no Nusselt number. Interpolating from particles
takes about as long as a step, so it is done in every `EVERY`-th step and at the end; between,
the history repeats the last value.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.observers.box_sections import (
    SIDES,
    Box,
    center_lines,
    extremum,
    stream_function,
    wall_temperature,
)
from lasersph.observers.flow_speed import flow_of
from lasersph.observers.view import View

EVERY = 50
LINE = 129
"""Points of a center line, from wall to wall."""
KEPT = 4
"""Every fourth of them goes to the summary."""
NODES = 41
"""Nodes of the stream function's grid along each side."""
SMALLEST_DIFFERENCE = 1e-9
"""Part of the temperature below which differences between sides are rounding."""


class BoxFlow:
    """Observes center lines, stream function and Nusselt numbers of a box."""

    columns: tuple[str, ...] = (
        "box_u_max_m_s",
        "box_u_min_m_s",
        "box_w_max_m_s",
        "box_w_min_m_s",
        "box_stream_function_max_m2_s",
        "box_stream_function_min_m2_s",
        *(f"box_nusselt_{side}" for side in SIDES),
    )

    def __init__(self) -> None:
        self.edges: Box | None = None
        self.row = dict.fromkeys(self.columns, 0.0)
        self.found: dict[str, Any] = {}
        self.unseen: View | None = None

    def observe(self, view: View) -> dict[str, float]:
        """Extrema on the center lines [m/s] and of the stream function [m^2/s], Nusselt numbers.

        Nusselt numbers are 0 where there is no temperature difference.
        """
        if self.edges is None:
            self.edges = Box.around(view.position, view.width)
        self.unseen = view
        if view.step % EVERY == 0:
            self._look()
        return dict(self.row)

    def _look(self) -> None:
        """Evaluate the last state, if that is not done."""
        view, box = self.unseen, self.edges
        if view is None or box is None:
            return
        self.unseen = None
        lines = lines_of(view, box)
        eddies = eddies_of(view, box)
        heat = heat_of(view, box)
        self.found = {
            "time_s": view.time,
            "width_m": box.width,
            "height_m": box.height,
            **lines,
            "stream_function": eddies,
            "heat": heat,
        }
        center = lines["center"]
        self.row = {
            **{f"box_{name}_m_s": center[f"{name}_m_s"] for name in CENTER},
            "box_stream_function_max_m2_s": eddies["max_m2_s"],
            "box_stream_function_min_m2_s": eddies["min_m2_s"],
            **{f"box_nusselt_{side}": heat.get(f"nusselt_{side}") or 0.0 for side in SIDES},
        }

    def summary(self) -> dict[str, Any]:
        """`box`: size, center lines and their extrema, stream function, heat; at the end."""
        self._look()
        return {"box": self.found} if self.found else {}

    def state(self) -> dict[str, Any]:
        """What `restore` needs."""
        edges = self.edges
        box = None if edges is None else [edges.left, edges.right, edges.bottom, edges.top]
        return {"edges": box, "row": dict(self.row), "found": self._ahead()}

    def _ahead(self) -> dict[str, Any]:
        """What the summary would hold if the run ended here."""
        shown = BoxFlow()
        shown.edges, shown.unseen = self.edges, self.unseen
        shown._look()
        return shown.found or self.found

    def restore(self, state: dict[str, Any]) -> None:
        """Continue from a state."""
        edges = state["edges"]
        self.edges = None if edges is None else Box(*edges)
        self.row, self.found, self.unseen = dict(state["row"]), state["found"], None


CENTER = ("u_max", "u_min", "w_max", "w_min")


def lines_of(view: View, box: Box) -> dict[str, Any]:
    """The center lines and where their extrema lie."""
    shares = np.linspace(0.0, 1.0, LINE)
    lines = center_lines(view.position, flow_of(view).velocity, box, shares)
    center: dict[str, float] = {}
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
        row, column = divmod(k, NODES)
        found[f"{name}_m2_s"] = float(psi[row, column])
        found[f"{name}_x_m"], found[f"{name}_z_m"] = float(x[column]), float(z[row])
    return found


def heat_of(view: View, box: Box) -> dict[str, Any]:
    """Temperature of and heat flux into the box through each side, Nusselt numbers.

    Empty where the temperature is the same everywhere; no Nusselt number without two opposite sides
    that heat crosses.
    """
    flow, spread = flow_of(view), float(np.ptp(view.temperature))
    if spread <= SMALLEST_DIFFERENCE * float(np.max(view.temperature)):
        return {}
    wall = {
        side: wall_temperature(
            view.position,
            view.temperature,
            box,
            side,
            count=NODES,
            held=flow.wall_temperature.get(side),
        )
        for side in SIDES
    }
    pairs = (("left", "right"), ("bottom", "surface"))
    heat: dict[str, Any] = {}
    for side, (temperature, slope) in wall.items():
        heat[f"temperature_{side}_K"] = temperature
        heat[f"flux_{side}_W_m2"] = -flow.conductivity * slope
    held, crossed = (
        [pair for pair in pairs if all(side in sides for side in pair)]
        for sides in (flow.wall_temperature, flow.conducting_sides)
    )
    differences = {pair: abs(wall[pair[0]][0] - wall[pair[1]][0]) for pair in held or crossed}
    if not differences:
        return heat
    pair = max(differences, key=lambda one: differences[one])
    heat |= {"between": " and ".join(pair), "difference_K": differences[pair]}
    length = box.width if pair == pairs[0] else box.height
    for side in pair:
        temperature, slope = wall[side]
        if differences[pair] > SMALLEST_DIFFERENCE * temperature:
            heat[f"nusselt_{side}"] = abs(slope) * length / differences[pair]
    return heat
