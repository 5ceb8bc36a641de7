"""`export`: the surface of a run or a texture as a file for other programs."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from lasersph.input import parse_quantity
from lasersph.output.errors import OutputError
from lasersph.output.height_map import KINDS
from lasersph.output.reader import Run, RunOrFolder, open_run
from lasersph.output.revolved import write_revolved
from lasersph.output.surface_files.read import read_surface
from lasersph.output.symmetry import is_axisymmetric

TEXTURE = "height.x3p"
"""Height of a whole texture, beside which no run lies."""
BODY = "body.vtkhdf"
"""Body of revolution of a section (r, z)."""


def export(
    folder: RunOrFolder,
    format: Literal["csv", "stl", "ply", "x3p", "sdf"] = "csv",
    *,
    at: float | str | None = None,
    revolve: bool = False,
) -> Path:
    """Write the surface of a crater or a relief into the folder of the run.

    crater.csv, surface-profile.csv, of a run in 3-D surface-map.csv, of a texture height.csv.

        lasersph.export("runs/texture-steel", "stl", at="60 ns")

    The profile of a surface that moved is extruded along its lines for triangles, by its width.
    `Run.relief` gives the same as arrays.

    Args:
        folder: a run, or its folder, or that of a texture. format: csv has meters, stl and ply
            triangles in micrometers, x3p and sdf are of surface metrology.
        at: time of the closest snapshot, in seconds or with a unit; the last one if not given.
        revolve: write the body of revolution of a section (r, z) into body.vtkhdf for ParaView
            instead, with the fields of the snapshot.

    Returns:
        The file, in the folder of the run.

    Raises:
        OutputError: nothing there to write, or another format. QuantityError: `at` is no time.
    """
    time = parse_quantity(at, "time") if isinstance(at, str) else at
    if revolve:
        return _export_body(open_run(folder), time)
    if format not in KINDS:
        raise OutputError(f'no format "{format}"; there are {", ".join(KINDS)}')
    # A texture has a map of its own; everything else is the folder of a run.
    heights = (folder.path if isinstance(folder, Run) else Path(folder)) / TEXTURE
    if heights.exists():
        return read_surface(heights).write(heights.with_suffix(f".{format}"))
    run = open_run(folder)
    # A profile has no area: it is drawn out for formats of triangles.
    moves = run.surface_moves
    relief = run.relief(time)
    is_profile = moves and relief.y.size == 1
    if is_profile and format in ("stl", "ply"):
        relief = relief.extruded()
    name = "surface-profile" if is_profile else "surface-map" if moves else "crater"
    return relief.write(run.path / f"{name}.{format}")


def _export_body(run: Run, time: float | None) -> Path:
    """Write body.vtkhdf. Raises OutputError where the run is no section, or has no snapshots."""
    if not is_axisymmetric(run.case):
        raise OutputError(
            f"{run.path} is no section (r, z), so there is nothing to revolve; "
            'geometry = "axisymmetric" in [solver] computes one'
        )
    if not len(run.snapshots):
        raise OutputError(f"{run.path} has no snapshots yet")
    steps = [run.snapshots, *([run.surface] if len(run.surface) else [])]
    step, *lines = (one[-1] if time is None else one.nearest(time) for one in steps)
    line = lines[0]["position"] if lines else None
    write_revolved(run.path / BODY, step, line, run.snapshots.units)
    return run.path / BODY
