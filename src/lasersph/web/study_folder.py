"""Folders in which a study laid its runs: a threshold, a convergence, the craters of a spot.

`study.json` says of such a folder what was asked and which key varies. A folder of an older version
has none: the names of its runs tell the kind, and the cases as they were computed what varies. The
table of the runs is made as that of a sweep.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import Any

from lasersph.output.errors import read_json
from lasersph.output.older_results import read_summary
from lasersph.output.study_mark import read_mark
from lasersph.sweeps import Table
from lasersph.sweeps.table import Row, numbers_in
from lasersph.web.changes import unit_of_key

NUMBER = r"[0-9.]+(?:e[-+]?[0-9]+)?"
RUN_NAMES = {
    "threshold": re.compile(rf"(?:fluence|intensity|pulse_energy|power)-{NUMBER}"),
    "converge": re.compile(rf"spacing-{NUMBER}nm"),
    "spot": re.compile(rf"[0-9]{{2,}}-fluence-{NUMBER}"),
}
"""Names of the folders of the runs of `studies.fluence_threshold`, `spacing_study` and
`spot_threshold`, by the kind of the study; for folders without `study.json`."""


def kind_of_study(folder: Path, inside: Iterable[str]) -> str:
    """The kind of study whose runs lie in a folder with these folders; empty where there is none.

    Raises:
        OutputError: its mark is damaged.
    """
    # The mark says it; a folder of an older version is known by the names of its runs.
    if mark := read_mark(folder):
        return mark.kind
    names = list(inside)
    kinds = (kind for kind, name in RUN_NAMES.items() if all(map(name.fullmatch, names)))
    return next(kinds, "") if names else ""


def study_title(folder: Path) -> str:
    """Title of a study: "threshold of dlip-steel to melt"; without a mark kind and case."""
    # Without a mark, kind and case.
    if mark := read_mark(folder):
        return mark.title
    runs = _runs(folder)
    case = read_json(runs[0] / "resolved.json")["case"]
    kind = kind_of_study(folder, (run.name for run in runs))
    return f"{kind}, {case.get('title') or folder.name}"


def study_table(folder: Path, before: Table | None = None) -> Table:
    """The runs of a study with the key that varies, or the keys in which their cases differ, SI.

    Args:
        before: an earlier table of the folder, whose complete runs are not read again.

    Raises:
        OutputError: a run cannot be read.
    """
    # Keys in which the runs differ.
    runs = _runs(folder)
    known = {row.run: row for row in before.rows} if before is not None else {}
    cases = {run.name: _numbers(read_json(run / "resolved.json")["case"]) for run in runs}
    mark = read_mark(folder)
    units = {mark.key: mark.unit} if mark else _varying(cases.values())
    rows = []
    # A complete run stays as it is; others are looked at again.
    for run in runs:
        settings = {key: cases[run.name][key] for key in units}
        old, summary = known.get(run.name), run / "summary.json"
        if old is not None and old.status == "complete":
            rows.append(Row(run.name, "complete", settings, old.numbers))
        elif summary.exists():
            numbers = dict(numbers_in(read_summary(run)))
            rows.append(Row(run.name, "complete", settings, numbers))
        else:
            rows.append(Row(run.name, "stopped", settings))
    # In the order of what varies.
    rows.sort(key=lambda row: tuple(row.settings.values()))
    columns = dict.fromkeys(name for row in rows for name in row.numbers)
    return Table(folder, tuple(rows), units, tuple(columns))


def _runs(folder: Path) -> list[Path]:
    return sorted(run for run in folder.iterdir() if (run / "resolved.json").exists())


def _varying(cases: Collection[Mapping[str, float]]) -> dict[str, str]:
    """Keys in which cases differ, with their SI units."""
    # Keys with a unit: names of cases and titles differ, too.
    every = dict.fromkeys(key for case in cases for key in case)
    return {key: unit for key in every if (unit := unit_of_key(key)) and _varies(key, cases)}


def _varies(key: str, cases: Iterable[Mapping[str, float]]) -> bool:
    values = [case.get(key) for case in cases]
    return None not in values and len(set(values)) > 1


def _numbers(case: Any, name: str = "") -> dict[str, float]:
    """Numbers of a case by dotted key."""
    if isinstance(case, dict):
        parts = [_numbers(item, f"{name}.{key}".lstrip(".")) for key, item in case.items()]
        return {key: value for part in parts for key, value in part.items()}
    is_number = isinstance(case, int | float) and not isinstance(case, bool)
    return {name: float(case)} if is_number else {}
