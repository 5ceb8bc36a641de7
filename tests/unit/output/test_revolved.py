"""The body of revolution of a section: volumes of its cells, its fields, and VTK's own reader."""

import json
from itertools import pairwise

import h5py
import numpy as np
import pytest
from synthetic_run import make_run

from lasersph import export, open_run
from lasersph.output import OutputError
from lasersph.output.revolved import SECTORS, write_revolved

WIDTH, DEPTH, COLUMNS, ROWS = 2e-6, 1e-6, 8, 4
CHORDS = np.sin(2.0 * np.pi / SECTORS) / (2.0 * np.pi / SECTORS)
"""Area of a polygon of chords over that of its circle."""


def section():
    """A snapshot of a block with a coarser row below, u = r and w = 1, T = number."""
    rows = []
    for columns, top, height in ((COLUMNS, 0.0, 0.25e-6), (COLUMNS // 2, -0.25e-6, 0.75e-6)):
        wide = WIDTH / columns
        r = (np.arange(columns) + 0.5) * wide
        z = np.full(columns, top - 0.5 * height)
        rows.append((r, z, np.full(columns, wide), np.full(columns, height)))
    r, z, dr, dz = (np.concatenate(part) for part in zip(*rows, strict=True))
    return {
        "time": 1e-9, "position": np.array([r, z]), "width": np.array([dr, dz]),
        "temperature": np.arange(r.size, dtype=float), "surface": (z > -0.25e-6).astype(np.uint8),
        "velocity": np.array([r, np.ones(r.size)]),
    }  # fmt: skip


def volumes(path):
    """Volumes of the cells [m^3] by tetrahedra from their first point, with the sign of VTK."""
    with h5py.File(path) as file:
        root = file["VTKHDF"]
        points = root["Points"][:].astype(float)
        offsets, ids, kinds = (root[name][:] for name in ("Offsets", "Connectivity", "Types"))
    faces = (
        (0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7),
    )  # fmt: skip
    assert set(kinds) == {12}
    found = np.zeros(kinds.size)
    for k in range(kinds.size):
        corner = points[ids[offsets[k] : offsets[k + 1]]]
        for face in faces:
            for a, b in pairwise(face[1:]):
                found[k] += float(np.linalg.det(corner[[face[0], a, b]])) / 6.0
    return found


def test_cells_fill_the_body(tmp_path):
    """Each has a volume above zero, all together that of the cylinder but for its chords; a corner
    on the axis is one point."""
    write_revolved(tmp_path / "body.vtkhdf", section(), None, {"temperature": "K"})
    found = volumes(tmp_path / "body.vtkhdf")
    assert found.size == (COLUMNS + COLUMNS // 2) * SECTORS and np.all(found > 0.0)
    whole = CHORDS * np.pi * WIDTH**2 * DEPTH
    assert found.sum() == pytest.approx(whole, rel=1e-5, abs=0.0)
    with h5py.File(tmp_path / "body.vtkhdf") as file:
        points = file["VTKHDF/Points"][:]
        assert np.count_nonzero(np.hypot(*points[:, :2].T) == 0.0) == 3
        data = file["VTKHDF/CellData"]
        assert data["temperature"].attrs["unit"] == "K"
        u, v, w = data["velocity"][:].T
        assert np.all(w == 1.0) and np.all((u == 0.0) == (v == 0.0))
        step, numbers = section(), data["temperature"][:].astype(int)
        assert np.hypot(u, v) == pytest.approx(step["position"][0, numbers], rel=1e-6, abs=0.0)


def test_cells_end_at_a_surface_that_moves(tmp_path):
    """A dimple takes its volume from the uppermost cells; a cell above it is not shown."""
    step = section()
    line = np.array([step["position"][0, :COLUMNS], np.full(COLUMNS, -0.1e-6)])
    line[1, 0] = -0.3e-6
    write_revolved(tmp_path / "body.vtkhdf", step, line, {})
    found = volumes(tmp_path / "body.vtkhdf")
    assert found.size == (COLUMNS + COLUMNS // 2 - 1) * SECTORS
    rings = np.pi * (WIDTH / COLUMNS) ** 2 * (2 * np.arange(COLUMNS) + 1)
    upper = 0.15e-6 * rings[1:].sum()
    # the first column of the lower row, twice as wide, is cut at the height over its center
    wide = rings[:2].sum()
    lower = 0.75e-6 * np.pi * WIDTH**2
    height = np.interp(WIDTH / COLUMNS, *line)
    lower -= max(-0.25e-6 - height, 0.0) * wide
    assert found.sum() == pytest.approx(CHORDS * (upper + lower), rel=1e-5, abs=0.0)


def test_vtk_reads_it(tmp_path):
    """Cells, fields and the volume by VTK's own filter."""
    pytest.importorskip("vtkmodules.vtkIOHDF", reason="needs vtk, of the extra view")
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
    from vtkmodules.vtkIOHDF import vtkHDFReader

    write_revolved(tmp_path / "body.vtkhdf", section(), None, {})
    reader, said = vtkHDFReader(), []
    reader.AddObserver("ErrorEvent", lambda *_: said.append("error"))
    reader.SetFileName(str(tmp_path / "body.vtkhdf"))
    size = vtkCellSizeFilter()
    size.SetInputConnection(reader.GetOutputPort())
    size.Update()
    assert not said
    data = size.GetOutput().GetCellData()
    found = vtk_to_numpy(data.GetArray("Volume"))
    assert np.all(found > 0.0)
    assert found.sum() == pytest.approx(CHORDS * np.pi * WIDTH**2 * DEPTH, rel=1e-4, abs=0.0)
    assert vtk_to_numpy(data.GetArray("velocity")).shape == (found.size, 3)


def test_export_of_a_run(tmp_path):
    """A section is written beside its run; a plane run is refused in one line."""
    folder = make_run(tmp_path / "run")
    with pytest.raises(OutputError, match="is no section"):
        export(folder, revolve=True)
    content = json.loads((folder / "resolved.json").read_text())
    content["case"]["solver"]["geometry"] = "axisymmetric"
    (folder / "resolved.json").write_text(json.dumps(content))
    path = export(folder, revolve=True, at="57 ns")
    assert path == folder / "body.vtkhdf"
    with h5py.File(path) as file:
        numbers = file["VTKHDF/CellData/temperature"][:]
    step = open_run(folder).snapshots.nearest(57e-9)
    assert numbers.max() == pytest.approx(step["temperature"].max(), rel=1e-6)
