"""particles.vtkhdf: layout, cuts, and kills at every moment of an append."""

import os

import h5py
import numpy as np
import pytest

from lasersph.output import transaction
from lasersph.output.errors import OutputError
from lasersph.output.particle_file import ParticleFile
from lasersph.output.reader import Snapshots


def append(file, step, count=40, dimension=2):
    """Add a step whose content follows from its number; positions never change."""
    position = np.random.default_rng(count).random((dimension, count))
    temperature = np.random.default_rng(step).random(count)
    flow = np.random.default_rng(step + 100).random((dimension, count))
    fields = {"temperature": temperature, "velocity": flow, "surface": np.ones(count, np.uint8)}
    file.append(step * 1e-9, position, fields, units={"temperature": "K", "velocity": "m/s"})
    return {"time": step * 1e-9, "position": position, **fields}


def same(found, expected):
    return found["time"] == expected["time"] and all(
        np.array_equal(found[k], expected[k]) and found[k].dtype == expected[k].dtype
        for k in expected
        if k != "time"
    )


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_steps_read_back_exactly(tmp_path, dimension):
    """Every array comes back bit for bit, in its own type, in every dimension."""
    file = ParticleFile(tmp_path / "particles.vtkhdf")
    written = [append(file, k, dimension=dimension) for k in range(4)]
    snapshots = Snapshots(file.path)
    assert len(snapshots) == 4
    assert all(same(found, step) for found, step in zip(snapshots, written, strict=True))
    assert same(snapshots[-1], written[-1])
    assert snapshots.units["temperature"] == "K"
    assert snapshots.nearest(1.4e-9)["time"] == 1e-9
    with pytest.raises(IndexError):
        snapshots[4]


def test_layout_follows_the_vtkhdf_specification(tmp_path):
    """Type, version, vertex cells and step offsets are what VTK's reader looks for."""
    file = ParticleFile(tmp_path / "particles.vtkhdf")
    append(file, 0, count=5)
    append(file, 1, count=5)
    append(file, 2, count=3)
    with h5py.File(file.path) as stored:
        root = stored["VTKHDF"]
        assert root.attrs["Type"] == b"PolyData"
        assert list(root.attrs["Version"]) == [2, 0]
        assert list(root["NumberOfPoints"]) == [5, 3]
        assert list(root["Vertices/NumberOfCells"]) == [5, 3]
        assert list(root["Vertices/Connectivity"]) == [0, 1, 2, 3, 4, 0, 1, 2]
        assert list(root["Vertices/Offsets"]) == [0, 1, 2, 3, 4, 5, 0, 1, 2, 3]
        assert list(root["Lines/Offsets"]) == [0, 0]
        assert root["Points"].shape == (8, 3)
        assert not root["Points"][:, 1].any()
        steps = root["Steps"]
        assert steps.attrs["NSteps"] == 3
        assert list(steps["PartOffsets"]) == [0, 0, 1]
        assert list(steps["PointOffsets"]) == [0, 0, 5]
        assert steps["CellOffsets"][:].tolist() == [[0] * 4, [0] * 4, [5, 0, 0, 0]]
        assert list(steps["PointDataOffsets/temperature"]) == [0, 5, 10]
        assert list(steps["PointDataOffsets/surface"]) == [0, 0, 5]


def test_unchanged_arrays_are_stored_once(tmp_path):
    """Positions of a solid cost nothing after the first step."""
    file = ParticleFile(tmp_path / "particles.vtkhdf")
    for k in range(5):
        append(file, k)
    with h5py.File(file.path) as stored:
        assert stored["VTKHDF/Points"].shape == (40, 3)
        assert stored["VTKHDF/PointData/temperature"].shape == (200,)
        assert stored["VTKHDF/PointData/temperature"].compression == "gzip"


