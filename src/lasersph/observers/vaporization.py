"""When and how deep the vaporization temperature was held, and what evaporated.

Under the plateau rules `hold` and `clip` a cell stays at T_v while it takes up the heat of
vaporization; the times are the first and the last at which a surface cell was at T_v. Under
`evaporate` there is no plateau: the times say when the surface was at or above T_v.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.observers.melt_pool import FULL
from lasersph.observers.peak import Peak, Span
from lasersph.observers.view import View, deepest, lower_faces

TOLERANCE = 1e-6
"""Relative distance below T_v that still counts as T_v."""


class Vaporization:
    """Observes material at the vaporization temperature."""

    columns: tuple[str, ...] = (
        "vapor_fraction_max",
        "vapor_depth_any_m",
        "vapor_depth_m",
        "evaporated_max_m",
    )

    def __init__(self) -> None:
        self.span = Span()
        self.peak = {name: Peak() for name in self.columns}

    def observe(self, view: View) -> dict[str, float]:
        """Largest vapor fraction, depth of its occurrence and evaporated thickness [m]."""
        fraction = view.vapor_fraction
        largest = float(np.max(fraction))
        faces = lower_faces(view) if largest > 0.0 else np.zeros(0)
        if view.vaporization is not None:
            surface = float(np.max(view.temperature[view.surface]))
            self.span.update(surface >= view.vaporization * (1.0 - TOLERANCE), view.time)
        values = (
            largest,
            deepest(faces, fraction > 0.0) if largest > 0.0 else 0.0,
            deepest(faces, fraction >= FULL) if largest >= FULL else 0.0,
            0.0 if view.evaporated is None else float(np.max(view.evaporated)),
        )
        row = dict(zip(self.columns, values, strict=True))
        for name, value in row.items():
            self.peak[name].update(value, view.time)
        return row

    def summary(self) -> dict[str, Any]:
        """`vaporization`: times at T_v, depths of f_v = 1 and f_v > 0, evaporated thickness.

        Nothing where the surface never reached T_v and nothing evaporated.
        """
        if self.span.first is None and self.peak["evaporated_max_m"].value == 0.0:
            return {}
        return {
            "vaporization": {
                "start_s": self.span.first,
                "end_s": self.span.last,
                "fraction_max": self.peak["vapor_fraction_max"].value,
                "depth_max_m": self.peak["vapor_depth_m"].value,
                "depth_any_max_m": self.peak["vapor_depth_any_m"].value,
                "evaporated_thickness_max_m": self.peak["evaporated_max_m"].value,
            }
        }

    def state(self) -> dict[str, Any]:
        """What `restore` needs."""
        peaks = {name: peak.state() for name, peak in self.peak.items()}
        return {"span": self.span.state(), "peak": peaks}

    def restore(self, state: dict[str, Any]) -> None:
        """Continue from a state."""
        self.span = Span(**state["span"])
        self.peak = {name: Peak(**values) for name, values in state["peak"].items()}
