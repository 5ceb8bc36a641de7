"""Figures of a section (r, z): mirrored about the axis, and labeled r."""

import json

import pytest
from synthetic_flow import make_pool_run
from synthetic_run import make_run

from lasersph import open_run
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
