"""Figures of a section (r, z): mirrored about the axis, and labeled r."""

import csv
import json

import numpy as np
import pytest
from synthetic_flow import make_pool_run
from synthetic_run import make_run

from lasersph import open_run
from lasersph.plots import plot
from lasersph.plots.flow_cells import flow_cell_map, section_cells
from lasersph.plots.flow_map import pool_flow_map
from lasersph.plots.particle_map import particle_map
from lasersph.plots.run_figures import draw_arrangement
from lasersph.plots.surface_profiles import surface_flow_profiles, surface_profiles


def as_section(folder):
    """The same run as if its case had been axisymmetric."""
    content = json.loads((folder / "resolved.json").read_text())
    content["case"]["solver"]["geometry"] = "axisymmetric"
    content["case"]["domain"] = {"extent": "full"}
    (folder / "resolved.json").write_text(json.dumps(content))
    return open_run(folder)


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """A section with heat, and one with flow."""
    folder = tmp_path_factory.mktemp("sections")
    return as_section(make_run(folder / "heat")), as_section(make_pool_run(folder / "pool"))


def test_both_sides_of_the_axis_are_drawn(runs):
    """From -r to r, with r at the axis; the lattice shows what was computed."""
    heat, pool = runs
    figures = [
        surface_profiles(heat), particle_map(heat), surface_flow_profiles(pool),
        pool_flow_map(pool),
    ]  # fmt: skip
    for figure in figures:
        axes = [one for one in figure.axes if one.get_label() != "<colorbar>"]
        assert axes[-1].get_xlabel().startswith("r [")
        assert not any(one.get_xlabel().startswith("x [") for one in axes)
        left, right = axes[0].get_xlim()
        assert left == pytest.approx(-right) and right > 0.0
    assert "dT/dr" in figures[2].axes[1].get_ylabel()
    assert draw_arrangement(heat).axes[0].get_xlabel().startswith("r [")


def with_cells(folder):
    """A run whose history says that a cell turned outward."""
    as_section(make_pool_run(folder))
    with open(folder / "history.csv", encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    names = ["flow_outward_turnover_m3_s", "flow_outward_height_m"]
    names += ["flow_inward_turnover_m3_s", "flow_inward_height_m"]
    with open(folder / "history.csv", "w", encoding="utf-8", newline="") as file:
        added = [["3e-13", "1.2e-7", "0", "0"] for _ in rows]
        csv.writer(file).writerows(
            [[*head, *names], *([*a, *b] for a, b in zip(rows, added, strict=True))]
        )
    return open_run(folder)


def test_cells_of_a_spot(tmp_path, runs):
    """The section is mirrored, each cell is named with what it turns; below it is over time."""
    figure = flow_cell_map(with_cells(tmp_path / "cells"))
    section, height, turnover = (one for one in figure.axes if one.get_label() != "<colorbar>")
    left, right = section.get_xlim()
    assert left == pytest.approx(-right) and right > 0.0
    assert "outward: " in section.get_title(loc="left")
    assert height.get_ylabel() == "height [nm]" and turnover.get_ylabel().startswith("turnover [")
    (line,) = height.lines
    assert np.nanmax(line.get_ydata()) == pytest.approx(120.0)
    # nothing of it without a section, and the name is that of the figures
    assert flow_cell_map(runs[1]) is None
    assert plot(tmp_path / "cells", "flow-cells") is not None


def test_stream_function_of_a_snapshot():
    """Two rows of two rings by hand: 2 pi r dr w, summed outward; the lower one turns inward."""
    step = {
        "position": np.array([[0.5, 1.5, 0.5, 1.5], [-0.5, -0.5, -1.5, -1.5]]),
        "width": np.ones((2, 4)),
        "velocity": np.array([np.zeros(4), [2.0, -1.0, -4.0, 1.0]]),
        "flows": np.array([1, 1, 1, 1]),
    }
    psi, cells = section_cells(step)
    assert psi == pytest.approx(2.0 * np.pi * np.array([1.0, -0.5, -2.0, -0.5]))
    assert cells["outward"].turnover == pytest.approx(2.0 * np.pi)
    assert cells["inward"].turnover == pytest.approx(4.0 * np.pi)
    assert (cells["outward"].height, cells["inward"].height) == (1.0, 2.0)
    assert (cells["outward"].center, cells["inward"].center) == (0, 2)
