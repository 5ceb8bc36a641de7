"""Warnings of many runs, each said once: they differ in their numbers, not in what they say."""

from __future__ import annotations

import re

from lasersph.output.errors import read_json
from lasersph.sweeps.folder import RUNS
from lasersph.sweeps.table import Table

NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[-+]?\d+)?(?: ?[A-Za-zµ%][\w/^²³]*)?")
"""A number with the word after it, its unit where it has one."""


def warning_kind(text: str) -> str:
    """A warning without its numbers and units: the same for all runs that it is about."""
    return NUMBER.sub("#", text)


def warnings_of_runs(table: Table) -> tuple[int, dict[str, int]]:
    """How many complete runs warn; each kind of warning, as the first of them says it, with the
    number of runs that have it. Raises OutputError where a summary is damaged."""
    warned, first, counts = 0, dict[str, str](), dict[str, int]()
    for row in table.rows:
        if row.status != "complete":
            continue
        # a run is counted once for each kind
        file = table.path / RUNS / row.run / "summary.json"
        summary = read_json(file) if file.is_file() else {}  # a table may be kept without its runs
        kinds = {warning_kind(text): text for text in reversed(summary.get("warnings", ()))}
        warned += bool(kinds)
        for kind, text in reversed(kinds.items()):
            shown = first.setdefault(kind, text)
            counts[shown] = counts.get(shown, 0) + 1
    return warned, counts
