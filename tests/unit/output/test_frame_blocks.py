"""Frames for a viewer: an index that is small, exact blocks, names that cannot be forged."""

import json
import os

import h5py
import numpy as np
import pytest
import synthetic_run

from lasersph.output import OutputError, frame_blocks, open_run
from lasersph.output.frame_blocks import levels_of, particle_block, particle_index


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return synthetic_run.make_run(tmp_path_factory.mktemp("frames") / "run")


def name_of(index, field, frame, file="particles"):
    where = index if file == "particles" else index["surface"]
    place = f"{where['blocks'][field][frame]}.{where['counts'][frame]}"
    return f"{file}.{field}.{place}.{index['stamp']}"


def test_index_says_what_there_is(folder):
    """Times, fields with unit and range over all frames, and the hottest frame first."""
    index = json.loads(json.dumps(particle_index(folder), allow_nan=False))
    steps = list(open_run(folder).snapshots)
    assert index["times"] == [step["time"] for step in steps]
    assert (index["dimensions"], index["is_complete"]) == (2, True)
    hottest = [float(step["temperature"].max()) for step in steps]
    fields = {field["name"]: field for field in index["fields"]}
    assert fields["temperature"]["unit"] == "K"
    assert fields["temperature"]["range"][1] == max(hottest)
    as_hot = [k for k, one in enumerate(hottest) if one == max(hottest)]
    assert index["start"] == as_hot[len(as_hot) // 2] > as_hot[0]
    assert "width" not in fields
    assert index["surface"] is None
    x = steps[0]["position"][0]
    assert index["bounds"][0] == [pytest.approx(x.min()), pytest.approx(x.max())]


def test_blocks_are_the_stored_arrays(folder):
    """Positions as (n, 3), scalars as (n,), little-endian float32; equal blocks have one name."""
    index = particle_index(folder)
    step = open_run(folder).snapshots[5]
    found = np.frombuffer(particle_block(folder, name_of(index, "temperature", 5)), "<f4")
    assert np.array_equal(found, step["temperature"])
    points = np.frombuffer(particle_block(folder, name_of(index, "position", 5)), "<f4")
    assert np.array_equal(points.reshape(-1, 3)[:, [0, 2]].T, step["position"].astype("f4"))
    assert name_of(index, "position", 5) == name_of(index, "position", 0)


@pytest.mark.parametrize(
    ("name", "error"),
    [
        ("temperature", ValueError),
        ("particles.temperature.-5.10.STAMP", ValueError),
        ("particles.temperature.0.99999999999999999999.STAMP", ValueError),
        ("particles.../case.toml.0.1.STAMP", ValueError),
        ("particles.temperature.0.COUNT.STAMP\n", ValueError),
        ("particles.temperature.٠.COUNT.STAMP", ValueError),
        ("history.temperature.0.COUNT.STAMP", ValueError),
        ("particles.temperature.0.999999999.STAMP", KeyError),
        ("particles.temperature.1.COUNT.STAMP", KeyError),
        ("particles.secret.0.COUNT.STAMP", KeyError),
        ("surface.position.0.COUNT.STAMP", KeyError),
        ("particles.temperature.0.COUNT.0123-45", KeyError),
    ],
)
def test_wrong_names_are_refused(folder, name, error):
    """Only blocks that a frame of this run has are read, whatever the name."""
    index = particle_index(folder)
    name = name.replace("STAMP", index["stamp"]).replace("COUNT", str(index["counts"][0]))
    with pytest.raises(error):
        particle_block(folder, name)


def test_a_run_computed_anew_has_other_names(tmp_path):
    """What a browser kept of a removed run is not asked for again, nor served."""
    folder = synthetic_run.make_run(tmp_path / "run", dimension=1)
    before = particle_index(folder)
    os.utime(folder / "resolved.json", ns=(1, 1))
    assert particle_index(folder)["stamp"] != before["stamp"]
    with pytest.raises(KeyError):
        particle_block(folder, name_of(before, "temperature", 0))


def test_a_file_without_ranges_is_scanned(tmp_path):
    """Snapshots of an earlier version give the same index."""
    folder = synthetic_run.make_run(tmp_path / "run", dimension=3)
    before = particle_index(folder)
    with h5py.File(folder / "particles.vtkhdf", "r+") as file:
        del file["ranges"]
    assert particle_index(folder) == before


def test_a_frame_waits_for_its_line(folder, monkeypatch):
    """Frames whose line of the surface is not written yet are not offered."""
    whole = frame_blocks.frames_of(folder / "particles.vtkhdf")
    line = {**whole, "times": whole["times"][:3], "counts": whole["counts"][:3]}
    files = {"particles.vtkhdf": whole, "surface.vtkhdf": line}
    monkeypatch.setattr(frame_blocks, "frames_of", lambda path: files[path.name])
    index = particle_index(folder)
    assert len(index["times"]) == len(index["counts"]) == len(index["surface"]["counts"]) == 3
    assert index["start"] < 3
    assert {len(offsets) for offsets in index["blocks"].values()} == {3}


def test_levels_of_a_metal():
    """Melting and boiling, where the material says them."""
    tables = {"melting": {"solidus": 1673.0, "liquidus": 1727.0}, "vaporization": None}
    assert levels_of(tables) == {"melts": 1727.0}
    assert levels_of({}) == {}


def test_before_the_first_snapshot(tmp_path):
    """No frames and no fields, instead of an error; no run is one."""
    folder = synthetic_run.make_run(tmp_path / "run", dimension=1)
    (folder / "particles.vtkhdf").unlink()
    index = particle_index(folder)
    assert (index["times"], index["fields"], index["surface"]) == ([], [], None)
    with pytest.raises(OutputError):
        particle_index(tmp_path)
