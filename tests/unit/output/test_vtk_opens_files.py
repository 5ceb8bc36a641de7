"""VTK's own reader opens every VTK file that lasersph writes, and finds in it what was written."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from lasersph.output.image_file import Maps, read_maps, write_maps
from lasersph.output.particle_file import AXES, ParticleFile

pytest.importorskip("vtkmodules.vtkIOHDF", reason="needs vtk, of the extra view")


def opened(path, step=0):
    """Arrays that the reader finds in a step of a file; an error of it is an error of the test."""
    from vtkmodules.vtkIOHDF import vtkHDFReader

    reader, said = vtkHDFReader(), []
    reader.AddObserver("ErrorEvent", lambda *_: said.append("error"))
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    reader.SetStep(step)
    reader.Update()
    assert not said
    return reader.GetOutputDataObject(0)


def arrays_of(data):
    """Arrays at the points, by name."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    fields = data.GetPointData()
    return {
        fields.GetArrayName(k): vtk_to_numpy(fields.GetArray(k))
        for k in range(fields.GetNumberOfArrays())
    }


@pytest.mark.parametrize("shape", [(133, 133), (5, 9)])
def test_maps(tmp_path, shape):
    """All maps of a texture, each value at its place."""
    ny, nx = shape
    x, y = np.linspace(-2e-6, 2e-6, nx), np.linspace(0.0, 3e-6, ny)
    fields = {
        "fluence": np.random.default_rng(1).random(shape),
        "height": 1e-9 * np.add.outer(np.arange(ny), 100.0 * np.arange(nx)),
    }
    path = tmp_path / "maps.vtkhdf"
    write_maps(path, Maps(x, y, fields, {"fluence": "J/m^2", "height": "m"}))
    image = opened(path)
    assert image.GetDimensions() == (nx, ny, 1)
    assert_allclose(image.GetSpacing()[:2], (x[1] - x[0], y[1] - y[0]))
    found = arrays_of(image)
    assert set(found) == set(fields)
    for name, values in fields.items():
        assert_array_equal(found[name].reshape(shape), values.astype(np.float32))
    again = read_maps(path)
    assert_allclose(again.fields["height"], fields["height"], rtol=1e-6)


def test_maps_of_earlier_versions_are_read(tmp_path):
    """Arrays (1, ny, nx), which VTK does not open, are still read here."""
    import h5py

    path, values = tmp_path / "maps.vtkhdf", np.arange(6.0).reshape(2, 3)
    write_maps(path, Maps(np.arange(3.0), np.arange(2.0), {"height": values}, {"height": "m"}))
    with h5py.File(path, "r+") as file:
        points = file["VTKHDF/PointData"]
        del points["height"]
        points.create_dataset("height", data=values[None]).attrs["unit"] = "m"
    assert_array_equal(read_maps(path).fields["height"], values)


@pytest.mark.parametrize("cells", ["Vertices", "Lines"])
@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_particles(tmp_path, dimension, cells):
    """Positions, numbers and vectors of every step, of particles that come and go."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    random, file = np.random.default_rng(dimension), ParticleFile(tmp_path / "p.vtkhdf", cells)
    steps = []
    for k, count in enumerate((7, 7, 5)):
        position = random.random((dimension, count))
        fields = {
            "temperature": random.random(count).astype(np.float32),
            "kind": random.integers(0, 5, count).astype(np.int8),
            "velocity": random.random((dimension, count)),
        }
        file.append(1e-9 * k, position, fields, units={"temperature": "K"})
        steps.append((position, fields))
    for k, (position, fields) in enumerate(steps):
        data = opened(file.path, k)
        points = vtk_to_numpy(data.GetPoints().GetData())
        assert_array_equal(points[:, AXES[dimension]], position.T)
        assert (data.GetNumberOfVerts(), data.GetNumberOfLines()) == (
            (position.shape[1], 0) if cells == "Vertices" else (0, 1)
        )
        found = arrays_of(data)
        assert set(found) == set(fields)
        assert_array_equal(found["temperature"], fields["temperature"])
        assert_array_equal(found["kind"], fields["kind"])
        assert_array_equal(found["velocity"][:, AXES[dimension]], fields["velocity"].T)


def test_triangulated_surface(tmp_path):
    """Triangles of a grid in every step, each with its normal upward; together they cover it."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    shape, file = (7, 5), ParticleFile(tmp_path / "surface.vtkhdf", "Lines")
    x, y = np.meshgrid(0.5 * np.arange(7.0), 0.25 * np.arange(5.0), indexing="ij")
    random = np.random.default_rng(2)
    steps = []
    for k in range(3):
        position = np.stack([x.ravel(), y.ravel(), 1e-3 * random.random(35)])
        fields = {
            "temperature": random.random(35).astype(np.float32),
            "velocity": random.random((3, 35)),
        }
        file.append(1e-9 * k, position, fields, units={"temperature": "K"}, shape=shape)
        steps.append((position, fields))
    file.cut(2)
    file.append(3e-9, *steps[2], shape=shape)
    for k, (position, fields) in enumerate(steps):
        data = opened(file.path, k)
        points = vtk_to_numpy(data.GetPoints().GetData())
        assert_array_equal(points, position.T)
        assert (data.GetNumberOfPolys(), data.GetNumberOfLines()) == (2 * 6 * 4, 0)
        corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        a, b, c = (points[corners[:, n]] for n in range(3))
        upward = 0.5 * np.cross(b - a, c - a)[:, 2]
        assert np.all(upward > 0.0)
        assert_allclose(upward.sum(), np.ptp(x) * np.ptp(y))
        assert_array_equal(arrays_of(data)["temperature"], fields["temperature"])
        assert_array_equal(arrays_of(data)["velocity"], fields["velocity"].T)
