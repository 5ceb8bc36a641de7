"""Two runs side by side: what their cases differ in, their main numbers, and figures of both."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from html import escape
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lasersph.input.document import split_settings
from lasersph.input.key_units import amount_dimension, unit_in
from lasersph.input.shown_unit import in_unit_of
from lasersph.input.text_table import text_table
from lasersph.observers.quantity import Quantity
from lasersph.output import Run, RunOrFolder, open_run
from lasersph.output.atomic import replace_json, replace_text
from lasersph.output.errors import clear_errors
from lasersph.plots import comparison, style
from lasersph.report.page import figure, heading, page, paragraph, table
from lasersph.report.tables import in_words, main_results, text_of

if TYPE_CHECKING:
    from lasersph.plots.notebook_figure import Figure

Cells = tuple[str, str, str, str]
LAST = " Of a train of pulses the last one is drawn, its times count from its start."
FIGURES = {
    "relief": "Relief at the end of both runs; below: that of the second less that of the first.",
    "temperature": "Surface temperature at the maximum of the light; shaded: pulse of the first."
    + LAST,
    "melt": "Width (a) and depth (b) of the half molten metal." + LAST,
}


@dataclass(frozen=True, eq=False)
class RunComparison:
    """Two runs side by side; printed, a table of settings and one of numbers.

    Attributes:
        runs: both. names: their folders, with parents where these alone tell them apart.
        settings: keys of the case that differ: key, first, second, as they were written.
        numbers: the main numbers of both by dotted key of summary.json, SI; None where a run has
            none.
        rows: the same in words: what, first, second, difference.
    """

    runs: tuple[Run, Run]
    names: tuple[str, str]
    settings: tuple[tuple[str, str, str], ...]
    numbers: Mapping[str, tuple[Any, Any]]
    rows: tuple[Cells, ...]

    def __str__(self) -> str:
        """The settings that differ, and the main numbers."""
        settings = text_table(list(map(list, self.settings)), ("setting", *self.names))
        numbers = text_table(list(map(list, self.rows)), ("", *self.names, "difference"))
        found = f"{settings}\n\n{numbers}" if self.settings else numbers
        return "\n".join([found, *(f"note: {text}" for text in self.notes)])

    @property
    def notes(self) -> list[str]:
        """Lines on amounts that earlier versions gave of the computed part."""
        return [run.note_on_older for run in self.runs if run.note_on_older is not None]

    def figures(self) -> dict[str, Figure]:
        """By name: "relief" where both surfaces move, "temperature" and "melt" where both have
        them, a curve each."""
        return comparison.figures_of_two(self.runs, self.names)

    def write(self, folder: str | PathLike[str]) -> Path:
        """Write figures, comparison.json (SI) and a page into a folder, and give the page.

        Raises:
            OutputError: the folder cannot be written.
        """
        # Pictures first, as the page holds them.
        target = Path(folder)
        with clear_errors("write", target):
            target.mkdir(parents=True, exist_ok=True)
        pictures = {
            name: style.save(drawn, target / f"{name}.png")
            for name, drawn in self.figures().items()
        }

        # The same as data, SI.
        content = {
            "schema_version": 1,
            "runs": [str(run.path.resolve()) for run in self.runs],
            "settings": {key: values for key, *values in self.settings},
            "numbers": {key: list(values) for key, values in self.numbers.items()},
        }
        replace_json(target / "comparison.json", content)

        # The page: settings, numbers, figures.
        title = " and ".join(self.names)
        body = [
            f"<h1>{escape(title)}</h1>",
            heading("Settings that differ"),
            table(self.settings, ("", *self.names))
            if self.settings
            else paragraph("The two case files say the same."),
            heading("Main numbers"),
            table(self.rows, ("", *self.names, "difference")),
            *(paragraph(text) for text in self.notes),
        ]
        for number, (name, picture) in enumerate(pictures.items(), start=1):
            body.append(figure(picture, FIGURES[name], number))
        replace_text(target / "comparison.html", page(title, body))
        return target / "comparison.html"


def compare_runs(first: RunOrFolder, second: RunOrFolder) -> RunComparison:
    """Two complete runs side by side; also two points of a sweep.

        both = lasersph.compare_runs("runs/one", "runs/two")
        print(both)  # settings that differ, main numbers
        both.figures()["temperature"]

    Args:
        first, second: runs, or their folders.

    Raises:
        OutputError: one is no run folder, or not complete.
    """
    runs = open_run(first), open_run(second)
    names = runs[0].path.name, runs[1].path.name
    # Folders of one name are told apart by their parents.
    if names[0] == names[1]:
        names = str(runs[0].path), str(runs[1].path)
    # Main numbers that either run has, in the words and units of their declarations.
    found: list[dict[str, tuple[Quantity, Any]]] = [
        {one.key: (one, value) for one, value in main_results(run.summary)} for run in runs
    ]
    keys = list(dict.fromkeys([*found[0], *found[1]]))
    numbers = {key: (found[0].get(key, _NONE)[1], found[1].get(key, _NONE)[1]) for key in keys}
    rows = []
    for key, values in numbers.items():
        quantity = (found[0].get(key) or found[1][key])[0]
        texts = (text_of(quantity, v, run.summary) for v, run in zip(values, runs, strict=True))
        unit = unit_in(quantity.unit, amount_dimension(runs[0].summary))
        rows.append((quantity.words, *texts, _difference(*values, unit)))
    return RunComparison(runs, names, tuple(_different_settings(*runs)), numbers, tuple(rows))


LARGEST_PERCENT = 1000.0
"""Differences above it stand without a percentage: nobody reads +338 409 %."""
_NONE = (None, None)
"""Of a quantity that a run does not have."""


def _difference(first: Any, second: Any, unit: str) -> str:
    """The second value less the first with its sign, and in percent of the first; nothing where
    they are no numbers."""
    # Only numbers can be subtracted.
    if not all(
        isinstance(one, int | float) and not isinstance(one, bool) for one in (first, second)
    ):
        return ""
    if second == first:
        return "the same"
    # The change with its sign, and in percent where that says more.
    change = second - first
    text = f"{'+' if change > 0.0 else '−'}{in_words(abs(change), unit)}"
    if not first:
        return text
    percent = 100.0 * change / abs(first)
    if abs(percent) > LARGEST_PERCENT:
        return text
    shown = f"{percent:+.0f}" if abs(percent) >= 10.0 else f"{percent:+.2g}"
    return f"{text} ({shown} %)".replace("-", "−")


def _different_settings(first: Run, second: Run) -> Iterator[tuple[str, str, str]]:
    """Keys that the case files of two runs say differently: key, first, second."""
    # As the files say it: defaults that nobody wrote do not differ.
    ours, theirs = (_settings_of(run.case_text) for run in (first, second))
    for key in dict.fromkeys([*ours, *theirs]):
        if ours.get(key) != theirs.get(key):
            yield key, ours.get(key, "–"), theirs.get(key, "–")


def _settings_of(case_text: str) -> dict[str, str]:
    """Every key of a case file with its value as written; those of the command line win."""
    # Settings of the command lie over the file, in its units.
    settings, text = split_settings(case_text)
    found = {key: str(value) for key, value in _flat(tomllib.loads(text))}
    for setting in settings:
        name, _, value = setting.partition("=")
        key = name.strip()
        found[key] = in_unit_of(value.strip(), found.get(key, ""))  # studies write SI
    return found


def _flat(tables: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    for key, value in tables.items():
        if isinstance(value, dict):
            yield from _flat(value, f"{prefix}{key}.")
        else:
            is_list = isinstance(value, list) and value and isinstance(value[0], dict)
            yield prefix + key, ", ".join(map(_inline, value)) if is_list else value


def _inline(table: Mapping[str, Any]) -> str:
    """A table as one line of a case file: {name = "maximum", depth = "0 nm"}."""
    return f"{{{', '.join(f'{key} = {json.dumps(value)}' for key, value in table.items())}}}"
