"""An animation of a run from its snapshots: temperature, and speed with arrows where it flows; of
an ablation the cut through the crater with its ejecta; of a surface that moves in 3-D its height.

Colors keep their meaning over all frames. The gif needs nothing beside matplotlib; mp4 needs the
program ffmpeg.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from lasersph.observers.box_sections import Box
from lasersph.output import OutputError, Run, RunOrFolder, open_run
from lasersph.output.errors import clear_errors
from lasersph.output.last_pulse import last_pulse
from lasersph.plots import style
from lasersph.plots.ablation_fields import has_ablation
from lasersph.plots.crater_cut import crater_frames
from lasersph.plots.flow_fields import (
    PlaneFlow,
    body_frame,
    has_flow,
    is_box,
    plane_flow,
    pool_frame,
    raster,
)
from lasersph.plots.flow_map import (
    ARROWS,
    BOX_ARROWS,
    LEAST_SPREAD,
    are_beside,
    beside_height,
    draw_arrows,
    draw_speed,
    draw_temperature,
    drawn_shape,
    exaggeration_of,
    finish,
    frame_unit,
    shape_of,
)
from lasersph.plots.particle_map import MAP_WIDTH, shown_depth
from lasersph.plots.surface_animation import surface_frames
from lasersph.plots.surface_maps import has_maps

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Format = Literal["gif", "mp4"]
MOST_FRAMES = 40
LEAST_FRAMES = 3
FRAMES_PER_SECOND = 8
DPI = 100
PIXELS = (200, 600)
"""Rows and columns of the pictures in a frame."""
MARGIN = 0.1
"""Time shown before and after a melt pool, over its life."""


def animate_run(folder: RunOrFolder, *, format: Format = "gif") -> Path:
    """Write an animation of a run to `figures/animation.gif` or `.mp4`.

    Of a train of pulses with pauses the last pulse is shown.

    Args:
        folder: a run, or its folder; the run has at least 3 snapshots and is in the plane, or in
            3-D an ablation or a surface that moves.
        format: "gif", or "mp4" where ffmpeg is installed.

    Returns:
        The file written.

    Raises:
        OutputError: no run there, too few snapshots, not in the plane, no ffmpeg, or the file
            cannot be written.
    """
    from matplotlib.animation import FFMpegWriter, PillowWriter

    # Refuse what cannot be animated before a file appears.
    run = last_pulse(open_run(folder))
    check_snapshots(run)
    if format == "mp4" and not FFMpegWriter.isAvailable():
        raise OutputError("mp4 needs the program ffmpeg, which is not here: take --format gif")
    target = run.path / "figures" / f"animation.{format}"
    # The file appears under its name when it is whole.
    with clear_errors("write", target):
        target.parent.mkdir(exist_ok=True)
        partial = target.with_name(f"unfinished-{target.name}")
        movie: Any = PillowWriter if format == "gif" else FFMpegWriter
        writer = movie(fps=FRAMES_PER_SECOND)
        pictures = frames(run)
        figure = next(pictures)
        with writer.saving(figure, str(partial), DPI):
            writer.grab_frame()
            for _ in pictures:
                writer.grab_frame()
        partial.replace(target)
    return target


def check_snapshots(run: Run) -> None:
    """Raises OutputError where there is nothing to animate."""
    if len(run.snapshots) < LEAST_FRAMES:
        raise OutputError(
            f"{run.path} has {len(run.snapshots)} snapshots; an animation needs {LEAST_FRAMES}"
        )
    if run.snapshots.dimension == 3 and (has_ablation(run) or has_maps(run)):
        return
    if run.snapshots.dimension != 2:
        raise OutputError(
            f"{run.path} is no plane run: only those are animated, and surfaces of melt in 3-D"
        )


def frames(run: Run) -> Iterator[Figure]:
    """One figure again and again, each time with another state."""
    times = frame_times(run)
    if has_ablation(run):
        yield from crater_frames(run, times)
        return
    if has_maps(run):
        yield from surface_frames(run, times)
        return
    # Scales and panels of the first frame hold for all.
    scene = scene_of(run, times)
    figure, axes = style.new_figure(height=scene.height)
    axes[0].remove()
    for k, time in enumerate(times):
        show = scene.redraw if k else scene.draw
        show(figure, plane_flow(run, float(time)))
        yield figure


@dataclass(frozen=True)
class Scene:
    """The part of a picture that stays the same over all frames.

    Attributes:
        frame: part of the plane that is shown [m].
        temperatures: of the color scale [K]; None: not drawn, as it is the same everywhere.
        fastest: speed at the end of the color scale [m/s]; 0: not drawn.
        is_beside: panels beside each other instead of above each other.
    """

    frame: Box
    temperatures: tuple[float, float] | None
    fastest: float
    is_beside: bool

    @property
    def panels(self) -> int:
        """Number of panels."""
        return (self.temperatures is not None) + (self.fastest > 0.0)

    @property
    def height(self) -> float:
        """Height of the figure [inch]; even numbers of pixels, which mp4 wants."""
        if self.is_beside:
            height = beside_height(self.frame, self.panels)
        else:
            shape = drawn_shape(self.frame)
            height = self.panels * (MAP_WIDTH * shape + 0.55) + 0.4
        # Two pixels at a time, since mp4 refuses odd numbers.
        return 2.0 * round(0.5 * height * DPI) / DPI

    def draw(self, figure: Figure, flow: PlaneFlow) -> None:
        """Draw the first state and fix where the panels lie."""
        # Panels, pictures and arrows of the first state.
        layout = (1, self.panels) if self.is_beside else (self.panels, 1)
        all_axes = list(figure.subplots(*layout, squeeze=False).ravel())
        unit, picture = frame_unit(self.frame), raster(flow, self.frame, PIXELS)
        if self.temperatures is not None:
            draw_temperature(all_axes[0], picture, unit, self.temperatures)
        if self.fastest > 0.0:
            draw_speed(all_axes[-1], picture, unit, self.fastest)
            self.draw_arrows(all_axes[-1], flow)
        exaggeration = 1.0 if self.is_beside else exaggeration_of(1.0 / shape_of(self.frame))
        finish(figure, all_axes, flow, self.frame, unit, exaggeration)
        # Later frames replace pictures only: the places of the panels must not move.
        figure.draw_without_rendering()
        figure.set_layout_engine(None)

    def redraw(self, figure: Figure, flow: PlaneFlow) -> None:
        """Show another state in the panels of the first."""
        panels = figure.axes[: self.panels]
        picture = raster(flow, self.frame, PIXELS)
        if self.temperatures is not None:
            panels[0].images[0].set_data(picture.temperature())
        if self.fastest > 0.0:
            speed = picture.speed() * style.speed_unit(self.fastest).factor
            # New values in the images of the first frame, new arrows in place of the old ones.
            for image, values in zip(panels[-1].images, (picture.metal(), speed), strict=True):
                image.set_data(values)
            for arrows in list(panels[-1].collections):
                arrows.remove()
            self.draw_arrows(panels[-1], flow)
        figure.suptitle(style.time_text(flow.time), fontsize=10)

    def draw_arrows(self, axes: Axes, flow: PlaneFlow) -> None:
        """Arrows where anything flows."""
        if np.any(flow.flows):
            count = BOX_ARROWS if self.is_beside else ARROWS
            draw_arrows(axes, flow, self.frame, frame_unit(self.frame), self.fastest, count)


def scene_of(run: Run, times: np.ndarray) -> Scene:
    """The scene that all frames of a run share."""
    # What is shown: all of a box, the pool with its rim, or the heated part of a body.
    middle = plane_flow(run, float(times[len(times) // 2]))
    history = run.history
    if is_box(run):
        frame = body_frame(middle)
    elif np.any(history.get("melt_depth_any_m", np.zeros(1)) > 0.0):
        frame = pool_frame(run, middle)
    else:
        left, right, _, _ = middle.cells.frame
        frame = Box(left, right, -shown_depth(run, middle.step), 0.0)

    # Ends of the color scales over the whole run.
    fastest = float(np.max(history["flow_speed_max_m_s"])) if has_flow(run) else 0.0
    shown = times if is_box(run) else times[:1]  # a pool's body is coldest at first
    coldest = min(float(np.min(run.snapshots.nearest(t)["temperature"])) for t in shown)
    hottest = float(np.max(history["temperature_max_K"]))
    varies = hottest - coldest > LEAST_SPREAD * hottest
    temperatures = (coldest, hottest) if varies or fastest == 0.0 else None
    return Scene(frame, temperatures, fastest, is_box(run) and are_beside(frame))


def frame_times(run: Run) -> np.ndarray:
    """Times of the snapshots that are shown: of a melt pool those of its life, else all [s]."""
    times = run.snapshots.times
    if not is_box(run) and not has_ablation(run):
        history = run.history
        # A pool lives for a small part of its run.
        wet = history["time_s"][history.get("melt_depth_any_m", np.zeros(1)) > 0.0]
        if wet.size:
            margin = MARGIN * (wet[-1] - wet[0])
            alive = times[(times >= wet[0] - margin) & (times <= wet[-1] + margin)]
            times = alive if alive.size >= LEAST_FRAMES else times
    # Frames at even numbers of snapshots.
    if times.size <= MOST_FRAMES:
        return times
    return times[np.round(np.linspace(0.0, times.size - 1.0, MOST_FRAMES)).astype(int)]
