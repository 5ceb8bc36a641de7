"""Figures of an ablation: from files alone, with units on their axes and the right numbers."""

import re
import subprocess
import sys

import matplotlib.pyplot as plt
import numpy as np
import pytest
import synthetic_ablation
import synthetic_run
from synthetic_ablation import DX, NS, UM, VELOCITY

from lasersph.output import OutputError, open_run
from lasersph.plots import (
    animate_run,
    animation,
    crater_cut,
    crater_scene,
    crater_view,
    draw_run,
    ejecta_vectors,
    style,
)
from lasersph.plots.ablation_fields import crater_snapshot, cut_frame, has_ablation, plane_cut
from lasersph.plots.ablation_history import crater_history, trace_figure
from lasersph.plots.crater_cut import body_picture


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """A made-up crater in each dimension."""
    folder = tmp_path_factory.mktemp("craters")
    kinds = {1: "top-hat", 2: "gaussian", 3: "top-hat"}
    return {
        d: open_run(synthetic_ablation.make_run(folder / f"{d}", d, kind))
        for d, kind in kinds.items()
    }


def test_every_axis_names_its_unit(runs):
    """Each axis label of each figure ends in a unit in brackets."""
    drawings = (crater_cut, ejecta_vectors, crater_view, crater_history, trace_figure)
    drawn = [figure for run in runs.values() for draw in drawings if (figure := draw(run))]
    assert len(drawn) == 12
    for figure in drawn:
        for axes in figure.axes:
            for text in (axes.get_xlabel(), axes.get_ylabel()):
                assert not text or re.search(r"\[\S+( .*)?\]$", text), text


def test_which_figures_apply(runs, monkeypatch):
    """A crater is drawn in place of the map of resting particles; vectors need a plane."""
    monkeypatch.setattr(style, "save", lambda figure, path: path)
    names = {d: {path.stem for path in draw_run(run.path)} for d, run in runs.items()}
    assert {"crater", "crater-history", "traces"} <= names[1] & names[2] & names[3]
    assert "ejecta" in names[2] & names[3] and "ejecta" not in names[1]
    assert "crater-3d" in names[3] and "crater-3d" not in names[1] | names[2]
    assert not {"particles", "surface-profiles"} & (names[1] | names[2] | names[3])


def test_cut_through_the_axis(runs):
    """In 3-D one layer of the body beside the axis, and both layers of ejecta around it."""
    step = runs[3].snapshots.nearest(10 * NS)
    cut = plane_cut(runs[3], step)
    assert np.ptp(step["position"][1, cut.body.number]) < 0.1 * DX
    assert set(np.sign(step["position"][1, cut.ejecta])) == {-1.0, 1.0}
    np.testing.assert_allclose(cut.velocity[1], VELOCITY)


def test_body_is_empty_in_the_crater(runs):
    """The pixels above the crater's floor at the axis show nothing, those below metal."""
    run = runs[3]
    frame = cut_frame(run)
    picture = body_picture(plane_cut(run, run.snapshots[-1]), frame)
    column = picture[:, picture.shape[1] // 2]
    depth = -frame.bottom * np.count_nonzero(np.isnan(column)) / column.size
    assert depth == pytest.approx(4 * DX, abs=0.1 * UM)


def test_telling_snapshot(runs):
    """The first snapshot with the final crater: the fourth layer leaves at 9 ns."""
    assert crater_snapshot(runs[1])["time"] == pytest.approx(9 * NS)


def test_largest_depth_at_the_axis_shares_its_line(runs, monkeypatch):
    """A line of its own would hide the other one; where they differ, both are drawn."""

    def legend():
        return crater_history(runs[2]).axes[0].get_legend_handles_labels()[1]

    assert "at the axis, largest" in legend() and "largest" not in legend()
    history = dict(runs[2].history)
    history["crater_depth_m"] = 0.5 * history["crater_depth_max_m"]
    monkeypatch.setitem(vars(runs[2]), "history", history)
    assert {"at the axis", "largest"} <= {*legend()}


def test_trace_with_regions(runs):
    """The Roman numbers of the regions stand above both panels."""
    figure = trace_figure(runs[1])
    texts = [[t.get_text() for t in axes.texts] for axes in figure.axes]
    assert {"I", "II", "III"} <= set(texts[0])
    assert {"I", "II", "IV"} <= set(texts[1])
    # particles that lie over each other are told apart by their dashes
    curves = [line for line in figure.axes[0].lines if not line.get_label().startswith("_")]
    assert len({line.get_linestyle() for line in curves}) == len(curves) == 2


@pytest.mark.parametrize("dimension", [2, 3])
def test_animation(runs, dimension, monkeypatch):
    """A gif of the cut, of at most so many snapshots as are asked for."""
    from PIL import Image

    monkeypatch.setattr(animation, "MOST_FRAMES", 4)

    with Image.open(animate_run(runs[dimension].path)) as movie:
        assert movie.n_frames == 4


def test_no_animation_of_a_line(runs):
    """In 1-D there is no picture to animate."""
    with pytest.raises(OutputError, match="no plane run"):
        animate_run(runs[1].path)


def test_scene_without_pyvista(runs, tmp_path, monkeypatch):
    """One clear line says what to install, and nothing is written."""
    monkeypatch.setitem(sys.modules, "pyvista", None)
    with pytest.raises(OutputError, match=r"pip install 'lasersph\[view\]'"):
        crater_scene(runs[3], tmp_path / "scene.png")
    assert not list(tmp_path.iterdir())


@pytest.fixture(scope="module")
def renderer():
    """Pyvista draws on this machine: tried in a process of its own, since VTK ends it if not."""
    pytest.importorskip("pyvista")
    attempt = "import pyvista as p; s = p.Plotter(off_screen=True); s.add_mesh(p.Cube()); s.show()"
    if subprocess.run([sys.executable, "-c", attempt], capture_output=True).returncode:
        pytest.skip("VTK finds neither EGL nor OSMesa to draw with")


@pytest.mark.usefixtures("renderer")
def test_scene(runs, tmp_path):
    """The crater is seen from above, warm in its middle, on white; other runs are refused."""
    path = crater_scene(runs[3], tmp_path / "scene.png")
    picture = plt.imread(path)
    assert picture.shape[:2] == (900, 1200)
    colored = np.ptp(picture[..., :3], axis=-1) > 0.2
    assert 0.05 < np.mean(colored) < 0.9
    assert np.all(picture[0, 0] == 1.0)
    with pytest.raises(OutputError, match="no 3-D run"):
        crater_scene(runs[2], path)


def test_run_without_ablation(tmp_path):
    """Nothing of this is drawn for a run without ablation."""
    run = open_run(synthetic_run.make_run(tmp_path / "run", strength=0.1))
    assert not has_ablation(run)
    for draw in (crater_cut, ejecta_vectors, crater_view, crater_history, trace_figure):
        assert draw(run) is None
