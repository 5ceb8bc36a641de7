"""`read_surface`: a measured profile or height map, whatever its format."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

import numpy as np

from lasersph.output.errors import OutputError, clear_errors
from lasersph.output.height_map import HeightMap
from lasersph.output.surface_files.sdf import read_sdf
from lasersph.output.surface_files.text import read_text
from lasersph.output.surface_files.x3p import read_x3p

TEXT = (".csv", ".txt", ".asc", ".dat", ".xyz", ".tsv")


def read_surface(file: str | PathLike[str]) -> HeightMap:
    """A profile (one row) or a height map, in meters; NaN where a height is missing.

    Raises:
        OutputError: the file cannot be read, or is of no known format; one line with its name.
    """
    path = Path(file)
    # The ending chooses the format.
    kind = path.suffix.lower()
    with clear_errors("read", path):
        content = path.read_bytes()
    try:
        if kind == ".x3p":
            return _gridded(*read_x3p(content))
        if kind != ".sdf" and kind not in TEXT:
            known = ", ".join((".x3p", ".sdf", *TEXT))
            raise OutputError(f'no format "{kind}" of a surface; there are {known}')
        # Instruments write their units in either encoding.
        try:
            text = content.decode("utf-8")
        except UnicodeDecodeError:
            text = content.decode("latin-1")
        if kind == ".sdf":
            return _gridded(*read_sdf(text))
        x, y, z = read_text(text)
    except OutputError as error:
        raise OutputError(f"cannot read {path}: {error}") from None
    return HeightMap(x, y, z)


def _gridded(z: np.ndarray, dx: float, dy: float) -> HeightMap:
    if not (dx > 0.0 and (dy > 0.0 or z.shape[0] == 1)):
        raise OutputError(f"its steps of {dx:g} m and {dy:g} m are not above zero")
    return HeightMap(dx * np.arange(z.shape[1]), dy * np.arange(z.shape[0]), z)
