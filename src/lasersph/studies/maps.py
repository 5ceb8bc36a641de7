"""Process maps: a number of many runs over one or two keys, and where metal melts, boils, ablates.

Between runs the number is interpolated: along the lines of a grid, over triangles of scattered
runs (Delaunay), both linearly in the keys or their logarithms, or by an emulator. Nothing is drawn
outside the runs' hull, nor across a run without a result.

Where metal melts, boils or is ablated is told between the runs with its band: `event_lines`.
"""

from __future__ import annotations

from os import PathLike

import numpy as np
from numpy.typing import NDArray

from lasersph.input import did_you_mean, format_quantity
from lasersph.input.key_units import unit_in, unit_of
from lasersph.observers.observer_list import RESULTS
from lasersph.output.older_results import images_of_older, is_amount
from lasersph.plots.process_map import MapAxis, ProcessMap
from lasersph.studies.emulator import box_of
from lasersph.studies.event_lines import events_of, one_sided_notes, onsets_of
from lasersph.studies.run_places import RunPlaces
from lasersph.studies.sweep_numbers import box_of_runs, numerical_deviation, sizes_of
from lasersph.sweeps import Table
from lasersph.sweeps.folder import RUNS

Array = NDArray[np.float64]
LEAST_RUNS = 3
SHOWN = "melt.depth_half_max_m"
OLDER = (
    "are by an earlier version, which gave amounts of the part that it computed; they are shown as"
    " those of the whole"
)
TOLERANCE = 0.05
"""Share of the largest value above which an emulator's standard deviation is hatched."""


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
    """The map of a sweep: a number over one or two of its keys.

        found = lasersph.map("runs/sweep", show="melt.depth_half_max_m", target=200e-9)
        found.field, found.lines["melts"]       # SI; see `plots.process_map.ProcessMap`
        lasersph.plots.draw_process_map(found)  # a figure

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
    _refuse_too_few(keys, points, good, show)
    # the number over the keys as the runs lie, heat over their logarithms
    box = box_of_runs(points)
    layout = RunPlaces(box, points)
    powers = RunPlaces(box_of(box.low, box.high, box.low > 0.0), points)
    field, deviation = layout.interpolate(values), None
    if emulate:
        field, deviation = layout.emulate(values, numerical_deviation(table, show))
        if np.nanmin(values) >= 0.0:  # no size of a pool below zero where it vanishes
            field = np.maximum(field, 0.0)
    # lines of the events with their bands, and of the target
    events = events_of(table, powers)
    lines = {one.name: powers.lines(one.heat) for one in events}
    bands = {one.name: powers.area(one.ambiguity(powers.interpolate)) for one in events}
    if target is not None:
        lines["target"] = layout.contour(field, target)
    # unit by the dimension of the runs; what is missing in words
    known, units = RESULTS.get(show), table.shown_units()
    unit = unit_in(known.unit, table.amount_dimension) if known else unit_of(show)
    notes = [*one_sided_notes(table, keys), *_notes_on_runs(table, show, good)]
    if target is not None and not lines["target"]:
        notes.append(f"{format_quantity(target, unit)} lies nowhere between the runs.")
    return ProcessMap(
        axes=tuple(
            MapAxis(key, table.units[key], grid, bool(bent), units[key])
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
        bands={name: found for name, found in bands.items() if found},
        onsets=tuple(onset for one in events for onset in onsets_of(one, powers)),
        target=target,
        notes=tuple(notes),
    )


def _refuse_too_few(keys: list[str], points: Array, good: NDArray[np.bool_], show: str) -> None:
    """Raise ValueError where the runs with a result, of points (runs, keys), span no map."""
    if good.sum() < max(LEAST_RUNS, len(keys) + 1):
        raise ValueError(f"only {good.sum()} of {good.size} runs have {show}; a map needs more")
    for key, column in zip(keys, points[good].T, strict=True):
        if np.ptp(column) == 0.0:
            raise ValueError(f"{key} is {column[0]:g} in every run with a result")


def _notes_on_runs(table: Table, show: str, good: NDArray[np.bool_]) -> list[str]:
    """Runs without a result, and those of an earlier version, in words."""
    notes, lost = [], int((~good).sum())
    if lost > 0:
        has = "has" if lost == 1 else "have"
        notes.append(f"{lost} of {good.size} runs {has} no result: nothing is interpolated there.")
    if is_amount(show) and (older := count_of_older(table)):
        notes.append(f"{older} of {good.size} runs {OLDER}.")
    return notes


def count_of_older(table: Table) -> int:
    """How many complete runs gave amounts of the computed part, which are multiplied as read."""
    folders = (table.path / RUNS / row.run for row in table.rows if row.status == "complete")
    return sum(images_of_older(folder) > 1 for folder in folders)


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
    others = [key for key in table.varied if key not in given]
    if len(given) + len(others) > 2:
        raise ValueError(
            f"{len(table.varied)} keys vary in {table.path} ({', '.join(table.varied)}) and a map "
            "shows two: make a sweep of two, or see lasersph sensitivity"
        )
    return [*others, *given] if x is None else [*given, *others]
