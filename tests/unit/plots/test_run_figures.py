"""Figures of a run: drawn from files alone, with units on their axes."""

import importlib
import json
import re
import shutil
from dataclasses import replace

import numpy as np
import pytest
import synthetic_run

import lasersph
from lasersph.output import OutputError, open_run
from lasersph.plots import (
    arrangement,
    draw_run,
    melt_pools,
    particle_map,
    surface_profiles,
    surface_temperatures,
)
from lasersph.plots import history as over_time
from lasersph.plots.particle_map import Cells
from lasersph.plots.style import LENGTHS, TIMES, unit_for, without_stairs


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    """Made-up runs in one and two dimensions."""
    place = tmp_path_factory.mktemp("runs")
    return {d: synthetic_run.make_run(place / f"run{d}", dimension=d) for d in (1, 2)}


@pytest.fixture(scope="module")
def run(folders):
    return open_run(folders[2])


def axes_of(figure):
    return [axes for axes in figure.axes if axes.get_label() != "<colorbar>"]


def test_all_figures_of_a_plane_run(folders, tmp_path):
    """Seven figures, as PNG files in reading order, from a copied folder."""
    copy = tmp_path / "copy"
    shutil.copytree(folders[2], copy)
    written = draw_run(copy)
    assert [path.name for path in written] == [
        "temperature.png",
        "melt-pool.png",
        "particles.png",
        "energy.png",
        "surface-profiles.png",
        "time-step.png",
        "arrangement.png",
    ]
    assert all(path.read_bytes().startswith(b"\x89PNG") for path in written)
    assert all(path.parent == copy / "figures" for path in written)


def test_one_figure_by_its_name(run, folders):
    """`lasersph.plot` of a run or its folder; a wrong name is told the nearest, or all of them."""
    for given in (run, folders[2]):
        labels = [axes.get_ylabel() for axes in axes_of(lasersph.plot(given, "temperature"))]
        assert labels == ["temperature [K]"]
    with pytest.raises(ValueError, match=r'no figure "temprature" \(do you mean "temperature"\?\)'):
        lasersph.plot(run, "temprature")
    with pytest.raises(ValueError, match=r'no figure "42"; there are .*temperature, .*melt-pool'):
        lasersph.plot(run, "42")
    with pytest.raises(OutputError, match='has no figure "crater": it has nothing of what it show'):
        lasersph.plot(run, "crater")


def test_one_dimension_leaves_out_what_has_no_meaning(folders):
    """No surface profile, no arrangement; temperature and melt fraction against depth."""
    run = open_run(folders[1])
    assert surface_profiles(run) is None
    assert arrangement(run.snapshots[0]) is None
    labels = [axes.get_ylabel() for axes in axes_of(particle_map(run))]
    assert labels == ["temperature [K]", "melt fraction [1]"]


def test_units_of_history_and_fields(run, folders):
    """Amounts of a section are per length; those of a line per area."""
    assert open_run(run) is run
    names = ("time_s", "temperature_max_K", "energy_stored_J", "melt_volume_m3", "limit")
    assert [run.units[name] for name in names] == ["s", "K", "J/m", "m^2", ""]
    assert open_run(folders[1]).units["energy_stored_J"] == "J/m^2"
    assert run.units.keys() == run.history.keys()
    units = run.snapshots.units
    assert units.keys() == run.snapshots[-1].keys()
    assert (units["time"], units["position"], units["temperature"]) == ("s", "m", "K")


def test_every_axis_names_its_unit(run):
    """Each shown axis label ends in a unit in brackets."""
    figures = [
        over_time.temperature_history(run),
        over_time.melt_pool_history(run),
        over_time.energy_history(run),
        over_time.time_step_history(run),
        surface_profiles(run),
        particle_map(run),
        arrangement(run.snapshots[0]),
        surface_temperatures([run]),
        melt_pools([run, run], ["a", "b"]),
    ]
    for figure in figures:
        for axes in axes_of(figure):
            labels = [text for text in (axes.get_xlabel(), axes.get_ylabel()) if text]
            assert axes.get_ylabel()
            assert all(re.search(r"\[.+\]$", text) for text in labels), labels


def test_equal_time_steps_lie_below_the_edge(run, monkeypatch):
    """Dots at the upper edge of the axes would be halves, or nothing."""
    history = dict(run.history)
    history["time_step_s"] = np.where(history["time_step_s"] > 0.0, 5e-11, 0.0)
    monkeypatch.setitem(vars(run), "history", history)
    axes = over_time.time_step_history(run).axes[0]
    assert axes.get_ylim() == pytest.approx((0.0, 55.0))


def test_temperature_curve_is_the_history(run):
    """The curve holds the numbers of history.csv, time in ns; a probe there shares its line."""
    figure = over_time.temperature_history(run)
    labels = [line.get_label() for line in figure.axes[0].lines]
    line = figure.axes[0].lines[0]
    assert labels[0] == "surface at x = 0, probe surface"
    assert "probe surface" not in labels
    assert np.array_equal(line.get_ydata(), run.history["temperature_at_maximum_K"])
    assert line.get_xdata()[-1] == pytest.approx(200.0)


