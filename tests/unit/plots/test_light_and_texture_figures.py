"""Figures of the fluence and of a texture: nothing is cut off, maps fill their panels."""

from dataclasses import dataclass

import numpy as np
import pytest

from lasersph.output.image_file import Maps
from lasersph.plots.fluence import fluence_figure
from lasersph.plots.texture import texture_figure


@dataclass
class MadeUpMap:
    """Fluence of a spot."""

    x: np.ndarray
    y: np.ndarray
    fluence: np.ndarray
    words: str = "spot"


@pytest.fixture
def side():
    """Places over 60 um [m]."""
    return np.linspace(-30e-6, 30e-6, 61)


@pytest.mark.parametrize("count", [1, 2])
@pytest.mark.parametrize("lines", [1, 5])
def test_fluence_is_not_cut_off(side, count, lines):
    """However many lines the note has, the names of the axes lie in the figure."""
    each = MadeUpMap(side, side, np.ones((61, 61)))
    figure = fluence_figure([each] * count, "\n".join(["a note"] * lines))
    figure.draw_without_rendering()
    for axes in figure.axes[:count]:
        ends = axes.xaxis.label.get_window_extent()
        assert ends.y0 >= 0.0 and ends.x0 >= 0.0


def test_maps_of_a_texture_fill_their_panels(side):
    """Color bars are as wide as their maps, and these nearly half of the figure; the band of the
    melt does not rise above the surface, nor is there any where nothing melts."""
    depth = np.clip(200e-9 * (1.0 - np.hypot(*np.meshgrid(side, side)) / 2e-5), 0.0, None)
    error = {"largest": 2e-8}
    sizes = dict.fromkeys(("Sa", "Sq", "Sz", "Ssk", "Sdr"), 1e-8)
    content = {
        "interpolation_error": {"height": error, "melt_depth": error},
        "areal_parameters": sizes,
    }
    units = {"height": "m", "melt_depth": "m"}
    fields = {"height": depth - depth.mean(), "melt_depth": depth}
    figure = texture_figure(Maps(side, side, fields, units), content)
    figure.draw_without_rendering()
    shown = [axes for axes in figure.axes if axes.get_ylabel().startswith("y") or axes.images]
    for axes in shown:
        box = axes.get_window_extent()
        (bar,) = axes.child_axes
        assert abs(bar.get_window_extent().width - box.width) < 1.0
        assert box.width > 0.38 * figure.bbox.width
    melt = next(axes for axes in figure.axes if axes.get_ylabel().startswith("molten"))
    band = np.vstack([path.vertices for path in melt.collections[0].get_paths()])
    assert band[:, 1].max() <= 0.0
    assert np.all(band[np.abs(band[:, 0]) > 25.0, 1] == 0.0)
