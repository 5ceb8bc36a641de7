"""What is told of a sweep: a card in the list, and its page with table, map and calibration."""

from __future__ import annotations

import csv
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.output import OutputError
from lasersph.output.reader import read_json
from lasersph.sweeps import Table
from lasersph.sweeps.folder import POINTS, RUNS, read_points
from lasersph.web.folder_list import Entry, FolderList, refuse_links
from lasersph.web.run_page import telling_damage

CALIBRATION, POSTERIOR = "calibration.json", "posterior.csv"
BINS = 40
"""Of the histogram of an unknown."""


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
                "counts": Counter(table.status),
                "rows": rows,
                "calibration": _calibration(entry.path),
            }

    def _table(self, entry: Entry) -> Table:
        refuse_links(entry.path)
        found = Table.read(entry.path, self._known.get(entry.path))
        self._known[entry.path] = found
        return found


def _title(folder: Path) -> str:
    return str(read_points(folder).get("study", {}).get("title", folder.name))


def _finite(numbers: Any) -> dict[str, float]:
    return {key: value for key, value in numbers.items() if np.isfinite(value)}


def _calibration(folder: Path) -> dict[str, Any] | None:
    """Content of calibration.json with a histogram of the posterior of each unknown."""
    if not (folder / CALIBRATION).exists() or not (folder / POSTERIOR).exists():
        return None
    found = read_json(folder / CALIBRATION)
    with (folder / POSTERIOR).open(newline="", encoding="utf-8") as stream:
        names, *rows = csv.reader(stream)
    values = np.array(rows, dtype=float)
    posterior = {}
    for name, column in zip(names[:-1], values.T, strict=False):
        density, edges = np.histogram(column, BINS, weights=values[:, -1], density=True)
        posterior[name] = {"edges": edges.tolist(), "density": density.tolist()}
    return found | {"posterior": posterior}
