"""Content of a sweep: a card in the list, and its page with table, map and calibration."""

from __future__ import annotations

import csv
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.observers.observer_list import RESULTS
from lasersph.output import OutputError
from lasersph.output.folder_lock import is_computing
from lasersph.output.reader import read_json
from lasersph.plots.calibration import unit_of_unknown
from lasersph.sweeps import Table
from lasersph.sweeps.folder import POINTS, read_points
from lasersph.sweeps.run_warnings import warnings_of_runs
from lasersph.web.folder_list import RESOLVED, Entry, FolderList, refuse_links
from lasersph.web.run_page import telling_damage
from lasersph.web.study_folder import study_table, study_title

CALIBRATION, POSTERIOR = "calibration.json", "posterior.csv"
BINS = 40
"""Of the histogram of an unknown that is not on a grid."""
MOST_LINES = 120
"""Values of an unknown that are taken for the lines of a grid."""
MAIN = ("melt.depth_half_max_m", "melt.depth_max_m", "crater.depth_m", "temperature_max_K")
"""Numbers that a table shows; the first that there is colors the points of a card and of a map."""
DIGITS = 4
"""Of the numbers of a map, finer than its colors."""


class Sweeps:
    """The sweeps of a folder; complete runs of theirs are not read again."""

    def __init__(self, folders: FolderList) -> None:
        self._folders = folders
        self._known: dict[Path, Table] = {}

    def card(self, entry: Entry) -> dict[str, Any]:
        """Card of a sweep in the list; where it cannot be read, why, in its own card alone."""
        head = {"id": entry.id, "name": entry.name, "kind": "sweep"}
        # A sweep that is damaged has a card that says so.
        try:
            with telling_damage(entry):
                table = self._table(entry)
                counts = _counts(entry, table)
                is_over = len(counts) == 1 and counts["complete"]
                return head | {
                    "title": _title(entry),
                    "state": "complete"
                    if is_over
                    else "running"
                    if counts["running"]
                    else "stopped",
                    "counts": {status: count for status, count in counts.items() if count},
                    "study": entry.study,
                    "spans": _spans(table),
                    "modified": _modified(entry),
                    "is_calibration": (entry.path / CALIBRATION).exists(),
                    "points": _points(table),
                }
        except OutputError as error:
            return head | {"state": "damaged", "error": str(error)}

    def details(self, entry: Entry) -> dict[str, Any]:
        """Rows, units and the answer of a calibration. Raises OutputError."""
        with telling_damage(entry):
            table = self._table(entry)
            rows = []
            # Rows of the table; what is computed now is asked of the folders.
            for row in table.rows:
                folder = entry.runs() / row.run
                is_there = (folder / RESOLVED).exists()
                is_running = row.status == "stopped" and is_computing(folder)
                rows.append(
                    {
                        "run": row.run,
                        "id": self._folders.run_of(folder) if is_there else "",
                        "status": "running" if is_running else row.status,
                        "settings": row.settings,
                        "numbers": _finite(row.numbers),
                        "reason": row.reason,
                    }
                )
            main = _main_numbers(table)
            columns = list(
                dict.fromkeys((*table.columns, *main))
            )  # whatever is shown can be chosen
            return {
                "id": entry.id,
                "name": entry.name,
                "title": _title(entry),
                "study": entry.study,
                "units": dict(table.units),
                "columns": columns,
                "main": main,
                "words": {key: RESULTS[key].words for key in columns if key in RESULTS},
                "counts": _counts(entry, table),
                "rows": rows,
                "warnings": _warnings(entry, table),
                "calibration": _calibration(entry.path),
            }

    def map(self, entry: Entry, keys: Sequence[str], column: str) -> dict[str, Any]:
        """Map of a number over keys as `lasersph map` draws it: axes, field between the runs, lines
        with their bands, and these in words.

        Where it cannot be drawn, `refused` says why. Raises OutputError.
        """
        from lasersph.studies.maps import process_map

        # A map is over the keys that vary, between runs that the library can interpolate.
        with telling_damage(entry):
            table = self._table(entry)
            if entry.study:
                return {"refused": "the runs of a study are points"}
            if set(keys) != set(table.varied):
                return {"refused": f"a map is over all that varies: {', '.join(table.varied)}"}
            try:
                shown = process_map(table, *keys, show=column)
            except (KeyError, ValueError) as error:
                return {"refused": str(error.args[0])}
            # Axes, field, lines and bands, rounded to what a screen shows.
            axes = [
                {"grid": _rounded(one.grid, 9), "is_logarithmic": one.is_logarithmic}
                for one in shown.axes
            ]
            lines, bands = (
                {name: [_rounded(part, 6) for part in parts] for name, parts in found.items()}
                for found in (shown.lines, shown.bands)
            )
            values = zip(shown.names, _rounded(shown.values, DIGITS), strict=True)
            return {
                "axes": axes,
                "values": dict(values),
                "field": _rounded(shown.field, DIGITS),
                "lines": lines,
                "bands": bands,
                "onsets": [f"{event}, {text}" for event, text in shown.onset_words()],
                "notes": list(shown.notes),
            }

    def _table(self, entry: Entry) -> Table:
        refuse_links(entry.path)
        read = study_table if entry.study else Table.read
        found = read(entry.path, self._known.get(entry.path))
        self._known[entry.path] = found
        return found


def _title(entry: Entry) -> str:
    """Title of a sweep; that of a calibration says so itself."""
    if entry.study:
        return study_title(entry.path)
    return str(read_points(entry.path).get("study", {}).get("title", entry.name))


