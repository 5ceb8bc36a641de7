"""Maps of a made-up dot: the whole period, its units, its sections; none of a line."""

from __future__ import annotations

import re

import numpy as np
import pytest
import synthetic_flow
from synthetic_dot import DEPTH, FASTEST, PERIOD, make_dot_run

from lasersph.output import open_run
from lasersph.plots.animation import animate_run
from lasersph.plots.relief import has_lines, relief_map, relief_profiles, topography_history
from lasersph.plots.surface_animation import surface_frames
from lasersph.plots.surface_maps import (
    surface_flow_map,
    surface_height_map,
    surface_sections,
    surface_temperature_map,
    velocity_maps,
)

MAPS = (surface_height_map, surface_flow_map, surface_temperature_map)


@pytest.fixture(scope="module")
def dot(tmp_path_factory):
    """A quarter of a period."""
    return open_run(make_dot_run(tmp_path_factory.mktemp("maps") / "run", extent="quarter"))


@pytest.mark.parametrize("draw", MAPS)
def test_maps_show_the_whole_period(dot, draw):
    """Both axes from -2.5 um to 2.5 um with units, a title with the time, and a color bar."""
    figure = draw(dot)
    axes = figure.axes[0]
    assert axes.get_xlim() == pytest.approx((-2.5, 2.5)) == axes.get_ylim()
    texts = [text for one in figure.axes for text in (one.get_xlabel(), one.get_ylabel())]
    assert all(re.search(r"\[.+\]$", text) for text in texts if text)
    assert "t = " in axes.get_title()


def test_values_of_maps(dot):
    """Height of -60 nm in the middle, 0 in the speed there, 2700 K, largest speed 2 m/s."""
    height, speed, temperature = (
        np.asarray(draw(dot).axes[0].images[0].get_array(), float) for draw in MAPS
    )
    assert height[20, 20] == pytest.approx(-1e9 * DEPTH, rel=0.02)
    assert speed[20, 20] < 0.15 * FASTEST and np.max(speed) == pytest.approx(FASTEST, rel=0.02)
    assert temperature[20, 20] == pytest.approx(2700.0, rel=0.01)
    assert height == pytest.approx(height[::-1]) and height == pytest.approx(height.T)


def test_velocity_is_mirrored_with_its_sign(dot):
    """u is odd in x and even in y, v the other way round; both are those of the dot."""
    step = dot.surface[-1]
    u, v = velocity_maps(dot, step)
    assert u == pytest.approx(-u[:, ::-1]) and u == pytest.approx(u[::-1])
    assert v == pytest.approx(v[:, ::-1]) and v == pytest.approx(-v[::-1])
    x = dot.relief().x
    k = 2 * np.pi / PERIOD
    near = np.abs(x) < 0.2 * PERIOD
    expected = FASTEST * np.sin(k * x) * np.cos(k * x[:, None])
    assert u[np.ix_(near, near)] == pytest.approx(expected[np.ix_(near, near)], rel=1e-5, abs=1e-9)


def test_animation(dot):
    """Height and temperature of each time with the same colors; a picture that can be played."""
    figures = [
        [np.array(axes.images[0].get_array()) for axes in figure.axes[:2]]
        for figure in surface_frames(dot, dot.surface.times)
    ]
    assert len(figures) == len(dot.surface)
    assert np.all(figures[0][0] == 0.0) and np.max(np.abs(figures[-1][0])) > 55.0
    assert np.max(figures[-1][1]) > 2600.0
    assert animate_run(dot).stat().st_size > 1000


def test_maps_of_a_flat_surface(tmp_path):
    """Speed and temperature are those of the dot; no heights; the animation has speeds."""
    flat = open_run(make_dot_run(tmp_path / "flat", moves=False))
    assert surface_height_map(flat) is None and surface_sections(flat) is None
    speed, temperature = (
        np.asarray(draw(flat).axes[0].images[0].get_array(), float) for draw in MAPS[1:]
    )
    assert np.max(speed) == pytest.approx(FASTEST, rel=0.02)
    assert temperature[20, 20] == pytest.approx(2700.0, rel=0.01)
    *_, last = surface_frames(flat, flat.surface.times)
    left, right = (axes.images[0] for axes in last.axes[:2])
    assert np.max(left.get_array()) == pytest.approx(FASTEST, rel=0.02)
    assert left.get_clim()[0] == 0.0 and np.max(right.get_array()) > 2600.0


def test_sections(dot):
    """Along x and y cosines, along the diagonal their square, over its own length."""
    lines = surface_sections(dot).axes[0].lines[:3]
    k = 2e-6 * np.pi / PERIOD
    for line, expected in zip(
        lines, (np.cos, np.cos, lambda q: np.cos(q / 2**0.5) ** 2), strict=True
    ):
        place, height = line.get_data()
        assert height == pytest.approx(-1e9 * DEPTH * expected(k * place), abs=1.0)


def test_lines_have_no_maps_and_maps_no_lines(dot, tmp_path):
    """Each kind of surface has figures of its own; both have a history."""
    assert relief_profiles(dot) is None and relief_map(dot) is None and not has_lines(dot)
    labels = [text.get_text() for text in topography_history(dot).axes[1].get_legend().get_texts()]
    assert labels == ["Sa", "Sq"]
    flat = open_run(synthetic_flow.make_pool_run(tmp_path / "flat"))
    assert not any(draw(flat) for draw in (*MAPS, surface_sections))
