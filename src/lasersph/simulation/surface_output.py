"""Files of a surface: surface.vtkhdf beside the snapshots, surface.csv at the end if it moves."""

from __future__ import annotations

from pathlib import Path

from lasersph.observers.area_relief import AreaRelief
from lasersph.observers.relief import Relief
from lasersph.observers.surface_fields import UNITS, columns_of, surface_fields, surface_points
from lasersph.observers.view import View
from lasersph.output.height_map import whole_map
from lasersph.output.particle_file import ParticleFile
from lasersph.output.surface_csv import write_heights, write_profile
from lasersph.output.symmetry import mirrored_axes


def append_surface(file: ParticleFile, view: View) -> None:
    """Add the surface of a view that has one: a line, or in 3-D triangles, with its fields.

    Raises:
        ValueError: a surface without columns. OutputError: the file could not be written.
    """
    # the numbers of columns along x and y make it a grid
    columns = columns_of(view)
    shape = columns.height.shape if isinstance(columns, AreaRelief) else None
    file.append(view.time, surface_points(view), surface_fields(view), units=UNITS, shape=shape)


def write_relief(folder: Path, relief: Relief | AreaRelief, extent: str) -> None:
    """Write surface.csv: a line as it was computed, a surface over x and y with its mirror images.

    Raises OutputError.

    Args:
        extent: `domain.extent` of the case.
    """
    path = folder / "surface.csv"
    if isinstance(relief, AreaRelief):
        mirrored = mirrored_axes({"domain": {"extent": extent}})
        write_heights(path, *whole_map(relief.x, relief.y, relief.height, mirrored))
    else:
        write_profile(path, relief.x, relief.height)