def test_cut_and_go_on(tmp_path):
    """After a cut the file continues as if the later steps had never been."""
    file = ParticleFile(tmp_path / "particles.vtkhdf")
    kept = [append(file, 0), append(file, 1), append(file, 2, count=25)]
    append(file, 3, count=60)
    file.cut(3)
    kept.append(append(file, 4, count=25))
    found = list(Snapshots(file.path))
    assert len(found) == 4
    assert all(same(a, b) for a, b in zip(found, kept, strict=True))
    with h5py.File(file.path) as stored:
        largest = stored["ranges/temperature"][:, 1].tolist()
    assert largest == [float(step["temperature"].max()) for step in kept]
    with pytest.raises(OutputError, match="holds 4 snapshots"):
        file.cut(5)
    file.cut(0)
    assert file.steps == 0


def test_fields_must_stay_the_same(tmp_path):
    """A step with other fields or lengths than the first is refused, and nothing is written."""
    file = ParticleFile(tmp_path / "particles.vtkhdf")
    append(file, 0)
    with pytest.raises(ValueError, match="fields"):
        file.append(1.0, np.zeros((2, 40)), {"temperature": np.zeros(40)})
    with pytest.raises(ValueError, match="number of particles"):
        file.append(1.0, np.zeros((2, 40)), {"temperature": np.zeros(39)})
    assert file.steps == 1


class Killed(BaseException):
    """Stands for the end of the process at a system call."""


def die_at_call(monkeypatch, number):
    """Let the process die at the given call of pwrite, ftruncate, fsync, replace or unlink;
    a dying pwrite writes half of its bytes."""
    calls = [0]

    def dying(function):
        def call(*arguments, **options):
            calls[0] += 1
            if calls[0] > number:
                raise Killed
            if calls[0] == number:
                if function is originals["pwrite"]:
                    descriptor, data, offset = arguments
                    function(descriptor, bytes(data)[: len(data) // 2], offset)
                raise Killed
            return function(*arguments, **options)

        return call

    originals = {name: getattr(os, name) for name in ("pwrite", "ftruncate", "fsync", "replace")}
    for name, function in originals.items():
        monkeypatch.setattr(os, name, dying(function))


def test_a_kill_at_any_system_call_leaves_a_readable_file(tmp_path, monkeypatch):
    """Wherever an append dies, the file holds the steps before, or these and the new one."""
    outcomes = set()
    for number in range(1, 200):
        file = ParticleFile(tmp_path / f"{number}.vtkhdf")
        written = [append(file, k, count=3000) for k in range(2)]
        with monkeypatch.context() as patch:
            die_at_call(patch, number)
            try:
                append(file, 2, count=3000)
                finished = True
            except Killed:
                finished = False
        found = list(Snapshots(file.path))
        assert len(found) in (2, 3)
        assert all(same(a, b) for a, b in zip(found[:2], written, strict=True))
        outcomes.add(len(found))
        file.cut(2)
        again = append(file, 5, count=3000)
        assert same(Snapshots(file.path)[2], again)
        assert not transaction.journal_of(file.path).exists()
        if finished:
            break
    assert finished
    assert outcomes == {2, 3}


def test_full_disk_leaves_the_earlier_steps(tmp_path, monkeypatch):
    """A full disk is one clear line, and the file stays as it was, to the byte."""
    file = ParticleFile(tmp_path / "particles.vtkhdf")
    append(file, 0)
    before = file.path.read_bytes()

    def full(*_):
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(os, "pwrite", full)
        with pytest.raises(OutputError, match="the disk is full"):
            append(file, 1)
    assert file.path.read_bytes() == before
    append(file, 1)
    assert file.steps == 2


def test_damaged_file_is_reported(tmp_path):
    """A file that HDF5 cannot open gives one clear line."""
    path = tmp_path / "particles.vtkhdf"
    path.write_bytes(b"not HDF5" * 100)
    with pytest.raises(OutputError, match="it is damaged"):
        Snapshots(path).times  # noqa: B018
