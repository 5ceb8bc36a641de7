"""`lasersph info`, `plot`, `report`, `export`: what a run folder holds."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from lasersph.cli.arguments import RunFolder, Settings, read_quantity
from lasersph.cli.drawing import drawing_processes
from lasersph.cli.failures import WrongCommand
from lasersph.cli.sparkline import sparkline
from lasersph.input.text_table import text_table

if TYPE_CHECKING:
    from lasersph.output import Run

Kind = Annotated[Literal["png", "svg", "pdf"], typer.Option("--kind", help="Of the files.")]

SHOWN_OF_LIGHT = ("pattern", "fluence of a pulse", "spot", "pulse energy", "fluence at its center")
"""Rows about the light that stand above its maps."""
Animate = Annotated[
    bool,
    typer.Option("--animate", help="Write an animation of temperature and speed instead."),
]
Format = Annotated[Literal["gif", "mp4"], typer.Option(help="Of the animation; mp4 needs ffmpeg.")]
Scene = Annotated[
    bool, typer.Option("--scene", help="Draw a 3-D crater with pyvista instead (extra `view`).")
]
NoScene = Annotated[
    bool,
    typer.Option("--no-scene", help="Leave out the viewer and its particles, at most 5 MB."),
]
Beams = Annotated[
    bool,
    typer.Option("--beams", help="Draw the fluence of a case's light: DIR is the case instead."),
]
ExportFormat = Annotated[
    Literal["csv", "stl", "ply", "x3p", "sdf"],
    typer.Option(
        help="csv: x, y, z in m; stl, ply: triangles in um, of 3-D runs; x3p, sdf: surface "
        "metrology (ISO 25178-72, -71)."
    ),
]
Revolve = Annotated[
    bool, typer.Option("--revolve", help="Write the body of a section (r, z) for ParaView instead.")
]
At = Annotated[
    str | None,
    typer.Option("--at", metavar="TIME", help="Take the closest snapshot; default: the last."),
]


def info(folder: RunFolder) -> None:
    """Show what a run folder holds: the case, how far it is, the main numbers."""
    from lasersph.input import format_quantity
    from lasersph.report.headline import light_text
    from lasersph.report.summary_text import warning_texts
    from lasersph.report.tables import summary_rows

    # What holds of every run: its case and its light.
    found = opened(folder)
    computed = found.summary.get("laser") if found.is_complete else None
    words = light_text(found.case.get("laser") or {}, computed).strip().rstrip(",")
    light = [("light", words)] if words else []
    # A complete run has its numbers.
    if found.is_complete:
        rows = summary_rows(found.summary, found.uncertainty)
        _print_tables([rows[0], *light, *rows[1:]], _curves(found))
        _print_warnings(warning_texts(found.summary, found.events))
        _print_note_on_older(found)
        print(f"{folder}: complete")
        return
    # One that is not has come to some time of its end.
    times = [float(time) for time in found.history.get("time_s", ())]
    end = format_quantity(float(found.case["time"]["end"]), "s")
    now = format_quantity(times[-1] if times else 0.0, "s")
    known = [("case", found.case["title"]), *light, ("history", f"up to {now} of {end}")]
    _print_tables(known, _curves(found))
    _print_warnings(warning_texts(None, found.events))
    _print_note_on_older(found)
    print(f"{folder}: not complete; continue it with lasersph run {folder}/ --resume")


def _print_tables(numbers: list[tuple[str, str]], curves: list[tuple[str, str]]) -> None:
    """Numbers and curves, whose names are short: a column of their own keeps them on their line."""
    print(text_table(numbers))
    if curves:
        print(text_table(curves))


def _print_warnings(texts: Sequence[str]) -> None:
    for text in texts:
        print(f"warning: {text}")


def _print_note_on_older(run: Run) -> None:
    if run.note_on_older is not None:
        print(f"note: {run.note_on_older}")


def _curves(run: Run) -> list[tuple[str, str]]:
    """Temperature and depth of the melt over time, each as a line of characters."""
    from lasersph.input import format_quantity
    from lasersph.output.last_pulse import last_pulse

    # Of a train of pulses only the last shows more than strokes.
    shown = last_pulse(run)
    history, number = shown.history, "" if shown is run else ", last pulse"
    curves = {"temperature over time": ("temperature_max_K", "K")}
    curves["melt depth over time"] = ("melt_depth_half_m", "m")
    rows = []
    # Nothing is drawn of what never was above zero.
    for name, (column, unit) in curves.items():
        values = [float(value) for value in history.get(column, ())]
        if values and max(values) > 0.0:
            line = sparkline([float(time) for time in history["time_s"]], values)
            rows.append((name + number, f"{line} up to {format_quantity(max(values), unit)}"))
    return rows


def plot(
    folder: RunFolder,
    kind: Kind = "png",
    animate: Animate = False,
    format: Format = "gif",
    scene: Scene = False,
    beams: Beams = False,
    settings: Settings = None,
) -> None:
    """Draw the figures of a run into DIR/figures, or an animation or a 3-D scene of it."""
    from lasersph.plots import animate_run, crater_scene, draw_run

    # A case has light before it has a run.
    if beams:
        print(_draw_beams(str(folder), settings or (), kind))
        return
    if settings:
        raise WrongCommand("--set changes a case and belongs to --beams")
    run = opened(folder)
    # A scene or an animation instead of the figures.
    if scene:
        target = run.path / "figures" / "crater-scene.png"
        target.parent.mkdir(exist_ok=True)
        print(crater_scene(run, target))
        return
    if animate:
        print(animate_run(folder, format=format))
        return
    with drawing_processes() as others:
        others.begin()
        for file in draw_run(folder, kind=kind, others=others):
            print(file)


def _draw_beams(name: str, settings: Sequence[str], kind: str) -> Path:
    """Draw the fluence of a pulse of a case into NAME-beams.KIND here."""
    from lasersph.case import load_case
    from lasersph.lasers.fluence_map import fluence_maps
    from lasersph.plots import style
    from lasersph.plots.fluence import fluence_figure
    from lasersph.simulation.light_text import light_rows

    case = load_case(name, settings)
    if case.laser is None:
        raise WrongCommand(f"{name} has no laser")
    # Not every beam has a finite picture.
    try:
        maps = fluence_maps(case.laser)
    except ValueError as error:
        raise WrongCommand(f"{name}: {error}") from None
    rows = [f"{key}: {text}" for key, text in light_rows(case.laser) if key in SHOWN_OF_LIGHT]
    return style.save(fluence_figure(maps, "\n".join(rows)), Path(f"{case.name}-beams.{kind}"))


def report(folder: RunFolder, no_scene: NoScene = False) -> None:
    """Write DIR/report.html: viewer, figures and numbers on one self-contained page."""
    from lasersph.report import write_report

    opened(folder)
    with drawing_processes() as others:
        others.begin()
        print(write_report(folder, with_scene=not no_scene, others=others))


def opened(folder: Path) -> Run:
    """The run in a folder; a folder without one is a wrong command."""
    from lasersph.output import OutputError, open_run

    try:
        return open_run(folder)
    except OutputError as error:
        raise WrongCommand(str(error)) from None


def export(
    folder: RunFolder, format: ExportFormat = "csv", at: At = None, revolve: Revolve = False
) -> None:
    """Write the surface of a crater or a relief as CSV, STL, PLY, X3P or SDF.

    A crater goes to DIR/crater.FORMAT, a surface that moved to DIR/surface-profile.FORMAT: its
    profile, as STL or PLY extruded along the lines by its width; where half a period was computed,
    the mirror image belongs to it. The height of a texture goes to DIR/height.FORMAT. With
    --revolve a section (r, z) goes to DIR/body.vtkhdf for ParaView, as the body that it stands for.
    """
    from lasersph.output import OutputError
    from lasersph.output.export import export as write_surface

    time = None if at is None else read_quantity("--at", at, "time")
    try:
        print(write_surface(folder, format, at=time, revolve=revolve))
    except OutputError as error:
        raise WrongCommand(str(error)) from None
