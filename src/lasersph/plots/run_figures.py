"""All figures of one run, drawn from its folder into `figures/`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from lasersph.output import OutputError, Run, open_run
from lasersph.output.errors import clear_errors
from lasersph.plots import history, style
from lasersph.plots.arrangement import arrangement
from lasersph.plots.particle_map import particle_map
from lasersph.plots.surface_profiles import surface_profiles

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Drawing(NamedTuple):
    """A figure of a run: name of its file, caption, what draws it (None: does not apply)."""

    name: str
    caption: str
    draw: Callable[[Run], Figure | None]


def draw_arrangement(run: Run) -> Figure | None:
    """The particles as they lay at the start."""
    return arrangement(run.snapshots[0]) if len(run.snapshots) else None


DRAWINGS = (
    Drawing(
        "temperature",
        "Temperature over time. The shade at the foot is the power of the incident light; dashed"
        " lines mark the melting range and the vaporization temperature.",
        history.temperature_history,
    ),
    Drawing(
        "melt-pool",
        "Size of the melt pool over time: full width at the surface and depth below the original"
        " surface, for completely fluid, half molten and any molten material. Each size is drawn"
        " once, in the middle of the time for which it stood.",
        history.melt_pool_history,
    ),
    Drawing(
        "surface-profiles",
        "Temperature along the surface at several times.",
        surface_profiles,
    ),
    Drawing(
        "particles",
        "Temperature and melt fraction of the particles near the surface, at the snapshot closest"
        " to the deepest melt (without melt: to the largest temperature).",
        particle_map,
    ),
    Drawing(
        "energy",
        "Where the absorbed energy is (above), and the relative error of the energy balance"
        " (below).",
        history.energy_history,
    ),
    Drawing(
        "time-step",
        "Time step, colored by what limited it, and iterations of each step.",
        history.time_step_history,
    ),
    Drawing(
        "arrangement",
        "Particles as they lay at the start: the whole body, and a detail at the surface.",
        draw_arrangement,
    ),
)


def draw_run(folder: str | Path, *, kind: str = "png") -> list[Path]:
    """Draw all figures of a run into its folder `figures`.

    Args:
        folder: the run folder.
        kind: "png", "svg" or "pdf".

    Returns:
        The files written, in reading order.

    Raises:
        OutputError: the folder is no run folder, has no history yet, or cannot be written.
    """
    run = open_run(folder)
    if len(run.history.get("time_s", ())) < 2:
        raise OutputError(f"{run.path} has no history to draw yet")
    target = run.path / "figures"
    written = []
    with clear_errors("write", target):
        target.mkdir(exist_ok=True)
        for drawing in DRAWINGS:
            figure = drawing.draw(run)
            if figure is not None:
                written.append(style.save(figure, target / f"{drawing.name}.{kind}"))
    return written
