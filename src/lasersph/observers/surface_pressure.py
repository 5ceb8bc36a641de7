"""Pressure of the flat surface, beside the recoil pressure of a free surface at the same place.

The surface is held flat. Where its pressure is above zero the liquid would rise, where it is below
zero it would sink; this pressure drives a return flow that a free surface would not have.
A boiling surface is pushed down by 0.54 p_sat(T) [Anisimov1968], which is what this pressure is
compared with. The dynamic pressure is known up to a constant; its mean over the liquid is zero.

A part of it undoes within one step the divergence that moving the particles left, and grows as the
step shrinks. Steps that are shortened to end at a given time are therefore passed over.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.observers.flow_speed import flow_of, time_of
from lasersph.observers.flow_view import FlowView
from lasersph.observers.peak import Peak
from lasersph.observers.view import View


class SurfacePressure:
    """Observes the pressure at the surface of the liquid."""

    columns: tuple[str, ...] = ("lid_pressure_max_Pa", "lid_pressure_min_Pa", "lid_recoil_max_Pa")

    def __init__(self) -> None:
        self.largest, self.lowest, self.recoil = Peak(), Peak(), Peak()
        self.at_largest: dict[str, float] = {}
        self.at_lowest: dict[str, float] = {}
        self.has_vapor = False
        self.row = dict.fromkeys(self.columns, 0.0)

    def observe(self, view: View) -> dict[str, float]:
        """Largest and smallest pressure of the surface and largest recoil pressure [Pa].

        Those of the step before where this one is shortened.
        """
        flow = flow_of(view)
        wet = np.flatnonzero(flow.flows[flow.surface])
        if wet.size == 0:
            self.row = dict.fromkeys(self.columns, 0.0)
        elif not flow.is_shortened:
            self.row = self._look(view, flow, wet)
        return self.row

    def _look(self, view: View, flow: FlowView, wet: np.ndarray) -> dict[str, float]:
        vapor = flow.recoil_pressure
        self.has_vapor = vapor is not None
        recoil = np.zeros(wet.size) if vapor is None else vapor[wet]
        pressure, x = flow.surface_pressure[wet], view.position[0, flow.surface[wet]]
        high, low = int(np.argmax(pressure)), int(np.argmin(pressure))
        values = (float(pressure[high]), float(pressure[low]), float(np.max(recoil)))
        self.largest.update(values[0], view.time)
        self.lowest.update(-values[1], view.time)
        self.recoil.update(values[2], view.time)
        if self.largest.last == view.time:
            self.at_largest = {"x_m": float(x[high]), "recoil_there_Pa": float(recoil[high])}
        if self.lowest.last == view.time:
            self.at_lowest = {"x_m": float(x[low]), "recoil_there_Pa": float(recoil[low])}
        return dict(zip(self.columns, values, strict=True))

    def summary(self) -> dict[str, Any]:
        """`lid`: largest and smallest pressure, where, when, and the recoil pressure there.

        Nothing where the surface was never liquid; recoil None without data of the vapor.
        """
        if not self.at_largest:
            return {}
        lid: dict[str, Any] = {}
        for name, peak, sign, at in (
            ("pressure_max", self.largest, 1.0, self.at_largest),
            ("pressure_min", self.lowest, -1.0, self.at_lowest),
        ):
            lid[f"{name}_Pa"], lid[f"{name}_at_s"] = sign * peak.value, peak.time
            lid[f"{name}_x_m"] = at["x_m"]
            lid[f"recoil_at_{name}_Pa"] = at["recoil_there_Pa"] if self.has_vapor else None
        lid["recoil_max_Pa"] = self.recoil.value if self.has_vapor else None
        lid["recoil_max_at_s"] = time_of(self.recoil) if self.has_vapor else None
        return {"lid": lid}

    def state(self) -> dict[str, Any]:
        """What `restore` needs."""
        return {
            "largest": self.largest.state(),
            "lowest": self.lowest.state(),
            "recoil": self.recoil.state(),
            "at_largest": dict(self.at_largest),
            "at_lowest": dict(self.at_lowest),
            "has_vapor": self.has_vapor,
            "row": dict(self.row),
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Continue from a state."""
        for name in ("largest", "lowest", "recoil"):
            setattr(self, name, Peak(**state[name]))
        self.at_largest, self.at_lowest = dict(state["at_largest"]), dict(state["at_lowest"])
        self.has_vapor, self.row = state["has_vapor"], dict(state["row"])
