"""Tables of numbers in `data/`, each a CSV whose comments say where they come from."""

from __future__ import annotations

from importlib.resources import files

import numpy as np


def read_table(name: str) -> dict[str, np.ndarray]:
    """Columns of a table by name, (rows,); a cell that is empty or "-" is NaN.

    Raises:
        FileNotFoundError: there is no such table.
    """
    text = (files("lasersph.validation") / "data" / name).read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    head, *rows = [line.split(",") for line in lines]
    columns = zip(*rows, strict=True)
    return {
        name.strip(): np.array([_number(cell) for cell in column])
        for name, column in zip(head, columns, strict=True)
    }


def _number(cell: str) -> float:
    cell = cell.strip()
    return float(cell) if cell not in ("", "-") else np.nan
