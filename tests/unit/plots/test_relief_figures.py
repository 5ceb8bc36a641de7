"""Figures, files and exports of a relief: made-up lines beside a made-up pool, read from files."""

import re
from dataclasses import replace

import h5py
import numpy as np
import pytest
import synthetic_flow
from synthetic_run import NM, PERIOD

from lasersph.case import load_case
from lasersph.cli import main
from lasersph.observers import Observers, View
from lasersph.observers.relief import Relief
from lasersph.observers.topography import Topography
from lasersph.output import OutputError, open_run
from lasersph.output.export import export
from lasersph.output.particle_file import ParticleFile
from lasersph.plots import style
from lasersph.plots.flow_fields import plane_flow, pool_frame, raster
from lasersph.plots.relief import (
    final_relief,
    lines_of,
    relief_after_pulses,
    relief_map,
    relief_profiles,
    topography_history,
)
from lasersph.simulation import run
from lasersph.simulation.recipes.conduction import ConductionRecipe

X = (np.arange(60) + 0.5) * 0.5 * PERIOD / 60


def height(share):
    """A cosine that deepens to 50 nm [m]."""
    return -50 * NM * share * np.cos(2 * np.pi * X / PERIOD)


@pytest.fixture(scope="module")
def pool(tmp_path_factory):
    """A run of a pool with a line at each of its snapshots, and the columns of its history."""
    found = open_run(synthetic_flow.make_pool_run(tmp_path_factory.mktemp("relief") / "run"))
    file = ParticleFile(found.path / "surface.vtkhdf", "Lines")
    times = found.snapshots.times
    for time in times:
        file.append(float(time), np.array([X, height(time / times[-1])]), {})
    share = found.history["time_s"] / times[-1]
    for name, size in (("depth", 50), ("rim_height", 50), ("Pa", 32), ("Pq", 35)):
        found.history[f"topography.{name}_m"] = size * NM * share
    found.history["topography.peak_to_valley_m"] = 100 * NM * share
    return found


def test_lines_are_mirrored(pool):
    """Half a period is shown whole, at every snapshot."""
    times, x, z = lines_of(pool)
    assert z.shape == (times.size, 2 * X.size) and np.all(np.diff(x) > 0.0)
    assert z[-1] == pytest.approx(np.concatenate([height(1.0)[::-1], height(1.0)]))


def test_figures_name_their_units(pool):
    """Every label of an axis ends in a unit; the profiles and the map hold the deepest relief."""
    figures = [relief_profiles(pool), relief_map(pool), final_relief(pool)]
    figures.append(topography_history(pool))
    for figure in figures:
        texts = [text for axes in figure.axes for text in (axes.get_xlabel(), axes.get_ylabel())]
        assert all(re.search(r"\[.+\]$", text) for text in texts if text)
    lowest = min(np.min(line.get_ydata()) for line in figures[0].axes[0].lines)
    assert lowest == pytest.approx(-50.0, rel=1e-3)


def test_pictures_hold_the_rim(pool):
    """Their frame ends above the highest rim; above the metal nothing is drawn."""
    flow = plane_flow(pool, 52e-9)
    frame = pool_frame(pool, flow)
    assert 50 * NM < frame.top < 120 * NM
    _, z, velocity = flow.on_grid(frame, 4, 40)
    assert np.all(np.isnan(velocity[:, z > 30 * NM]))
    metal = raster(flow, frame, (40, 4)).metal()
    assert np.all(np.isnan(metal[z > 30 * NM])) and np.all(metal[z < 0.0] == 1.0)


def test_trains(pool):
    """The relief after each pulse before a pause and after the last; the rest shows the last pulse,
    whose time counts from its start."""
    train = open_run(pool.path)
    times, _, z = lines_of(pool)
    train.events = [{"event": "pause", "time_s": times[number]} for number in (4, 7, 9)]
    figure = relief_after_pulses(train)
    assert [text.get_text() for text in figure.legends[0].get_texts()] == [
        "1 pulse",
        "2 pulses",
        "4 pulses",
    ]
    shown = [line.get_ydata() / 1e9 for line in figure.axes[0].lines]
    assert shown == [pytest.approx(z[number]) for number in (3, 6, -1)]
    lines = relief_profiles(train).axes[0].lines
    assert len(lines) <= times.size - 9
    assert lines[0].get_ydata() / 1e9 == pytest.approx(z[9])
    assert relief_map(train).axes[0].get_ylim()[1] < 1.1e9 * (times[-1] - times[9])
    assert relief_after_pulses(pool) is None


def test_flat_run_has_none(pool, monkeypatch, tmp_path):
    """Without lines no figure is drawn."""
    monkeypatch.setattr(style, "save", lambda figure, path: path)
    flat = open_run(synthetic_flow.make_pool_run(tmp_path / "flat"))
    for draw in (relief_profiles, relief_map, final_relief, topography_history):
        assert draw(flat) is None


