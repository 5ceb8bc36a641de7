"""A measured profile beside ours: a hidden factor is found, what cannot be compared is refused."""

import json

import numpy as np
import pytest
import synthetic_flow
import synthetic_run
from scipy.ndimage import uniform_filter
from texture_cells import HIGHEST, PERIOD, spot, table
from texture_cells import relief as made_up

from lasersph.cli import main
from lasersph.output import open_run
from lasersph.output.atomic import replace_json
from lasersph.output.height_map import HeightMap
from lasersph.output.image_file import Maps, write_maps
from lasersph.output.particle_file import ParticleFile
from lasersph.report.comparison_page import unknown_rows
from lasersph.studies.texture import compare as comparing
from lasersph.studies.texture import relief
from lasersph.studies.texture.compare import compare
from lasersph.studies.texture.measurement import NoComparison, correlated_points, refuse_odd
from lasersph.studies.texture.relief import Relief, read_relief

NM, UM = 1e-9, 1e-6


@pytest.fixture(scope="module")
def ours():
    """A spot with 0.9 of the fluence that the cells reach."""
    x = np.arange(-24e-6, 24.01e-6, 0.125e-6)
    fluence = spot(center=0.9 * HIGHEST).at(*np.meshgrid(x, x))
    return Relief("texture", table(), x, x, fluence, 0.1 * NM)


def measurement(ours, factor, seed, scale=1.01, noise=5 * NM, rows=1, count=500, turn=0.0):
    """A profile (or a map) of 44 um of a relief with a factor on its fluence, tilted and moved."""
    random = np.random.default_rng(seed)
    x, y = np.linspace(-22 * UM, 22 * UM, count), np.linspace(-8 * UM, 8 * UM, rows)
    y = np.zeros(1) if rows == 1 else y
    X, Y = np.meshgrid(x, y)
    x_0, cosine, sine = (X - 0.7 * UM) / scale, np.cos(turn), np.sin(turn)
    z = ours.at(cosine * x_0 + sine * Y / scale, cosine * Y / scale - sine * x_0, factor)
    z = z + 3 * NM + 2e-3 * X + 1e-3 * Y + noise * random.normal(size=X.shape)
    return HeightMap(x - x[0], y - y[0], z)


def test_hidden_factor(ours):
    """Factor, lateral scale and place come back , at two factors."""
    for seed, factor in enumerate((0.87, 1.05)):
        found = compare(ours, measurement(ours, factor, seed, scale=0.99))
        for name, hidden in (("fluence_factor", factor), ("lateral_scale", 0.99)):
            assert abs(found.values[name] - hidden) < 3.0 * found.errors[name]
            assert found.errors[name] < 0.01
        assert found.noise == pytest.approx(5 * NM, rel=0.15)
        assert found.height_factor[0] == pytest.approx(1.0, abs=4.0 * found.height_factor[1])
        assert "no more than noise" in comparing.sentence(found)
        heights = comparing.answer(found)["peak_to_valley"]
        assert heights == {"measured_m": np.ptp(found.measured), "computed_m": np.ptp(found.ours)}


def test_map(ours):
    """A height map is leveled in both directions and turned; it tells the factor more surely."""
    found = compare(ours, measurement(ours, 0.95, 1, rows=20, count=160, turn=0.1))
    assert abs(found.values["rotation_rad"] - 0.1) < 3.0 * found.errors["rotation_rad"] < 0.01
    assert abs(found.values["fluence_factor"] - 0.95) < 3.0 * found.errors["fluence_factor"]
    assert found.errors["fluence_factor"] < 0.004


def test_points_that_are_correlated():
    """Waves of a wrong model count along both directions, noise does not."""
    x = np.linspace(0.0, 1.0, 80)
    noise = np.random.default_rng(0).normal(size=(80, 80))
    blurred = uniform_filter(noise, 4, mode="wrap")
    found = [correlated_points(z.ravel(), HeightMap(x, x, z), 10_000) for z in (noise, blurred)]
    assert found[0] == pytest.approx(1.0, abs=0.2)
    assert found[1] == pytest.approx(16.0, rel=0.3)
    assert correlated_points(blurred[0], HeightMap(x, x[:1], blurred[:1]), 1) < 6.0