def test_profile_is_mirrored_at_half_a_period(run):
    """A run of half a period is shown over the whole one."""
    figure = surface_profiles(run, [50e-9])
    x, temperature = figure.axes[0].lines[0].get_data()
    assert np.allclose(x, -x[::-1])
    assert np.array_equal(temperature, temperature[::-1])


def test_unfinished_run_is_drawn(tmp_path):
    """A running or broken-off run has figures too; an empty one says so."""
    folder = synthetic_run.make_run(tmp_path / "run", dimension=1, complete=False)
    assert len(draw_run(folder)) == 5
    (folder / "history.csv").unlink()
    with pytest.raises(OutputError, match="no history to draw yet"):
        draw_run(folder)


def test_without_light_and_melt(tmp_path):
    """Nothing melts: no figure of the melt pool."""
    run = open_run(synthetic_run.make_run(tmp_path / "run", dimension=1, strength=0.1))
    assert over_time.melt_pool_history(run) is None
    assert particle_map(run) is not None


def test_without_phase_change_no_empty_map_of_melt(tmp_path):
    """Where melting was not computed, temperature stands alone; an unfinished run shows both."""
    folder = synthetic_run.make_run(tmp_path / "run", strength=0.1)
    assert len(axes_of(particle_map(open_run(folder)))) == 2
    summary = json.loads((folder / "summary.json").read_text())
    summary["material"]["solidus_K"] = None
    (folder / "summary.json").write_text(json.dumps(summary))
    assert len(axes_of(particle_map(open_run(folder)))) == 1


def test_fluences_label_the_curves(run):
    """Several runs are told apart by their fluence in J/cm2."""
    figure = surface_temperatures([run])
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    assert "0.6 J/cm$^2$" in texts


def test_stairs_are_drawn_through_their_middles():
    """Each value once, in the middle of the time for which it stood; zeros stay."""
    times = np.arange(9.0)
    values = np.array([0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 0.0, 0.0, 0.0])
    x, y = without_stairs(times, values)
    assert list(x) == [0.0, 1.0, 3.0, 5.0, 6.0, 8.0]
    assert list(y) == [0.0, 0.0, 1.0, 2.0, 0.0, 0.0]
    x, y = without_stairs(times[:6], np.array([0.0, 1.0, 1.0, 2.0, 2.0, 2.0]))
    assert list(x) == [0.0, 1.5, 4.0, 5.0] and list(y) == [0.0, 1.0, 2.0, 2.0]


def test_picture_shows_the_closest_cell():
    """Two cells side by side, mirrored: four columns of pixels, nothing outside."""
    cells = Cells(np.array([[0.5, 1.5], [-0.5, -0.5]]), np.ones((2, 2)), np.array([7, 8]))
    picture = cells.mirrored().picture()
    assert cells.mirrored().frame == (-2.0, 2.0, -1.0, 0.0)
    quarter = picture.shape[1] // 4
    assert [picture[10, quarter * k + 5] for k in range(4)] == [8, 7, 7, 8]
    alone = Cells(np.array([[0.5, 9.5], [-0.5, -0.5]]), np.ones((2, 2)), np.array([7, 8]))
    assert alone.picture()[10, picture.shape[1] // 2] == -1


def test_picture_ends_at_the_upper_faces():
    """A flat surface is drawn at 0 beside a rim that stands above it; gaps inside are filled."""
    center = np.array([[0.5, 0.5, 1.5, 1.5], [-1.5, -0.5, -1.6, 0.4]])
    cells = Cells(center, np.ones((2, 4)), np.arange(4))
    picture = cells.picture((0.0, 2.0, -2.0, 1.0), (300, 200))
    assert np.count_nonzero(picture[:, 50] >= 0) == 200  # from -2 to 0
    assert np.flatnonzero(picture[:, 150] >= 0).max() == 289  # up to 0.9
    assert picture[99, 150] >= 0  # half way between two cells that are twice their height apart


def test_rim_is_inside_the_map(run, monkeypatch):
    """The axes of a map reach above the highest cell of a surface that moved."""
    maps = importlib.import_module("lasersph.plots.particle_map")
    original = maps.cells_of_cut
    monkeypatch.setattr(
        maps,
        "cells_of_cut",
        lambda step, depth: replace(
            cells := original(step, depth),
            center=cells.center + np.array([[0.0], [0.2 * depth]]),
        ),
    )
    for axes in axes_of(particle_map(run)):
        (image,) = axes.images
        assert image.get_extent()[3] > 0.0
        assert axes.get_ylim()[1] > image.get_extent()[3]


def test_units_suit_the_numbers():
    """200 ns, 5 um, 50 ps are shown as such."""
    assert unit_for(200e-9, TIMES).name == "ns"
    assert unit_for(50e-12, TIMES).name == "ps"
    assert unit_for(5e-6, LENGTHS).name == "µm"
    assert unit_for(270e-9, LENGTHS).name == "nm"
    assert unit_for(3.0, TIMES).name == "s"
