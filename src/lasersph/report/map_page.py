"""The page of a process map: pictures, what they show in numbers, and the runs with links."""

from __future__ import annotations

import csv
from html import escape
from pathlib import Path

import numpy as np

from lasersph.input import format_quantity, in_field_units
from lasersph.input.key_units import suffix, unit_of
from lasersph.output.atomic import replace_text
from lasersph.output.errors import clear_errors
from lasersph.plots import style
from lasersph.plots.process_map import MapAxis, ProcessMap, draw_process_map
from lasersph.report.page import figure, heading, page, paragraph

RUNS = "runs"
"""Folder of the runs beside the page."""


def write_map(
    shown: ProcessMap, folder: Path, title: str, *, levels: tuple[float, ...] = ()
) -> list[Path]:
    """Write a map into the folder of its sweep as PNG, SVG, CSV and one page.

    Args:
        title: of the page. levels: of the contours, SI.

    Returns:
        The files: picture, drawing, values, lines if there are any, page.

    Raises:
        OutputError: the folder cannot be written.
    """
    # Picture, drawing, values and outlines beside each other, then the page that shows them.
    stem = folder / f"map-{shown.column}"
    picture = draw_process_map(shown, levels)
    with clear_errors("write", folder):
        files = [style.save(picture, Path(f"{stem}.{kind}")) for kind in ("png", "svg")]
        files.append(_write_rows(Path(f"{stem}.csv"), _field_rows(shown)))
        if shown.lines or shown.bands:
            files.append(_write_rows(Path(f"{stem}-lines.csv"), _line_rows(shown)))
        body = _page_body(shown, title, files[0])
        replace_text(Path(f"{stem}.html"), page(title, body))
    return [*files, Path(f"{stem}.html")]


def name_with_unit(axis: MapAxis) -> str:
    """Column of a key in CSV files, in the unit of the plan: laser.fluence [J/cm^2]."""
    return f"{axis.key} [{axis.shown.name}]" if axis.shown.name else axis.key


def _write_rows(path: Path, rows: list[list[object]]) -> Path:
    with path.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)
    return path


def _field_rows(shown: ProcessMap) -> list[list[object]]:
    """Header, and a row for each place of the field, keys in the units of the plan and the number
    in SI as in table.csv; empty where no run tells the number."""
    # The unit stands at the head, so that the name goes without.
    unit = f" [{shown.unit}]" if shown.unit else ""
    name = shown.column.removesuffix(suffix(unit_of(shown.column))) if unit else shown.column
    head: list[object] = [*map(name_with_unit, shown.axes), f"{name}{unit}"]
    columns = [*np.meshgrid(*(axis.shown.numbers(axis.grid) for axis in shown.axes)), shown.field]
    if shown.deviation is not None:
        head.append(f"standard deviation{unit}")
        columns.append(shown.deviation)
    rows = np.stack([column.ravel() for column in columns], axis=1)
    return [head, *([f"{one:.6g}" if np.isfinite(one) else "" for one in row] for row in rows)]


def _line_rows(shown: ProcessMap) -> list[list[object]]:
    """Header, and the points of each line, then of each band; a line of several parts counts
    them."""
    # Bands follow the lines, under their names.
    outlines = {**shown.lines, **{f"{name}: band": one for name, one in shown.bands.items()}}
    rows: list[list[object]] = [["line", "part", *map(name_with_unit, shown.axes)]]
    for name, parts in outlines.items():
        for number, part in enumerate(parts, start=1):
            keys = [a.shown.numbers(at) for a, at in zip(shown.axes, part.T, strict=True)]
            rows += [
                [name, number, *(f"{one:.6g}" for one in at)] for at in zip(*keys, strict=True)
            ]
    return rows


def _page_body(shown: ProcessMap, title: str, picture: Path) -> list[str]:
    keys = " and ".join(axis.words for axis in shown.axes)
    body = [
        f"<h1>{escape(title)}</h1>",
        paragraph(f"{len(shown.names)} runs over {keys}; each links to its folder", "about"),
        *(paragraph(note, "warning") for note in shown.notes),
        figure(picture, _caption(shown), 1),
        *_onset_table(shown),
        heading("Runs"),
        _runs_table(shown),
    ]
    return body


def _caption(shown: ProcessMap) -> str:
    # Between the runs the field is interpolated, linearly or by an emulator.
    how = "interpolated linearly between runs"
    if shown.deviation is not None:
        how = "as a Gaussian process through the runs gives it"
    text = f"{shown.words[0].upper()}{shown.words[1:]}, {how}."
    if shown.deviation is not None and len(shown.axes) == 2:
        allowed = format_quantity(shown.allowed, shown.unit, 2, typographic=True)
        text += f" Hatched: its standard deviation exceeds {allowed}."
    # Bands and lines, and what is known where a line is missing.
    if shown.bands:
        events = ", ".join(map(shown.line_words, shown.bands))
        how = "Hatched" if len(shown.axes) == 2 else "Shaded"
        text += f" {how}: where the onset of {events} lies"
        is_line_missing = not set(shown.bands) <= set(shown.lines)
        text += "; without a line, only the runs on both sides of it are known." * is_line_missing
        text += "; lines: where it most likely is." * (not is_line_missing)
    if shown.target is not None:
        text += f" Wanted: {format_quantity(shown.target, shown.unit, typographic=True)}."
    return text


def _onset_table(shown: ProcessMap) -> list[str]:
    """Heading and table of where each event begins, on each line of the grid."""
    rows = [
        f"<tr><td>{escape(event)}</td><td>{escape(text)}</td></tr>"
        for event, text in shown.onset_words()
    ]
    head = f"<tr><th>begins</th><th>{escape(shown.axes[0].words)}</th></tr>"
    return [heading("Where it begins"), "\n".join(["<table>", head, *rows, "</table>"])] * bool(
        rows
    )


def _runs_table(shown: ProcessMap) -> str:
    """Runs with their keys, the number or why there is none; each name links to its folder."""
    head = ["run", *(axis.words for axis in shown.axes), shown.words, "status"]
    reasons = shown.reasons or ("",) * len(shown.names)
    lines = ["<table>", "<tr>" + "".join(f"<th>{escape(one)}</th>" for one in head) + "</tr>"]
    for name, point, value, status, reason in zip(
        shown.names, shown.points, shown.values, shown.status, reasons, strict=True
    ):
        # Keys and number in the units of the field; runs without a number say why.
        cells = [in_field_units(at, axis.unit) for at, axis in zip(point, shown.axes, strict=True)]
        cells += [in_field_units(value, shown.unit), ": ".join(filter(None, (status, reason)))]
        link = f'<a href="{RUNS}/{escape(name)}/">{escape(name)}</a>'
        others = "".join(f'<td class="number">{escape(cell)}</td>' for cell in cells)
        lines.append(f"<tr><td>{link}</td>{others}</tr>")
    return "\n".join([*lines, "</table>"])
