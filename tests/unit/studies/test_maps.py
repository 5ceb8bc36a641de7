"""Process maps of made-up sweeps, whose melting and boiling lines are known."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.stats import qmc
from synthetic_sweep import (
    LIQUIDUS,
    boiling_fluence,
    grid_points,
    made_up_depth,
    made_up_sweep,
    melting_fluence,
)

from lasersph.output import OutputError
from lasersph.studies import box_of, process_map
from lasersph.studies.sweep_numbers import box_of_runs

DEPTH = "melt.depth_max_m"


def errors_of_lines(found, name, exact):
    """Relative distances in fluence of the points of a line from where it should run."""
    points = np.concatenate(found.lines[name])
    return np.abs(points[:, 0] / exact(points[:, 1]) - 1.0)


def field_errors(found):
    """Distances of the field from the made-up depth, where it is known."""
    fluence, duration = np.meshgrid(*(axis.grid for axis in found.axes))
    return np.abs(found.field - made_up_depth(fluence, duration))


def test_lines_of_a_grid(tmp_path):
    """Six fluences and four durations give the melting line to 0.5 %, though depths are zero on
    one side of it; the boiling line to 3 %, though temperatures rest at the boiling point."""
    found = process_map(made_up_sweep(tmp_path, grid_points()), show=DEPTH)
    assert [axis.key for axis in found.axes] == ["laser.fluence", "laser.pulse.fwhm"]
    assert [axis.is_logarithmic for axis in found.axes] == [False, True]
    assert errors_of_lines(found, "melts", melting_fluence).max() < 0.005
    assert errors_of_lines(found, "boils", boiling_fluence).max() < 0.03
    assert found.field.shape == (161, 161) and not np.any(np.isnan(found.field))
    assert found.unit == "m" and found.notes == ()


def test_a_run_at_its_melting_point_says_only_that_it_is_not_fluid(tmp_path):
    """Half-molten metal rests at the melting point: where it gets fluid is known to the next run,
    not to a four hundredth of the way."""
    points = [(fluence, 1e-8) for fluence in (2e3, 4e3, 6e3, 8e3)]
    table = made_up_sweep(tmp_path, points)
    hottest = {"temperature_max_K": LIQUIDUS, "material.liquidus_K": LIQUIDUS}
    numbers = {k: v for k, v in table.rows[1].numbers.items() if k != "melt.start_s"} | hottest
    rows = (table.rows[0], replace(table.rows[1], numbers=numbers), *table.rows[2:])
    found = process_map(replace(table, rows=rows), show=DEPTH)
    (onset,) = (one for one in found.onsets if one.event == "melts")
    assert onset.between == (4e3, 6e3) and onset.estimate is None
    assert onset.known == "bracket" and "melts" not in found.lines


def test_nothing_is_interpolated_over_a_failed_run(tmp_path):
    """The cells of the grid that a failed run is a corner of stay empty, no others."""
    points = grid_points()
    failed = points.index((points[9][0], points[9][1]))
    found = process_map(made_up_sweep(tmp_path, points, failed={failed}), show=DEPTH)
    fluence, duration = np.meshgrid(*(axis.grid for axis in found.axes))
    near = np.abs(fluence - points[failed][0]) < 1.999e3
    near &= np.abs(np.log(duration / points[failed][1])) < 0.999 * np.log(50.0) / 3.0
    assert np.all(np.isnan(found.field[near]))
    assert not np.any(np.isnan(found.field[np.abs(fluence - points[failed][0]) > 2.01e3]))
    assert found.notes == ("1 of 24 runs has no result: nothing is interpolated there.",)
    assert list(found.is_usable).count(False) == 1


@pytest.mark.parametrize("emulate", [False, True])
def test_scattered_runs(tmp_path, emulate):
    """A Sobol sequence: right within its hull, nothing outside; the emulator says how surely."""
    box = box_of((2e3, 1e-9), (1.2e4, 5e-8), (False, True))
    points = box.restored(qmc.Sobol(2, rng=1).random(32))
    table = made_up_sweep(tmp_path, [tuple(point) for point in points])
    found = process_map(table, show=DEPTH, emulate=emulate, target=1e-7)
    known = np.isfinite(found.field)
    assert 0.5 < known.mean() < 0.95
    errors = field_errors(found)[known]
    assert np.sqrt(np.mean(errors**2)) < 0.05 * np.nanmax(found.values)
    # where a run has just not melted the extrapolated twice its threshold carries no weight
    assert np.median(errors_of_lines(found, "melts", melting_fluence)) < 0.01
    assert np.median(errors_of_lines(found, "target", lambda t: 2 * melting_fluence(t))) < 0.02
    assert (found.deviation is not None) == emulate
    if emulate:
        assert found.deviation is not None and np.all(found.deviation[known] > 0.0)
        assert np.mean(errors < 2.0 * found.deviation[known] + 1e-10) > 0.8
        assert found.field[known].min() >= 0.0


def test_one_key(tmp_path):
    """A line with its band; melting at a point."""
    points = [(fluence, 1e-8) for fluence in np.linspace(2e3, 8e3, 7)]
    found = process_map(made_up_sweep(tmp_path, points), show=DEPTH, emulate=True, target=5e-8)
    assert found.field.shape == found.axes[0].grid.shape
    assert found.deviation is not None and np.nanmax(found.deviation) < 1e-8
    assert_allclose(found.lines["melts"][0][:, 0], [4e3], rtol=1e-3)
    assert_allclose(found.lines["target"][0][:, 0], [6e3], rtol=0.02)
    beyond = process_map(tmp_path, show=DEPTH, target=5e-7)
    assert "target" not in beyond.lines
    assert beyond.notes[-1] == "500 nm lies nowhere between the runs."


def test_an_event_of_no_run_has_no_line(tmp_path):
    """Up to 0.8 J/cm2 nothing boils: a word says which runs would tell where boiling begins; above
    0.5 J/cm2 everything melts."""
    points = [(fluence, 1e-8) for fluence in np.linspace(5e3, 8e3, 4)]
    found = process_map(made_up_sweep(tmp_path, points), show=DEPTH)
    assert not found.lines and not found.bands and not found.onsets
    assert found.notes == (
        "Every run melts: colder runs (laser.fluence below 0.5 J/cm²) "
        "would tell where melting begins.",
        "No run boils: hotter runs (laser.fluence above 0.8 J/cm²) "
        "would tell where boiling begins.",
    )


def test_ends_are_those_of_complete_runs(tmp_path):
    """Of a sweep that is half done: runs above 0.6 J/cm2 are still to come, or have failed."""
    points = [(fluence, t) for fluence in (5e3, 6e3, 7e3, 8e3) for t in (10e-9, 10.5e-9)]
    found = process_map(made_up_sweep(tmp_path, points, failed={4, 5, 6, 7}), show=DEPTH)
    assert any("hotter runs (laser.fluence above 0.6 J/cm²)" in text for text in found.notes)


@pytest.mark.parametrize("count", [3, 4, 6, 11])
def test_bands_hold_the_true_lines(tmp_path, count):
    """On grids of any fineness the exact melting and boiling fluences lie within their bands, and
    boiling, of which a bracket alone is known, between the two runs around it."""
    fluences = np.linspace(2e3, 1.2e4, count)
    points = [(f, t) for f in fluences for t in np.geomspace(5e-9, 2e-8, 3)]
    found = process_map(made_up_sweep(tmp_path, points), show=DEPTH)
    exact = {"melts": melting_fluence, "boils": boiling_fluence}
    seen = 0
    for onset in found.onsets:
        low, high = onset.between
        true = exact[onset.event](onset.at)
        if onset.known in ("measured", "bracket"):
            assert low <= true * (1.0 + 1e-9) and true <= high * (1.0 + 1e-9)
            assert onset.event in found.bands
            seen += 1
        if onset.event == "boils" and onset.known == "bracket":
            around = np.searchsorted(fluences, true)
            assert_allclose((low, high), fluences[around - 1 : around + 1], rtol=1e-9)
    assert seen >= 4


def test_no_line_sits_on_a_run(tmp_path):
    """With one run that does not boil nothing can be extrapolated: the whole cell between the runs
    is shaded and no line is drawn."""
    points = [(f, t) for f in (6e3, 1.1e4, 1.6e4) for t in (5e-9, 1e-8)]
    found = process_map(made_up_sweep(tmp_path, points), show=DEPTH)
    assert "boils" not in found.lines
    assert [(one.at, one.known, one.between) for one in found.onsets] == [
        (5e-9, "bracket", (6e3, 1.1e4)),
        (1e-8, "bracket", (6e3, 1.1e4)),
    ]
    (ring,) = found.bands["boils"]
    assert_allclose(ring.min(axis=0), (6e3, 5e-9), rtol=0.01)
    assert_allclose(ring.max(axis=0), (1.1e4, 1e-8), rtol=0.01)
    assert found.onset_words()[1] == ("boiling", "10 ns: between 0.6 J/cm² and 1.1 J/cm²")


def test_keys_in_the_wanted_order(tmp_path):
    """y alone puts the other key on x."""
    found = process_map(made_up_sweep(tmp_path, grid_points()), y="laser.fluence", show=DEPTH)
    assert [axis.key for axis in found.axes] == ["laser.pulse.fwhm", "laser.fluence"]


def test_box_counts_keys_as_the_runs_lie():
    """Evenly, evenly in the logarithm, and through zero."""
    points = np.stack([np.linspace(1, 9, 5), np.geomspace(1, 9, 5), np.linspace(-1, 1, 5)], axis=1)
    assert box_of_runs(points).logarithmic.tolist() == [False, True, False]


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ({"x": "laser.fluenze"}, 'laser.fluenze does not vary .* "laser.fluence"'),
        ({"x": "laser.fluence", "y": "laser.fluence"}, "x and y are both"),
    ],
)
def test_refused_keys(tmp_path, arguments, text):
    """Keys that no map has."""
    table = made_up_sweep(tmp_path, grid_points())
    with pytest.raises(ValueError, match=text):
        process_map(table, show=DEPTH, **arguments)


def test_refused_sweeps(tmp_path):
    """Too few runs, an unknown number, no sweep."""
    points = grid_points()
    (tmp_path / "few").mkdir()
    (tmp_path / "all").mkdir()
    failed = set(range(2, 24))
    with pytest.raises(ValueError, match=r"only 2 of 24 runs have melt\.depth_max_m"):
        process_map(made_up_sweep(tmp_path / "few", points, failed=failed), show=DEPTH)
    with pytest.raises(KeyError, match="no run has a number"):
        process_map(made_up_sweep(tmp_path / "all", points), show="melt.depth_mx_m")
    with pytest.raises(OutputError):
        process_map(tmp_path / "none")