def _warnings(entry: Entry, table: Table) -> list[dict[str, Any]]:
    """Each kind of warning of the runs of a sweep: `text`, of one of them, `runs` that have it."""
    if entry.study:
        return []
    _, counts = warnings_of_runs(table)
    return [{"text": text, "runs": count} for text, count in counts.items()]


def _counts(entry: Entry, table: Table) -> Counter[str]:
    """How many runs have a state; of those that are begun, what is computed now."""
    # Runs that are begun: some of them are computed now.
    begun = [row.run for row in table.rows if row.status == "stopped"]
    running = sum(is_computing(entry.runs() / run) for run in begun)
    counts = Counter[str](table.status)
    if running:
        counts += Counter({"running": running})
        counts -= Counter({"stopped": running})
    return counts


def _spans(table: Table) -> list[dict[str, Any]]:
    """Key that varies: `key`, SI `unit`, and the smallest and largest value, or the words."""
    spans = []
    for key, unit in table.units.items():
        values = list(dict.fromkeys(row.settings[key] for row in table.rows))
        numbers = [one for one in values if isinstance(one, int | float)]
        # Numbers have a range, words are listed.
        ends = [min(numbers), max(numbers)] if len(numbers) == len(values) > 0 else values
        spans.append({"key": key, "unit": unit, "ends": ends})
    return spans


def _modified(entry: Entry) -> float:
    """When a sweep or the newest run of a study was begun [s since 1970]."""
    if not entry.study:
        return (entry.path / POINTS).stat().st_mtime
    return max(file.stat().st_mtime for file in entry.path.glob(f"*/{RESOLVED}"))


def _main_numbers(table: Table) -> list[str]:
    """Those of `MAIN` that a run of the table has, or the first of its numbers."""
    known = {key for row in table.rows for key in row.numbers}
    return [key for key in MAIN if key in known] or list(table.columns[:1])


def _points(table: Table) -> list[list[float | None]]:
    """For each run its place among the others, 0 to 1, over one or two keys, and the first of the
    main numbers: x, y, color; None where it is not known. Empty where keys hold words."""
    # Up to two keys and the first main number.
    names = [*table.varied[:2], *_main_numbers(table)[:1]]
    try:
        columns = [table.values(name) for name in names]
    except (KeyError, ValueError):
        return []
    if len(columns) < 2 or not np.any(np.isfinite(columns[-1])):
        return []
    # Shares of the range of each; a key with one value has all at 0.
    columns = [columns[0], columns[1], columns[-1]]  # of one key the number itself goes up
    shares = [(one - np.nanmin(one)) / (np.nanmax(one) - np.nanmin(one) or 1.0) for one in columns]
    return _rounded(np.stack(shares, axis=1), DIGITS)


def _finite(numbers: Any) -> dict[str, float]:
    return {key: value for key, value in numbers.items() if np.isfinite(value)}


def _rounded(values: Any, digits: int) -> Any:
    """Nested lists of numbers with so many significant digits; None for what is not finite."""
    if np.ndim(values):
        return [_rounded(one, digits) for one in values]
    return float(f"{values:.{digits}g}") if np.isfinite(values) else None


def _calibration(folder: Path) -> dict[str, Any] | None:
    """Content of calibration.json with a histogram of the posterior of each unknown, and the shares
    of each pair in its cells, rows from low to high, the largest 1."""
    if not (folder / CALIBRATION).exists() or not (folder / POSTERIOR).exists():
        return None
    # The posterior: unknowns and, in the last column, weights.
    found = read_json(folder / CALIBRATION)
    with (folder / POSTERIOR).open(newline="", encoding="utf-8") as stream:
        names, *rows = csv.reader(stream)
    values = np.array(rows, dtype=float)
    weights, names = values[:, -1], names[:-1]
    edges = [_edges(column) for column in values.T[:-1]]
    posterior, pairs = {}, {}
    # Histograms of each unknown, and of pairs over the same edges.
    for row, name in enumerate(names):
        density, _ = np.histogram(values[:, row], edges[row], weights=weights, density=True)
        shown = unit_of_unknown(found["unknowns"].get(name, {})).numbers(edges[row])
        posterior[name] = {"edges": shown.tolist(), "density": density.tolist()}
        for column in range(row):
            across, up = values[:, column], values[:, row]
            bins = [edges[column], edges[row]]
            cells, _, _ = np.histogram2d(across, up, bins, weights=weights)
            pairs[f"{names[column]} {name}"] = _rounded(cells.T / cells.max(), DIGITS)
    # Numbers in the units in which the plan gives them.
    unknowns = {name: _in_units_of_the_plan(one) for name, one in found["unknowns"].items()}
    return found | {"unknowns": unknowns, "posterior": posterior, "pairs": pairs}


def _in_units_of_the_plan(one: dict[str, Any]) -> dict[str, Any]:
    """An unknown of calibration.json with its numbers in the unit in which the plan gives it."""
    if "shown_unit" not in one:  # of an older version
        return one
    unit = unit_of_unknown(one)
    values = {name: unit.number(one[name]) for name in ("mean", "low_95", "high_95")}
    return one | values | {"sd": one["sd"] / unit.size, "unit": unit.name}


def _edges(values: Any) -> Any:
    """Edges of the cells of an unknown: around the lines of a grid, or of even size."""
    # A grid has few values: each cell ends halfway to the next one.
    lines = np.unique(values)
    if not 1 < lines.size <= MOST_LINES:
        return np.histogram_bin_edges(values, BINS)
    middles = 0.5 * (lines[1:] + lines[:-1])
    return np.array([1.5 * lines[0] - 0.5 * lines[1], *middles, 1.5 * lines[-1] - 0.5 * lines[-2]])
