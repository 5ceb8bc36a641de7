"""What is told of a sweep: a card in the list, and its page with table, map and calibration."""

from __future__ import annotations

import csv
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.observers.observer_list import RESULTS
from lasersph.output import OutputError
from lasersph.output.reader import read_json
from lasersph.sweeps import Table
from lasersph.sweeps.folder import POINTS, RUNS, read_points
from lasersph.web.folder_list import Entry, FolderList, refuse_links
from lasersph.web.run_page import telling_damage

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
        """What the list shows of a sweep; where it cannot be read, why, in its own card alone."""
        head = {"id": entry.id, "name": entry.name, "kind": "sweep"}
        try:
            with telling_damage(entry):
                table = self._table(entry)
                return head | {
                    "title": _title(entry.path),
                    "state": "complete" if all(table.is_complete) else "stopped",
                    "counts": Counter(table.status),
                    "keys": list(table.varied),
                    "modified": (entry.path / POINTS).stat().st_mtime,
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
            for row in table.rows:
                folder = entry.path / RUNS / row.run
                is_there = (folder / "resolved.json").exists()
                rows.append(
                    {
                        "run": row.run,
                        "id": self._folders.run_of(folder) if is_there else "",
                        "status": row.status,
                        "settings": row.settings,
                        "numbers": _finite(row.numbers),
                        "reason": row.reason,
                    }
                )
            return {
                "id": entry.id,
                "name": entry.name,
                "title": _title(entry.path),
                "units": dict(table.units),
                "columns": list(table.columns),
                "main": _main_numbers(table),
                "words": {key: RESULTS[key].words for key in table.columns if key in RESULTS},
                "counts": Counter(table.status),
                "rows": rows,
                "calibration": _calibration(entry.path),
            }

    def map(self, entry: Entry, keys: Sequence[str], column: str) -> dict[str, Any]:
        """What `lasersph map` draws of a number over keys: axes, field between the runs, lines.

        Where it cannot be drawn, `refused` says why. Raises OutputError.
        """
        from lasersph.studies.maps import process_map

        with telling_damage(entry):
            table = self._table(entry)
            if set(keys) != set(table.varied):
                return {"refused": f"a map is over all that varies: {', '.join(table.varied)}"}
            try:
                shown = process_map(table, *keys, show=column)
            except (KeyError, ValueError) as error:
                return {"refused": str(error.args[0])}
            axes = [
                {"grid": _rounded(one.grid, 9), "is_logarithmic": one.is_logarithmic}
                for one in shown.axes
            ]
            lines = {
                name: [_rounded(part, 6) for part in all_] for name, all_ in shown.lines.items()
            }
            values = zip(shown.names, _rounded(shown.values, DIGITS), strict=True)
            return {
                "axes": axes,
                "values": dict(values),
                "field": _rounded(shown.field, DIGITS),
                "lines": lines,
                "notes": list(shown.notes),
            }

    def _table(self, entry: Entry) -> Table:
        refuse_links(entry.path)
        found = Table.read(entry.path, self._known.get(entry.path))
        self._known[entry.path] = found
        return found


def _title(folder: Path) -> str:
    return str(read_points(folder).get("study", {}).get("title", folder.name))


def _main_numbers(table: Table) -> list[str]:
    """Those of `MAIN` that a run of the table has, or the first of its numbers."""
    known = {key for row in table.rows for key in row.numbers}
    return [key for key in MAIN if key in known] or list(table.columns[:1])


def _points(table: Table) -> list[list[float | None]]:
    """For each run its place among the others, 0 to 1, over one or two keys, and the first of the
    main numbers: x, y, color; None where it is not known. Empty where keys hold words."""
    names = [*table.varied[:2], *_main_numbers(table)[:1]]
    try:
        columns = [table.values(name) for name in names]
    except (KeyError, ValueError):
        return []
    if len(columns) < 2 or not np.any(np.isfinite(columns[-1])):
        return []
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
    found = read_json(folder / CALIBRATION)
    with (folder / POSTERIOR).open(newline="", encoding="utf-8") as stream:
        names, *rows = csv.reader(stream)
    values = np.array(rows, dtype=float)
    weights, names = values[:, -1], names[:-1]
    edges = [_edges(column) for column in values.T[:-1]]
    posterior, pairs = {}, {}
    for row, name in enumerate(names):
        density, _ = np.histogram(values[:, row], edges[row], weights=weights, density=True)
        posterior[name] = {"edges": edges[row].tolist(), "density": density.tolist()}
        for column in range(row):
            across, up = values[:, column], values[:, row]
            bins = [edges[column], edges[row]]
            cells, _, _ = np.histogram2d(across, up, bins, weights=weights)
            pairs[f"{names[column]} {name}"] = _rounded(cells.T / cells.max(), DIGITS)
    return found | {"posterior": posterior, "pairs": pairs}


def _edges(values: Any) -> Any:
    """Edges of the cells of an unknown: around the lines of a grid, or of even size."""
    lines = np.unique(values)
    if not 1 < lines.size <= MOST_LINES:
        return np.histogram_bin_edges(values, BINS)
    middles = 0.5 * (lines[1:] + lines[:-1])
    return np.array([1.5 * lines[0] - 0.5 * lines[1], *middles, 1.5 * lines[-1] - 0.5 * lines[-2]])
