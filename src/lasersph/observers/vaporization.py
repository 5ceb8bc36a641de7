"""When and how deep the vaporization temperature was held, and what evaporated.

Under the plateau rules `hold` and `clip` a cell stays at T_v while it takes up the heat of
vaporization; the times are the first and the last at which a surface cell was at T_v. Under
`evaporate` there is no plateau: the times say when the surface was at or above T_v.
"""

from __future__ import annotations

import numpy as np

from lasersph.observers.melt_pool import FULL
from lasersph.observers.observer import Observer, Row
from lasersph.observers.peak import Span
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View, largest_depth, lower_faces

TOLERANCE = 1e-6
"""Relative distance below T_v that still counts as T_v."""


class Vaporization(Observer):
    """Observes material at the vaporization temperature."""

    title = "vaporization"
    note = "Depths are those of the lower faces of cells."
    columns = (
        Quantity(
            "vapor_fraction_max",
            "",
            "share of the heat of vaporization that a cell took up",
            largest="vaporization.fraction_max",
        ),
        Quantity(
            "vapor_depth_any_m",
            "m",
            "depth of cells that took up some of it",
            largest="vaporization.depth_any_max_m",
            cells=1.0,
        ),
        Quantity(
            "vapor_depth_m",
            "m",
            "depth of cells that took up all of it",
            largest="vaporization.depth_max_m",
            cells=1.0,
        ),
        Quantity(
            "evaporated_max_m",
            "m",
            "evaporated thickness",
            largest="vaporization.evaporated_thickness_max_m",
        ),
    )
    results = (
        Quantity("vaporization.start_s", "s", "first at the vaporization temperature"),
        Quantity("vaporization.end_s", "s", "last at the vaporization temperature"),
    )
    kept = ("span",)

    def __init__(self) -> None:
        super().__init__()
        self.span = Span()

    def observe(self, view: View) -> Row:
        """Largest vapor fraction, depth of its occurrence and evaporated thickness [m]."""
        fraction = view.vapor_fraction
        largest = float(np.max(fraction))
        faces = lower_faces(view) if largest > 0.0 else np.zeros(0)
        if view.vaporization is not None:
            surface = float(np.max(view.temperature[view.surface]))
            self.span.update(surface >= view.vaporization * (1.0 - TOLERANCE), view.time)
        values = (
            largest,
            largest_depth(faces, fraction > 0.0) if largest > 0.0 else 0.0,
            largest_depth(faces, fraction >= FULL) if largest >= FULL else 0.0,
            0.0 if view.evaporated is None else float(np.max(view.evaporated)),
        )
        return self.record(view.time, values)

    def values(self) -> dict[str, object]:
        """Times at the vaporization temperature."""
        return {"vaporization.start_s": self.span.first, "vaporization.end_s": self.span.last}

    def summary(self) -> dict[str, object]:
        """Nothing where the surface never reached T_v and nothing evaporated."""
        is_seen = self.span.first is not None or self.peak["evaporated_max_m"].value > 0.0
        return super().summary() if is_seen else {}
