"""The pictures of a run as files in its folder: all figures, and the animation."""

from __future__ import annotations

from pathlib import Path

from lasersph.output import Run, RunOrFolder
from lasersph.output.errors import clear_errors
from lasersph.output.last_pulse import last_pulse
from lasersph.plots import style
from lasersph.plots.animation import animate_run
from lasersph.plots.drawing_processes import DrawingProcesses, Picture
from lasersph.plots.run_figures import Begun, captions, figure_of, with_history

ANIMATION = "animation"
"""Name of the animation among the pictures."""


def draw_run(
    folder: RunOrFolder,
    *,
    kind: str = "png",
    begun: Begun | None = None,
    others: DrawingProcesses | None = None,
) -> list[Path]:
    """Draw all figures of a run into its folder `figures`; `plot` gives one of them.

        lasersph.draw_run("runs/dlip-steel", kind="svg")

    Args:
        folder: a run, or its folder. kind: "png", "svg" or "pdf".
        begun: called before each drawing: name, how many are drawn, of how many.
        others: processes that draw as well; if not given, this one draws all of them.

    Returns:
        The files written, in reading order.

    Raises:
        OutputError: the folder is no run folder, has no history yet, or cannot be written.
    """
    return draw_pictures(folder, list(captions()), kind=kind, begun=begun, others=others)


def draw_pictures(
    folder: RunOrFolder,
    names: list[str],
    *,
    kind: str = "png",
    begun: Begun | None = None,
    others: DrawingProcesses | None = None,
) -> list[Path]:
    """Draw pictures of a run by name, of figures and the animation, those first that take longest.

    Args:
        folder, kind, begun, others: as of `draw_run`.

    Returns:
        The files written, in the order of their names.

    Raises:
        OutputError: as `draw_run`.
    """
    run = with_history(folder)
    shown = last_pulse(run)
    target = run.path / "figures"
    pictures = [Picture(str(run.path.resolve()), name, kind) for name in names]

    def draw(picture: Picture) -> Path | None:
        if begun is not None:
            begun(picture.name, pictures.index(picture), len(pictures))
        return draw_picture(run, shown, picture.name, kind)

    with clear_errors("write", target):
        target.mkdir(exist_ok=True)
        # The animation takes as long as several figures: whoever draws it begins with it.
        first = sorted(pictures, key=lambda picture: picture.name != ANIMATION)
        if others is None:
            files = {picture: draw(picture) for picture in first}
        else:
            files = others.draw(first, draw)
    found = (files[picture] for picture in pictures)
    return [target / file.name for file in found if file is not None]


def draw_picture(run: Run, shown: Run, name: str, kind: str) -> Path | None:
    """Draw a figure of a run by name, or its animation, into its folder `figures`.

    Args:
        shown: the last pulse of the run. kind: of the file of a figure.

    Returns:
        The file; None where the run has nothing of what it shows.
    """
    if name == ANIMATION:
        return animate_run(run)
    figure = figure_of(run, shown, name)
    return None if figure is None else style.save(figure, run.path / "figures" / f"{name}.{kind}")
