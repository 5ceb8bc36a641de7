"""Process maps: a number of many runs over one or two keys, and where metal melts, boils, ablates.

Between runs the number is interpolated: along the lines of a grid, over triangles of scattered
runs (Delaunay), both linearly in the keys or their logarithms, or by an emulator. Nothing is drawn
outside the runs' hull, nor across a run without a result.

Sizes in whole cells jump; where melting begins they say only to a cell. The lines of melting and
boiling interpolate what does not jump, the highest temperature of each run, on the scale

    ln [E(T_max) / E(T_event)],   E(T) = int sqrt(k rho c_p) dT   from the initial temperature,

linearly over the logarithms of the keys. E is the effusivity times the rise of temperature: the
surface of a half-space reaches it in proportion to the flux and to the root of the time
[Carslaw1959, 2.9], which holds nearly for properties that change. The latent heat is left out, of
which the thin layer that melts first takes little. Runs that boil, whose T_max rests at the boiling
point, are given what colder runs extrapolate to. The line of ablation lies halfway between runs
that eject matter and runs that do not.

[Carslaw1959] Carslaw, Jaeger, Conduction of Heat in Solids, Oxford (1959).
"""

from __future__ import annotations

import json
from os import PathLike
from typing import Any, cast

import numpy as np
from contourpy import contour_generator
from numpy.typing import NDArray
from scipy.interpolate import LinearNDInterpolator, RegularGridInterpolator
from scipy.spatial import Delaunay

from lasersph.input import did_you_mean, format_quantity
from lasersph.materials import Material
from lasersph.observers.observer_list import RESULTS
from lasersph.observers.quantity import unit_in
from lasersph.output import open_run
from lasersph.plots.process_map import MapAxis, ProcessMap
from lasersph.report.tables import unit_of
from lasersph.studies.emulator import Box, box_of, fit_emulator
from lasersph.studies.sweep_numbers import (
    box_of_runs,
    numbers_of,
    numerical_deviation,
    sizes_of,
)
from lasersph.sweeps import Table
from lasersph.sweeps.folder import RUNS

Array = NDArray[np.float64]
PLACES = {1: 401, 2: 161}
"""Places of the field along each axis of a map over one key and over two."""
LEAST_RUNS = 3
SHOWN = "melt.depth_half_max_m"
TOLERANCE = 0.05
"""Share of the largest value above which an emulator's standard deviation is hatched."""
HELD = 1e-9
"""Relative distance from the boiling point at which a temperature rests there: rounding."""
ROUNDING = 1e-6
"""Of relative rises, far below a kelvin: it decides on no side of a line."""
COLDEST = -7.0
"""ln of a thousandth: a run that is hardly heated at all."""


