"""The body of a section (r, z) for ParaView: each particle as the ring that it stands for.

A cell of the section, turned about the axis in steps of an angle, becomes hexahedra, two of whose
corners are one where it touches the axis. The layout is VTKHDF 2.0, type UnstructuredGrid
[VTKHDF]; fields are data of cells. Where the surface moves, the uppermost cells end at its height.

Left out: the area that chords of 2 pi / SECTORS leave of a circle, 0.3 %.

[VTKHDF] VTKHDF format specification, Kitware,
https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/.
"""

from __future__ import annotations

import io
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from lasersph.output.atomic import replace_file

SECTORS = 48
"""Cells around the axis. Guard: a round body looks round, and files stay some tens of MB."""
HEXAHEDRON = 12
"""Kind of the cells in VTK."""
TOLERANCE = 1e-6
"""Part of the smallest width of a cell below which places are one. Rounding: of sums of widths."""
ON_AXIS = 0.25
"""Part of a cell's width within which its inner corners lie on the axis. Guard: the first cells of
a section begin there, but for rounding; the next ones a width farther out."""
NOT_SHOWN = ("time", "position", "width", "normal", "mass")
"""Entries of a snapshot that are no field of a cell: masses are those of whole rings."""


def write_revolved(
    path: Path, step: Mapping[str, Any], line: np.ndarray | None, units: Mapping[str, str]
) -> None:
    """Write the body of a snapshot of a section (r, z) in single precision. Raises OutputError.

    Args:
        step: a snapshot. line: (2, columns) places and heights of a surface that moves [m], None
            of a flat one. units: of the fields.
    """
    import h5py

    low, high, shown = rings(step, line)
    points, cells, ring, sector = turned(low, high)
    # HDF5 writes into memory, so that the file appears whole
    content = io.BytesIO()
    with h5py.File(content, "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = (2, 0)
        root.attrs["Type"] = np.bytes_("UnstructuredGrid")
        arrays = {
            "NumberOfPoints": np.array([len(points)]),
            "NumberOfCells": np.array([len(cells)]),
            "NumberOfConnectivityIds": np.array([cells.size]),
            "Points": points.astype(np.float32),
            "Connectivity": cells.ravel(),
            "Offsets": np.arange(0, cells.size + 1, 8),
            "Types": np.full(len(cells), HEXAHEDRON, np.uint8),
        }
        for name, array in arrays.items():
            root.create_dataset(name, data=array, compression="gzip", shuffle=True)
        # a field of each cell, vectors turned with it
        data = root.create_group("CellData")
        for name, values in step.items():
            if name in NOT_SHOWN:
                continue
            of_cells = values[..., shown[ring]]
            if of_cells.ndim == 2:
                angle = (sector + 0.5) * 2.0 * np.pi / SECTORS
                u, w = of_cells
                of_cells = np.stack([u * np.cos(angle), u * np.sin(angle), w], axis=1)
            kind = np.float32 if of_cells.dtype.kind == "f" else of_cells.dtype
            dataset = data.create_dataset(
                name, data=of_cells.astype(kind), compression="gzip", shuffle=True
            )
            dataset.attrs["unit"] = units.get(name, "")
    replace_file(path, lambda stream: stream.write(content.getvalue()))


def rings(
    step: Mapping[str, Any], line: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Lower and upper corners (2, m) of the cells of a section [m], and their numbers (m,)."""
    position, width = np.asarray(step["position"], float), np.asarray(step["width"], float)
    low, high = position - 0.5 * width, position + 0.5 * width
    if line is not None:
        # nothing above the surface, and the uppermost cells up to it
        height = np.interp(position[0], *line)
        at_surface = np.asarray(step["surface"]) > 0
        high[1] = np.where(at_surface | (high[1] > height), height, high[1])
    shown = np.flatnonzero(high[1] - low[1] > TOLERANCE * float(np.min(width)))
    return low[:, shown], high[:, shown], shown


def turned(
    low: np.ndarray, high: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Rings as hexahedra.

    Args:
        low, high: (2, m) corners in (r, z) [m].

    Returns:
        Points (p, 3) [m]; hexahedra (h, 8) by numbers of points; and for each of these (h,) the
        number of its ring, and that of its sector.
    """
    # corners of all cells, each once: (r0, z0), (r1, z0), (r1, z1), (r0, z1)
    corners = np.stack(
        [
            np.concatenate([low[0], high[0], high[0], low[0]]),
            np.concatenate([low[1], low[1], high[1], high[1]]),
        ]
    )
    unit = TOLERANCE * float(np.min(high - low))
    _, first, corner = np.unique(
        np.round(corners / unit).astype(np.int64), axis=1, return_index=True, return_inverse=True
    )
    corner = corner.reshape(4, -1)
    r, z = corners[:, first]
    is_axis = r < ON_AXIS * float(np.min(high[0] - low[0]))
    # a point on the axis is one, others have one a sector
    count = np.where(is_axis, 1, SECTORS)
    start = np.cumsum(count) - count
    of_point = np.repeat(np.arange(r.size), count)
    angle = (np.arange(of_point.size) - start[of_point]) * 2.0 * np.pi / SECTORS
    radius = np.where(is_axis, 0.0, r)[of_point]
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle), z[of_point]], axis=1)

    def numbers(which: np.ndarray, sector: np.ndarray) -> np.ndarray:
        """Points of corners in sectors."""
        return start[which] + np.where(is_axis[which], 0, sector % SECTORS)

    # each ring in all sectors; the face one sector on comes first, as VTK wants it
    ring = np.repeat(np.arange(low.shape[1]), SECTORS)
    sector = np.tile(np.arange(SECTORS), low.shape[1])
    faces = ((k, sector + step) for step in (1, 0) for k in range(4))
    hexahedra = np.stack([numbers(corner[k, ring], where) for k, where in faces], axis=1)
    return points, hexahedra, ring, sector
