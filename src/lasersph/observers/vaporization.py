"""When and how deep the vaporization temperature was held, and what evaporated.

Under the plateau rules `hold` and `clip` a cell stays at T_v while it takes up the heat of
vaporization; the times are the first and the last at which a surface cell was at T_v. Under
`evaporate`, and where vapor leaves as a flux, there is no plateau: the times say when the surface
was at or above T_v.

Above 0.9 T_c a vapor is no ideal gas any more and the curve of saturation pressure an
extrapolation: when and where the surface was that hot is told as well.
"""

from __future__ import annotations

import numpy as np

from lasersph.observers.melt_pool import FULL
from lasersph.observers.observer import Observer, Row
from lasersph.observers.peak import Span
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View, largest_depth, lower_faces

NEAR_CRITICAL = 0.9
"""Share of T_c above which the curve of saturation pressure does not hold."""
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
            "evaporated thickness, where most left",
            end="vaporization.evaporated_thickness_max_m",  # it only grows
        ),
        Quantity(
            "evaporated_mean_m",
            "m",
            "evaporated thickness, mean over the surface",
            end="vaporization.evaporated_thickness_mean_m",
        ),
    )
    results = (
        Quantity("vaporization.start_s", "s", "first at the vaporization temperature"),
        Quantity("vaporization.end_s", "s", "last at the vaporization temperature"),
        Quantity("vaporization.near_critical_start_s", "s", "first above 0.9 T_c"),
        Quantity("vaporization.near_critical_end_s", "s", "last above 0.9 T_c"),
        Quantity("vaporization.near_critical_x_m", "m", "place of the hottest surface above it"),
        Quantity("vaporization.critical_K", "K", "critical temperature T_c"),
    )
    kept = ("span", "near", "hottest", "place", "critical")

    def __init__(self) -> None:
        super().__init__()
        self.span, self.near = Span(), Span()
        self.hottest = 0.0
        self.place: float | None = None
        self.critical: float | None = None

    def observe(self, view: View) -> Row:
        """Largest vapor fraction, depth of its occurrence and evaporated thickness [m]."""
        # shares of the heat of vaporization, of which most runs have none
        fraction = view.vapor_fraction
        largest = float(np.max(fraction))
        faces = lower_faces(view) if largest > 0.0 else np.zeros(0)
        # times at the boiling point, but for rounding
        if view.vaporization is not None:
            surface = float(np.max(view.temperature[view.surface]))
            self.span.update(surface >= view.vaporization * (1.0 - TOLERANCE), view.time)
            self._look_near_critical(view, surface)
        # evaporated thickness of each column, where the run evaporates
        evaporated = np.zeros(1) if view.evaporated is None else view.evaporated
        share = view.column_share
        values = (
            largest,
            largest_depth(faces, fraction > 0.0) if largest > 0.0 else 0.0,
            largest_depth(faces, fraction >= FULL) if largest >= FULL else 0.0,
            float(np.max(evaporated)),
            float(np.mean(evaporated) if share is None else share @ evaporated),
        )
        return self.record(view.time, values)

    def values(self) -> dict[str, object]:
        """Times at the vaporization temperature."""
        is_near = self.near.first is not None
        return {
            "vaporization.start_s": self.span.first,
            "vaporization.end_s": self.span.last,
            "vaporization.near_critical_start_s": self.near.first,
            "vaporization.near_critical_end_s": self.near.last,
            "vaporization.near_critical_x_m": self.place,
            "vaporization.critical_K": self.critical if is_near else None,
        }

    def _look_near_critical(self, view: View, surface: float) -> None:
        """When the surface was above 0.9 T_c, and where it was hottest then."""
        self.critical = view.critical
        if view.critical is None:
            return
        # the hottest place is kept as long as nothing hotter comes
        is_near = surface > NEAR_CRITICAL * view.critical
        self.near.update(is_near, view.time)
        if is_near and surface > self.hottest:
            self.hottest = surface
            if view.dimension > 1:
                at = view.surface[np.argmax(view.temperature[view.surface])]
                self.place = float(view.position[0, at])

    def summary(self) -> dict[str, object]:
        """Nothing where the surface never reached T_v and nothing evaporated."""
        is_seen = self.span.first is not None or float(self.last["evaporated_max_m"]) > 0.0
        return super().summary() if is_seen else {}