def test_end_of_the_cells(ours):
    """A factor above what the cells cover is said, not extrapolated."""
    hot = Relief("hot", ours.table, ours.x, ours.y, ours.fluence / 0.9, 0.0)
    found = compare(hot, measurement(ours, 1.0 / 0.9, 3))
    assert "compute a texture of more pulse energy" in comparing.sentence(found)


def test_intervals_end_at_their_bounds(ours):
    """A factor at the end of what the cells cover has an interval with one end, in file and page;
    one within lies between two."""
    hot = Relief("hot", ours.table, ours.x, ours.y, ours.fluence / 0.9, 0.0)
    found = compare(hot, measurement(ours, 1.0 / 0.9, 3))
    assert "fluence_factor" in found.at_bound
    low, high = found.interval("fluence_factor")
    assert low < high == pytest.approx(found.values["fluence_factor"], rel=1e-9)
    assert high <= hot.largest_factor * (1.0 + 1e-9)
    (row,) = (one for one in unknown_rows(comparing.answer(found)) if one[0].startswith("factor"))
    assert row[2] == "at its bound" and row[3].endswith(" or more")
    assert f"{low:.4g} or more" in comparing.sentence(found)


def test_place_in_coordinates_of_the_measurement(ours):
    """Our center is told where the measurement's own x has it, wherever its zero is."""
    surface = measurement(ours, 0.95, 6, scale=1.0)
    for start in (0.0, 100 * UM):
        moved = HeightMap(surface.x + start, surface.y, surface.z)
        content = comparing.answer(compare(ours, moved))
        assert content["origin_in_measurement"]["x_m"] == pytest.approx(
            start + 22.7 * UM, abs=0.1 * UM
        )
    rows = dict(row[:2] for row in unknown_rows(content))
    assert rows["our x = 0 lies at this x of the measurement"].startswith("122.")


def test_a_period_without_its_last_point(tmp_path):
    """A profile of a cell that repeats ends one step before the next period; its own export, too,
    is compared with it."""
    x = np.arange(100) * PERIOD / 100
    refuse_odd(HeightMap(x, np.zeros(1), 30 * NM * np.cos(2.0 * np.pi * x / PERIOD)[None]), PERIOD)
    with pytest.raises(NoComparison, match="shorter than a period"):
        refuse_odd(HeightMap(x[:-1], np.zeros(1), np.cos(x[:-1])[None] * NM), PERIOD)


def test_wrong_model_is_said(ours):
    """Heights twice as large at the same widths are more than noise, and the errors grow."""
    good, wrong = measurement(ours, 1.0, 4), measurement(ours, 1.0, 4, noise=0.0)
    found = compare(ours, HeightMap(wrong.x, wrong.y, 2.0 * wrong.z + (good.z - wrong.z)))
    assert "more than noise" in comparing.sentence(found)
    assert found.tau > 1.5


def odd(x_factor=1.0, z_factor=1.0, count=500, width=44 * UM, period=PERIOD):
    """A cosine of some period, in some unit."""
    x = np.linspace(0.0, width, count)
    z = 30 * NM * np.cos(2.0 * np.pi * x / period)
    return HeightMap(x_factor * x, np.zeros(1), z_factor * z[None, :])


def two_hills(period, first=0.4):
    """A relief whose second wave is stronger than its first one."""
    x = np.linspace(0.0, 44 * UM, 500)
    noise = 2 * NM * np.random.default_rng(2).normal(size=x.size)
    z = first * np.cos(2.0 * np.pi * x / period) + np.cos(4.0 * np.pi * x / period)
    return HeightMap(x, np.zeros(1), (30 * NM * z + noise)[None, :])


REFUSED = {
    "short": (odd(x_factor=1e-3), "shorter than a period of 5 um: is its unit right"),
    "coarse": (odd(count=30), "do not show a period of 5 um"),
    "high": (odd(z_factor=1e6), "is the unit of the heights right"),
    "flat": (odd(z_factor=0.0), "all measured heights are the same"),
    "other period": (odd(period=3 * UM), "the measured period of 2.98"),
    "two hills a period": (two_hills(3.7 * UM), "the measured period of 3.[67]"),
}


@pytest.mark.parametrize(("surface", "message"), REFUSED.values(), ids=REFUSED.keys())
def test_refused(ours, surface, message):
    """Each is one line."""
    with pytest.raises(NoComparison, match=message):
        compare(ours, surface)


