"""Rows of numbers of the CSV files that a case names."""

from __future__ import annotations

import csv
import math
from pathlib import Path

from lasersph.input.errors import CaseError


def read_rows(file: Path, columns: tuple[str, ...]) -> list[tuple[float, ...]]:
    """Rows of numbers of a CSV file with these column names.

    Raises CaseError with the line of what cannot be read.
    """
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
            return [_numbers(row, columns, file, reader.line_num) for row in reader]
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
