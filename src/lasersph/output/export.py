"""`export`: the surface of a run or a texture as a file for other programs."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from lasersph.input import parse_quantity
from lasersph.output.errors import OutputError
from lasersph.output.height_map import KINDS
from lasersph.output.reader import Run, RunOrFolder, open_run
from lasersph.output.surface_files.read import read_surface

TEXTURE = "height.x3p"
"""Height of a whole texture, beside which no run lies."""


def export(
    folder: RunOrFolder,
    format: Literal["csv", "stl", "ply", "x3p", "sdf"] = "csv",
    *,
    at: float | str | None = None,
) -> Path:
    """Write the surface of a crater or a relief: crater.csv, surface-profile.csv or height.csv.

        lasersph.export("runs/texture-steel", "stl", at="60 ns")

    The profile of a surface that moved is extruded along its lines for triangles, by its width.
    `Run.relief` gives the same as arrays.

    Args:
        folder: a run, or its folder, or that of a texture. format: csv has meters, stl and ply
            triangles in micrometers, x3p and sdf are of surface metrology.
        at: time of the closest snapshot, in seconds or with a unit; the last one if not given.

    Returns:
        The file, in the folder of the run.

    Raises:
        OutputError: nothing there to write, or another format. QuantityError: `at` is no time.
    """
    if format not in KINDS:
        raise OutputError(f'no format "{format}"; there are {", ".join(KINDS)}')
    # A texture has a map of its own; everything else is the folder of a run.
    heights = (folder.path if isinstance(folder, Run) else Path(folder)) / TEXTURE
    if heights.exists():
        return read_surface(heights).write(heights.with_suffix(f".{format}"))
    run = open_run(folder)
    time = parse_quantity(at, "time") if isinstance(at, str) else at
    # A profile has no area: it is drawn out for formats of triangles.
    moves = len(run.surface) > 0
    relief = run.relief(time)
    if moves and format in ("stl", "ply"):
        relief = relief.extruded()
    return relief.write(run.path / f"{'surface-profile' if moves else 'crater'}.{format}")
