"""The surface of a dot in its run folder: fields at columns, height maps of the whole, exports."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import synthetic_dot
from synthetic_dot import DEPTH, PERIOD, below_lid, dot_view, make_dot_run

from lasersph.observers.relief import Relief
from lasersph.observers.surface_fields import at_columns, surface_fields
from lasersph.output import OutputError, open_run
from lasersph.output.export import export
from lasersph.output.frame_blocks import particle_index
from lasersph.output.surface_files.read import read_surface
from lasersph.report.scene import embedded_frames
from lasersph.web.run_page import relief

K = 2.0 * np.pi / PERIOD


@pytest.fixture(scope="module", params=["full", "half", "quarter"])
def dot(request, tmp_path_factory):
    """A run of a whole period, half and a quarter of it."""
    return open_run(make_dot_run(tmp_path_factory.mktemp("dot") / "run", extent=request.param))


def test_relief_is_that_of_the_whole(dot):
    """Heights of a period in meters at every extent, at the end or at a time; surface.csv too."""
    relief = dot.relief()
    assert relief.z.shape == (40, 40) and np.all(np.diff(relief.x) > 0.0)
    assert relief.x[0] == pytest.approx(-0.5 * PERIOD + 0.5 * PERIOD / 40)
    expected = -DEPTH * np.cos(K * relief.x) * np.cos(K * relief.y)[:, None]
    assert relief.z == pytest.approx(expected, rel=1e-9, abs=1e-20)
    assert np.all(dot.relief(0.0).z == 0.0)
    x, y, z = np.loadtxt(dot.path / "surface.csv", delimiter=",", skiprows=1).T
    assert z == pytest.approx(-DEPTH * np.cos(K * x) * np.cos(K * y), rel=1e-6, abs=1e-16)
    assert x.size == 1600


def test_report_holds_the_body(dot):
    """Frames of a page have the surface with its fields, in 16 bits; so has the index of a page."""
    frames = embedded_frames(dot)
    index = frames["index"]
    nx, ny = index["surface"]["shape"]
    assert set(index["surface"]["blocks"]) == {"position", "temperature", "speed", "height"}
    assert {one["name"] for one in index["fields"]} >= {"temperature", "speed", "height"}
    assert (index["mirrored"], index["mirrored_y"]) == dot.mirrored
    name = next(name for name in frames["blocks"] if name.startswith("surface.height"))
    assert np.shape(frames["blocks"][name]["range"]) == (1, 2)
    whole = particle_index(dot.path)
    assert whole["surface"]["shape"] == [nx, ny] and whole["surface"]["counts"][0] == nx * ny


def test_page_of_a_run_shows_a_section(dot):
    """The web page draws the line along x at y = 0."""
    found = relief(SimpleNamespace(path=dot.path))
    x, z = np.array(found["x"]), np.array(found["height"])
    assert x.size == 40 and np.all(np.diff(x) > 0.0)
    assert z == pytest.approx(-DEPTH * np.cos(K * x), rel=0.01, abs=1e-10)


def test_fields_of_the_surface(dot):
    """Temperature, height and velocity at the columns, triangles in the file."""
    step = dot.surface[-1]
    x, y, z = step["position"]
    assert step["height"] == pytest.approx(z, rel=1e-6)
    assert step["temperature"] == pytest.approx(
        1800 + 900 * np.cos(K * x) * np.cos(K * y), rel=1e-6
    )
    assert step["speed"] == pytest.approx(np.linalg.norm(step["velocity"], axis=0), rel=1e-6)
    assert dot.surface.units["speed"] == "m/s"
    assert dot.surface.shape == {40: (40, 40), 20: (20, 20)}.get(round(x.size**0.5), (20, 40))


@pytest.mark.parametrize("kind", ["csv", "sdf", "x3p", "stl", "ply"])
def test_exports(dot, kind):
    """Files of the whole period; those of heights are read again."""
    path = export(dot, kind)
    if kind in ("csv", "sdf", "x3p"):
        found = read_surface(path)
        assert found.z == pytest.approx(dot.relief().z, abs=1e-13)
        assert np.ptp(found.x) == pytest.approx(PERIOD * 39 / 40)
    elif kind == "stl":
        facets = np.frombuffer(path.read_bytes(), "<u4", 1, 80)[0]
        assert facets == 2 * 39 * 39
    else:
        assert f"element face {2 * 39 * 39}" in path.read_text()


def test_columns_between_particles():
    """Linear fields of a lattice come back at its columns, of others by the particles around; a
    column without any has the value of its neighbor, and one beyond a seam counts across it."""
    x = (np.arange(10) + 0.5) * 1e-7
    relief = Relief(x, np.zeros(10))
    assert at_columns(relief, x[None], 3.0 * x[None])[0] == pytest.approx(3.0 * x)
    found = at_columns(relief, x[None, :5], np.ones((1, 5)) * np.arange(5.0))[0]
    assert found[5:] == pytest.approx(4.0)
    between = np.array([[x[2] + 0.25e-7, x[2] - 0.25e-7]])
    assert at_columns(relief, between, np.array([[1.0, 3.0]]))[0][2] == pytest.approx(2.0)
    seam = at_columns(Relief(x, np.zeros(10), "periodic"), np.array([[0.1e-7]]), np.array([[7.0]]))
    assert seam[0] == pytest.approx(7.0)


def test_parts_have_the_same_numbers(tmp_path):
    """Summary of whole, half and quarter: topography and number of pools."""
    found = []
    for extent in synthetic_dot.SHARES:
        run = open_run(make_dot_run(tmp_path / extent, extent=extent))
        topography = run.summary["topography"]
        found.append([topography[f"{name}_m"] for name in ("Sa", "Sq", "Sz", "first_harmonic")])
        found[-1] += [topography["displaced_volume_m3"], run.summary["melt"]["area_half_max_m2"]]
    assert found[1] == pytest.approx(found[0], rel=1e-9, abs=0.0)
    assert found[2] == pytest.approx(found[0], rel=1e-9, abs=0.0)


def test_flat_surface_has_no_heights(tmp_path):
    """Its columns have temperature and velocity; there is no relief to read or to export."""
    found, moving = surface_fields(below_lid(dot_view(3e-8))), surface_fields(dot_view(3e-8))
    assert set(moving) - set(found) == {"height"}
    assert all(np.array_equal(values, moving[name]) for name, values in found.items())
    run = open_run(make_dot_run(tmp_path / "run", moves=False))
    assert len(run.surface) == 7 and not run.surface_moves
    assert np.all(run.surface[-1]["position"][2] == 0.0)
    assert not (run.path / "surface.csv").exists()
    for read in (run.relief, lambda: export(run, "csv")):
        with pytest.raises(OutputError, match="a surface that moves"):
            read()
    blocks = embedded_frames(run)["index"]["surface"]["blocks"]
    assert set(blocks) == {"position", "temperature", "speed"}


def test_surface_without_columns_is_refused():
    """A view of neither has no fields of a surface."""
    with pytest.raises(ValueError, match="no columns"):
        surface_fields(replace(dot_view(0.0), relief=None))
