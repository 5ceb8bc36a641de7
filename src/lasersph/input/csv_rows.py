"""Rows of numbers of the CSV files that a case names."""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping
from pathlib import Path

from lasersph.input.errors import CaseError

Rows = list[tuple[float, ...]]


def read_rows(
    file: Path, columns: tuple[str, ...], largest: Mapping[str, float] | None = None
) -> Rows:
    """Rows of numbers of a CSV file with these column names.

    Args:
        largest: of a table over time, in whose first column times do not go back: columns that
            hold no negative numbers, with the largest one of each.

    Raises:
        CaseError: with the line of what cannot be read, or is refused.
    """
    rows, lines = _read(file, columns)
    if largest is not None:
        _refuse_over_time(rows, lines, columns, largest, file)
    return rows


def has_columns(file: Path, columns: tuple[str, ...]) -> bool:
    """Whether the first line of a CSV file names all of these columns; not where there is none."""
    try:
        with file.open(newline="", encoding="utf-8-sig") as stream:
            return set(columns) <= set(next(csv.reader(stream), ()))
    except (OSError, UnicodeDecodeError, csv.Error):
        return False


def _read(file: Path, columns: tuple[str, ...]) -> tuple[Rows, list[int]]:
    """Rows, and the line of each."""
    try:
        with file.open(newline="", encoding="utf-8-sig") as stream:
            reader = csv.DictReader(stream)
            missing = [name for name in columns if name not in (reader.fieldnames or ())]
            if missing:
                raise CaseError(
                    f"no column {', '.join(missing)}",
                    f'the first line must name the columns "{",".join(columns)}"',
                    file=str(file),
                    line=1,
                )
            rows, lines = [], []
            for row in reader:
                lines.append(reader.line_num)
                rows.append(_numbers(row, columns, file, reader.line_num))
            return rows, lines
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or "is no CSV text"
        raise CaseError(f"cannot be read: {reason}", file=str(file)) from None


def _numbers(
    row: dict[str, str], columns: tuple[str, ...], file: Path, line: int
) -> tuple[float, ...]:
    try:
        numbers = tuple(float(row[name]) for name in columns)
    except (TypeError, ValueError):
        numbers = (math.nan,)
    if not all(math.isfinite(number) for number in numbers):
        raise CaseError(f"needs {len(columns)} finite numbers", file=str(file), line=line)
    return numbers


def _refuse_over_time(
    rows: Rows, lines: list[int], columns: tuple[str, ...], largest: Mapping[str, float], file: Path
) -> None:
    """Refuse the first row that goes back in time, or with a number out of its range."""
    before = 0.0
    for line, row in zip(lines, rows, strict=True):
        time = row[0]
        for name, high in largest.items():
            number = row[columns.index(name)]
            if number < 0.0:
                what, right = f"{name} {number:g} is negative", "give 0 or more"
                raise CaseError(what, right, file=str(file), line=line)
            if number > high:
                what, right = f"{name} {number:g} is more than {high:g}", f"give {high:g} or less"
                raise CaseError(what, right, file=str(file), line=line)
        if time < before:
            raise CaseError(
                f"time {time:g} s lies before {before:g} s"
                + (" of the row above" if line != lines[0] else ", the start of the run"),
                "times rise from row to row",
                file=str(file),
                line=line,
            )
        before = time
