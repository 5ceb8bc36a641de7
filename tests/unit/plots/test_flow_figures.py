"""Figures of a flow: drawn from files alone, with units on their axes and the right numbers."""

import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import synthetic_flow
import synthetic_run
from synthetic_flow import FASTEST, LAYER
from synthetic_run import NM, NS, PERIOD

from lasersph.boundaries import FlowConditions
from lasersph.observers.box_sections import Box
from lasersph.output import OutputError, open_run
from lasersph.plots import (
    animate_run,
    animation,
    draw_run,
    flow_history,
    speed_extrema,
    style,
    surface_flow_profiles,
    surface_speeds,
)
from lasersph.plots.flow_fields import plane_flow, raster
from lasersph.plots.flow_history import center_line_figure, lines_of, mirror_of
from lasersph.plots.flow_map import are_beside, box_flow_map, pool_flow_map
from lasersph.plots.particle_map import Cells


@pytest.fixture(scope="module")
def pool(tmp_path_factory):
    return open_run(synthetic_flow.make_pool_run(tmp_path_factory.mktemp("pool") / "run"))


@pytest.fixture(scope="module")
def box(tmp_path_factory):
    return open_run(synthetic_flow.make_box_run(tmp_path_factory.mktemp("box") / "run"))


@pytest.fixture(scope="module")
def still(tmp_path_factory):
    """A run without flow."""
    return open_run(synthetic_run.make_run(tmp_path_factory.mktemp("still") / "run", strength=0.1))


@pytest.fixture
def unsaved(monkeypatch):
    """Figures are drawn but not written, which takes most of the time."""
    monkeypatch.setattr(style, "save", lambda figure, path: path)


def test_every_axis_names_its_unit(pool, box):
    """Each shown axis label of each figure ends in a unit in brackets."""
    figures = [
        pool_flow_map(pool),
        surface_flow_profiles(pool),
        flow_history.speed_history(pool),
        flow_history.extrema_history(pool),
        flow_history.layer_history(pool),
        flow_history.surface_pressure_history(pool),
        flow_history.quality_history(pool),
        surface_speeds([pool], ["a"]),
        box_flow_map(box),
        center_line_figure(box),
        flow_history.nusselt_history(box),
    ]
    for figure in figures:
        for axes in figure.axes:
            if axes.get_label() == "<colorbar>":
                continue
            labels = [text for text in (axes.get_xlabel(), axes.get_ylabel()) if text]
            assert axes.get_ylabel()
            assert all(re.search(r"\[.+\]$", text) for text in labels), labels


def test_figures_of_a_pool(pool, unsaved):
    """Figures of flow among those of heat, in reading order."""
    names = [path.stem for path in draw_run(pool.path)]
    flow = ["flow", "flow-speed", "surface-flow", "flow-extrema", "flow-layer", "surface-pressure"]
    assert [name for name in names if name in flow] == flow
    assert names.index("flow") < names.index("temperature") < names.index("flow-speed")
    assert "box-flow" not in names


def test_figures_of_a_box(box, unsaved):
    """A box has no melt pool, but center lines and Nusselt numbers."""
    names = [path.stem for path in draw_run(box.path)]
    assert {"box-flow", "center-lines", "nusselt", "flow-speed"} <= set(names)
    assert not {"melt-pool", "particles", "flow", "surface-flow", "flow-extrema"} & set(names)


def test_nothing_to_draw_without_flow(still):
    """Runs with heat alone have none of these figures."""
    draw = (
        pool_flow_map,
        box_flow_map,
        surface_flow_profiles,
        center_line_figure,
        flow_history.nusselt_history,
    )
    assert not any(one(still) for one in draw)
    names = ("speed_history", "extrema_history", "layer_history", "surface_pressure_history")
    assert not any(getattr(flow_history, name)(still) for name in names)


