"""The surface of a crater or a relief as a height map, and as files for others: CSV, STL, PLY,
and the formats of surface metrology, X3P and SDF (`surface_files`).

A height map holds, for each column of one particle's width, the upper face of the uppermost
condensed particle. CSV gives it in meters, one line a column. STL (binary) [StlFormat] and PLY
(ASCII) [PlyFormat] hold the surface as triangles between the centers of the columns, two for each
four of them, normals upward, in micrometers: these formats know no units, and printers and viewers
take small numbers for none.

[StlFormat] 3D Systems, Stereolithography Interface Specification (1988).
[PlyFormat] Turk, The PLY Polygon File Format (1994).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from lasersph.output.atomic import replace_file, replace_text
from lasersph.output.errors import OutputError
from lasersph.output.surface_files.sdf import sdf_text
from lasersph.output.surface_files.x3p import x3p_bytes
from lasersph.output.triangles import grid_triangles

CONDENSED = 0
"""Stage of a particle of the body, see `observers.AblationView`."""
MICROMETERS = 1e6
KINDS = ("csv", "stl", "ply", "x3p", "sdf")


@dataclass(frozen=True)
class HeightMap:
    """Height of the surface over a regular grid of columns.

    Attributes:
        x: (nx,) centers of the columns [m]. y: (ny,) [m]; in 2-D one value, 0.
        z: (ny, nx) height [m], 0 at the original surface; NaN where nothing is left.
        top: (ny, nx) number of the uppermost particle in the snapshot; -1 where nothing is left;
            none of a map that is not of particles.
        time: seconds.
        units: of each of these.
    """

    units: ClassVar[Mapping[str, str]] = {"x": "m", "y": "m", "z": "m", "time": "s"}
    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    top: np.ndarray = field(default_factory=lambda: np.zeros((0, 0), int))
    time: float = 0.0

    @property
    def steps(self) -> tuple[float, float]:
        """Distances between columns along x and y [m]; that along x for both of a profile."""
        dx = float(self.x[-1] - self.x[0]) / (self.x.size - 1)
        return dx, float(self.y[-1] - self.y[0]) / (self.y.size - 1) if self.y.size > 1 else dx

    def write(self, path: Path) -> Path:
        """Write the map; the ending of the name says in which format: csv, stl, ply, x3p, sdf.

        Raises:
            OutputError: another ending, a surface of one line as triangles, or the file cannot be
                written.
        """
        # The ending chooses the format: text first, then the packed XML, then triangles.
        kind = path.suffix.removeprefix(".").lower()
        if kind not in KINDS:
            raise OutputError(f'no format "{kind}" for a height map; there are {", ".join(KINDS)}')
        note = f"surface at {self.time:.6g} s; x from {self.x[0]:.9g} m, y from {self.y[0]:.9g} m"
        if kind in ("csv", "sdf"):
            text = self.as_csv() if kind == "csv" else sdf_text(self.z, *self.steps, note)
            replace_text(path, text)
            return path
        if kind == "x3p":
            replace_file(path, lambda file: file.write(x3p_bytes(self.z, *self.steps, note)))
            return path
        if min(self.z.shape) < 2:
            raise OutputError(f"a profile is a line and has no {kind.upper()} surface; take csv")
        if kind == "stl":
            replace_file(path, lambda stream: stream.write(self.as_stl()))
        else:
            replace_text(path, self.as_ply())
        return path

    def extruded(self) -> HeightMap:
        """A profile drawn out along y by its width, in two rows."""
        y = np.array([0.0, self.x[-1] - self.x[0]])
        return HeightMap(self.x, y, np.repeat(self.z, 2, axis=0), time=self.time)

    def as_csv(self) -> str:
        """Lines of x, y, z in meters."""
        x, y = np.meshgrid(self.x, self.y)
        rows = np.column_stack([x.ravel(), y.ravel(), self.z.ravel()])
        lines = (f"{a:.9g},{b:.9g},{c:.9g}" for a, b, c in rows)
        return "x_m,y_m,z_m\n" + "\n".join(lines) + "\n"

    def vertices(self) -> np.ndarray:
        """Centers of the columns at their heights, (ny nx, 3) [um]; the lowest height where nothing
        is left."""
        x, y = np.meshgrid(self.x, self.y)
        z = np.where(np.isnan(self.z), np.nanmin(self.z), self.z)
        return MICROMETERS * np.column_stack([x.ravel(), y.ravel(), z.ravel()])

    def triangles(self) -> np.ndarray:
        """Numbers of the vertices of each triangle, (t, 3), counterclockwise from above."""
        return grid_triangles(np.arange(self.z.size).reshape(self.z.shape))

    def as_stl(self) -> bytes:
        """Binary STL: header, number of triangles, normal and corners of each, single precision."""
        corners = self.vertices()[self.triangles()]
        # Normal of a facet, (b - a) x (c - a), of unit length.
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        # Layout of one facet in STL: twelve floats and a word that nobody reads.
        layout = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("spare", "<u2")])
        facets = np.zeros(len(corners), layout)
        facets["normal"], facets["corners"] = normal, corners
        head = f"lasersph surface at {self.time:.6g} s, unit um".encode().ljust(80)
        return head + np.uint32(len(corners)).tobytes() + facets.tobytes()

    def as_ply(self) -> str:
        """ASCII PLY of vertices and triangles."""
        vertices, triangles = self.vertices(), self.triangles()
        head = (
            f"ply\nformat ascii 1.0\ncomment lasersph surface at {self.time:.6g} s, unit um\n"
            f"element vertex {len(vertices)}\n"
            "property float x\nproperty float y\nproperty float z\n"
            f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header"
        )
        points = [f"{x:.7g} {y:.7g} {z:.7g}" for x, y, z in vertices]
        faces = [f"3 {a} {b} {c}" for a, b, c in triangles]
        return "\n".join([head, *points, *faces]) + "\n"


def height_map(step: Mapping[str, Any]) -> HeightMap:
    """Height map of a snapshot of an ablation in 2-D or 3-D.

    Args:
        step: a snapshot with position, width and stage.

    Raises:
        OutputError: no ablation, or a run of one dimension.
    """
    if "stage" not in step or step["position"].shape[0] == 1:
        raise OutputError(
            "a height map needs a 2-D or 3-D run with ablation, or a surface that moves"
        )

    # Columns as wide as the narrowest particle, of those that still belong to the body.
    position, width = step["position"], float(np.min(step["width"]))
    body = np.flatnonzero(step["stage"] == CONDENSED)
    x, column = bins(position[0, body], width)
    if position.shape[0] == 3:
        y, row = bins(position[1, body], width)
    else:
        y, row = np.zeros(1), np.zeros(body.size, dtype=int)
    # Uppermost particle of each column: in upward order the last one written stays.
    place = row * x.size + column
    upward = np.argsort(position[-1, body], kind="stable")
    top = np.full(x.size * y.size, -1)
    top[place[upward]] = body[upward]
    # The surface is the upper face of that particle, half its width above its center.
    z = np.where(top >= 0, position[-1, top] + 0.5 * step["width"][-1, top], np.nan)
    shape = (y.size, x.size)
    return HeightMap(x, y, z.reshape(shape), top.reshape(shape), float(step["time"]))


def profile_map(step: Mapping[str, Any], *, is_half: bool) -> HeightMap:
    """The line of a surface as a height map of one row.

    Args:
        step: of `Run.surface`. is_half: whether the mirror image about x = 0 belongs to it.
    """
    x, z = step["position"]
    # The mirror image about x = 0 comes first, so that x grows.
    if is_half:
        x, z = np.concatenate([-x[::-1], x]), np.concatenate([z[::-1], z])
    return HeightMap(x, np.zeros(1), z[None, :].copy(), time=float(step["time"]))


def surface_map(
    step: Mapping[str, Any], shape: tuple[int, int], mirrored: tuple[bool, bool], name: str = ""
) -> HeightMap:
    """The surface of a run in 3-D as a height map of the whole.

    Args:
        step: of `Run.surface`. shape: numbers of columns along x and y. mirrored: whether the
            mirror images about x = 0 and y = 0 belong to it. name: of a field that takes the
            place of the heights.
    """
    x, y, z = (values.reshape(shape) for values in step["position"])
    z = np.asarray(step[name], float).reshape(shape) if name else z
    x, y, z = whole_map(x[:, 0], y[0], z, mirrored)
    return HeightMap(x, y, z.T.copy(), time=float(step["time"]))


def whole_map(
    x: np.ndarray,
    y: np.ndarray,
    z: np.ndarray,
    mirrored: tuple[bool, bool],
    odd: tuple[bool, bool] = (False, False),
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Places (nx,), (ny,) and values (nx, ny) with their mirror images about x = 0 and y = 0.

    Args:
        mirrored: along x and y. odd: whether values change their sign across x = 0, and y = 0.
    """
    # The mirror image comes first, so that places grow.
    if mirrored[0]:
        x, z = np.concatenate([-x[::-1], x]), np.concatenate([(-1) ** odd[0] * z[::-1], z])
    if mirrored[1]:
        z = np.concatenate([(-1) ** odd[1] * z[:, ::-1], z], axis=1)
        y = np.concatenate([-y[::-1], y])
    return x, y, z


def bins(values: np.ndarray, width: float) -> tuple[np.ndarray, np.ndarray]:
    """Centers of equal columns that hold all values [m], and the column of each value."""
    # Number of a column: the distance from the first center in widths, rounded.
    first = float(np.min(values))
    count = int(np.round((float(np.max(values)) - first) / width)) + 1
    number = np.clip(np.round((values - first) / width).astype(int), 0, count - 1)
    return first + width * np.arange(count), number
