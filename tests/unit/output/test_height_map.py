"""Height maps of craters and their files, read back by hand."""

from __future__ import annotations

import numpy as np
import pytest
import synthetic_ablation
from synthetic_ablation import DX, NS

from lasersph.observers import snapshot_fields
from lasersph.output import OutputError
from lasersph.output.height_map import HeightMap, height_map


def step(dimension):
    """A snapshot at the end of the pulse, as it is read back."""
    view = synthetic_ablation.view_at(10 * NS, 20, dimension)
    return {"time": view.time, "position": view.position, **snapshot_fields(view)}


@pytest.fixture
def slope():
    """Four columns rising along x by one column's width [um]."""
    z = np.array([[0.0, 1.0], [0.0, 1.0]]) * 1e-6
    return HeightMap(np.array([0.0, 1e-6]), np.array([0.0, 1e-6]), z, np.zeros((2, 2), int), 1e-9)


@pytest.mark.parametrize("dimension", [2, 3])
def test_map_of_a_crater(dimension):
    """Four layers are gone at the axis, none at the edge, whatever flies above."""
    found = height_map(step(dimension))
    ny, nx = found.z.shape
    assert (ny, nx) == (1 if dimension == 2 else 30, 30)
    assert found.z[ny // 2, nx // 2] == pytest.approx(-4 * DX, abs=1e-12)
    assert found.z[0, 0] == pytest.approx(0.0, abs=1e-12)
    assert found.x[0] == pytest.approx(-2.9e-6)


def test_csv_in_meters(slope, tmp_path):
    """One line a column."""
    lines = slope.write(tmp_path / "crater.csv").read_text().splitlines()
    assert lines[0] == "x_m,y_m,z_m"
    assert lines[2] == "1e-06,0,1e-06"
    assert len(lines) == 5


def test_stl_of_a_slope(slope, tmp_path):
    """Two facets of 50 bytes, normals (-1, 0, 1)/sqrt(2), corners in micrometers."""
    data = slope.write(tmp_path / "crater.stl").read_bytes()
    assert len(data) == 84 + 2 * 50
    assert b"unit um" in data[:80]
    assert int.from_bytes(data[80:84], "little") == 2
    normal = np.frombuffer(data[84:96], "<f4")
    np.testing.assert_allclose(normal, np.array([-1.0, 0.0, 1.0]) / np.sqrt(2.0), rtol=1e-6)
    corners = np.frombuffer(data[96:132], "<f4").reshape(3, 3)
    np.testing.assert_allclose(corners, [[0, 0, 0], [1, 0, 1], [1, 1, 1]], atol=1e-7)


def test_ply_of_a_slope(slope, tmp_path):
    """Four vertices and two faces."""
    lines = slope.write(tmp_path / "crater.ply").read_text().splitlines()
    assert "element vertex 4" in lines and "element face 2" in lines
    start = lines.index("end_header") + 1
    assert lines[start : start + 2] == ["0 0 0", "1 0 1"]
    assert lines[-2:] == ["3 0 1 3", "3 0 3 2"]


def test_hole_is_closed_in_triangles(slope):
    """Where nothing is left a mesh takes the lowest height; the CSV says nan."""
    z = slope.z.copy()
    z[0, 1] = np.nan
    holed = HeightMap(slope.x, slope.y, z, slope.top, slope.time)
    assert holed.vertices()[1, 2] == 0.0
    assert "nan" in holed.as_csv()


def test_refusals(slope, tmp_path):
    """Another ending, a line as a surface, a run without ablation or of one dimension."""
    with pytest.raises(OutputError, match='no format "obj"'):
        slope.write(tmp_path / "crater.obj")
    with pytest.raises(OutputError, match="take csv"):
        height_map(step(2)).write(tmp_path / "crater.stl")
    with pytest.raises(OutputError, match="run with ablation, or a surface that moves"):
        height_map(step(1))
