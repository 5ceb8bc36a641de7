"""Where metal melts, boils or is ablated between the runs of a process map, and how surely.

Sizes in whole cells jump; where melting begins they say only to a cell. The lines of melting and
boiling interpolate a number that does not jump, the highest temperature of each run, as its heat

    w = ln [E(T_max) / E(T_event)],   E(T) = int sqrt(k rho c_p) dT   from the initial temperature,

linearly over the logarithms of the keys. E is the effusivity times the rise of temperature: the
surface of a half-space reaches it in proportion to the flux and to the root of the time
[Carslaw1959, 2.9], which holds nearly for properties that change. The latent heat is left out, of
which the thin layer that melts first takes little.

Between two runs whose heat is known the line is as sure as the way of interpolating: its band is
where the heat is no farther from zero than

    d = ln <E / E_event> - <w>,   <> the linear interpolation,

by which the rise interpolated itself differs from its logarithm interpolated. A run that boils
has a temperature that rests at the boiling point, and says only that it is hotter. The band then
reaches from the last run without the event to the first with it; the line within it is what colder
runs extrapolate to, where there are enough of them, and is missing elsewhere. A run whose hottest
metal rests at a melting point, half molten, says only that it is not yet fluid: the band reaches
from it to the first run that melts, without a line. Ablation has a band between runs and no line.

[Carslaw1959] Carslaw, Jaeger, Conduction of Heat in Solids, Oxford (1959).
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lasersph.input import in_field_units
from lasersph.materials import Material
from lasersph.output import open_run
from lasersph.plots.process_map import EVENTS, Onset
from lasersph.studies.emulator import box_of
from lasersph.studies.run_places import RunPlaces
from lasersph.studies.sweep_numbers import numbers_of
from lasersph.sweeps import Table
from lasersph.sweeps.folder import RUNS

Array = NDArray[np.float64]
HELD = 1e-9
"""Relative distance from the melting or boiling point at which a temperature rests there:
rounding."""
ROUNDING = 1e-6
"""Of relative rises, far below a kelvin: it decides on no side of a line."""
COLDEST = -7.0
"""ln of a thousandth: a run that is hardly heated at all."""
UNKNOWN = 1e6
"""Heat of a run of which only the side is known: a line may pass right beside its colder
neighbor."""
STEPS = 401
"""Places between two runs at which an onset is looked for: a four hundredth of their distance."""


@dataclass(frozen=True, eq=False)
class Event:
    """An event in the runs of a map.

    Attributes:
        name: "melts", "boils" or "ablates". happened: in which runs (runs,).
        heat: passes zero where the event begins; NaN in a run without a result or of which only
            the side is known (runs,). low, high: what it is at least and at most (runs,).
    """

    name: str
    happened: NDArray[np.bool_]
    heat: Array
    low: Array
    high: Array

    def bounds(self, interpolate: Callable[[Array], Array]) -> tuple[Array, Array]:
        """Least and largest heat at places between the runs."""
        exists = np.where(np.isfinite(self.low), 0.0, np.nan)
        # a place among runs of one side is on that side, whatever is interpolated
        least = interpolate(np.where(self.happened, ROUNDING, -UNKNOWN) + exists)
        largest = interpolate(np.where(self.happened, UNKNOWN, -ROUNDING) + exists)
        # d: how far two ways of interpolating differ
        measured = np.clip(self.low, COLDEST, -COLDEST)
        apart = np.log(interpolate(np.exp(measured))) - interpolate(measured)
        low = np.maximum(interpolate(self.low) - apart, least)
        return low, np.minimum(interpolate(self.high) + apart, largest)

    def ambiguity(self, interpolate: Callable[[Array], Array]) -> Array:
        """Positive at places between the runs where the event may have happened or not."""
        low, high = self.bounds(interpolate)
        return np.minimum(high, -low)


def events_of(table: Table, layout: RunPlaces) -> list[Event]:
    """The events that some run has and some has not."""
    return [
        _event(table, layout, name, happened)
        for name, happened in _outcomes(table).items()
        if len(set(happened[table.is_complete])) == 2
    ]


def one_sided_notes(table: Table, keys: list[str]) -> list[str]:
    """Of each event that every run has, or none, which runs would tell where it begins."""
    complete, notes = table.is_complete, []
    for name, happened in _outcomes(table).items():
        # a metal without boiling point, and a solver without ejection, cannot tell
        is_possible = {
            "melts": True,
            "boils": np.any(np.isfinite(numbers_of(table, "material.vaporization_K"))),
            "ablates": np.any(np.isfinite(numbers_of(table, "ejecta.count"))),
        }[name]
        if not is_possible or len(set(happened[complete])) != 1:
            continue
        does = bool(happened[complete][0])
        where_to = _heating_end(table, keys, colder=does)
        who, which = ("Every", "colder") if does else ("No", "hotter")
        where = f"{which} runs{where_to} would tell where {EVENTS[name]} begins"
        notes.append(f"{who} run {name}: {where}.")
    return notes


def onsets_of(event: Event, layout: RunPlaces) -> Iterator[Onset]:
    """Where an event begins along the first key: on each line of a grid, or over a single key."""
    for runs in layout.rows():
        at = float(layout.points[runs[0], 1]) if layout.points.shape[1] == 2 else None
        # runs with a result, in the order of the first key
        known = runs[np.isfinite(event.low[runs])]
        if known.size == 0:
            continue
        places, happened = layout.points[known, 0], event.happened[known]
        # neighbors of which one has the event
        changes = np.flatnonzero((happened[1:] != happened[:-1]) & (np.diff(places) > 0.0))
        if changes.size == 0:
            ends = float(places[0]), float(places[-1])
            yield Onset(event.name, at, ends, "every" if happened[0] else "none")
        for k in changes:
            yield _onset_between(event, at, known[k : k + 2], places[k : k + 2])


def _onset_between(event: Event, at: float | None, pair: NDArray[np.int_], ends: Array) -> Onset:
    """Where an event begins between two neighboring runs."""
    # places between the two runs, evenly in the logarithm of a positive key
    share = np.linspace(0.0, 1.0, STEPS)
    places = box_of(ends[:1], ends[1:], ends[:1] > 0.0).restored(share[:, None])[:, 0]
    places[[0, -1]] = ends

    def interpolate(values: Array) -> Array:
        return (1.0 - share) * values[pair[0]] + share * values[pair[1]]

    # the band, and the zero of the heat within it
    inside = np.flatnonzero(event.ambiguity(interpolate) > 0.0)
    heat = event.heat[pair]
    line = heat[0] / (heat[0] - heat[1])
    estimate = float(np.interp(line, share, places)) if np.isfinite(line) else None
    if inside.size == 0:  # narrower than a step
        inside = np.array([np.searchsorted(share, line)])
    first, last = max(inside[0] - 1, 0), min(inside[-1] + 1, STEPS - 1)
    between = float(places[first]), float(places[last])
    is_measured = first > 1 and last < STEPS - 2
    return Onset(event.name, at, between, "measured" if is_measured else "bracket", estimate)


def _outcomes(table: Table) -> dict[str, NDArray[np.bool_]]:
    """Which runs melt completely somewhere, reach the boiling point, eject matter (runs,)."""
    boiling_point = numbers_of(table, "material.vaporization_K")
    return {
        "melts": np.isfinite(numbers_of(table, "melt.start_s")),
        "boils": numbers_of(table, "temperature_max_K") >= boiling_point * (1.0 - HELD),
        "ablates": numbers_of(table, "ejecta.count") > 0.0,
    }


def _event(table: Table, layout: RunPlaces, name: str, happened: NDArray[np.bool_]) -> Event:
    """An event with what the runs tell of its heat."""
    # without a temperature a run says only on which side it is
    exists = np.where(table.is_complete, 0.0, np.nan)
    low = np.where(happened, ROUNDING, -UNKNOWN) + exists
    high = np.where(happened, UNKNOWN, -ROUNDING) + exists
    if name == "ablates":
        return Event(name, happened, np.full(low.shape, np.nan), low, high)
    # heat from the highest temperature, on the side that the outcome says
    hottest = numbers_of(table, "temperature_max_K")
    heat = _relative_rises(table, hottest)[list(EVENTS).index(name)]
    heat = np.where(happened, np.maximum(heat, ROUNDING), np.minimum(heat, -ROUNDING))
    # a temperature that rests at the boiling point is a lower limit
    is_held = _outcomes(table)["boils"]
    # one that rests at the melting point, where metal is not yet fluid, says no more than that
    if name == "melts":
        is_melting = ~happened & (
            hottest >= numbers_of(table, "material.liquidus_K") * (1.0 - HELD)
        )
        heat = np.where(is_melting, np.nan, heat)
    low = np.where(np.isfinite(heat), heat, low)
    high = np.where(is_held | np.isnan(heat), high, heat)
    return Event(name, happened, _raised(heat, is_held, layout), low, high)


def _relative_rises(table: Table, hottest: Array) -> Array:
    """ln(E / E_event) of the hottest spot of each run, for melting and for boiling (2, runs); NaN
    without a result or such an event."""
    scales: dict[str, tuple[Array, Array, Array]] = {}
    found = np.full((2, len(table.rows)), np.nan)
    for k, row in enumerate(table.rows):
        if row.status != "complete":
            continue
        # E(T) of each metal and initial temperature, once
        case: dict[str, Any] = open_run(table.path / RUNS / row.run).resolved["case"]
        text = json.dumps([case["material"], case["initial_temperature"]])
        if text not in scales:
            metal = Material.model_validate(case["material"])
            curve = metal.caloric_curve(case["initial_temperature"], "evaporate")
            latent = curve.latent_heats[0] * curve.melt_fraction
            # between nodes k and c_p are constant: sqrt(k c_p) dT = sqrt(dP dh); rho cancels
            steps = np.sqrt(np.diff(curve.potential) * np.diff(curve.enthalpy - latent).clip(0.0))
            rise = np.concatenate([[0.0], np.cumsum(steps)])
            boiling = metal.vaporization and metal.vaporization.temperature
            events = np.array([metal.liquidus or np.nan, boiling or np.nan])
            scales[text] = curve.temperature, rise, np.interp(events, curve.temperature, rise)
        temperature, rise, events = scales[text]
        with np.errstate(divide="ignore"):  # a run that is not heated at all
            found[:, k] = np.log(np.interp(hottest[k], temperature, rise) / events)
    return np.maximum(found, COLDEST)


def _raised(heat: Array, is_held: NDArray[np.bool_], layout: RunPlaces) -> Array:
    """The heat of runs whose temperature rests at the boiling point, extrapolated from the colder
    runs and never lowered: a plane by least squares, weighted by the inverse square distance. NaN
    where the colder runs determine no plane."""
    colder = np.isfinite(heat) & ~is_held
    raised = np.where(is_held, np.nan, heat)
    # plane through the colder runs about run k: its value there is the heat
    for k in np.flatnonzero(is_held):
        steps = layout.x[colder] - layout.x[k]
        weight = 1.0 / np.linalg.norm(steps, axis=1, keepdims=True)
        plane = np.hstack([np.ones((len(steps), 1)), steps]) * weight
        solution, _, rank, _ = np.linalg.lstsq(plane, heat[colder] * weight[:, 0], rcond=None)
        if rank == plane.shape[1]:
            raised[k] = max(heat[k], solution[0])
    return raised


def _heating_end(table: Table, keys: list[str], *, colder: bool) -> str:
    """End of the key that heats most, beyond which runs are colder or hotter, in brackets;
    empty where the temperatures do not tell."""
    points = np.stack([table.values(key) for key in keys], axis=1)
    hottest = numbers_of(table, "temperature_max_K")
    known = np.isfinite(hottest)
    # ends of what was computed: runs to come, or that failed, tell nothing
    low, high = points[known].min(axis=0), points[known].max(axis=0)
    # plane through the highest temperatures: its steepest key heats most
    share = (points[known] - low) / np.where(high > low, high - low, 1.0)
    plane = np.hstack([np.ones((known.sum(), 1)), share])
    slopes = np.linalg.lstsq(plane, hottest[known], rcond=None)[0][1:]
    k = int(np.argmax(np.abs(slopes)))
    if np.ptp(hottest[known]) <= HELD * hottest[known].max():
        return ""
    is_below = (slopes[k] > 0.0) == colder
    end = in_field_units(float((low if is_below else high)[k]), table.units[keys[k]])
    return f" ({keys[k]} {'below' if is_below else 'above'} {end})"
