"""The relief of a surface that moves, from surface.vtkhdf: profiles, the section below, a map.

Of several pulses they show the last one, as pauses are a million times as long as the melt lasts;
one figure has the relief after each.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from lasersph.input import format_quantity
from lasersph.output import Run, RunOrFolder, open_run
from lasersph.output.last_pulse import last_pulse
from lasersph.plots import style
from lasersph.plots.curves import draw_columns
from lasersph.plots.particle_map import cells_of_cut
from lasersph.plots.pulses import pulses_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PROFILES = 7
SECTION = 1.6
"""The section is shown this many times as deep as the melt was, or as the relief is."""


def lines_of(run: Run) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times (t,) [s], places (columns,) and heights (t, columns) [m]; half a period is mirrored."""
    places = run.surface.series("position")
    x = np.array(places[0][0])
    height = np.array([place[1] for place in places])
    # The mirror image comes first, so that x grows.
    if run.symmetry_factor == 2:
        x, height = np.concatenate([-x[::-1], x]), np.hstack([height[:, ::-1], height])
    return run.surface.times, x, height


def has_lines(run: Run) -> bool:
    """Whether the run has lines of a surface over x; a surface over x and y has maps."""
    return len(run.surface) > 0 and run.surface.dimension == 2


def relief_after_pulses(run: RunOrFolder) -> Figure | None:
    """The surface as it froze after 1, 2, 5, 10 ... pulses; None unless a pause was left out."""
    run = open_run(run)
    pulses = pulses_of(run)
    if len(pulses) < 2 or len(run.surface) < 2 or not has_lines(run):
        return None
    _, x, _ = lines_of(run)
    # Each pulse leaves its last line behind.
    height = np.array([lines_of(pulse)[2][-1] for pulse in pulses.values()])
    words = ["1 pulse" if count == 1 else f"{count} pulses" for count in pulses]
    return profiles_figure(x, height, words, run.across)


def relief_profiles(run: RunOrFolder) -> Figure | None:
    """The surface at several times while it moves; None in a run whose surface is flat."""
    run = open_run(run)
    if len(run.surface) < 2 or not has_lines(run):
        return None
    times, x, height = lines_of(last_pulse(run))
    # From the first motion of the surface to the last, at even numbers of snapshots.
    moves = np.flatnonzero(np.any(np.diff(height, axis=0), axis=1))
    first, last = (moves[0], moves[-1] + 1) if moves.size else (0, times.size - 1)
    shown = np.unique(np.linspace(first, last, PROFILES).round().astype(int))
    words = [format_quantity(float(time), "s", typographic=True) for time in times[shown]]
    return profiles_figure(x, height[shown], words, run.across)


def profiles_figure(
    x: np.ndarray, height: np.ndarray, words: Sequence[str], across: str = "x"
) -> Figure:
    """Heights (profiles, columns) [m] over places (columns,) [m], each with its words."""
    figure, (axes,) = style.new_figure(height=3.6)
    length = style.fitting_unit("m", np.max(np.abs(x)))
    up = style.fitting_unit("m", largest(height))
    colors = style.color_scale("viridis", len(words))
    for profile, color, text in zip(height, colors, words, strict=True):
        axes.plot(x * length.factor, profile * up.factor, lw=1.2, color=color, label=text)
    axes.set_xlim(x[0] * length.factor, x[-1] * length.factor)
    style.label(axes, f"{across} [{length.name}]", f"height of the surface [{up.name}]")
    style.legend_above(figure, axes, columns=7)
    return figure


def relief_map(run: RunOrFolder) -> Figure | None:
    """Height of the surface over place and time; None where it stays flat."""
    run = open_run(run)
    if len(run.surface) < 3 or not has_lines(run):
        return None
    times, x, height = lines_of(last_pulse(run))
    length, time = style.fitting_unit("m", np.max(np.abs(x))), style.fitting_unit("s", times[-1])
    up = style.fitting_unit("m", largest(height))
    figure, (axes,) = style.new_figure(height=3.6)
    axes.grid(False)
    # Zero in the middle of the colors: pits and rims are told apart.
    limit = largest(height) * up.factor
    image = axes.pcolormesh(
        x * length.factor,
        times * time.factor,
        height * up.factor,
        cmap="RdBu_r",
        vmin=-limit,
        vmax=limit,
        shading="nearest",
        rasterized=True,
    )
    style.label(axes, f"{run.across} [{length.name}]", f"time [{time.name}]")
    style.color_bar(axes, image, f"height of the surface [{up.name}]")
    return figure


def final_relief(run: RunOrFolder) -> Figure | None:
    """The surface at the end over the particles, which tell how far each has ever been molten."""
    run = open_run(run)
    if not has_lines(run) or not len(run.snapshots):
        return None

    # particles are laid out anew in a pause: what lies where since then
    snapshots = last_pulse(run).snapshots
    fractions = snapshots.series("melt_fraction")
    if any(fraction.size != fractions[-1].size for fraction in fractions):
        return None

    # How far each particle has ever been molten, over the last pulse.
    molten, last = np.max(fractions, axis=0), snapshots[-1]
    _, x, height = lines_of(run)

    # Down to somewhat below the deepest melt.
    surface = height[-1]
    deepest = -np.min(np.where(molten > 0.5, last["position"][1], 0.0))
    depth = SECTION * max(deepest, largest(surface))
    cells = cells_of_cut(last, depth)
    cells = cells.mirrored() if run.symmetry_factor == 2 else cells
    unit = style.fitting_unit("m", np.max(np.abs(x)))
    figure, (axes,) = style.new_figure(height=3.2)

    # The metal as pixels, the surface as a line over it.
    picture = cells.picture()
    values = np.where(picture < 0, np.nan, molten[picture])
    image = style.paint(
        axes,
        values,
        cells.frame,
        unit,
        across=run.across,
        cmap=style.FRACTION_COLORS,
        vmin=0.0,
        vmax=1.0,
    )
    style.color_bar(axes, image, "largest melt fraction [1]")
    axes.plot(x * unit.factor, surface * unit.factor, color=style.COLORS[1], lw=1.6)
    axes.axhline(0.0, color=style.GRAY, lw=0.8, ls="--")
    axes.set_aspect("auto")
    axes.set_ylim(
        -depth * unit.factor, 1.5 * max(float(np.max(surface)), 0.1 * depth) * unit.factor
    )
    axes.set_title(style.time_text(last["time"]), fontsize=10, loc="left")
    return figure


def largest(height: np.ndarray) -> float:
    """Largest distance of a surface from z = 0 [m]; of a flat one a nanometer."""
    return float(np.max(np.abs(height))) or 1e-9


def topography_history(run: RunOrFolder) -> Figure | None:
    """Depth and rim over time, and mean heights of the profile or of the area; None where the
    surface is flat."""
    run = open_run(run)
    if not np.any(run.history.get("topography.peak_to_valley_m", 0.0)):
        return None
    figure, all_axes = style.new_figure(2, height=4.6, share_x=True)
    extremes = {
        "topography.depth_m": "depth of the lowest point",
        "topography.rim_height_m": "height of the rim",
    }
    draw_columns(all_axes[0], run, extremes, label="distance")
    letter = "S" if "topography.Sa_m" in run.history else "P"
    means = {f"topography.{letter}{one}_m": f"{letter}{one}" for one in "aq"}
    draw_columns(all_axes[1], run, means, label="mean height")
    for axes in all_axes:
        style.legend(axes)
    return figure