def process_map(
    runs: Table | str | PathLike[str],
    x: str | None = None,
    y: str | None = None,
    show: str = SHOWN,
    *,
    emulate: bool = False,
    target: float | None = None,
    tolerance: float = TOLERANCE,
) -> ProcessMap:
    """The map of a sweep.

    Args:
        runs: the table of a sweep, or its folder.
        x, y: keys to show; default: those that vary.
        show: number of the summaries. target: value of it whose line is wanted, SI.
        emulate: interpolate by a Gaussian process, with its standard deviation.
        tolerance: standard deviation over the largest value above which the figure hatches.

    Raises:
        ValueError: keys that do not vary, or more that do; too few runs with the number.
        KeyError: no run has the number. OutputError: no sweep there; scikit-learn is missing.
    """
    table = runs if isinstance(runs, Table) else Table.read(runs)
    keys = _chosen_keys(table, x, y)
    points = np.stack([table.values(key) for key in keys], axis=1)
    values = sizes_of(table, show)
    good = np.isfinite(values)
    if good.sum() < max(LEAST_RUNS, len(keys) + 1):
        raise ValueError(f"only {good.sum()} of {good.size} runs have {show}; a map needs more")
    for key, column in zip(keys, points[good].T, strict=True):
        if np.ptp(column) == 0.0:
            raise ValueError(f"{key} is {column[0]:g} in every run with a result")
    box = box_of_runs(points)
    layout = _Layout(box, points)
    powers = _Layout(box_of(box.low, box.high, box.low > 0.0), points)
    field, deviation = layout.interpolate(values), None
    if emulate:
        field, deviation = layout.emulate(values, numerical_deviation(table, show))
        if np.nanmin(values) >= 0.0:  # no size of a pool below zero where it vanishes
            field = np.maximum(field, 0.0)
    lines = {name: powers.lines(heat) for name, heat in _event_heats(table, powers)}
    if target is not None:
        lines["target"] = layout.contour(field, target)
    known, dimensions = RESULTS.get(show), int(np.nanmax(table.values("dimensions")))
    unit = unit_in(known.unit, dimensions) if known else unit_of(show)
    notes = []
    if (lost := int((~good).sum())) > 0:
        has = "has" if lost == 1 else "have"
        notes.append(f"{lost} of {good.size} runs {has} no result: nothing is interpolated there.")
    if target is not None and not lines["target"]:
        notes.append(f"{format_quantity(target, unit)} lies nowhere between the runs.")
    return ProcessMap(
        axes=tuple(
            MapAxis(key, table.units[key], grid, bool(bent))
            for key, grid, bent in zip(keys, layout.grids, box.logarithmic, strict=True)
        ),
        column=show,
        unit=unit,
        points=points,
        values=values,
        names=table.runs,
        status=table.status,
        reasons=tuple(row.reason for row in table.rows),
        field=field,
        deviation=deviation,
        allowed=tolerance * float(np.max(np.abs(values[good]))),
        lines={name: found for name, found in lines.items() if found},
        target=target,
        notes=tuple(notes),
    )


def _chosen_keys(table: Table, x: str | None, y: str | None) -> list[str]:
    """The keys of the map. Raises ValueError."""
    given = [key for key in (x, y) if key is not None]
    for key in given:
        if key not in table.varied:
            varied = ", ".join(table.varied)
            hint = did_you_mean(key, table.varied) or f"; what varies: {varied}"
            raise ValueError(f"{key} does not vary in {table.path}{hint}")
    if x is not None and x == y:
        raise ValueError(f"x and y are both {x}")
    rest = [key for key in table.varied if key not in given]
    if len(given) + len(rest) > 2:
        raise ValueError(
            f"{len(table.varied)} keys vary in {table.path} ({', '.join(table.varied)}) and a map "
            "shows two: make a sweep of two, or see lasersph sensitivity"
        )
    return [*rest, *given] if x is None else [*given, *rest]


