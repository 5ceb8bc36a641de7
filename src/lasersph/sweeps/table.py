"""The table of many runs: one row a run with its status, what varied, and the numbers it gave.

It is always made anew from the folders, so that no number outlives its run.
"""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Self

import numpy as np

from lasersph.input.key_units import amount_dimension, suffix, unit_in, unit_of
from lasersph.input.model import did_you_mean
from lasersph.input.shown_unit import ShownUnit, units_written
from lasersph.output.atomic import replace_text
from lasersph.output.errors import OutputError, clear_errors, install_hint
from lasersph.output.older_results import read_summary
from lasersph.sweeps.folder import PLAN, RUNS, TABLE, last_events, read_points
from lasersph.sweeps.points import Value

if TYPE_CHECKING:
    import pandas  # pyright: ignore[reportMissingImports]

Status = Literal["complete", "stopped", "failed", "wrong", "missing"]


@dataclass(frozen=True)
class Row:
    """One run.

    Attributes:
        run: its name. status: "complete"; "stopped": begun, to be continued; "failed" or "wrong"
            (its case is refused), as `reason` says in one line; "missing": not yet begun.
        settings: what varies, by key, SI. numbers: of its summary, by dotted key, SI.
    """

    run: str
    status: Status
    settings: Mapping[str, Value]
    numbers: Mapping[str, float] = field(default_factory=dict)
    reason: str = ""

    @property
    def hash(self) -> str:
        """Of its case."""
        return self.run.partition("-")[2]


