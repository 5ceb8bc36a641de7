"""Maps over a regular grid in one VTKHDF file, which ParaView opens as it is.

The layout is VTKHDF 2.0, type ImageData [VTKHDF]: a plane of nx by ny points at equal steps, and an
array (ny, nx) a map: VTK's reader drops the axis without extent and refuses (1, ny, nx). The file
appears whole or not at all.

[VTKHDF] VTKHDF format specification, Kitware,
https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/.
"""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.output.atomic import replace_file
from lasersph.output.errors import OutputError, clear_errors


@dataclass(frozen=True, eq=False)
class Maps:
    """Maps over one grid.

    Attributes:
        x: (nx,) [m]. y: (ny,) [m]. fields: arrays (ny, nx) by name, SI. units: of each.
    """

    x: np.ndarray
    y: np.ndarray
    fields: Mapping[str, np.ndarray]
    units: Mapping[str, str]


def write_maps(path: Path, maps: Maps) -> None:
    """Write maps in single precision. Raises OutputError."""
    import h5py

    # Equal steps of the grid; a side of one point has a step of 1, which VTK demands above zero.
    nx, ny = maps.x.size, maps.y.size
    steps = [float(np.ptp(side)) / max(side.size - 1, 1) or 1.0 for side in (maps.x, maps.y)]
    # HDF5 writes into memory, so that the file appears whole.
    content = io.BytesIO()
    with h5py.File(content, "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = (2, 0)
        root.attrs["Type"] = np.bytes_("ImageData")
        root.attrs["WholeExtent"] = (0, nx - 1, 0, ny - 1, 0, 0)
        root.attrs["Origin"] = (float(maps.x[0]), float(maps.y[0]), 0.0)
        root.attrs["Spacing"] = (*steps, 1.0)
        root.attrs["Direction"] = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
        # One array a map, with its unit as an attribute that ParaView passes over.
        points = root.create_group("PointData")
        for name, values in maps.fields.items():
            data = values.astype(np.float32)
            dataset = points.create_dataset(name, data=data, compression="gzip", shuffle=True)
            dataset.attrs["unit"] = maps.units[name]
    replace_file(path, lambda stream: stream.write(content.getvalue()))


def read_maps(path: Path) -> Maps:
    """Maps as `write_maps` wrote them, or earlier versions as (1, ny, nx). Raises OutputError."""
    import h5py

    with clear_errors("read", path):
        try:
            with h5py.File(path, "r") as file:
                # `WholeExtent` has the first and last number of each axis.
                root: Any = file["VTKHDF"]
                ends, start, step = (root.attrs[n] for n in ("WholeExtent", "Origin", "Spacing"))
                points = root["PointData"]
                shape = ends[3] + 1, ends[1] + 1
                fields = {n: np.reshape(one, shape).astype(float) for n, one in points.items()}
                units = {name: str(one.attrs["unit"]) for name, one in points.items()}
        except (KeyError, IndexError) as error:
            raise OutputError(f"cannot read {path}: it holds no maps ({error})") from None
    x, y = (start[k] + step[k] * np.arange(ends[2 * k + 1] + 1) for k in (0, 1))
    return Maps(x, y, fields, units)