class _Layout:
    """Where the runs of a map lie, how numbers are interpolated between them, and the places of
    the field."""

    def __init__(self, box: Box, points: Array) -> None:
        self.box, self.points = box, points
        self.x = box.scaled(points)
        keys = points.shape[1]
        shares = np.linspace(0.0, 1.0, PLACES[keys])
        self.shares = np.stack(np.meshgrid(*[shares] * keys, indexing="xy"), axis=-1)
        corner = box.restored(np.repeat(shares[:, None], keys, axis=1))
        self.grids = tuple(corner.T)

    def emulate(self, values: Array, noise: float) -> tuple[Array, Array]:
        """Mean and standard deviation of an emulator at the places where `interpolate` knows the
        number as well."""
        good, unknown = np.isfinite(values), np.isnan(self.interpolate(values))
        found = fit_emulator(self.points[good], values[good], box=self.box, noise=noise)
        places = self.box.restored(self.shares).reshape(-1, self.points.shape[1])
        mean, deviation = (one.reshape(unknown.shape) for one in found.predict(places))
        return np.where(unknown, np.nan, mean), np.where(unknown, np.nan, deviation)

    def interpolate(self, values: Array) -> Array:
        """A number of each run (runs,) at all places, linearly; NaN outside the runs and beside
        one without the number."""
        if self.x.shape[1] == 1:
            order = np.argsort(self.x[:, 0], kind="stable")
            return np.interp(self.shares[..., 0], self.x[order, 0], values[order])
        if (grid := self.grid_order()) is not None:
            (first, second), order = grid
            found = RegularGridInterpolator((first, second), values[order])
            return found(np.clip(self.shares, 0.0, 1.0))
        return LinearNDInterpolator(Delaunay(self.x), values)(self.shares)

    def grid_order(self) -> tuple[tuple[Array, Array], NDArray[np.int_]] | None:
        """Scaled lines of a grid and the run at each crossing; None where the runs are no grid."""
        lines = [np.unique(np.round(column, 9)) for column in self.x.T]
        if len(lines) != 2 or lines[0].size * lines[1].size != len(self.x):
            return None
        place = [
            np.searchsorted(one, np.round(c, 9)) for one, c in zip(lines, self.x.T, strict=True)
        ]
        order = np.full((lines[0].size, lines[1].size), -1)
        order[place[0], place[1]] = np.arange(len(self.x))
        return None if np.any(order < 0) else ((lines[0], lines[1]), order)

    def lines(self, values: Array) -> tuple[Array, ...]:
        """Where a number of each run passes zero."""
        return self.contour(self.interpolate(values), 0.0)

    def contour(self, field: Array, level: float) -> tuple[Array, ...]:
        """Where a field passes a level: lines (k, 2), or one array (k, 1) over a single key."""
        if field.ndim == 1:
            above = field > level
            known = np.isfinite(field[1:]) & np.isfinite(field[:-1])
            k = np.flatnonzero((above[1:] != above[:-1]) & known)
            share = (level - field[k]) / (field[k + 1] - field[k])
            places = (k + share) / (field.size - 1)
            return (self.box.restored(places[:, None]),) if k.size else ()
        step = np.linspace(0.0, 1.0, field.shape[0])
        found = contour_generator(step, step, np.ma.masked_invalid(field)).lines(level)
        return tuple(self.box.restored(line) for line in cast(list[Array], found))


def _event_heats(table: Table, layout: _Layout) -> list[tuple[str, Array]]:
    """Of each event that some run has and some has not: a number of each run (runs,) that passes
    zero where the event begins, NaN without a result."""
    complete = table.is_complete
    hottest = numbers_of(table, "temperature_max_K")
    boiling = hottest >= numbers_of(table, "material.vaporization_K") * (1.0 - HELD)
    has_happened = {
        "melts": np.isfinite(numbers_of(table, "melt.start_s")),
        "boils": boiling,
        "ablates": numbers_of(table, "ejecta.count") > 0.0,
    }
    found = []
    for place, (name, happened) in enumerate(has_happened.items()):
        if np.all(happened[complete]) or not np.any(happened[complete]):
            continue
        if name == "ablates":
            heat = np.where(complete, happened - 0.5, np.nan)
        else:
            heat = _relative_rises(table, hottest)[place]
            heat = np.where(happened, np.maximum(heat, ROUNDING), np.minimum(heat, -ROUNDING))
            heat = _raised(heat, boiling, layout)
        found.append((name, heat))
    return found


def _relative_rises(table: Table, hottest: Array) -> Array:
    """ln(E / E_event) of the hottest spot of each run, for melting and for boiling (2, runs); NaN
    without a result or such an event."""
    scales: dict[str, tuple[Array, Array, Array]] = {}
    found = np.full((2, len(table.rows)), np.nan)
    for k, row in enumerate(table.rows):
        if row.status != "complete":
            continue
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


def _raised(heat: Array, boiling: NDArray[np.bool_], layout: _Layout) -> Array:
    """The heat of runs whose temperature rests at the boiling point, extrapolated from the colder
    runs and never lowered: a plane by least squares, weighted by the inverse square distance."""
    colder = np.isfinite(heat) & ~boiling
    keys = layout.x.shape[1]
    raised = heat.copy()
    if colder.sum() < keys + 1:
        return raised
    for k in np.flatnonzero(boiling):
        steps = layout.x[colder] - layout.x[k]
        weight = 1.0 / np.linalg.norm(steps, axis=1, keepdims=True)
        plane = np.hstack([np.ones((len(steps), 1)), steps]) * weight
        guess = np.linalg.lstsq(plane, heat[colder] * weight[:, 0], rcond=None)[0][0]
        raised[k] = max(raised[k], guess)
    return raised