def test_two_hills_a_line():
    """A profile whose strongest wave is the second or third of a period is of that period."""
    for wave in (2, 3):
        refuse_odd(odd(period=PERIOD / wave), PERIOD)


def test_command(ours, tmp_path, capsys, monkeypatch):
    """Numbers, aligned heights, a figure, a page; a wrong file is one line and writes nothing."""
    monkeypatch.setattr(relief, "read_relief", lambda folder: ours)
    measured = measurement(ours, 0.95, 5).write(tmp_path / "line.x3p")
    assert main(["compare", str(tmp_path), str(measured)]) == 0
    assert "factor on the local fluence" in capsys.readouterr().out
    folder = tmp_path / "compare-line"
    content = json.loads((folder / "comparison.json").read_text())
    low, high = content["unknowns"]["fluence_factor"]["interval_95"]
    assert low - 0.01 < 0.95 < high + 0.01
    lines = np.loadtxt(folder / "aligned.csv", delimiter=",", skiprows=1)
    assert lines[:, 4] == pytest.approx(lines[:, 2] - lines[:, 3], abs=1e-14)
    assert content["sentence"].split(";")[0] in (folder / "comparison.html").read_text()
    assert not (folder / "comparison-maps.png").exists()
    (tmp_path / "bad.csv").write_text("x,z\n1,2\n")
    assert main(["compare", str(tmp_path), str(tmp_path / "bad.csv")]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert not (tmp_path / "compare-bad").exists()


def test_command_with_a_map(ours, tmp_path, capsys, monkeypatch):
    """The page has maps of both and of their difference; a profile has none."""
    monkeypatch.setattr(relief, "read_relief", lambda folder: ours)
    file = measurement(ours, 0.95, 5, rows=16, count=90, turn=0.05).write(tmp_path / "map.sdf")
    assert main(["compare", str(tmp_path), str(file)]) == 0
    assert "angle of the measurement to the lines" in capsys.readouterr().out
    assert (tmp_path / "compare-map/comparison-maps.png").exists()
    assert 'id="comparison-maps"' in (tmp_path / "compare-map/comparison.html").read_text()


def test_run_whose_period_follows_from_an_angle(tmp_path):
    """Its pattern has that period, and the relief of the cell repeats."""
    run = open_run(synthetic_flow.make_pool_run(tmp_path / "run"))
    content = run.resolved
    content["case"]["laser"]["beam"] = {
        "kind": "interference",
        "wavelength": 355 * NM,
        "angle": 2.0 * np.arcsin(0.5 * 355 * NM / synthetic_run.PERIOD),
    }
    replace_json(run.path / "resolved.json", content)
    x = (np.arange(60) + 0.5) * 0.5 * synthetic_run.PERIOD / 60
    for time in run.snapshots.times:
        lines = ParticleFile(run.path / "surface.vtkhdf", "Lines")
        lines.append(float(time), np.array([x, made_up(HIGHEST, x)]), {})
    found = read_relief(run.path)
    assert found.table.period == pytest.approx(synthetic_run.PERIOD)
    there = found.at(x + 3.0 * synthetic_run.PERIOD, 0.0 * x, 1.0)
    assert there == pytest.approx(made_up(HIGHEST, x), abs=0.1 * NM)


def test_texture_read_back(tmp_path):
    """The folder of a texture tells its relief at any factor without its runs."""
    x = np.arange(-20, 21) * 1e-6
    fluence = spot().at(*np.meshgrid(x, x))
    write_maps(tmp_path / "maps.vtkhdf", Maps(x, x, {"fluence": fluence}, {"fluence": "J/m^2"}))
    one = table()
    cells = {"fluence_J_m2": one.fluence, "x_m": one.x, "height_m": one.values["height"]}
    content = {"period_m": PERIOD, "pulses": 1, "cells": cells}
    content["interpolation_error"] = {"height": {"rms": 1e-10}}
    replace_json(tmp_path / "texture.json", content)
    found = read_relief(tmp_path)
    places = np.array([0.0, 1e-6, 7e-6])
    expected = one.at("height", 0.8 * spot().at(places), places)
    assert found.at(places, 0.0 * places, 0.8) == pytest.approx(expected, abs=0.3 * NM)
