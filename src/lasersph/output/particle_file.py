"""Snapshots of all particles in one transient VTKHDF file, which ParaView opens as it is.

The layout is VTKHDF 2.0, type PolyData, with one vertex cell per particle, or for a surface one
line through all points, or triangles between those of a grid [VTKHDF]: arrays of all steps lie end
to end, and the group `Steps` says where each step begins. An array that did not change since the
step before (positions of a solid, cell widths) is not written again: its offset points to the old
block. Blocks are compressed (gzip 1, shuffle), one chunk a block, so that adding a step rewrites
nothing. The file is opened, appended and closed at each step through a `Transaction`: a kill at any
moment leaves a readable file. Beside the group `VTKHDF`, which is all that ParaView reads, `ranges`
keeps the smallest and largest values of each step for viewers.

Coordinates are three-dimensional, as VTK wants: (0, 0, z) in 1-D, (x, 0, z) in 2-D.

[VTKHDF] VTKHDF format specification, Kitware,
https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal

import numpy as np

from lasersph.output.errors import OutputError
from lasersph.output.transaction import Transaction, discard, finish_commit
from lasersph.output.triangles import grid_triangles

AXES = {1: (2,), 2: (0, 2), 3: (0, 1, 2)}
CellKind = Literal["Vertices", "Lines", "Polygons", "Strips"]
CELL_KINDS: tuple[CellKind, ...] = ("Vertices", "Lines", "Polygons", "Strips")
LARGEST_CHUNK = 1 << 20
FILTERS: dict[str, Any] = {"compression": "gzip", "compression_opts": 1, "shuffle": True}


class ParticleFile:
    """Appends steps to a VTKHDF file and cuts it back; nothing stays open in between."""

    def __init__(self, path: Path, cells: CellKind = "Vertices") -> None:
        """Continue the file at `path`, or start it with the first step.

        Args:
            cells: a vertex for each point, or one line through all of them in their order; points
                of a grid are always triangles.
        """
        self.path = path
        self.cells: CellKind = cells

    @property
    def steps(self) -> int:
        """Number of steps in the file. Raises OutputError where it is damaged."""
        if not self.path.exists():
            return 0
        with open_for_reading(self.path) as file:
            return int(file["VTKHDF/Steps"].attrs["NSteps"])

    def append(
        self,
        time: float,
        position: np.ndarray,
        fields: Mapping[str, np.ndarray],
        *,
        units: Mapping[str, str] | None = None,
        shape: tuple[int, int] | None = None,
    ) -> None:
        """Add one step.

        Args:
            time: seconds. position: (dim, n) [m].
            fields: arrays (n,) or (dim, n) by name, stored in their own type; the names must be
                the same in every step.
            units: unit of each field, kept as an attribute.
            shape: numbers of points along x and y of a grid, x slowest, whose triangles are the
                cells; the same in every step.

        Raises:
            ValueError: an array has the wrong length, or the names differ from the first step's.
            OutputError: the file could not be written; its old content is intact.
        """
        dimension, count = position.shape

        # Refuse arrays that are not of these particles.
        if any(array.shape[-1] != count for array in fields.values()):
            raise ValueError("a field has another number of particles than the positions")
        with open_for_changes(self.path) as file:
            # The first step lays out the file; each later one must have the same fields.
            if "VTKHDF" not in file:
                start_file(file, dimension, fields, units or {}, position.dtype, count)
                if shape is not None:
                    file.attrs["shape"] = shape
            # groups by name once: each look into the file takes as long as a small write
            root, ranges = file["VTKHDF"], file.get("ranges")
            data, steps = root["PointData"], root["Steps"]
            if set(data) != set(fields):
                raise ValueError("the fields of a step differ from those of the first step")
            number = int(steps.attrs["NSteps"])

            # Positions and cells, each written only where they changed.
            points = to_three_axes(position)
            point_offset = store_block(root["Points"], points)
            store_range(ranges, "position", points)
            cells: CellKind = self.cells if shape is None else "Polygons"
            part, first_cell, first_point = store_cells(root, count, cells, shape)
            place = CELL_KINDS.index(cells)
            # Where the blocks of this step begin.
            extend(steps["Values"], [time])
            extend(steps["PartOffsets"], [part])
            extend(steps["NumberOfParts"], [1])
            extend(steps["PointOffsets"], [point_offset])
            # Offsets of the kinds of cells that are not used stay 0.
            for name, first in (
                ("CellOffsets", first_cell),
                ("ConnectivityIdOffsets", first_point),
            ):
                extend(steps[name], [[first if k == place else 0 for k in range(4)]])
            # Fields as blocks of their own, with their ranges for viewers.
            offsets = steps["PointDataOffsets"]
            for name, array in fields.items():
                block = to_three_axes(array) if array.ndim == 2 else array
                offset = store_block(data[name], block)
                extend(offsets[name], [offset])
                store_range(ranges, name, block)
            # The number of steps goes last: until then no reader looks at the new rows.
            steps.attrs["NSteps"] = number + 1

    def cut(self, steps: int) -> None:
        """Keep the first `steps` steps; 0 removes the file.

        Raises:
            OutputError: the file holds fewer steps or is damaged.
        """
        if steps == 0:
            discard(self.path)
            return
        present = self.steps
        if present < steps:
            raise OutputError(f"{self.path} holds {present} snapshots, the checkpoint {steps}")
        if present > steps:
            # Blocks that only dropped steps used go with them.
            with open_for_changes(self.path) as file:
                cut_steps(file["VTKHDF"], steps)
                for dataset in file.get("ranges", {}).values():
                    dataset.resize(steps, axis=0)


@contextmanager
def open_for_changes(path: Path) -> Iterator[Any]:
    """The HDF5 file open for changes, which reach the disk together when the block ends."""
    import h5py

    # A commit that a killed process left is finished first.
    finish_commit(path)
    transaction = Transaction(path)
    try:
        with open_hdf5(transaction, "r+" if transaction.size else "w", h5py) as file:
            yield file
        transaction.commit()
    finally:
        transaction.close()


@contextmanager
def open_for_reading(path: Path) -> Iterator[Any]:
    """The HDF5 file open for reading, also while another process appends to it."""
    import h5py

    if not path.exists():
        raise OutputError(f"cannot read {path}: there is no such file")
    transaction = Transaction(path)
    try:
        with open_hdf5(transaction, "r", h5py) as file:
            yield file
    finally:
        transaction.close()


def open_hdf5(transaction: Transaction, mode: str, h5py: Any) -> Any:
    """Open HDF5 on a transaction; a file that HDF5 does not understand is reported damaged."""
    try:
        file = h5py.File(transaction, mode)
        if mode != "w" and "VTKHDF/Steps" not in file:
            file.close()
            raise OSError("no particle data")
        return file
    except (OSError, RuntimeError) as error:
        raise OutputError(f"cannot read {transaction.path}: it is damaged ({error})") from error


def start_file(
    file: Any,
    dimension: int,
    fields: Mapping[str, np.ndarray],
    units: Mapping[str, str],
    real: np.dtype,
    count: int,
) -> None:
    """Lay out an empty VTKHDF file."""
    # Points and their cells, all parts end to end.
    file.attrs["dimension"] = dimension
    root = file.create_group("VTKHDF", track_order=True)
    root.attrs["Version"] = np.array([2, 0], dtype=np.int64)
    root.attrs["Type"] = np.bytes_("PolyData")
    grow(root, "NumberOfPoints", np.int64)
    grow(root, "Points", real, width=3, chunk=count)
    for kind in CELL_KINDS:
        group = root.create_group(kind)
        grow(group, "NumberOfCells", np.int64)
        grow(group, "NumberOfConnectivityIds", np.int64)
        chunk = count if kind in ("Vertices", "Polygons") else None
        grow(group, "Connectivity", np.int64, chunk=chunk)
        grow(group, "Offsets", np.int64, chunk=chunk)

    # Steps: time, and where in the arrays each of them begins.
    data = root.create_group("PointData", track_order=True)
    steps = root.create_group("Steps")
    steps.attrs["NSteps"] = np.int64(0)
    grow(steps, "Values", np.float64)
    for name in ("PartOffsets", "NumberOfParts", "PointOffsets"):
        grow(steps, name, np.int64)
    grow(steps, "CellOffsets", np.int64, width=4)
    grow(steps, "ConnectivityIdOffsets", np.int64, width=4)
    offsets = steps.create_group("PointDataOffsets")

    # Fields, with the offset of the block of each step.
    for name, array in fields.items():
        width = 3 if array.ndim == 2 else None
        dataset = grow(data, name, array.dtype, width=width, chunk=count)
        dataset.attrs["unit"] = units.get(name, "")
        grow(offsets, name, np.int64)

    # Ranges: outside the group that ParaView reads.
    ranges = file.create_group("ranges")
    grow(ranges, "position", np.float64, width=6)
    for name, array in fields.items():
        grow(ranges, name, np.float64, width=6 if array.ndim == 2 else 2)


def grow(group: Any, name: str, kind: Any, width: int | None = None, chunk: int | None = None):
    """Create an empty dataset that can grow; `chunk` particles a chunk and compressed, if given."""
    tail = () if width is None else (width,)
    # One chunk a block where its length is known; small tables grow by 256 rows.
    length = 256 if chunk is None else max(1, min(chunk, LARGEST_CHUNK))
    return group.create_dataset(
        name,
        shape=(0, *tail),
        maxshape=(None, *tail),
        dtype=kind,
        chunks=(length, *tail),
        **(FILTERS if chunk is not None else {}),
    )


def to_three_axes(vector: np.ndarray) -> np.ndarray:
    """(dim, n) -> (n, 3), z last."""
    # Axes that the run does not have stay 0.
    result = np.zeros((vector.shape[1], 3), dtype=vector.dtype)
    for row, axis in enumerate(AXES[vector.shape[0]]):
        result[:, axis] = vector[row]
    return result


def extend(dataset: Any, rows: Any) -> int:
    """Append rows to a dataset and return where they begin."""
    from h5py import h5s

    stored = dataset.id
    values = np.ascontiguousarray(rows, dtype=stored.dtype)
    start, *tail = stored.shape
    stored.set_extent((start + len(values), *tail))
    # HDF5's own calls: indices as of NumPy take several times as long for a row
    place = stored.get_space()
    place.select_hyperslab((start, *(0 for _ in tail)), values.shape)
    stored.write(h5s.create_simple(values.shape), place, values)
    return start


def store_block(dataset: Any, block: np.ndarray) -> int:
    """Append a block unless it equals the last one; return the offset where it lies."""
    block = np.ascontiguousarray(block, dtype=dataset.dtype)
    digest = hashlib.blake2b(block.tobytes(), digest_size=16).hexdigest()
    # The same bytes as last time: the new step points to the old block.
    if dataset.attrs.get("last_digest") == digest:
        return int(dataset.attrs["last_offset"])
    offset = extend(dataset, block)
    dataset.attrs["last_digest"] = digest
    dataset.attrs["last_offset"] = offset
    return offset


def store_range(ranges: Any, name: str, block: np.ndarray) -> None:
    """Keep the range of a step; a file begun before ranges were kept stays without (None)."""
    if ranges is not None:
        extend(ranges[name], [value_range(block)])


def value_range(block: np.ndarray) -> np.ndarray:
    """Smallest and largest values, NaN left out: (n,) -> (2,); (n, 3) -> (6,), x, y, z of each."""
    ends = (np.fmin.reduce(block, axis=0), np.fmax.reduce(block, axis=0))
    return np.concatenate([np.ravel(end).astype(float) for end in ends])


def cells_of(
    count: int, cells: CellKind, shape: tuple[int, int] | None
) -> tuple[np.ndarray, np.ndarray]:
    """Numbers of the points of all cells, end to end, and where in them each cell begins and ends.

    Args:
        count: number of points. cells, shape: see `store_cells`.
    """
    if shape is not None:
        # points have x slowest, triangles count y rows
        triangles = grid_triangles(np.arange(count).reshape(shape).T)
        return triangles.ravel(), 3 * np.arange(len(triangles) + 1)
    points = np.arange(count)
    return points, np.arange(count + 1) if cells == "Vertices" else np.array([0, count])


def store_cells(
    root: Any, count: int, cells: CellKind, shape: tuple[int, int] | None = None
) -> tuple[int, int, int]:
    """Cells of `count` points, written once as long as the number stays the same.

    Args:
        cells: "Vertices", one for each point, "Lines", one through all, or "Polygons", the
            triangles of a grid of a shape.

    Returns:
        Number of the part, and of the first cell and connectivity entry in it.
    """
    numbers, group = root["NumberOfPoints"], root[cells]
    connected, ends = cells_of(count, cells, shape)
    # The number of points is as in the step before: its part is used again.
    part = numbers.shape[0] - 1
    if part >= 0 and int(numbers[part]) == count:
        written = int(np.sum(group["NumberOfCells"][:]))
        return part, written - (ends.size - 1), group["Connectivity"].shape[0] - connected.size

    # A new part: points in their order, and no cells of the other kinds.
    extend(numbers, [count])
    first_cell = int(np.sum(group["NumberOfCells"][:]))
    first = extend(group["Connectivity"], connected)
    extend(group["Offsets"], ends)
    for kind in CELL_KINDS:
        extend(root[kind]["NumberOfCells"], [ends.size - 1 if kind == cells else 0])
        extend(root[kind]["NumberOfConnectivityIds"], [connected.size if kind == cells else 0])
        if kind != cells:
            extend(root[kind]["Offsets"], [0])
    return part + 1, first_cell, first


def cut_steps(root: Any, count: int) -> None:
    """Drop the steps from number `count` on, and the blocks that only they used."""
    steps = root["Steps"]
    # Parts and blocks that the kept steps use.
    part = int(max(steps["PartOffsets"][:count]))
    points = root["NumberOfPoints"][: part + 1]
    shrink(root["Points"], steps["PointOffsets"][:count], steps["PartOffsets"][:count], points)
    for name, offsets in steps["PointDataOffsets"].items():
        dataset = root["PointData"][name]
        shrink(dataset, offsets[:count], steps["PartOffsets"][:count], points)
        offsets.resize(count, axis=0)
    # Cells of those parts; each part has one entry in `Offsets` more than cells.
    root["NumberOfPoints"].resize(part + 1, axis=0)
    for kind in CELL_KINDS:
        group = root[kind]
        for name in ("NumberOfCells", "NumberOfConnectivityIds"):
            group[name].resize(part + 1, axis=0)
        cells = int(np.sum(group["NumberOfCells"][:]))
        ids = int(np.sum(group["NumberOfConnectivityIds"][:]))
        group["Connectivity"].resize(ids, axis=0)
        group["Offsets"].resize(cells + part + 1, axis=0)
    # Rows of the dropped steps.
    for name in ("Values", "PartOffsets", "NumberOfParts", "PointOffsets"):
        steps[name].resize(count, axis=0)
    steps["CellOffsets"].resize(count, axis=0)
    steps["ConnectivityIdOffsets"].resize(count, axis=0)
    steps.attrs["NSteps"] = np.int64(count)


def shrink(dataset: Any, offsets: np.ndarray, parts: np.ndarray, points: np.ndarray) -> None:
    """Cut a dataset behind the last block that the kept steps use."""
    # The block that lies furthest back in the file ends what is kept.
    last = int(np.argmax(offsets))
    end = int(offsets[last] + points[parts[last]])
    if dataset.shape[0] > end:
        dataset.resize(end, axis=0)
        # The next step compares with the block that is the last one now.
        block = np.ascontiguousarray(dataset[int(offsets[last]) : end])
        dataset.attrs["last_digest"] = hashlib.blake2b(block.tobytes(), digest_size=16).hexdigest()
        dataset.attrs["last_offset"] = int(offsets[last])
