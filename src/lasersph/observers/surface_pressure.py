"""Pressure of the flat surface, beside the recoil pressure of a free surface at the same place.

The surface is kept flat. Where its pressure is above zero the liquid would rise, where it is below
zero it would sink; this pressure drives a return flow that a free surface would not have.
A boiling surface is pushed down by 0.54 p_sat(T) [Anisimov1968], which is what this pressure is
compared with. The dynamic pressure is known up to a constant; its mean over the liquid is zero.

Particles melt and freeze as a whole: one that freezes loses its velocity within a step, which takes
an impulse, and so a pressure that grows as 1 / dt. Both numbers are therefore running means over
the time of ten full steps, in which an impulse counts by its size, however long the step was.
"""

from __future__ import annotations

from math import exp

import numpy as np

from lasersph.observers.flow_speed import flow_of
from lasersph.observers.flow_view import FlowView
from lasersph.observers.observer import Observer, Row, time_of
from lasersph.observers.peak import Peak
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View

AVERAGED_STEPS = 10.0
"""Full steps of the running mean: one step's jump of 0.5 MPa in steel shows as 0.05 MPa."""
RECOIL = "recoil pressure of the vapor on a free surface"


class SurfacePressure(Observer):
    """Observes the pressure at the surface of the liquid."""

    title = "pressure of the liquid at its surface"
    note = (
        "That of a flat surface has a mean of zero over the liquid and drives a return flow that a"
        " free surface, which would rise or sink instead, does not have."
    )
    columns = (
        Quantity("lid_pressure_max_Pa", "Pa", "largest pressure at the surface, running mean"),
        Quantity("lid_pressure_min_Pa", "Pa", "smallest pressure at the surface, running mean"),
        Quantity("lid_recoil_max_Pa", "Pa", f"largest {RECOIL}"),
    )
    results = (
        *(
            one
            for name, text in (("max", "largest"), ("min", "smallest"))
            for one in (
                Quantity(
                    f"lid.pressure_{name}_Pa",
                    "Pa",
                    f"{text} pressure at the surface",
                    at=(f"lid.pressure_{name}_at_s", f"lid.pressure_{name}_x_m"),
                ),
                Quantity(f"lid.recoil_at_pressure_{name}_Pa", "Pa", f"{RECOIL} there"),
            )
        ),
        Quantity("lid.recoil_max_Pa", "Pa", f"largest {RECOIL}", at=("lid.recoil_max_at_s",)),
    )
    kept = ("largest", "lowest", "recoil", "places", "has_vapor", "means", "seen_at")

    def __init__(self) -> None:
        super().__init__()
        self.largest, self.lowest, self.recoil = Peak(), Peak(), Peak()
        self.places: dict[str, list[float]] = {}
        self.has_vapor = False
        self.means: list[float] = []
        self.seen_at = 0.0

    def observe(self, view: View) -> Row:
        """Largest and smallest pressure of the surface and largest recoil pressure [Pa]."""
        flow = flow_of(view)
        wet = np.flatnonzero(flow.flows[flow.surface])
        # a surface that is solid has no pressure to show
        if wet.size == 0:
            self.means = []
            return self.record(view.time, (0.0, 0.0, 0.0))
        return self.record(view.time, self._measure(view, flow, wet))

    def _measure(self, view: View, flow: FlowView, wet: np.ndarray) -> tuple[float, ...]:
        pressure, x = flow.surface_pressure[wet], view.position[0, flow.surface[wet]]
        # highest and lowest pressure of this step, and where
        high, low = int(np.argmax(pressure)), int(np.argmin(pressure))
        # recoil pressure there and at the hottest place, where it is largest
        T = flow.surface_temperature[wet]
        self.has_vapor = flow.recoil is not None
        at = np.array([T[high], T[low], T.max()])
        recoil = np.zeros(3) if flow.recoil is None else flow.recoil(at)
        now = [float(pressure[high]), float(pressure[low])]
        span = AVERAGED_STEPS * flow.full_step
        # running mean, first value as it is
        share = 1.0 - exp(-(view.time - self.seen_at) / span) if self.means and span else 1.0
        old = self.means or now
        self.means = [mean + share * (p - mean) for mean, p in zip(old, now, strict=True)]
        self.seen_at = view.time
        values = (*self.means, float(recoil[2]))
        self.largest.update(values[0], view.time)
        self.lowest.update(-values[1], view.time)
        self.recoil.update(values[2], view.time)
        # where each extreme was, and the recoil there
        extremes = (("max", self.largest, high), ("min", self.lowest, low))
        for (name, peak, k), there in zip(extremes, recoil, strict=False):
            if peak.last == view.time:
                self.places[name] = [float(x[k]), float(there)]
        return values

    def values(self) -> dict[str, object]:
        """Largest and smallest pressure, where, when, and the recoil pressure there.

        Recoil None without data of the vapor.
        """
        found: dict[str, object] = {}
        for name, peak, sign in (("max", self.largest, 1.0), ("min", self.lowest, -1.0)):
            stem, (x, recoil) = f"lid.pressure_{name}", self.places[name]
            found |= {f"{stem}_Pa": sign * peak.value, f"{stem}_at_s": peak.time, f"{stem}_x_m": x}
            found[f"lid.recoil_at_pressure_{name}_Pa"] = recoil if self.has_vapor else None
        found["lid.recoil_max_Pa"] = self.recoil.value if self.has_vapor else None
        found["lid.recoil_max_at_s"] = time_of(self.recoil) if self.has_vapor else None
        return found

    def summary(self) -> dict[str, object]:
        """Nothing where the surface was never liquid."""
        return super().summary() if self.places else {}
