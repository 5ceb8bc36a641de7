"""Inner and outer extrema of the surface velocity, told apart in time [Demuth2020, Fig. 7].

The surface flows away from the maximum of the light (x = 0). Its speed |u(x)| has one maximum on
each side, the outer one, from the onset of the flow. When a zone at the vaporization temperature
shrinks, the steep gradient at its edge can raise a second maximum closer to x = 0, the inner one.

A maximum counts where it rises above the lowest speed between itself and a larger one by a
twentieth of the largest speed of the profile. Of two, the one closer to x = 0 is the inner one; of
more, the two that rise most count. A single one keeps the name of the one it continues: that whose
last place is closer. A first single one is outer. Seen is the side x > 0; a run over a full period
is symmetric, which a law of its own checks.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lasersph.observers.flow_speed import flow_of, time_of
from lasersph.observers.peak import Peak, Span
from lasersph.observers.view import View

PROMINENCE = 0.05
"""Least rise of an extremum over the valley beside it, as a part of the largest speed."""

Place = tuple[float, float]
"""Speed [m/s] and x [m] of an extremum."""


class FlowExtrema:
    """Observes the inner and the outer extremum of the speed at the surface."""

    columns: tuple[str, ...] = (
        "flow_outer_speed_m_s",
        "flow_outer_x_m",
        "flow_inner_speed_m_s",
        "flow_inner_x_m",
    )

    def __init__(self) -> None:
        self.peak = {"outer": Peak(), "inner": Peak()}
        self.span = {"inner": Span(), "coexist": Span(), "inner_exceeds": Span()}
        self.lasted = dict.fromkeys(self.span, 0.0)
        self.last_place: dict[str, float] = {}

    def observe(self, view: View) -> dict[str, float]:
        """Speed [m/s] and place [m] of both extrema; 0 where one does not exist."""
        found = self._named(surface_extrema(view))
        self.last_place = self.last_place | {name: x for name, (_, x) in found.items()}
        if not found:
            self.last_place = {}
        outer, inner = found.get("outer", (0.0, 0.0)), found.get("inner", (0.0, 0.0))
        for name, (speed, _) in (("outer", outer), ("inner", inner)):
            self.peak[name].update(speed, view.time)
        states = {
            "inner": "inner" in found,
            "coexist": len(found) == 2,
            "inner_exceeds": inner[0] > outer[0],
        }
        for name, holds in states.items():
            self.span[name].update(holds, view.time)
            self.lasted[name] += view.time_step if holds else 0.0
        return dict(zip(self.columns, (*outer, *inner), strict=True))

    def _named(self, extrema: list[Place]) -> dict[str, Place]:
        """Extrema in order of x, one or two, by name."""
        if len(extrema) == 2:
            return {"inner": extrema[0], "outer": extrema[1]}
        if not extrema:
            return {}
        x = extrema[0][1]
        apart = {name: abs(place - x) for name, place in self.last_place.items()}
        name = min(apart, key=lambda known: apart[known]) if apart else "outer"
        self.last_place = {}
        return {name: extrema[0]}

    def summary(self) -> dict[str, Any]:
        """`flow.extrema`: both largest speeds, and for how long the inner one was there, beside
        the outer one, and faster than it; nothing where the surface never moved.
        """
        if self.peak["outer"].value == 0.0 and self.peak["inner"].value == 0.0:
            return {}
        extrema: dict[str, Any] = {}
        for name, peak in self.peak.items():
            extrema[f"{name}_speed_max_m_s"] = peak.value
            extrema[f"{name}_speed_max_at_s"] = time_of(peak)
        for name, span in self.span.items():
            extrema[f"{name}_start_s"], extrema[f"{name}_end_s"] = span.first, span.last
            extrema[f"{name}_lasted_s"] = self.lasted[name]
        return {"flow": {"extrema": extrema}}

    def state(self) -> dict[str, Any]:
        """What `restore` needs."""
        return {
            "peak": {name: peak.state() for name, peak in self.peak.items()},
            "span": {name: span.state() for name, span in self.span.items()},
            "lasted": dict(self.lasted),
            "last_place": dict(self.last_place),
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Continue from a state."""
        self.peak = {name: Peak(**values) for name, values in state["peak"].items()}
        self.span = {name: Span(**values) for name, values in state["span"].items()}
        self.lasted, self.last_place = dict(state["lasted"]), dict(state["last_place"])


def surface_extrema(view: View) -> list[Place]:
    """The one or two largest maxima of |u| along the surface at x > 0, in order of x."""
    flow = flow_of(view)
    x = view.position[0, flow.surface]
    chosen = flow.flows[flow.surface] & (x > 0.0)
    if np.count_nonzero(chosen) < 3:
        return []
    speed = np.concatenate([[0.0], np.abs(flow.surface_velocity[chosen]), [0.0]])
    place = np.concatenate([[0.0], x[chosen], [0.0]])
    found, rise = local_maxima(speed, PROMINENCE * float(np.max(speed)))
    most = np.sort(found[np.argsort(-rise, kind="stable")[:2]])
    return [(float(speed[k]), float(place[k])) for k in most]


def local_maxima(values: np.ndarray, least: float) -> tuple[np.ndarray, np.ndarray]:
    """Places of the local maxima that rise at least `least` above their valleys, and their rise.

    Args:
        values: (n,), not below zero, zero at both ends. least: above zero finds no noise.
    """
    from scipy.signal import find_peaks

    if float(np.max(values)) <= 0.0:
        return np.zeros(0, dtype=np.int64), np.zeros(0)
    found, properties = find_peaks(values, prominence=max(least, 1e-300))
    return found, properties["prominences"]
