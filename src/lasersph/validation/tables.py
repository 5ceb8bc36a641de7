"""Tables of numbers, each a CSV whose comments say where they come from."""

from __future__ import annotations

from pathlib import Path

import numpy as np


def read_table(file: Path) -> dict[str, np.ndarray]:
    """Columns of a table by name, (rows,); a cell that is empty or "-" is NaN.

    Raises:
        FileNotFoundError: there is no such table.
    """
    # Comments and empty lines are for people.
    text = file.read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    head, *rows = [[cell.strip() for cell in line.split(",")] for line in lines]
    columns = zip(*rows, strict=True) if rows else ((),) * len(head)
    return {name: np.array(column_of(cells)) for name, cells in zip(head, columns, strict=True)}


def column_of(cells: tuple[str, ...]) -> list[float] | list[str]:
    """Numbers, NaN where there is none; texts where any cell is no number."""
    try:
        return [float(cell) if cell not in ("", "-") else np.nan for cell in cells]
    except ValueError:
        return list(cells)


def quantities_at(table: dict[str, np.ndarray], key: str, number: float) -> dict[str, float]:
    """Values by name of a table of `quantity` and `value`, in the rows where `key` is a number."""
    rows = np.flatnonzero(table[key] == number)
    return {str(table["quantity"][row]): float(table["value"][row]) for row in rows}