def test_speed_curve_is_the_history(pool):
    """The curve holds the numbers of history.csv; where nothing flows it breaks."""
    axes = flow_history.speed_history(pool).axes[0]
    line = next(line for line in axes.lines if line.get_label() == "at the surface")
    column = pool.history["flow_surface_speed_max_m_s"]
    assert np.array_equal(np.nan_to_num(line.get_ydata()), column)
    assert np.isnan(line.get_ydata()[0])
    assert axes.get_legend() is None
    assert any("50 nm below it" in line.get_label() for line in axes.lines)


def test_profiles_are_mirrored(pool):
    """T is even in x; dT/dx and u are odd; u breaks where the surface is solid."""
    figure = surface_flow_profiles(pool, [57 * NS])
    (_, T), (_, gradient), (x, u) = (axes.lines[0].get_data() for axes in figure.axes)
    assert np.allclose(x, -x[::-1])
    assert np.array_equal(T, T[::-1])
    assert np.array_equal(gradient, -gradient[::-1])
    assert np.array_equal(u, -u[::-1], equal_nan=True)
    assert np.isnan(u[0])
    assert np.all(gradient[x > 50.0] <= 1e-3)
    assert float(np.nanmax(u)) == pytest.approx(
        np.max(pool.snapshots.nearest(57 * NS)["surface_velocity"])
    )


def test_velocity_on_a_grid(pool):
    """Interpolated over the whole period: odd in x, NaN outside the liquid."""
    flow = plane_flow(pool, 52 * NS)
    frame = Box(-1000 * NM, 1000 * NM, -400 * NM, 0.0)
    x, z, velocity = flow.on_grid(frame, 20, 8)
    assert velocity.shape == (2, 8, 20)
    assert velocity[0] == pytest.approx(-velocity[0, :, ::-1], abs=1e-3 * FASTEST, nan_ok=True)
    speed = FASTEST * np.exp(-((5 / 12) ** 2))
    wanted = np.sin(2 * np.pi * x / PERIOD) * (1 + z[-1] / LAYER) * np.exp(z[-1] / LAYER)
    assert velocity[0, -1] == pytest.approx(speed * wanted, abs=0.02 * speed)
    deep = Box(-1000 * NM, 1000 * NM, -4000 * NM, -3000 * NM)
    assert np.all(np.isnan(flow.on_grid(deep, 4, 4)[2]))


def test_phases_of_a_picture(pool):
    """Solid far below, boiling at the maximum, liquid and mush between."""
    flow = plane_flow(pool, 55 * NS)
    frame = Box(-10 * NM, 10 * NM, -1500 * NM, 0.0)
    column = raster(flow, frame, (60, 1)).phase()[::-1, 0]
    assert list(dict.fromkeys(column)) == [3.0, 2.0, 1.0, 0.0]


@pytest.mark.parametrize(
    "flow, mirror",
    [
        ({}, ""),
        ({"front": "symmetry"}, "front"),
        ({"sides": "symmetry"}, ""),
        ({"sides": "symmetry", "front": "no-slip"}, "back"),
    ],
)
def test_center_lines_lie_where_the_observer_has_them(flow, mirror):
    """In front or back of the resolved case, where the conditions of its flow say so."""
    conditions = FlowConditions.model_validate(flow)
    assert conditions.mirror == mirror
    resolved = {"solver": {"flow": conditions.model_dump()}}
    assert mirror_of(SimpleNamespace(case=resolved)) == mirror
    assert mirror_of(SimpleNamespace(case={})) == ""


def test_center_lines_of_the_last_snapshot(box):
    """The lines of files are those of the observer, to the precision of the file."""
    found = box.summary["box"]["lines"]
    lines = lines_of(box, np.linspace(0.0, 1.0, 33))
    assert lines.u == pytest.approx(found["u_m_s"], abs=1e-4)
    assert lines.w == pytest.approx(found["w_m_s"], abs=1e-4)


