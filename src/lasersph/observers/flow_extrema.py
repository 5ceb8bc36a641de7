"""Inner and outer extrema of the surface velocity, told apart in time [Demuth2020, Fig. 7].

The surface flows away from the maximum of the light (x = 0). Its speed |u(x)| has one maximum on
each side, the outer one, from the onset of the flow. When a zone at the vaporization temperature
shrinks, the steep gradient at its edge can raise a second maximum closer to x = 0, the inner one.

A maximum counts where it rises above the lowest speed between itself and a larger one by a
twentieth of the largest speed of the profile; of more than two, the two that rise most count. An
inner one appears after the surface has been at the vaporization temperature, and closer to x = 0
than the outer one that it joins. Until then the pool spreads, the temperature bends in the mush
before it and the speed with it: no maximum within some spacings of the edge counts. Of two that do
not fit this the one that continues the outer one counts alone (the larger one, where none is
known). A single one keeps the name of the one it continues: that whose last place is closer. A
first single one is outer. Its place is the center of its top, all that lies less than that
twentieth below it: where maxima that do not count by themselves take turns in being the highest,
the place of the highest jumps between them, as from 0.9 of the width of a pool to its middle. Seen
is the side x > 0; a run over a full period is symmetric, which a law of its own checks.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from lasersph.observers.flow_speed import flow_of
from lasersph.observers.observer import Observer, Row
from lasersph.observers.peak import Span
from lasersph.observers.quantity import Quantity
from lasersph.observers.view import View

PROMINENCE = 0.05
"""Least rise of an extremum over the valley beside it, as a part of the largest speed."""

EDGE = 4.0
"""Spacings from the edge of the liquid within which no extremum counts at first."""
NEARLY = 1.0 - 1e-9
"""Of the vaporization temperature: at it, but for rounding."""
STATES = {
    "inner": "an inner extremum",
    "coexist": "both extrema",
    "inner_exceeds": "both, the inner one faster",
}

Place = tuple[float, float]
"""Speed [m/s] and x [m] of an extremum."""


class FlowExtrema(Observer):
    """Observes the inner and the outer extremum of the speed at the surface."""

    title = "extrema of the surface speed"
    note = "On the side x > 0; 0 where one does not exist."
    columns = tuple(
        one
        for name in ("outer", "inner")
        for one in (
            Quantity(
                f"flow_{name}_speed_m_s",
                "m/s",
                f"speed of the {name} extremum of the surface",
                largest=f"flow.extrema.{name}_speed_max_m_s",
            ),
            Quantity(f"flow_{name}_x_m", "m", f"place of the {name} extremum"),
        )
    )
    results = tuple(
        Quantity(f"flow.extrema.{name}_{key}_s", "s", f"{text}: {words}")
        for name, text in STATES.items()
        for key, words in (("start", "first"), ("end", "last"), ("lasted", "in all"))
    )
    kept = ("span", "lasted", "last_place", "has_boiled")

    def __init__(self) -> None:
        super().__init__()
        self.span = {name: Span() for name in STATES}
        self.lasted = dict.fromkeys(STATES, 0.0)
        self.last_place: dict[str, float] = {}
        self.has_boiled = False

    def observe(self, view: View) -> Row:
        """Speed [m/s] and place [m] of both extrema; 0 where one does not exist."""
        if view.vaporization is not None:
            hottest = float(np.max(view.temperature[view.surface]))
            self.has_boiled |= hottest >= view.vaporization * NEARLY
        found = self._by_name(surface_extrema(view, 0.0 if self.has_boiled else EDGE))
        self.last_place = {name: x for name, (_, x) in found.items()}
        outer, inner = found.get("outer", (0.0, 0.0)), found.get("inner", (0.0, 0.0))
        both = len(found) == 2
        for name, holds in zip(
            STATES, ("inner" in found, both, both and inner[0] > outer[0]), strict=True
        ):
            self.span[name].update(holds, view.time)
            self.lasted[name] += view.time_step if holds else 0.0
        return self.record(view.time, (*outer, *inner))

    def _by_name(self, extrema: list[Place]) -> dict[str, Place]:
        """Extrema in order of x, one or two, by name."""
        if not extrema:
            return {}
        if len(extrema) == 2:
            # of two, the one that goes on with the outer one; the larger, where none is known
            one = max(extrema)
            if "outer" in self.last_place:
                one = min(extrema, key=lambda place: abs(place[1] - self.last_place["outer"]))
            is_closer = one is extrema[1] or "outer" not in self.last_place
            if "inner" in self.last_place or (self.has_boiled and is_closer):
                return {"inner": extrema[0], "outer": extrema[1]}
            return {"outer": one}
        x = extrema[0][1]
        apart = {name: abs(place - x) for name, place in self.last_place.items()}
        name = min(apart, key=lambda known: apart[known]) if apart else "outer"
        return {name: extrema[0]}

    def values(self) -> dict[str, object]:
        """For how long the inner one was there, beside the outer one, and faster than that."""
        found: dict[str, object] = {}
        for name, span in self.span.items():
            stem = f"flow.extrema.{name}"
            found |= {f"{stem}_start_s": span.first, f"{stem}_end_s": span.last}
            found[f"{stem}_lasted_s"] = self.lasted[name]
        return found

    def summary(self) -> dict[str, object]:
        """Nothing where the surface never moved."""
        return super().summary() if any(peak.value for peak in self.peak.values()) else {}


def surface_extrema(view: View, margin: float = 0.0) -> list[Place]:
    """The one or two largest maxima of |u| along the surface at x > 0, in order of x.

    Args:
        margin: spacings from the edge of the liquid within which none counts.
    """
    flow = flow_of(view)
    x = view.position[0, flow.surface]
    chosen = flow.flows[flow.surface] & (x > 0.0)
    if np.count_nonzero(chosen) < 3:
        return []
    speed = np.concatenate([[0.0], np.abs(flow.surface_velocity[chosen]), [0.0]])
    place = np.concatenate([[0.0], x[chosen], [0.0]])
    least = PROMINENCE * float(np.max(speed))
    found, rise = local_maxima(speed, least)
    center = centers_of_tops(place, speed, found, least)
    edge = float(np.max(place)) - margin * float(view.width[0, flow.surface[0]])
    inside = np.flatnonzero(place[found] <= edge)
    most = np.sort(inside[np.argsort(-rise[inside], kind="stable")[:2]])
    return [(float(speed[found[k]]), float(center[k])) for k in most]


def centers_of_tops(
    place: np.ndarray, speed: np.ndarray, peaks: np.ndarray, least: float
) -> np.ndarray:
    """Centers of what rises above speed[peak] - least, weighted by how far, for each peak [m].

    A top reaches to the lowest speeds between its peak and the next ones.

    Args:
        place, speed: (n,) [m], [m/s]; speeds are zero at both ends. peaks: (m,) their numbers.
    """
    valleys = [a + int(np.argmin(speed[a:b])) for a, b in pairwise(peaks)]
    ends = [0, *valleys, speed.size]
    centers = np.zeros(peaks.size)
    for k, peak in enumerate(peaks):
        top = slice(ends[k], ends[k + 1])
        weights = np.maximum(speed[top] - speed[peak] + least, 0.0)
        centers[k] = np.average(place[top], weights=weights)
    return centers


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