@dataclass(frozen=True)
class Table:
    """Rows in the order of the plan.

    Attributes:
        path: the folder of the runs. rows: one a run. units: SI unit of each varied key.
        columns: keys of the numbers that table.csv shows.
    """

    path: Path
    rows: tuple[Row, ...]
    units: Mapping[str, str]
    columns: tuple[str, ...]

    @classmethod
    def read(cls, folder: str | PathLike[str], before: Table | None = None) -> Self:
        """The table of a folder of runs, also while they are computed.

        Args:
            before: an earlier table of the folder, whose complete runs are not read again.

        Raises:
            OutputError: there are no runs in the folder, or a summary is damaged.
        """
        path = Path(folder)
        content, events = read_points(path), last_events(path)
        known = {} if before is None else {row.run: row for row in before.rows}
        # refused points have no folder; complete runs of an earlier table stay as they are
        rows = tuple(
            Row(entry["run"], "wrong", entry["settings"], reason=entry["refused"])
            if entry["refused"]
            else _row(path, entry, events.get(entry["run"], {}), known.get(entry["run"]))
            for entry in content["points"]
        )
        # without a choice all numbers, in the order in which runs name them
        every = dict.fromkeys(name for row in rows for name in row.numbers)
        return cls(path, rows, content["units"], tuple(content["columns"] or every))

    @property
    def varied(self) -> tuple[str, ...]:
        """The keys that vary."""
        return tuple(self.units)

    @property
    def runs(self) -> tuple[str, ...]:
        """Names of the runs."""
        return tuple(row.run for row in self.rows)

    @property
    def status(self) -> tuple[Status, ...]:
        """Of each run."""
        return tuple(row.status for row in self.rows)

    @property
    def is_complete(self) -> np.ndarray:
        """Whether each run is complete, (runs,) bool."""
        return np.array([row.status == "complete" for row in self.rows], dtype=bool)

    def values(self, column: str) -> np.ndarray:
        """A varied key or a number of the summaries for each run, (runs,), SI.

        NaN where a run is not complete, or has no such number; varied numbers are always there.

        Raises:
            KeyError: no run has this number. ValueError: a varied key holds words.
        """
        if column in self.units:
            return np.array([float(row.settings[column]) for row in self.rows])
        known = {name for row in self.rows for name in row.numbers}
        if known and column not in known:
            raise KeyError(f'no run has a number "{column}"{did_you_mean(column, known)}')
        return np.array([row.numbers.get(column, math.nan) for row in self.rows])

    def count(self, status: Status) -> int:
        """How many runs have a status."""
        return self.status.count(status)

    def header(self) -> list[str]:
        """Names of the columns of `frame`, all in SI; those of varied keys end in the unit."""
        keys = [name_with_unit(key, unit) for key, unit in self.units.items()]
        return ["run", "status", *keys, *self.columns, "wall_time_s", "hash", "reason"]

    def records(self) -> Iterator[list[Value | None]]:
        """The rows of `frame`, SI; None where there is nothing."""
        for row in self.rows:
            settings = [row.settings.get(key) for key in self.units]
            numbers = [row.numbers.get(name) for name in (*self.columns, "wall_time_s")]
            yield [row.run, row.status, *settings, *numbers, row.hash, row.reason]

    def shown_units(self) -> dict[str, ShownUnit]:
        """The unit of each varied key in which the plan gives its values."""
        plan = self.path / PLAN
        with clear_errors("read", plan):
            text = plan.read_text(encoding="utf-8") if plan.exists() else ""
        return units_written(text, self.units)

    @property
    def amount_dimension(self) -> int:
        """Dimensions that the amounts of the runs cover; 3 before any has ended."""
        found = (amount_dimension(row.numbers) for row in self.rows if "dimensions" in row.numbers)
        return next(found, 3)

    def number_unit(self, column: str) -> str:
        """SI unit of a number of the summaries in runs of this dimension: of an energy J/m in 2-D;
        empty for a pure number."""
        return unit_in(unit_of(column), self.amount_dimension)

    def write(self) -> Path:
        """Write table.csv into the folder, whole or not at all: varied keys in the units of the
        plan, numbers in SI, units in the head. Raises OutputError."""
        units = self.shown_units()
        head = [f"{key} [{unit.name}]" if unit.name else key for key, unit in units.items()]
        for column in (*self.columns, "wall_time_s"):
            unit = self.number_unit(column)
            head.append(
                f"{column.removesuffix(suffix(unit_of(column)))} [{unit}]" if unit else column
            )
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(["run", "status", *head, "hash", "reason"])
        for row in self.records():
            # settings in the units of the plan, numbers stay SI
            for number, unit in enumerate(units.values(), start=2):
                if isinstance(value := row[number], float):
                    row[number] = unit.number(value)
            writer.writerow("" if one is None else one for one in row)
        replace_text(self.path / TABLE, text.getvalue())
        return self.path / TABLE

    def frame(self) -> pandas.DataFrame:
        """The table for pandas, all in SI, the units at the ends of the names, indexed by run.

        Raises:
            OutputError: pandas is not installed.
        """
        try:
            import pandas  # pyright: ignore[reportMissingImports]
        except ImportError as error:
            raise OutputError(install_hint("pandas")) from error
        return pandas.DataFrame(list(self.records()), columns=self.header()).set_index("run")

    def unknown_columns(self) -> list[str]:
        """Lines on columns that the plan names and no complete run has."""
        known = {name for row in self.rows for name in row.numbers}
        return [
            f'no run has a number "{name}"{did_you_mean(name, known)}'
            for name in self.columns
            if known and name not in known
        ]


def name_with_unit(key: str, unit: str) -> str:
    """A key with its unit as summaries write them: laser.fluence_J_m2."""
    letters = re.sub(r"[^A-Za-z0-9]+", "_", unit.replace("^", "")).strip("_")
    return f"{key}_{letters}" if letters else key


def numbers_in(summary: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, float]]:
    """Every number of a summary with its dotted key, but for the version of its format."""
    for key, value in summary.items():
        name = prefix + key
        if isinstance(value, dict):
            yield from numbers_in(value, f"{name}.")
        elif type(value) in (int, float) and name != "schema_version":
            yield name, value


def _row(path: Path, entry: Mapping[str, Any], event: Mapping[str, Any], before: Row | None) -> Row:
    run, settings = entry["run"], entry["settings"]
    if before is not None and before.status == "complete":
        return Row(run, "complete", settings, before.numbers)
    folder = path / RUNS / run
    # the folder says whether it is complete, the log why it is not
    summary = folder / "summary.json"
    if summary.exists():
        return Row(run, "complete", settings, dict(numbers_in(read_summary(folder))))
    if event.get("event") in ("failed", "wrong"):
        return Row(run, event["event"], settings, reason=event["message"])
    is_begun = (folder / "resolved.json").exists()
    return Row(run, "stopped" if is_begun else "missing", settings)
