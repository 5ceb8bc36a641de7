"""Pictures, files and page of process maps."""

import csv
import re

import numpy as np
import pytest
from synthetic_sweep import grid_points, made_up_sweep

from lasersph.cli import main
from lasersph.input import in_field_units
from lasersph.plots.process_map import draw_process_map
from lasersph.report.map_page import write_map
from lasersph.studies import process_map

DEPTH = "melt.depth_max_m"


def test_files_of_a_map(tmp_path):
    """PNG, SVG, two tables and a page that holds its picture and links to every run."""
    table = made_up_sweep(tmp_path, grid_points(), failed={5})
    found = process_map(table, show=DEPTH, target=2e-7)
    files = write_map(found, tmp_path, "Process map of s")
    names = ["png", "svg", "csv", "lines.csv", "html"]
    assert [file.name.removeprefix(f"map-{DEPTH}")[1:] for file in files] == names
    assert all(file.stat().st_size > 500 for file in files)
    page = files[-1].read_text(encoding="utf-8")
    for run in table.runs:
        assert f'href="runs/{run}/"' in page
    assert "data:image/png;base64," in page and "<script" not in page
    assert not re.search(r'(src|href)="(?!data:|runs/|#)', page)
    assert (
        "failed: no step converges" in page
        and "1 of 24 runs has no result" in page
        and "0.2 J/cm²" in page
    )
    assert (
        "onset of melting, boiling" in page
        and "Where it begins" in page
        and "Wanted: 200 nm" in page
    )

    rows = list(csv.reader(files[2].open(encoding="utf-8")))
    assert rows[0] == ["laser.fluence [J/cm^2]", "laser.pulse.fwhm [s]", "melt.depth_max [m]"]
    assert float(rows[1][0]) == pytest.approx(1e-4 * found.axes[0].grid[0])
    assert len(rows) == 1 + found.field.size and rows[1][:2] != ["", ""]
    assert sum(row[2] == "" for row in rows) == np.isnan(found.field).sum()
    lines = list(csv.reader(files[3].open(encoding="utf-8")))
    assert lines[0] == ["line", "part", "laser.fluence [J/cm^2]", "laser.pulse.fwhm [s]"]
    low, high = 1e-4 * found.axes[0].grid[[0, -1]]
    assert all(0.999 * low <= float(row[2]) <= 1.001 * high for row in lines[1:])
    assert {row[0] for row in lines[1:]} == {
        "melts",
        "boils",
        "target",
        "melts: band",
        "boils: band",
    }


@pytest.mark.parametrize("keys", [1, 2])
def test_figures_name_what_they_show(tmp_path, keys):
    """Axes in field units; failed runs, lines, bands and hatches are in the legend."""
    points = grid_points() if keys == 2 else [(f, 1e-8) for f in np.linspace(2e3, 8e3, 7)]
    table = made_up_sweep(tmp_path, points, failed={len(points) - 1})
    found = process_map(table, show=DEPTH, emulate=True, target=5e-8, tolerance=1e-6)
    figure = draw_process_map(found, (0.0, 1e-7, 2e-7))
    axes = figure.axes[0]
    assert axes.get_xlabel() == "laser fluence [J/cm$^2$]"
    words = {text.get_text() for text in figure.legends[0].get_texts()}
    assert {"melting", "no result"} <= words
    if keys == 2:
        assert axes.get_ylabel() == "laser pulse fwhm [ns]" and axes.get_yscale() == "log"
        assert {"run", "50 nm", "boiling"} <= words
        assert any(word.startswith("sd above") for word in words)
    else:
        assert axes.get_ylabel().endswith("[nm]") and "95 %" in words


def test_short_logarithmic_axes_have_numbers(tmp_path):
    """From 6 to 16 ns lies one of 1, 2 and 5 times a power of ten: numbers are evenly spaced."""
    points = [
        (fluence, 6e-9 * (16.0 / 6.0) ** k) for fluence in (3e3, 6e3) for k in (0.0, 0.5, 1.0)
    ]
    found = process_map(made_up_sweep(tmp_path, points), show=DEPTH)
    axes = draw_process_map(found).axes[0]
    assert axes.get_yscale() == "log"
    low, high = 0.999 * axes.get_ylim()[0], 1.001 * axes.get_ylim()[1]
    assert [tick for tick in axes.get_yticks() if low <= tick <= high] == [6, 8, 10, 12, 14, 16]


def test_field_units():
    """Fluences and intensities per square centimeter, others with a prefix."""
    assert in_field_units(6e3, "J/m^2") == "0.6 J/cm²"
    assert in_field_units(1e-8, "s") == "10 ns"
    assert in_field_units(float("nan"), "m") == "–"


def test_command(tmp_path, capsys):
    """The map says its lines and its files; the sensitivity its indices."""
    made_up_sweep(tmp_path, grid_points())
    assert main(["map", str(tmp_path), "--show", DEPTH, "--target", "200 nm"]) == 0
    said = capsys.readouterr().out
    assert "melting, 1 ns: in every run from 0.2 J/cm² to 1.2 J/cm²\n" in said
    assert re.search(r"melting, 13\.57 ns: 0\.4\d+ ± 0\.0\d+ J/cm²\n", said)
    assert "boiling, 1 ns: between 0.2 J/cm² and 0.4 J/cm²; as colder runs" in said
    assert "200 nm: " in said
    assert str(tmp_path / f"map-{DEPTH}.html") in said
    assert main(["sensitivity", str(tmp_path), "--of", DEPTH]) == 0
    said = capsys.readouterr().out
    assert re.search(r"laser\.fluence +0\.\d+ \+- 0\.\d+", said) and "24 runs" in said


@pytest.mark.parametrize(
    ("options", "text"),
    [
        (["--target", "200 K"], "--target:"),
        (["--levels", "200 nm"], "--levels: give two or more"),
        (["--levels", "200 nm,100 nm"], "--levels: give two or more"),
        (["--x", "laser.fluenze"], "laser.fluenze does not vary"),
        (["--show", "melt.depth_mx_m"], 'no run has a number "melt.depth_mx_m"'),
    ],
)
def test_refused_commands(tmp_path, capsys, options, text):
    """One line, exit code 2, nothing written."""
    made_up_sweep(tmp_path, grid_points((2e3, 1.2e4, 3), (1e-9, 1e-8, 2)))
    before = sorted(tmp_path.rglob("*"))
    assert main(["map", str(tmp_path), "--show", DEPTH, *options]) == 2
    said = capsys.readouterr().err
    assert text in said and said.count("\n") == 1
    assert sorted(tmp_path.rglob("*")) == before
