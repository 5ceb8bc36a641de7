"""surface.csv: the surface of a run at its end, in meters."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np

from lasersph.output.atomic import replace_text


def write_profile(path: Path, x: np.ndarray, height: np.ndarray) -> None:
    """Write x and height of a surface (columns,) [m]. Raises OutputError."""
    _write(path, "x_m,height_m", x, height)


def write_heights(path: Path, x: np.ndarray, y: np.ndarray, height: np.ndarray) -> None:
    """Write x, y and height of a surface over both, (nx,), (ny,), (nx, ny) [m]; x slowest.

    Raises OutputError.
    """
    places = np.meshgrid(x, y, indexing="ij")
    _write(path, "x_m,y_m,height_m", *(grid.ravel() for grid in (*places, height)))


def _write(path: Path, head: str, *columns: Iterable[float]) -> None:
    rows = (",".join(f"{value:.9g}" for value in row) for row in zip(*columns, strict=True))
    replace_text(path, "\n".join([head, *rows, ""]))
