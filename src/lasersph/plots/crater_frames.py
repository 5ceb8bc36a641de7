"""The frames of an animation of a crater: the cut with its temperature and the ejecta in flight."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from lasersph.output import Run
from lasersph.plots import style
from lasersph.plots.ablation_fields import cut_frame, plane_cut
from lasersph.plots.crater_cut import (
    body_picture,
    draw_cut,
    draw_ejecta,
    figure_height,
    temperature_range,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DPI = 100


def crater_frames(run: Run, times: Iterable[float]) -> Iterator[Figure]:
    """One figure again and again, each time with the snapshot closest to another time [s].

    Colors keep their meaning over all frames.
    """
    frame, limits = cut_frame(run), temperature_range(run)
    height = 2.0 * round(0.5 * figure_height(frame) * DPI) / DPI  # even pixels, which mp4 wants
    figure, (axes,) = style.new_figure(height=height)
    for k, time in enumerate(times):
        cut = plane_cut(run, run.snapshots.nearest(float(time)))
        if k == 0:
            ejecta = draw_cut(axes, cut, frame, limits)
            figure.draw_without_rendering()
            figure.set_layout_engine(None)
        else:
            axes.images[0].set_data(body_picture(cut, frame))
            for drawn in ejecta:
                drawn.remove()
            ejecta = draw_ejecta(axes, cut, frame, limits)
        axes.set_title(style.time_text(cut.time), fontsize=10, loc="left")
        yield figure