def test_picture_of_a_closed_box_has_no_gap(box):
    """It ends at the walls, wherever the particles beside them went."""
    cells, first = plane_flow(box, box.snapshots.times[-1]).cells, box.snapshots[0]
    assert cells.frame == Cells(first["position"], first["width"], cells.number).frame
    inward = replace(cells, center=0.8 * cells.center)
    assert np.all(inward.picture() >= 0)
    assert np.any(replace(inward, walls=None).picture(cells.frame) < 0)


def test_panels_of_boxes(box):
    """Beside each other, but above each other where the box is flat."""
    left, right = (axes.get_position() for axes in box_flow_map(box).axes[:2])
    assert left.y0 == pytest.approx(right.y0) and left.x1 < right.x0
    assert are_beside(Box(0.0, 2.0, -1.0, 0.0)) and not are_beside(Box(0.0, 2.1, -1.0, 0.0))
    assert animation.scene_of(box, box.snapshots.times[:3]).is_beside


def test_colors_reach_the_coldest_of_a_box(box):
    """The cold wall may be colder than anything was at the start."""
    scene = animation.scene_of(box, box.snapshots.times)
    coldest = min(float(step["temperature"].min()) for step in box.snapshots)
    assert scene.temperatures == (coldest, np.max(box.history["temperature_max_K"]))


def test_runs_together(pool):
    """One color a run; outer extrema dashed, inner ones full."""
    axes = speed_extrema([pool, pool], ["a", "b"]).axes[0]
    assert [line.get_linestyle() for line in axes.lines] == ["--", "-", "--", "-", "-", "--"]
    assert [line.get_label() for line in axes.lines[4:]] == ["inner extremum", "outer extremum"]
    assert axes.get_ylabel() == "surface speed [m/s]"


def test_animation_is_a_gif_of_the_life_of_the_pool(pool, box, monkeypatch):
    """At most so many frames, from the first melt to the last."""
    from PIL import Image

    times = animation.frame_times(pool)
    assert times[0] >= 30 * NS
    assert len(times) <= animation.MOST_FRAMES
    monkeypatch.setattr(animation, "MOST_FRAMES", 3)
    for run in (pool, box):
        path = animate_run(run.path)
        assert path == run.path / "figures" / "animation.gif"
        with Image.open(path) as image:
            assert image.n_frames == 3
    assert not list((pool.path / "figures").glob("unfinished*"))


def test_mp4_is_written_by_ffmpeg(pool, box, tmp_path, monkeypatch):
    """It is handed every frame, of even width and height, and the name of the file."""
    from matplotlib import rc_context

    stand_in = tmp_path / "ffmpeg"
    stand_in.write_text(
        '#!/bin/sh\nfor last; do :; done\ncat > "$last"\necho "$@" > "$(dirname "$0")/asked"\n'
    )
    stand_in.chmod(0o755)
    monkeypatch.setattr(animation, "MOST_FRAMES", 3)
    for run in (pool, box):
        with rc_context({"animation.ffmpeg_path": str(stand_in)}):
            path = animate_run(run.path, format="mp4")
        assert path == run.path / "figures" / "animation.mp4"
        ((width, height),) = re.findall(r"-s (\d+)x(\d+)", (tmp_path / "asked").read_text())
        width, height = int(width), int(height)
        assert width % 2 == height % 2 == 0
        assert path.stat().st_size == 3 * 4 * width * height


def test_what_cannot_be_animated(pool, tmp_path, monkeypatch):
    """One clear line: no ffmpeg, not in the plane, too few snapshots."""
    line = open_run(synthetic_run.make_run(tmp_path / "line", dimension=1))
    with pytest.raises(OutputError, match="only those are animated"):
        animate_run(line.path)
    from matplotlib.animation import FFMpegWriter

    monkeypatch.setattr(FFMpegWriter, "isAvailable", classmethod(lambda cls: False))
    with pytest.raises(OutputError, match="take --format gif"):
        animate_run(pool.path, format="mp4")
    (line.path / "particles.vtkhdf").unlink()
    with pytest.raises(OutputError, match="an animation needs 3"):
        animate_run(line.path)