def test_line_in_the_layout_of_vtkhdf(pool):
    """One line cell through all points, found by its offsets in every step."""
    with h5py.File(pool.path / "surface.vtkhdf") as stored:
        root = stored["VTKHDF"]
        assert list(root["Lines/NumberOfCells"]) == [1]
        assert list(root["Lines/NumberOfConnectivityIds"]) == [X.size]
        assert list(root["Lines/Offsets"]) == [0, X.size]
        assert list(root["Vertices/NumberOfCells"]) == [0]
        assert not np.any(root["Steps/CellOffsets"][:])
        count = int(root["Steps"].attrs["NSteps"])
    file = ParticleFile(pool.path / "surface.vtkhdf", "Lines")
    before = [step["position"] for step in pool.surface]
    file.cut(count - 2)
    file.append(1.0, before[0], {})
    file.cut(count - 2)
    again = open_run(pool.path).surface
    assert [np.array_equal(a["position"], b) for a, b in zip(again, before, strict=False)] == [
        True
    ] * (count - 2)
    for number in (count - 2, count - 1):
        file.append(float(pool.surface.times[number]), before[number], {})


def test_relief_as_arrays(pool, tmp_path):
    """Places and heights of the whole period in meters, at the end or at a time."""
    relief = pool.relief()
    assert relief.x == pytest.approx(np.concatenate([-X[::-1], X]))
    assert relief.z[0] == pytest.approx(np.concatenate([height(1.0)[::-1], height(1.0)]))
    assert relief.units["z"] == "m"
    assert np.all(pool.relief(0.0).z == 0.0)
    flat = open_run(synthetic_flow.make_pool_run(tmp_path / "flat"))
    with pytest.raises(OutputError, match="flat: a height map needs"):
        flat.relief()


def test_export_at_a_time(pool):
    """Seconds and a text with a unit are the same; another format is refused."""
    times = pool.snapshots.times
    texts = [
        export(pool, at=at).read_text() for at in (float(times[1]), f"{1e9 * times[1]} ns", None)
    ]
    assert texts[0] == texts[1] != texts[2]
    with pytest.raises(OutputError, match='no format "obj"'):
        export(pool.path, "obj")


def test_export(pool, capsys):
    """The whole period as CSV, whose half was computed, and triangles extruded by its width."""
    assert main(["export", str(pool.path)]) == 0
    rows = (pool.path / "surface-profile.csv").read_text().splitlines()
    assert rows[0] == "x_m,y_m,z_m" and len(rows) == 1 + 2 * X.size
    x, _, z = np.array([[float(text) for text in row.split(",")] for row in rows[1:]]).T
    assert np.ptp(np.diff(x)) < 1e-6 * (x[1] - x[0]) and x[0] == pytest.approx(-X[-1])
    assert z == pytest.approx(-50 * NM * np.cos(2 * np.pi * x / PERIOD), rel=1e-6)
    assert main(["export", str(pool.path), "--format", "ply"]) == 0
    text = (pool.path / "surface-profile.ply").read_text()
    assert f"element vertex {4 * X.size}" in text
    corners = np.array([line.split() for line in text.splitlines()[10 : 10 + 4 * X.size]], float)
    assert np.ptp(corners[:, 1]) == pytest.approx(np.ptp(corners[:, 0]))
    assert f"element face {2 * (2 * X.size - 1)}" in text
    capsys.readouterr()


class WithRelief(ConductionRecipe):
    """Heat alone, under a surface that somebody else has moved."""

    def view(self, solver, step, limit) -> View:
        """The state with a relief that grows with the time."""
        view = super().view(solver, step, limit)
        x = np.sort(view.position[0, view.surface])
        return replace(view, relief=Relief(x, -1e-3 * view.time * np.cos(np.pi * x / x[-1])))

    def observers(self, iterations):
        """With the observer of the relief."""
        return Observers([*super().observers(iterations).members, Topography()])


def test_run_writes_line_profile_and_numbers(tmp_path):
    """surface.vtkhdf beside each snapshot, surface.csv, `topography` in summary and history."""
    settings = ["solver.kind=conduction", "particles.spacing=100 nm", "time.end=5 ns", "probes="]
    case = load_case("dlip-steel", [*settings, "output.snapshots.interval=1 ns"])
    folder = tmp_path / "run"
    summary = run(case, folder, threads=1, recipe=WithRelief).summary
    found = open_run(folder)
    assert np.array_equal(found.surface.times, found.snapshots.times)
    rows = np.loadtxt(folder / "surface.csv", delimiter=",", skiprows=1)
    assert rows[:, 1] == pytest.approx(found.surface[-1]["position"][1], rel=1e-6)
    assert summary["topography"]["depth_m"] == pytest.approx(5e-12, rel=1e-2)
    assert found.history["topography.depth_m"][-1] == summary["topography"]["depth_m"]
