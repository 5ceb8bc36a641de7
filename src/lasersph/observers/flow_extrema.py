"""Inner and outer extrema of the surface velocity, told apart in time [Demuth2020, Fig. 7].

The surface flows away from the maximum of the light (x = 0). Its speed |u(x)| has one maximum on
each side, the outer one, from the onset of the flow. When a zone at the vaporization temperature
shrinks, the steep gradient at its edge can raise a second maximum there, the inner one, which may
outgrow the outer one and outlive the zone.

A maximum counts where it rises above the lowest speed between itself and a larger one by a
twentieth of the largest speed of the profile; of more than two, the two that rise most count. Once
the zone shrinks, a line tells the names: inside of it a maximum is inner, outside it is outer. The
line lies half way between the last place of the outer maximum and the edge of the zone, or the last
place of the inner one if that is further out. Before, and without a zone and an inner one, all are
outer. When the zone is gone, the inner one keeps its name until the outer one is alone. Of two on a
side counts the larger one inside and the one that continues the last outer one outside (the larger
one, where none is known).

Until the zone shrinks the pool spreads, the temperature bends in the mush before it and the speed
with it: no maximum within some spacings of the edge of the liquid counts. The place of a maximum is
the center of its top, all on its side of the line that lies less than that twentieth below it:
where maxima that do not count by themselves take turns in being the highest, the place of the
highest jumps between them, as from 0.9 of the width of a pool to its middle. Seen is the side
x > 0; a run over a full period is symmetric, which a law of its own checks. In 3-D it is the line
y = 0 on that side, through the middle of a dot.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from lasersph.observers.flow_speed import flow_of
from lasersph.observers.observer import Observer, Row
from lasersph.observers.peak import Span
from lasersph.observers.quantity import Quantity
from lasersph.observers.surface_fields import SurfaceLine, line_along_x
from lasersph.observers.view import View

PROMINENCE = 0.05
"""Least rise of an extremum over the valley beside it, as a part of the largest speed."""

EDGE = 4.0
"""Spacings from the edge of the liquid within which no extremum counts while the pool spreads."""
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
    note = "On the side x > 0, in 3-D at y = 0; 0 where one does not exist."
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
    kept = ("span", "lasted", "last_place", "widest")

    def __init__(self) -> None:
        super().__init__()
        self.span = {name: Span() for name in STATES}
        self.lasted = dict.fromkeys(STATES, 0.0)
        self.last_place: dict[str, float] = {}
        self.widest = 0.0

    def observe(self, view: View) -> Row:
        """Speed [m/s] and place [m] of both extrema; 0 where one does not exist."""
        surface, spacing = line_along_x(view), spacing_at(view)
        edge = zone_edge(surface, spacing, view.vaporization)
        self.widest = max(self.widest, edge)
        # a particle less at its edge, not its motion with the flow
        shrinks = edge < self.widest - 0.5 * float(np.min(view.width))
        line = self._line(edge) if shrinks else 0.0
        margin = 0.0 if shrinks else EDGE * spacing
        found = self._by_name(surface_extrema(surface, margin, line), line)
        # a maximum that does not count for a while goes on, but not the inner one without a zone
        lasting = self.last_place if edge > 0.0 or "inner" in found else {}
        self.last_place = lasting | {name: x for name, (_, x) in found.items()}
        if not self.last_place:
            self.widest = 0.0
        outer, inner = found.get("outer", (0.0, 0.0)), found.get("inner", (0.0, 0.0))
        # how long each state lasted: steps in which it holds
        both = len(found) == 2
        for name, holds in zip(
            STATES, ("inner" in found, both, both and inner[0] > outer[0]), strict=True
        ):
            self.span[name].update(holds, view.time)
            self.lasted[name] += view.time_step if holds else 0.0
        return self.record(view.time, (*outer, *inner))

    def _line(self, edge: float) -> float:
        """Place of the line inside of which an extremum is inner [m]; 0: none can be.

        Args:
            edge: of the zone at the vaporization temperature [m]; 0 where there is none.
        """
        inside = max(edge, self.last_place.get("inner", 0.0))
        outer = self.last_place.get("outer", 0.0)
        # halfway between both extrema, once both have been seen
        return 0.5 * (inside + outer) if inside > 0.0 and outer > 0.0 else 0.0

    def _by_name(self, extrema: list[Place], line: float) -> dict[str, Place]:
        """At most one extremum on each side of the line, by name."""
        # largest inner extremum; outer one as the last place tells
        inner = [place for place in extrema if place[1] < line]
        outer = [place for place in extrema if place[1] >= line]
        last = self.last_place.get("outer")
        found = {"inner": max(inner)} if inner else {}
        if outer:
            # the one that goes on with the outer one; the larger, where none is known
            found["outer"] = (
                max(outer) if last is None else min(outer, key=lambda place: abs(place[1] - last))
            )
        return found

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


def zone_edge(surface: SurfaceLine, spacing: float, vaporization: float | None) -> float:
    """Outer edge at x > 0 of the surface at the vaporization temperature [m]; 0 where none is.

    Args:
        spacing: of the particles along x [m]. vaporization: temperature [K], None where there is
            none.
    """
    if vaporization is None:
        return 0.0
    # cells at the boiling point, but for rounding
    boils = surface.temperature >= vaporization * NEARLY
    if not np.any(boils):
        return 0.0
    return max(float(np.max(surface.x[boils])) + 0.5 * spacing, 0.0)


def spacing_at(view: View) -> float:
    """Spacing of the particles at the surface along x [m]."""
    return float(view.width[0, flow_of(view).surface[0]])


def surface_extrema(surface: SurfaceLine, margin: float = 0.0, line: float = 0.0) -> list[Place]:
    """The one or two largest maxima of |u| along the surface at x > 0, in order of x.

    Args:
        margin: distance from the edge of the liquid within which none counts [m].
        line: place that no top crosses [m].
    """
    # half of the surface at x > 0, closed by zeros at both ends
    chosen = surface.flows & (surface.x > 0.0)
    if np.count_nonzero(chosen) < 3:
        return []
    speed = np.concatenate([[0.0], surface.speed[chosen], [0.0]])
    place = np.concatenate([[0.0], surface.x[chosen], [0.0]])
    # peaks that stand out, and their places by the weight of their tops
    least = PROMINENCE * float(np.max(speed))
    found, rise = local_maxima(speed, least)
    center = centers_of_tops(place, speed, found, least, line)
    edge = float(np.max(place)) - margin
    inside = np.flatnonzero(place[found] <= edge)
    # the two that stand out most, in order of x
    most = np.sort(inside[np.argsort(-rise[inside], kind="stable")[:2]])
    return [(float(speed[found[k]]), float(center[k])) for k in most]


def centers_of_tops(
    place: np.ndarray, speed: np.ndarray, peaks: np.ndarray, least: float, line: float = 0.0
) -> np.ndarray:
    """Centers of what rises above speed[peak] - least, weighted by how far, for each peak [m].

    A top reaches to the lowest speeds between its peak and the next ones, and not across the line.

    Args:
        place, speed: (n,) [m], [m/s]; speeds are zero at both ends. peaks: (m,) their numbers.
        line: place [m].
    """
    # each peak has the part between the valleys at its sides, on one side of the line
    valleys = [a + int(np.argmin(speed[a:b])) for a, b in pairwise(peaks)]
    ends = [0, *valleys, speed.size]
    centers = np.zeros(peaks.size)
    for k, peak in enumerate(peaks):
        top = slice(ends[k], ends[k + 1])
        weights = np.maximum(speed[top] - speed[peak] + least, 0.0)
        weights *= (place[top] < line) == (place[peak] < line)
        centers[k] = np.average(place[top], weights=weights)
    return centers


def local_maxima(values: np.ndarray, least: float) -> tuple[np.ndarray, np.ndarray]:
    """Places of the local maxima that rise at least `least` above their valleys, and their rise.

    Args:
        values: (n,), not below zero, zero at both ends. least: above zero finds no noise.
    """
    # runs of equal values that are higher than both runs beside them; each stands in its middle
    starts = np.append(0, np.flatnonzero(np.diff(values)) + 1)
    ends = np.append(starts[1:], values.size) - 1
    level = values[starts]
    is_top = (level[1:-1] > level[:-2]) & (level[1:-1] > level[2:])
    found = (starts[1:-1][is_top] + ends[1:-1][is_top]) // 2
    # a maximum rises above the higher one of the valleys at its sides
    valleys = [max(valley(values[k::-1]), valley(values[k:])) for k in found]
    rise = values[found] - np.array(valleys, dtype=values.dtype)
    counts = rise >= max(least, 1e-300)
    return found[counts], rise[counts]


def valley(values: np.ndarray) -> float:
    """Lowest of the values (n,) from the first one to the next that is higher, if any is."""
    higher = values > values[0]
    return float(np.min(values[: np.argmax(higher)] if np.any(higher) else values))
